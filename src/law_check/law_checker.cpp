#include "law_check/law_checker.hpp"

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "law_check/contact_kinematics.hpp"
#include "law_check/laws.hpp"
#include "law_check/massless_laws.hpp"

namespace signorini::law_check {

struct LawChecker::Parts {
  CheckContext context;
};

LawChecker::LawChecker(const Model& model, const LawLimits& limits) : parts_(new Parts{{model, limits}}) {}
LawChecker::~LawChecker() = default;

std::vector<Violation> LawChecker::check_instant(const InstantRecord& record) const {
  std::vector<Violation> found;
  InstantLawChecker finder(parts_->context, record, found);
  finder.momentum();
  finder.captures();
  finder.restitution();
  finder.states();
  finder.transitions();
  finder.continuity();
  finder.releases();
  finder.continuation();
  finder.event_rows();
  finder.balance();
  return found;
}

std::vector<Violation> LawChecker::check_stretch(double t, const CheckedSide& from,
                                                 const CheckedSide& to) const {
  return stretch_laws(parts_->context, t, from, to);
}

std::vector<Violation> LawChecker::check_equilibrium(double t, const CheckedSide& side,
                                                     const Vector& load) const {
  return equilibrium_law(parts_->context, t, side, load);
}

std::array<double, 2> LawChecker::modal_size(double norm) const {
  std::array<double, 2> size = parts_->context.inverse_mass_root();
  for (double& s : size) s *= norm;
  return size;
}

std::array<double, 2> LawChecker::modal_size(const Vector& x) const {
  return modal_size(std::sqrt(std::max(0.0, x.dot(parts_->context.model.mass * x))));
}

double LawChecker::twice_energy(const Vector& u) const { return parts_->context.twice_energy(u); }

double LawChecker::speed_per_energy_root(std::size_t k) const {
  const ContactResponse* own = parts_->context.contact_response(k);
  return own != nullptr ? std::sqrt(std::max(0.0, own->nn)) + std::sqrt(std::max(0.0, own->tt)) : 0.0;
}

void LawChecker::check_contact(double t, std::size_t k, const ContactState& state, const ContactKinematics& m,
                               bool accelerates, double of_held, std::vector<Violation>& found) const {
  const Contact& c = parts_->context.model.contacts[k];
  if (!c.obeys_coulomb() || c.friction.is_rate_dependent()) return;
  for (const GuardValue& guard : guards_of(c, state, m, parts_->context.limits)) {
    const std::string_view law = guard.law;
    // The slip rate of a contact with a dashpot contains g'', so it is checked only if accelerations are known.
    if (law == "slip direction" && (c.sliding_point() || (c.normal_damping > 0.0 && !accelerates))) continue;
    const bool held = law == "tension" ? c.takes_impulses() : law == "friction" && !c.tangential_stiffness;
    double limit =
        rounding::elimination * (guard.size + (held ? of_held : 0.0)) + tolerance_factor * guard.tolerance;
    if (guard.value >= -limit) continue;
    if (law == "rest" || (law == "slip direction" && may_be_held_by_neighbour(parts_->context.model, k))) {
      limit += c.capture_velocity.value_or(parts_->context.limits.capture_velocity);
      if (guard.value >= -limit) continue;
    }
    found.push_back({t, "between", static_cast<int>(k), guard.law, -guard.value, limit, guard.unit(), false});
  }
}

double LawChecker::constraint_force_terms(const CheckedSide& side) const {
  return parts_->context.balance_terms(side);
}

std::vector<Violation> LawChecker::check_point(double t, const CheckedSide& now) const {
  std::vector<Violation> found;
  const Model& model = parts_->context.model;
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    if (guards_are_satisfied(model.contacts[k], k, (*now.mode)[k], now)) continue;
    const ContactKinematics m = kinematics(model.contacts[k], k, now);
    const std::size_t before = found.size();
    check_contact(t, k, (*now.mode)[k], m, now.a != nullptr, 0.0, found);
    if (found.size() > before && found.back().law == std::string_view("slip direction")) {
      found.back().limit += slip_rate_noise(parts_->context, now, k);
      if (found.back().value <= found.back().limit) found.pop_back();
    }
    if (found.size() == before ||
        (model.contacts[k].normal_spring() && model.contacts[k].tangential_stiffness))
      continue;
    // The check is repeated with the uncertainty of constraint forces, a costly sum over the structure.
    found.resize(before);
    check_contact(t, k, (*now.mode)[k], m, now.a != nullptr, parts_->context.balance_terms(now), found);
  }
  for (const MasslessImbalance& off : massless_balance(parts_->context, now, 2)) {
    const bool turns = model.dofs[static_cast<std::size_t>(off.dof)].rotation;
    found.push_back(
        {t, "between", -1, off.law, off.value, off.limit, Unit{1, turns ? 1 : 0, -off.order}, false});
  }
  return found;
}

}  // namespace signorini::law_check
