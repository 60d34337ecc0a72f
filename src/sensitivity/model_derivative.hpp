// model_derivative.hpp: derivative of all model data with respect to a key of the scene.
//
//   x_p = ( 3/4 (x1 - x-1) - 3/20 (x2 - x-2) + 1/60 (x3 - x-3) ) / h      x_j: the data at p + j h
//   linear data: (x1 - x-1) / 2h;   at the limit of a key's range: p and five points on one side
//
// Data are smooth functions of the keys, most of them linear. The truncation error is of order h^6 (h^5 at a limit of the
// range), the rounding error is eps/h; with h = 2^-9 of the value both are below 1e-12. A fourth-order stencil through the
// same points checks whether the data are smooth. If they are not, h is divided by 16, at most twice. Rows and guards of
// contacts are differenced too, so that a law needs no derivatives of its own (contact/law.hpp).
#pragma once

#include <vector>

#include "contact/law.hpp"
#include "signorini/sensitivity.hpp"

namespace signorini::sensitivity {

// Finite-difference stencils for first derivatives.
//
//   f' = sum_i w_i f(p + k_i h) / h          k_i: points, w_i: weights
//
// `check` contains weights of lower order for the same points. If both results differ, the function is not smooth.

/// Points in units of the step h; the sum of weights times values is divided by h.
struct Stencil {
  std::vector<int> points;
  std::vector<double> weights, check;  ///< check: weights of lower order at the same points
};

/// Central difference, exact for linear and quadratic functions.
[[nodiscard]] const Stencil& two_points();
/// Central stencil of sixth order, with a check of fourth order.
[[nodiscard]] const Stencil& six_points();
/// Stencil of fifth order with points on the upper side, with a check of fourth order; a step h < 0 gives the lower side.
[[nodiscard]] const Stencil& one_sided_points();

/// Derivatives of a history's numbers, piece by piece. Empty: the history does not depend on the key.
struct HistoryRates {
  std::vector<double> starts;
  std::vector<Piece> pieces;  ///< each number of a piece is replaced by its derivative
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

/// Derivatives of the data of one contact; rows and guards are those with anchor zero.
struct ContactRates {
  Combination normal, tangent, body_tangent;
  double gap = 0.0, tangential_stiffness = 0.0, initial_shear = 0.0, restitution = 0.0, shear_stiffness = 0.0;
  Friction friction;  ///< derivatives of the contact's friction constants
  HistoryRates normal_force, surface_motion;
  std::array<Rows, all_states.size()> rows;
  std::array<std::array<Form, ContactLaw::max_guards>, all_states.size()> guards;
};

struct LoadRates {
  Combination direction;
  HistoryRates history;
};

/// Derivatives of model data: unit of the datum in the model / unit of the key.
struct ModelDerivative {
  SparseMatrix mass, damping, stiffness;  ///< entries whose derivative is zero are omitted
  std::vector<LoadRates> loads;
  std::vector<ContactRates> contacts;
  Vector u0, v0;
  double step = 0.0;       ///< step h of the differences; unit of the key
  bool one_sided = false;  ///< true: all points are on one side of the key's value
};

/// If `from` has a weight load and `model` has none, adds a weight load of value zero to `model`, as a place for its
/// derivative.
void add_weight_load(const Model& from, Model& model);

/// Derivative with respect to the key at `path`. model: build_model(read({})), in internal units; value, size: of the key.
/// Errors: SceneError and UsageError if the key cannot be varied, or if the data do not depend smoothly on it.
[[nodiscard]] ModelDerivative derivative(const SceneReader& read, const Model& model, const std::string& path,
                                         double value, double size);

// All numbers of a model that a parameter may change, visited in a fixed order.
//
//   data_of(model): the numbers themselves in place of derivatives;   visit_all(d, f): calls f(x) for each number x
//
// Two models with equal shape_of() have the same numbers in the same order, after align() has given their combinations the
// same terms.

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

/// Gives the combinations of all models the same terms, because a model may omit terms that are zero.
void align(const std::vector<ModelDerivative*>& all);
/// The numbers of the model, stored in a ModelDerivative.
[[nodiscard]] ModelDerivative data_of(const Model& model);
/// Sizes and structure of a model; they must be equal for differences of models to be meaningful.
[[nodiscard]] std::vector<long> shape_of(const Model& model);
/// All numbers except those of the matrices; the numbers of u0 and v0 are last.
[[nodiscard]] std::vector<double> values_of(ModelDerivative& data);
/// Magnitude to which the rounding error of each number is relative: the magnitude of the number, or for a coefficient of a
/// combination the largest coefficient of the combination.
[[nodiscard]] std::vector<double> sizes_of(ModelDerivative data);

}  // namespace signorini::sensitivity
