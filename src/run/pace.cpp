#include "run/pace.hpp"

#include <algorithm>
#include <cmath>

#include "contact/slots.hpp"

namespace signorini {
namespace {

double fastest_of(const History& history) {
  double omega = 0.0;
  for (const Piece& piece : history.pieces())
    if (piece.amplitude != 0.0) omega = std::max(omega, std::abs(piece.omega));
  return omega;
}

double fastest_given(const Model& model) {
  double omega = 0.0;
  for (const Load& load : model.loads) omega = std::max(omega, fastest_of(load.history));
  for (const Contact& contact : model.contacts)
    omega = std::max({omega, fastest_of(contact.normal_force), fastest_of(contact.surface_motion)});
  for (const Output& output : model.outputs)
    for_each_linear(output, [&](const Output& o) {
      for (const Output::Given& given : o.given) omega = std::max(omega, fastest_of(given.history));
    });
  return omega;
}

}  // namespace

Reach reach_of(const Stepper& engine, const Output& linear) {
  return {engine.reach(linear.u), engine.reach(linear.v), engine.reach(linear.a)};
}

double added(const Ripple& ripple, const Reach& reach, const Output& linear) {
  double sum = reach.u * ripple.u + reach.v * ripple.v + reach.a * ripple.a;
  for (const Output::ContactForces& f : linear.forces)
    sum += std::abs(f.N) * ripple.forces[static_cast<Eigen::Index>(normal_slot(f.contact))] +
           std::abs(f.T) * ripple.forces[static_cast<Eigen::Index>(tangent_slot(f.contact))];
  return sum;
}

Pace::Pace(const Model& model, double t_end) : model_(model), t_end_(t_end) { loads_changed(); }

void Pace::loads_changed() { given_ = std::max(fastest_given(model_), 1.0 / t_end_); }

double Pace::of_all(const Stepper& engine, double length) const {
  return std::max(given_, std::min(model_.omega_max, engine.turns() / length));
}

double Pace::of_what_counts(const Stepper& engine, double all,
                            const std::function<bool(const Ripple&)>& is_rounding) const {
  const auto quiet_above = [&](double omega) {
    const auto ripple = engine.ripple(omega);
    return ripple && is_rounding(*ripple);
  };
  double from = given_, to = all;
  if (quiet_above(from)) return from;
  while (to > 2.0 * from) {
    const double middle = std::sqrt(from) * std::sqrt(to);
    (quiet_above(middle) ? to : from) = middle;
  }
  return to;
}

}  // namespace signorini
