#include "run/choose_engine.hpp"

#include <fmt/core.h>
#include <algorithm>

#include "engine/exact/modal/damped_system.hpp"
#include "engine/exact/modal/modal_system.hpp"
#include "model/slip_growth.hpp"
#include "run/cost_estimate.hpp"
#include "run/engines.hpp"
#include "signorini/error.hpp"

namespace signorini::run {
namespace {

/// Limit of (fastest decay) / (fastest oscillation) for engine exact; see choose_engine.hpp.
constexpr double slow = 0.2;

}  // namespace

EngineChoice choose_engine(const Model& model, const RunSpec& run) {
  if (run.engine != Engine::automatic) return {run.engine, false, "as given"};
  const Engine closed_form = engine_for(EngineRole::closed_form),
               integrator = engine_for(EngineRole::integrator);
  if (!exact_accepts(model, run))
    return {integrator, true, "a law or a load of the scene has no closed-form solution"};
  const double decay = model::fastest_decay(model), oscillation = std::max(model.omega_max, 1.0 / run.t_end);
  if (decay > slow * oscillation)
    return {integrator, true,
            fmt::format("the fastest decay, {:.3g} 1/{}, is not slow compared with the fastest oscillation, "
                        "{:.3g} rad/{}",
                        decay, model.units.time, oscillation, model.units.time)};
  return {closed_form, true,
          "the laws are linear, and every decay is slow compared with the fastest oscillation"};
}

namespace {

constexpr int max_unknowns = 4000;  // limit of n, because mode shapes and their inverse take 16 n^2 bytes
// Least number of unknowns for modes: with fewer, the modes of a state cost more than the series (validation/exact). Chosen.
constexpr int min_unknowns = 16;

// Least number of unknowns for complex modes: with fewer, the series costs less (validation/exact). Chosen value.
constexpr int min_damped_unknowns = 40;
// Complex modes of all states are chosen only if the series costs at least this many times as much.
constexpr double worth = 2.0;
// Limit of the number of unknowns n for complex modes: those of a state take 120 n^2 bytes, and 5 s for n = 500.
constexpr int max_damped_unknowns = 500;

bool has_rigid_rows(const Model& model) {
  return std::any_of(model.contacts.begin(), model.contacts.end(), [](const Contact& contact) {
    return contact.takes_impulses() || contact.sticks_rigidly();
  });
}

}  // namespace

bool damped_modes_are_faster(const Model& model) {
  return model.size() >= min_damped_unknowns && !has_rigid_rows(model);
}

ModalKind modal_kind(const Model& model) {
  const std::string why = modal::proportional_refusal(model);
  if (model.size() > max_unknowns) return {false, false, "too many unknowns to store their modes"};
  if (why.empty()) return {false, modal::max_state_springs(model) > modal::max_rank, ""};
  if (std::string other = modal::damped_refusal(model); !other.empty()) return {true, false, other};
  return {true, modal::max_state_terms(model) > modal::max_damped_terms,
          model.size() > max_damped_unknowns ? why + ", and too many unknowns for complex modes" : ""};
}

namespace {

/// Choice between modes and series for a scene that modes can compute.
FlowChoice cheaper_flow(const Model& model, const RunSpec& run, const ModalKind& kind) {
  if (model.size() < min_unknowns)
    return {false, "auto: the scene has so few unknowns that the series is as fast as modes"};
  if (kind.too_many_springs)
    return {
        false,
        "auto: with this many contacts, computing the modes of each contact state costs more than it saves"};
  if (!kind.damped) return {true, "auto: modes can compute the whole scene"};
  // Complex modes also break the symmetry of a structure on rigid contacts: feet that land together land at slightly
  // different times.
  if (has_rigid_rows(model))
    return {false, "auto: hits of rigid contacts excite the whole mesh, so complex modes save no time"};
  if (!damped_modes_are_faster(model) ||
      worth * seconds_of_damped_states(model) > seconds_of_series(model, run))
    return {false, "auto: the complex modes of the contact states would cost as much as the series"};
  return {true, "auto: complex modes can compute the whole scene"};
}

}  // namespace

FlowChoice choose_flow(const Model& model, const RunSpec& run) {
  if (run.flow == Flow::taylor) return {false, "as given"};
  const ModalKind kind = modal_kind(model);
  const std::string& why = kind.objection;
  if (run.flow == Flow::automatic) {
    if (!why.empty()) return {false, fmt::format("auto: series, because the scene has {}", why)};
    return cheaper_flow(model, run, kind);
  }
  if (!why.empty())
    throw SceneError(run.place, "run.flow",
                     fmt::format("\"modal\" cannot compute a scene that has {}; use \"taylor\"", why));
  return {true, kind.damped ? "as given: complex modes" : "as given"};
}

}  // namespace signorini::run
