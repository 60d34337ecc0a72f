#include "run/choose_flow.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "engine/exact/modal/damped_system.hpp"
#include "engine/exact/modal/modal_system.hpp"
#include "run/effort.hpp"
#include "signorini/error.hpp"

namespace signorini {
namespace {

constexpr int most_unknowns = 4000;  // shapes and their inverse take 16 n^2 bytes
constexpr int fewest_unknowns =
    16;  // below, a state's modes cost more than the series (validation/exact); chosen

constexpr int most_damped_unknowns = 500;  // a state's complex modes take 120 n^2 bytes and some 5 s there
constexpr double clear_gain = 2.0;         // of what the series costs, over complex modes of all states

}  // namespace

ModalKind modal_kind(const Model& model) {
  const std::string why = proportional_refusal(model);
  if (model.size() > most_unknowns) return {false, "more unknowns than modes are kept of"};
  if (why.empty()) return {};
  if (std::string other = damped_refusal(model); !other.empty()) return {true, other};
  return {true, model.size() > most_damped_unknowns ? why + ", with so many unknowns" : ""};
}

FlowChoice choose_flow(const Model& model, const RunSpec& run) {
  if (run.flow == Flow::taylor) return {false, "as given"};
  const auto [damped, why] = modal_kind(model);
  if (run.flow == Flow::automatic) {
    if (!why.empty()) return {false, fmt::format("auto: modes cannot follow {}", why)};
    if (model.size() < fewest_unknowns) return {false, "auto: few unknowns, for which the series is as fast"};
    if (!damped) return {true, "auto: modes follow all of it"};
    if (seconds_of_series(model, run) < clear_gain * seconds_of_damped_states(model))
      return {false, "auto: the series is expected to cost less than complex modes"};
    return {true, "auto: complex modes follow all of it"};
  }
  if (!why.empty())
    throw SceneError(run.place, "run.flow",
                     fmt::format("\"modal\" cannot follow this scene: {}; use \"taylor\"", why));
  return {true, damped ? "as given: complex modes" : "as given"};
}

}  // namespace signorini
