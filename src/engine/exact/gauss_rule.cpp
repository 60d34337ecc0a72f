#include "engine/exact/gauss_rule.hpp"

#include <gsl/gsl_integration.h>

#include <memory>

namespace signorini {
namespace {

GaussRule make_rule(std::size_t count) {
  GaussRule rule;
  rule.count = count;
  const std::unique_ptr<gsl_integration_glfixed_table, void (*)(gsl_integration_glfixed_table*)> table(
      gsl_integration_glfixed_table_alloc(count), gsl_integration_glfixed_table_free);
  for (std::size_t i = 0; i < count; ++i)
    gsl_integration_glfixed_point(0.0, 1.0, i, &rule.x[i], &rule.w[i], table.get());
  return rule;
}

}  // namespace

const GaussRule& gauss_rule() {
  static const GaussRule rule = make_rule(GaussRule::nodes);
  return rule;
}

const GaussRule& short_gauss_rule() {
  static const GaussRule rule = make_rule(GaussRule::nodes / 2);
  return rule;
}

}  // namespace signorini
