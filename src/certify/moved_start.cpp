#include "certify/moved_start.hpp"

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "model/assembly/loads.hpp"
#include "model/statics/held_rows.hpp"
#include "model/statics/static_system.hpp"

namespace signorini {
namespace {

/// Forces at u0 that are left where the contacts that bear have the forces of their gaps there, rigid ones of the start.
Vector left_over(const Model& model, const std::vector<double>& reactions) {
  Vector force = static_load(model.loads, model.size()) - model.stiffness * model.u0;
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact& c = model.contacts[k];
    if (!c.has_gap() || !(reactions[k] > 0.0)) continue;
    c.normal.add_to(force, c.has_spring() ? -c.normal_stiffness * c.gap_at(model.u0) : reactions[k]);
  }
  return force;
}

double rounding_of_gap(const Contact& contact, const Vector& u) {
  return rounding::of_elimination * (std::abs(contact.gap) + contact.normal.magnitude(u));
}

bool bears(const Model& model, std::size_t k) {
  return model.contacts[k].has_gap() && model.statics.reactions[k] > 0.0;
}

/// No contact that bears has left, and none that is open has come.
bool keeps_states(const Model& model, const Model& near, const Vector& u) {
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact& c = model.contacts[k];
    if (!c.has_gap() || c.takes_impulses()) continue;
    const double before = c.gap_at(model.u0);
    if (std::abs(before) > rounding_of_gap(c, model.u0) && before * near.contacts[k].gap_at(u) <= 0.0)
      return false;
  }
  return true;
}

}  // namespace

std::optional<Vector> moved_start(const Model& model, const Model& near) {
  const bool known = model.static_start && model.statics.reactions.size() == model.contacts.size() &&
                     std::none_of(model.contacts.begin(), model.contacts.end(),
                                  [](const Contact& c) { return c.own != nullptr && c.has_gap(); });
  if (!known || model.statics.frictional) return std::nullopt;
  const Vector p = left_over(near, model.statics.reactions) - left_over(model, model.statics.reactions);
  std::vector<HeldRow> rows;
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact& c = near.contacts[k];
    if (!c.has_gap()) continue;
    if (c.has_spring() && bears(model, k))
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
  // Free motions are held where ut = 0.
  for (std::size_t k = 0; !w && k < model.contacts.size(); ++k) {
    const Combination& tangent = near.contacts[k].tangent;
    if (tangent.terms.empty() ||
        std::abs(tangent.dot(near.u0)) > rounding::of_elimination * near.u0.cwiseAbs().maxCoeff())
      continue;
    rows.push_back({tangent, own_stiffness(near.stiffness, tangent), true});
    w = solve();
  }
  if (w && !(w->allFinite() && keeps_states(model, near, near.u0 + *w))) w.reset();
  return w;
}

}  // namespace signorini
