#include "certify/moved_start.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/rounding.hpp"
#include "contact/friction.hpp"
#include "model/assembly/loads.hpp"
#include "model/statics/held_rows.hpp"
#include "model/statics/static_system.hpp"

namespace signorini {
namespace {

// Relative distance to the friction limit below which a contact may slide. Chosen as for starts of reduced models.
constexpr double at_limit = 1e-9;

bool rubs(const Model& model, const Contact& c) { return model.statics.frictional && c.has_friction(); }

/// True if friction holds the contact below its limit, by a spring.
bool sticks(const Model& model, std::size_t k) {
  const Contact& c = model.contacts[k];
  const double limit = sticking_limit(c, -model.statics.reactions[k]);
  return c.tangential_stiffness && c.initial_slip == 0 &&
         std::abs(c.initial_shear) < (1.0 - at_limit) * limit;
}

/// Shears in `near`, with unchanged sliding points.
std::vector<double> shears(const Model& model, const Model& near) {
  std::vector<double> list;
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact &c = model.contacts[k], &other = near.contacts[k];
    const bool springs = c.tangential_stiffness && *c.tangential_stiffness > 0.0;
    list.push_back(springs ? c.initial_shear * (*other.tangential_stiffness / *c.tangential_stiffness)
                           : c.initial_shear);
  }
  return list;
}

/// Unbalanced forces at u0, with contact forces from the gaps, for rigid contacts from the start.
Vector left_over(const Model& model, const std::vector<double>& reactions,
                 const std::vector<double>& shears) {
  Vector force = static_load(model.loads, model.size()) - model.stiffness * model.u0;
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact& c = model.contacts[k];
    if (model.statics.frictional && reactions[k] > 0.0 && c.has_friction())
      c.tangent.add_to(force, -shears[k]);
    if (c.normal_force_given() || !(reactions[k] > 0.0)) continue;
    c.normal.add_to(force, c.normal_spring() ? -c.normal_stiffness * c.gap_at(model.u0) : reactions[k]);
  }
  return force;
}

double rounding_of_gap(const Contact& contact, const Vector& u) {
  return rounding::of_elimination * (std::abs(contact.gap) + contact.normal.magnitude(u));
}

bool bears(const Model& model, std::size_t k) {
  return !model.contacts[k].normal_force_given() && model.statics.reactions[k] > 0.0;
}

/// True if no loaded contact has opened, and no open one has closed.
bool keeps_states(const Model& model, const Model& near, const Vector& u) {
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact& c = model.contacts[k];
    if (!c.normal_spring()) continue;
    const double before = c.gap_at(model.u0);
    if (std::abs(before) > rounding_of_gap(c, model.u0) && before * near.contacts[k].gap_at(u) <= 0.0)
      return false;
  }
  return true;
}

}  // namespace

namespace {

/// True for a static start in which all friction is below its limits, by springs.
bool is_known(const Model& model) {
  if (!model.static_start || model.statics.reactions.size() != model.contacts.size()) return false;
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact& c = model.contacts[k];
    if (!c.obeys_coulomb()) return false;
    if (!rubs(model, c)) continue;
    if (c.sliding_point() || c.curved_surface()) return false;
    if (model.statics.reactions[k] > 0.0 && !sticks(model, k)) return false;
  }
  return true;
}

}  // namespace

std::optional<MovedStart> moved_start(const Model& model, const Model& near) {
  if (!is_known(model)) return std::nullopt;
  MovedStart moved{{}, shears(model, near)};
  const std::vector<double>& reactions = model.statics.reactions;
  const Vector p =
      left_over(near, reactions, moved.shears) - left_over(model, reactions, shears(model, model));
  std::vector<HeldRow> rows;
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact& c = near.contacts[k];
    if (rubs(model, c) && reactions[k] > 0.0) rows.push_back({c.tangent, *c.tangential_stiffness, false});
    if (c.normal_force_given()) continue;
    if (c.normal_spring() && bears(model, k))
      rows.push_back({c.normal, c.normal_stiffness, false});
    else if (bears(model, k) || std::abs(c.gap_at(near.u0)) <= rounding_of_gap(c, near.u0))
      rows.push_back({c.normal, own_stiffness(near.stiffness, c.normal), true});
  }
  const auto solve = [&]() -> std::optional<Vector> {
    const HeldRows held(near.stiffness, rows);
    if (!held.regular()) return std::nullopt;
    return held.solve(p, Vector::Zero(static_cast<Eigen::Index>(rows.size()))).first;
  };
  std::optional<Vector> w = solve();
  // Free motions are fixed by ut = 0.
  for (std::size_t k = 0; !w && k < model.contacts.size(); ++k) {
    const Combination& tangent = near.contacts[k].tangent;
    if (tangent.terms.empty() ||
        std::abs(tangent.dot(near.u0)) > rounding::of_elimination * near.u0.cwiseAbs().maxCoeff())
      continue;
    rows.push_back({tangent, own_stiffness(near.stiffness, tangent), true});
    w = solve();
  }
  if (!w || !(w->allFinite() && keeps_states(model, near, near.u0 + *w))) return std::nullopt;
  for (std::size_t k = 0; k < model.contacts.size(); ++k)
    if (rubs(model, model.contacts[k]) && reactions[k] > 0.0)
      moved.shears[k] += *near.contacts[k].tangential_stiffness * near.contacts[k].tangent.dot(*w);
  moved.w = std::move(*w);
  return moved;
}

}  // namespace signorini
