#include "law_check/law_checker.hpp"

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "law_check/contact_kinematics.hpp"
#include "law_check/laws.hpp"
#include "law_check/massless_laws.hpp"

namespace signorini::law_check {

struct LawChecker::Parts {
  CheckContext bench;
};

LawChecker::LawChecker(const Model& model, const LawLimits& limits) : parts_(new Parts{{model, limits}}) {}
LawChecker::~LawChecker() = default;

std::vector<Violation> LawChecker::instant(const InstantRecord& record) const {
  std::vector<Violation> found;
  Finder finder(parts_->bench, record, found);
  finder.momentum();
  finder.captures();
  finder.restitution();
  finder.states();
  finder.transitions();
  finder.continuity();
  finder.releases();
  finder.continuation();
  finder.rows();
  finder.balance();
  return found;
}

std::vector<Violation> LawChecker::stretch(double t, const CheckedSide& from, const CheckedSide& to) const {
  return stretch_laws(parts_->bench, t, from, to);
}

std::vector<Violation> LawChecker::equilibrium(double t, const CheckedSide& side, const Vector& load) const {
  return equilibrium_law(parts_->bench, t, side, load);
}

std::array<double, 2> LawChecker::modal_size(double norm) const {
  std::array<double, 2> size = parts_->bench.lightness();
  for (double& s : size) s *= norm;
  return size;
}

std::array<double, 2> LawChecker::modal_size(const Vector& x) const {
  return modal_size(std::sqrt(std::max(0.0, x.dot(parts_->bench.model.mass * x))));
}

double LawChecker::twice_energy(const Vector& u) const { return parts_->bench.twice_energy(u); }

double LawChecker::lightness(std::size_t k) const {
  const OwnResponse* own = parts_->bench.own_response(k);
  return own != nullptr ? std::sqrt(std::max(0.0, own->nn)) + std::sqrt(std::max(0.0, own->tt)) : 0.0;
}

void LawChecker::contact(double t, std::size_t k, const ContactState& state, const ContactKinematics& m,
                         bool accelerates, double of_held, std::vector<Violation>& found) const {
  const Contact& c = parts_->bench.model.contacts[k];
  if (!c.obeys_coulomb() || c.friction.varies()) return;
  for (const SeenGuard& guard : guards_of(c, state, m, parts_->bench.limits)) {
    const std::string_view law = guard.law;
    // The slip rate with a dashpot needs an acceleration.
    if (law == "slip direction" && (c.sliding_point() || (c.normal_damping > 0.0 && !accelerates))) continue;
    const bool held = law == "tension" ? c.takes_impulses() : law == "friction" && !c.tangential_stiffness;
    double limit =
        rounding::of_elimination * (guard.size + (held ? of_held : 0.0)) + of_tolerance * guard.tolerance;
    if (guard.value >= -limit) continue;
    if (law == "rest" || (law == "slip direction" && held_beside(parts_->bench.model, k))) {
      limit += c.capture_velocity.value_or(parts_->bench.limits.capture_velocity);
      if (guard.value >= -limit) continue;
    }
    found.push_back({t, "between", static_cast<int>(k), guard.law, -guard.value, limit, guard.unit(), false});
  }
}

double LawChecker::held_forces(const CheckedSide& side) const { return parts_->bench.balance(side); }

std::vector<Violation> LawChecker::between(double t, const CheckedSide& now) const {
  std::vector<Violation> found;
  const Model& model = parts_->bench.model;
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    if (guards_stand(model.contacts[k], k, (*now.mode)[k], now)) continue;
    const ContactKinematics m = kinematics(model.contacts[k], k, now);
    const std::size_t before = found.size();
    contact(t, k, (*now.mode)[k], m, now.a != nullptr, 0.0, found);
    if (found.size() > before && found.back().law == std::string_view("slip direction")) {
      found.back().limit += noise_of_slip_rate(parts_->bench, now, k);
      if (found.back().value <= found.back().limit) found.pop_back();
    }
    if (found.size() == before ||
        (model.contacts[k].normal_spring() && model.contacts[k].tangential_stiffness))
      continue;
    found.resize(before);  // rarely reached: the uncertainty of constraint forces is a sum over the structure
    contact(t, k, (*now.mode)[k], m, now.a != nullptr, parts_->bench.balance(now), found);
  }
  for (const Unbalanced& off : massless_balance(parts_->bench, now, 2)) {
    const bool turns = model.dofs[static_cast<std::size_t>(off.dof)].rotation;
    found.push_back(
        {t, "between", -1, off.law, off.value, off.limit, Unit{1, turns ? 1 : 0, -off.order}, false});
  }
  return found;
}

}  // namespace signorini::law_check
