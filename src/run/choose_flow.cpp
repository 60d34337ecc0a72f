#include "run/choose_flow.hpp"

#include <algorithm>

#include "engine/exact/modal/modal_system.hpp"

namespace signorini {
namespace {

constexpr int fewest_unknowns = 24;  // below, the series is as fast
constexpr int most_unknowns = 4000;  // shapes and their inverse take 16 n^2 bytes

bool stands_still(const Piece& piece) {
  return piece.amplitude == 0.0 &&
         std::all_of(piece.coefficients.begin(), piece.coefficients.end(),
                     [&](const double& c) { return &c == piece.coefficients.data() || c == 0.0; });
}

bool stands_still(const History& history) {
  return std::all_of(history.pieces().begin(), history.pieces().end(),
                     [](const Piece& piece) { return stands_still(piece); });
}

/// Why auto prefers the series; empty: it does not.
std::string doubt(const Model& model) {
  if (model.size() < fewest_unknowns) return "few unknowns";
  if (model.size() > most_unknowns) return "more unknowns than modes are kept of";
  for (const Load& load : model.loads)
    if (!stands_still(load.history)) return "loads that change";
  for (const Contact& contact : model.contacts)
    if (!stands_still(contact.normal_force) || !stands_still(contact.surface_motion))
      return "surfaces that move";
  return {};
}

}  // namespace

std::string objection_to_modes(const Model& model) {
  std::string why = modal_refusal(model);
  return why.empty() ? doubt(model) : why;
}

}  // namespace signorini
