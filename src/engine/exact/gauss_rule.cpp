#include "engine/exact/gauss_rule.hpp"

#include <gsl/gsl_integration.h>

#include <memory>

namespace signorini {
namespace {

GaussRule make_rule() {
  GaussRule rule;
  const std::unique_ptr<gsl_integration_glfixed_table, void (*)(gsl_integration_glfixed_table*)> table(
      gsl_integration_glfixed_table_alloc(GaussRule::nodes), gsl_integration_glfixed_table_free);
  for (std::size_t i = 0; i < GaussRule::nodes; ++i)
    gsl_integration_glfixed_point(0.0, 1.0, i, &rule.x[i], &rule.w[i], table.get());
  return rule;
}

}  // namespace

const GaussRule& gauss_rule() {
  static const GaussRule rule = make_rule();
  return rule;
}

}  // namespace signorini
