#include "run/expected.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "run/engines.hpp"
#include "signorini/error.hpp"

namespace signorini {
namespace {

/// Rounds to one digit: the value is an order of magnitude.
double rough(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)));
  return std::round(value / unit) * unit;
}

RunSpec by_exact(RunSpec run) {
  run.engine = engine_for(EngineRole::closed_form);
  return run;
}

}  // namespace

Expected expected(const Model& model, const RunSpec& run, const Method& method) {
  Expected result;
  for (const Dof& dof : model.dofs) result.unknowns += dof.massless ? 1 : 2;
  result.unknowns += 2 * static_cast<long>(model.contacts.size());
  result.omega_max = model.omega_max;
  for (const Load& load : model.loads)
    for (const Piece& piece : load.history.pieces())
      if (piece.amplitude != 0.0) result.omega_max = std::max(result.omega_max, piece.omega);
  if (result.omega_max > 0.0)
    result.effort = engine_row(method.engine).effort({model, run, method, result.omega_max, result.unknowns});
  return result;
}

Expected expected(const Model& model, const RunSpec& run) {
  return expected(model, run, engine_row(run.engine).method(model, run));
}

bool exact_takes(const Model& model, const RunSpec& run) {
  if (!std::all_of(model.contacts.begin(), model.contacts.end(),
                   [](const Contact& contact) { return contact.obeys_coulomb(); }))
    return false;
  try {
    const RunSpec exact = by_exact(run);
    engine_row(exact.engine).refuse(model, exact);
  } catch (const SceneError&) {
    return false;
  }
  return true;
}

std::optional<double> exact_instead(const Model& model, const RunSpec& run) {
  if (engine_row(run.engine).role != EngineRole::integrator || !exact_takes(model, run)) return std::nullopt;
  const Effort effort = expected(model, by_exact(run)).effort;
  return effort.seconds > 0.0 ? std::optional(effort.seconds) : std::nullopt;
}

std::string about_seconds(double seconds) {
  return seconds < 0.1 ? "less than 0.1" : fmt::format("about {:g}", rough(seconds));
}

}  // namespace signorini
