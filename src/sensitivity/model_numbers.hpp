// model_numbers.hpp: all numbers of a model that a parameter may change, in a fixed order.
//
//   data_of(model): the numbers themselves, in the place of their derivatives;   visit(d, f): f(x) of each
//
// Two models whose shapes are equal have the same numbers in the same order, once align() has given their
// combinations the same terms.
#pragma once

#include "sensitivity/model_derivative.hpp"

namespace signorini {

template <class Visit>
void visit_form(Form& f, const Visit& visit) {
  for (double* x :
       {&f.N, &f.T, &f.gap, &f.ut, &f.vn, &f.vt, &f.an, &f.at, &f.pressing, &f.pressing_rate, &f.constant})
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

/// Zero entries may have no terms in some models: adds the terms of each model to all.
void align(const std::vector<ModelDerivative*>& all);
/// The data themselves, in a ModelDerivative.
[[nodiscard]] ModelDerivative data_of(const Model& model);
/// Sizes and structure that must be equal for differences to be meaningful.
[[nodiscard]] std::vector<long> shape_of(const Model& model);
/// All numbers except the matrices; those of u0 and v0 are last.
[[nodiscard]] std::vector<double> values_of(ModelDerivative& data);
/// Magnitudes to which the rounding of each number is relative: itself, in a form its largest factor.
[[nodiscard]] std::vector<double> sizes_of(ModelDerivative data);

}  // namespace signorini
