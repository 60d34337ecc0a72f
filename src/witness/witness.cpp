#include "witness/witness.hpp"

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "witness/laws.hpp"

namespace signorini {

struct Witness::Parts {
  Bench bench;
};

Witness::Witness(const Model& model, const WitnessLimits& limits) : parts_(new Parts{{model, limits}}) {}
Witness::~Witness() = default;

std::vector<Violation> Witness::instant(const InstantRecord& record) const {
  std::vector<Violation> found;
  Finder finder(parts_->bench, record, found);
  finder.momentum();
  finder.captures();
  finder.restitution();
  finder.states();
  finder.transitions();
  finder.continuity();
  return found;
}

std::array<double, 2> Witness::modal_size(const Vector& x) const {
  std::array<double, 2> size = parts_->bench.lightness();
  const double norm = std::sqrt(std::max(0.0, x.dot(parts_->bench.model.mass * x)));
  for (double& s : size) s *= norm;
  return size;
}

namespace {

/// Another foot that sticks may hold this one at the limit of its friction: what it slips is rounding of what holds it.
bool held_beside(const Model& model, const std::vector<ContactState>& mode, std::size_t k) {
  const auto shares = [&](const Contact& other) {
    return std::any_of(other.tangent.terms.begin(), other.tangent.terms.end(), [&](const auto& a) {
      const auto& own = model.contacts[k].tangent.terms;
      return std::any_of(own.begin(), own.end(), [&](const auto& b) { return a.first == b.first; });
    });
  };
  for (std::size_t j = 0; j < model.contacts.size(); ++j)
    if (j != k && model.contacts[j].takes_impulses() && kind_of(mode[j].state) == State::stick &&
        shares(model.contacts[j]))
      return model.contacts[k].takes_impulses();
  return false;
}

}  // namespace

std::vector<Violation> Witness::between(double t, const WitnessedSide& now) const {
  std::vector<Violation> found;
  const Model& model = parts_->bench.model;
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact& c = model.contacts[k];
    if (c.own || c.friction.varies()) continue;
    const Sight m = see(c, k, now);
    for (const SeenGuard& guard : guards_of(c, (*now.mode)[k], m, parts_->bench.limits)) {
      const std::string_view law = guard.law;
      // The slip rate with a dashpot needs an acceleration; of what sticks without a spring T is that of a solve.
      if (law == "slip direction" && (c.shear || (c.normal_damping > 0.0 && now.a == nullptr))) continue;
      double limit = rounding::of_elimination * guard.size + of_tolerance * guard.tolerance;
      if (law == "slip direction" && guard.value < -limit && held_beside(model, *now.mode, k))
        limit += c.capture_velocity.value_or(parts_->bench.limits.capture_velocity);
      if (guard.value >= -limit) continue;
      found.push_back({t, "between", static_cast<int>(k), guard.law, -guard.value, limit,
                       law == "penetration" || law == "lasting gap" ? seen::length
                       : law == "slip direction"                    ? seen::velocity
                                                                    : seen::force,
                       false});
    }
  }
  return found;
}

}  // namespace signorini
