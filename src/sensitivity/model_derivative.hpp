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

#include <vector>

#include "contact/law.hpp"
#include "signorini/sensitivity.hpp"

namespace signorini::sensitivity {

// Finite-difference stencils.
//
//   f' = sum_i w_i f(p + k_i h) / h          k_i: points, w_i: weights
//
// `check` are weights of lower order at the same points: where both results differ, the function is not smooth.

/// Points in units of the step, and weights divided by the step.
struct Stencil {
  std::vector<int> points;
  std::vector<double> weights, check;  ///< check: weights of lower order at the same points
};

/// Central difference, exact for linear and quadratic functions.
[[nodiscard]] const Stencil& two_points();
/// Central stencil of sixth order, checked by one of fourth order.
[[nodiscard]] const Stencil& six_points();
/// Stencil of fifth order with points on the upper side, checked by one of fourth order; on the lower side h
/// < 0.
[[nodiscard]] const Stencil& one_sided_points();

/// Derivatives of a history's numbers, piece by piece. Empty: no change.
struct HistoryRates {
  std::vector<double> starts;
  std::vector<Piece> pieces;  ///< the numbers are derivatives
  [[nodiscard]] bool none() const { return pieces.empty(); }
};

inline constexpr std::array all_states = {State::open,
                                          State::inside,
                                          State::closed,
                                          State::stick,
                                          State::slip_plus,
                                          State::slip_minus,
                                          State::static_limit_plus,
                                          State::static_limit_minus};
[[nodiscard]] constexpr std::size_t index_of(State state) { return static_cast<std::size_t>(state); }

/// Derivatives of one contact's data, with anchors at zero.
struct ContactRates {
  Combination normal, tangent, body_tangent;
  double gap = 0.0, tangential_stiffness = 0.0, initial_shear = 0.0, restitution = 0.0, shear_stiffness = 0.0;
  Friction friction;  ///< derivatives of the contact's constants of friction
  HistoryRates normal_force, surface_motion;
  std::array<Rows, all_states.size()> rows;
  std::array<std::array<Form, ContactLaw::most_guards>, all_states.size()> guards;
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

/// Copies the weight load of a model with gravity into one without, with value zero: a place for its
/// derivative.
void add_weight_load(const Model& from, Model& model);

/// Derivative by the key at `path`. model: build_model(read({})), in the machine's units; value, size: of the
/// key. Errors: SceneError and UsageError if the key cannot be varied, or if the data do not depend smoothly
/// on it.
[[nodiscard]] ModelDerivative derivative(const SceneReader& read, const Model& model, const std::string& path,
                                         double value, double size);

// All numbers of a model that a parameter may change, in a fixed order.
//
//   data_of(model): the numbers themselves, in the place of their derivatives;   visit(d, f): f(x) of each
//
// Two models whose shapes are equal have the same numbers in the same order, once align() has given their
// combinations the same terms.

template <class Visit>
void visit_form(Form& f, const Visit& visit) {
  for (double* x : {&f.N, &f.T, &f.gap, &f.ut, &f.vn, &f.vt, &f.an, &f.at, &f.applied_normal_force,
                    &f.applied_normal_force_rate, &f.constant})
    visit(*x);
}

template <class Visit>
void visit_rates(HistoryRates& h, const Visit& visit) {
  for (double& t : h.starts) visit(t);
  for (Piece& piece : h.pieces) {
    visit(piece.origin);
    for (double& c : piece.coefficients) visit(c);
    visit(piece.amplitude);
    visit(piece.omega);
    visit(piece.phase);
  }
}

template <class Visit>
void visit_combinations(ModelDerivative& d, const Visit& visit) {
  for (LoadRates& load : d.loads) visit(load.direction);
  for (ContactRates& c : d.contacts)
    for (Combination* form : {&c.normal, &c.tangent, &c.body_tangent}) visit(*form);
}

template <class Visit>
void visit_all(ModelDerivative& d, const Visit& visit) {
  visit_combinations(d, [&](Combination& c) {
    for (auto& [index, factor] : c.terms) visit(factor);
  });
  for (LoadRates& load : d.loads) visit_rates(load.history, visit);
  for (ContactRates& c : d.contacts) {
    for (double* x : {&c.gap, &c.tangential_stiffness, &c.initial_shear, &c.restitution, &c.shear_stiffness,
                      &c.friction.static_, &c.friction.kinetic})
      visit(*x);
    for (const FrictionConstant& constant : friction_constants)
      if (auto& x = c.friction.*constant.value) visit(*x);
    visit_rates(c.normal_force, visit);
    visit_rates(c.surface_motion, visit);
    for (Rows& rows : c.rows) {
      visit_form(rows.normal, visit);
      visit_form(rows.tangent, visit);
    }
    for (auto& guards : c.guards)
      for (Form& guard : guards) visit_form(guard, visit);
  }
  for (double& u : d.u0) visit(u);
  for (double& v : d.v0) visit(v);
}

/// Adds the terms of each model's combinations to those of all others, since some models have no terms for
/// zeros.
void align(const std::vector<ModelDerivative*>& all);
/// The data themselves, in a ModelDerivative.
[[nodiscard]] ModelDerivative data_of(const Model& model);
/// Sizes and structure that must be equal for differences to be meaningful.
[[nodiscard]] std::vector<long> shape_of(const Model& model);
/// All numbers except the matrices; those of u0 and v0 are last.
[[nodiscard]] std::vector<double> values_of(ModelDerivative& data);
/// Magnitude to which the rounding of each number is relative: its own, for a number of a form the form's
/// largest.
[[nodiscard]] std::vector<double> sizes_of(ModelDerivative data);

}  // namespace signorini::sensitivity
