// model_derivative.hpp: derivative of all model data by a key of the scene.
//
//   x_p = ( 3/4 (x1 - x-1) - 3/20 (x2 - x-2) + 1/60 (x3 - x-3) ) / h      x_j: the data at p + j h
//   linear data: (x1 - x-1) / 2h;   at the limit of a key's range: five points on one side
//
// Data are smooth functions of the keys, mostly linear ones: the truncation error is of order h^6 (h^5 at a limit),
// rounding eps/h. With h = 2^-9 of the value both are below 1e-12. A fourth-order stencil through the same points
// checks whether the data are smooth; if not, h is divided by 16, twice at most. Rows and guards of contacts are
// differenced too, so that a law is implemented in one place (contact/law.hpp).
#pragma once

#include "contact/law.hpp"
#include "signorini/sensitivity.hpp"

namespace signorini {

/// Derivatives of a history's numbers, piece by piece. Empty: no change.
struct HistoryRates {
  std::vector<double> starts;
  std::vector<Piece> pieces;  ///< the numbers are derivatives
  [[nodiscard]] bool none() const { return pieces.empty(); }
};

inline constexpr std::array all_states = {State::open,      State::inside,    State::closed,
                                          State::stick,     State::slip_plus, State::slip_minus,
                                          State::held_plus, State::held_minus};
[[nodiscard]] constexpr std::size_t index_of(State state) { return static_cast<std::size_t>(state); }

/// Derivatives of one contact's data, with anchors at zero.
struct ContactRates {
  Combination normal, tangent, body_tangent;
  double gap = 0.0, tangential_stiffness = 0.0, initial_shear = 0.0, restitution = 0.0, shear_stiffness = 0.0;
  Friction friction;  ///< derivatives of the contact's constants of friction
  HistoryRates normal_force, surface_motion;
  std::array<Rows, all_states.size()> rows;
  std::array<std::array<Form, guards_per_contact>, all_states.size()> guards;
};

struct LoadRates {
  Combination direction;
  HistoryRates history;
};

/// Derivatives in the units of `model`, over the unit of the key.
struct ModelDerivative {
  SparseMatrix mass, damping, stiffness;  ///< without entries for constants
  std::vector<LoadRates> loads;
  std::vector<ContactRates> contacts;
  Vector u0, v0;
  double step = 0.0;
  bool one_sided = false;
};

/// Gives a model without gravity a zero weight load, copied from one with gravity, as a place for its derivative.
void take_weight(const Model& from, Model& model);

/// model: build_model(read({})), in the machine's units. Errors: SceneError and UsageError if the key cannot be varied,
/// or if the data do not depend smoothly on it.
[[nodiscard]] ModelDerivative derivative(const SceneReader& read, const Model& model, const std::string& path,
                                         double value, double size);

}  // namespace signorini
