#include "run/choose_engine.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "run/engines.hpp"
#include "signorini/error.hpp"

namespace signorini {
namespace {

/// Of the fastest oscillation: see choose_engine.hpp.
constexpr double slow = 0.2;

}  // namespace

double fastest_decay(const Model& model) {
  const Vector m = model.mass.diagonal();
  Vector c = model.damping.diagonal(), k = model.stiffness.diagonal();
  for (const Contact& contact : model.contacts) {
    for (const auto& [dof, n] : contact.normal.terms) {
      c[dof] += n * n * contact.normal_damping;
      k[dof] += n * n * contact.normal_stiffness;
    }
    for (const auto& [dof, t] : contact.tangent.terms)
      k[dof] += t * t * contact.tangential_stiffness.value_or(0.0);
  }
  double rate = model.alpha + model.beta * model.omega_max * model.omega_max;
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    if (m[i] > 0.0)
      rate = std::max(rate, c[i] / m[i]);
    else if (c[i] > 0.0)
      rate = std::max(rate, k[i] / c[i]);
  }
  return rate;
}

EngineChoice choose_engine(const Model& model, const RunSpec& run) {
  if (run.engine != Engine::automatic) return {run.engine, "as given"};
  try {
    engine_row(Engine::exact).refuse(model, run);
  } catch (const SceneError&) {
    return {Engine::ida, "auto: a law or a load of the scene has no closed flow"};
  }
  const double decay = fastest_decay(model), oscillation = std::max(model.omega_max, 1.0 / run.t_end);
  if (decay > slow * oscillation)
    return {Engine::ida,
            fmt::format("auto: the fastest decay, {:.3g} per unit of time, is not slow beside the "
                        "fastest oscillation, {:.3g}",
                        decay, oscillation)};
  return {Engine::exact, "auto: the laws are linear, and every decay is slow beside the fastest oscillation"};
}

}  // namespace signorini
