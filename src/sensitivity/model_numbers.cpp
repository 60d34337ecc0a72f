#include "sensitivity/model_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "contact/friction.hpp"

namespace signorini {
namespace {

// Least number of coefficients of a piece, so that a zero coefficient has a place for its derivative: a cubic's
// integral.
constexpr std::size_t fewest_coefficients = 5;

HistoryRates numbers_of(const History& history) {
  HistoryRates numbers{history.starts(), history.pieces()};
  for (Piece& piece : numbers.pieces)
    if (piece.coefficients.size() < fewest_coefficients) piece.coefficients.resize(fewest_coefficients, 0.0);
  return numbers;
}

ContactRates numbers_of(const Contact& contact) {
  ContactRates c;
  c.normal = contact.normal;
  c.tangent = contact.tangent;
  c.body_tangent = contact.body_tangent();
  c.gap = contact.gap;
  c.tangential_stiffness = contact.tangential_stiffness.value_or(0.0);
  c.initial_shear = contact.initial_shear;
  c.restitution = contact.restitution;
  c.friction = contact.friction;
  if (const ShearElement* element = contact.sliding_point()) c.shear_stiffness = element->stiffness;
  c.normal_force = numbers_of(contact.normal_force);
  c.surface_motion = numbers_of(contact.surface_motion);
  for (const State state : all_states) {
    c.rows[index_of(state)] = rows(contact, {state, 0.0});
    if (state == State::inside && !(contact.normal_stiffness > 0.0)) continue;
    const auto forms = guards(contact, {state, 0.0});
    for (std::size_t i = 0; i < forms.size(); ++i) c.guards[index_of(state)][i] = forms[i].form;
  }
  return c;
}

}  // namespace

void align(const std::vector<ModelDerivative*>& all) {
  std::vector<std::map<int, double>> none;
  for (ModelDerivative* data : all) {
    std::size_t i = 0;
    visit_combinations(*data, [&](Combination& c) {
      if (none.size() == i) none.emplace_back();
      for (const auto& term : c.terms) none[i][term.first] = 0.0;
      ++i;
    });
  }
  for (ModelDerivative* data : all) {
    std::size_t i = 0;
    visit_combinations(*data, [&](Combination& c) {
      std::map<int, double> factors = none[i++];
      for (const auto& [index, factor] : c.terms) factors[index] += factor;
      c.terms.assign(factors.begin(), factors.end());
    });
  }
}

ModelDerivative data_of(const Model& model) {
  ModelDerivative d;
  d.mass = model.mass;
  d.damping = model.damping;
  d.stiffness = model.stiffness;
  for (const Load& load : model.loads) d.loads.push_back({load.direction, numbers_of(load.history)});
  for (const Contact& contact : model.contacts) d.contacts.push_back(numbers_of(contact));
  d.u0 = model.u0;
  d.v0 = model.v0;
  return d;
}

std::vector<long> shape_of(const Model& model) {
  std::vector<long> shape{static_cast<long>(model.dofs.size())};
  const auto history = [&](const History& h) {
    for (const Piece& piece : h.pieces())
      shape.push_back(static_cast<long>(std::max(piece.coefficients.size(), fewest_coefficients)));
    shape.push_back(-1);
  };
  for (const Dof& dof : model.dofs) shape.push_back(dof.massless);
  for (const Load& load : model.loads) history(load.history);
  for (const Contact& c : model.contacts) {
    history(c.normal_force);
    history(c.surface_motion);
    for (const bool has : {c.tangential_stiffness.has_value(), c.sliding_point() != nullptr, c.has_friction(),
                           c.normal_damping > 0.0, c.normal_force_given(), c.takes_impulses()})
      shape.push_back(has);
    for (const FrictionConstant& constant : friction_constants)
      shape.push_back((c.friction.*constant.value).has_value());
  }
  for (const double reaction : model.statics.reactions) shape.push_back(reaction > 0.0);
  return shape;
}

std::vector<double> values_of(ModelDerivative& data) {
  std::vector<double> values;
  visit_all(data, [&](double& x) { values.push_back(x); });
  return values;
}

std::vector<double> sizes_of(ModelDerivative data) {
  visit_combinations(data, [](Combination& c) {
    double greatest = 0.0;
    for (const auto& term : c.terms) greatest = std::max(greatest, std::abs(term.second));
    for (auto& term : c.terms) term.second = greatest;
  });
  std::vector<double> sizes = values_of(data);
  for (double& size : sizes) size = std::abs(size);
  return sizes;
}

}  // namespace signorini
