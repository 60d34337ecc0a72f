#include "run/choose_flow.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "engine/exact/modal/modal_system.hpp"
#include "signorini/error.hpp"

namespace signorini {
namespace {

constexpr int most_unknowns = 4000;  // shapes and their inverse take 16 n^2 bytes
constexpr int fewest_unknowns =
    16;  // below, a state's modes cost more than the series (validation/exact); chosen

bool stands_still(const Piece& piece) {
  return !piece.function && piece.amplitude == 0.0 &&
         std::all_of(piece.coefficients.begin(), piece.coefficients.end(),
                     [&](const double& c) { return &c == piece.coefficients.data() || c == 0.0; });
}

bool stands_still(const History& history) {
  return std::all_of(history.pieces().begin(), history.pieces().end(),
                     [](const Piece& piece) { return stands_still(piece); });
}

/// What modes cannot follow; empty: they can follow all of it.
std::string objection(const Model& model) {
  if (std::string why = modal_refusal(model); !why.empty()) return why;
  if (model.size() > most_unknowns) return "more unknowns than modes are kept of";
  for (const Load& load : model.loads)
    if (!stands_still(load.history)) return "loads that change other than in jumps";
  for (const Contact& contact : model.contacts)
    if (!stands_still(contact.normal_force) || !stands_still(contact.surface_motion))
      return "surfaces that move";
  return {};
}

}  // namespace

FlowChoice choose_flow(const Model& model, const RunSpec& run) {
  if (run.flow == Flow::taylor) return {false, "as given"};
  const std::string why = objection(model);
  if (run.flow == Flow::automatic) {
    if (!why.empty()) return {false, fmt::format("auto: modes cannot follow {}", why)};
    if (model.size() < fewest_unknowns) return {false, "auto: few unknowns, for which the series is as fast"};
    return {true, "auto: modes follow all of it"};
  }
  if (!why.empty())
    throw SceneError(run.place, "run.flow",
                     fmt::format("\"modal\" cannot follow this scene: {}; use \"taylor\"", why));
  return {true, "as given"};
}

}  // namespace signorini
