#include "run/refusals.hpp"

#include <fmt/core.h>

#include "contact/friction.hpp"
#include "engine/exact/exact_engine.hpp"

namespace signorini {
namespace {

[[noreturn]] void refuse(const RunSpec& run, const std::string& what) {
  throw SceneError(run.place, "run.engine", fmt::format("engine \"{}\" {}", to_string(run.engine), what));
}

/// A series has to reach the end of every polynomial in the forcing.
void refuse_long_polynomials(const Model& model, const RunSpec& run) {
  const auto check = [&](const History& history, const std::string& what) {
    for (const Piece& p : history.pieces())
      for (std::size_t j = most_levels - 1; j < p.coefficients.size(); ++j)
        if (p.coefficients[j] != 0.0)
          refuse(run, fmt::format("takes polynomials up to degree {}; {} has degree {} or more",
                                  most_levels - 2, what, j));
  };
  for (const Load& load : model.loads) check(load.history, load.name);
  for (const Contact& contact : model.contacts) {
    check(contact.normal_force, "normal_force of contact '" + contact.name + "'");
    check(contact.surface_motion, "the surface of contact '" + contact.name + "'");
  }
}

}  // namespace

const char* to_string(Engine engine) {
  switch (engine) {
    case Engine::automatic:
      return "auto";
    case Engine::ida:
      return "ida";
    case Engine::newmark:
      return "newmark";
    case Engine::friction_iteration:
      return "friction-iteration";
    case Engine::exact:
      return "exact";
  }
  return "?";
}

void refuse_what_engine_cannot(const Model& model, const RunSpec& run) {
  if (run.engine == Engine::ida) return;
  for (const Contact& contact : model.contacts) {
    if (friction_varies(contact))
      refuse(run,
             fmt::format("needs laws that are linear, and the friction of contact '{}' depends on its slip "
                         "rate (stribeck_velocity); use \"ida\"",
                         contact.name));
    // What iterates on friction takes no impulses.
    if (run.engine == Engine::friction_iteration && contact.takes_impulses())
      refuse(run, fmt::format("needs contact elements, and contact '{}' is rigid; use \"newmark\" or law = "
                              "\"compliant\"",
                              contact.name));
  }
  if (run.engine == Engine::exact) refuse_long_polynomials(model, run);
}

}  // namespace signorini
