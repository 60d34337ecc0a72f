#include "run/pace.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "contact/slots.hpp"
#include "motion/clock.hpp"

namespace signorini {
namespace {

/// An oscillating piece of a history, while it acts.
struct Swing {
  double from, to, omega;
};

/// Adds the oscillating pieces that are longer than the resolution of the clock.
void add_swings(const History& history, std::vector<Swing>& all) {
  constexpr double ever = std::numeric_limits<double>::infinity();
  const std::vector<double>& starts = history.starts();
  for (std::size_t i = 0; i < history.pieces().size(); ++i) {
    const Piece& piece = history.pieces()[i];
    if (piece.amplitude == 0.0 || piece.omega == 0.0) continue;
    const double from = i == 0 ? -ever : starts[i - 1], to = i == starts.size() ? ever : starts[i];
    if (std::isinf(to) || to - from > resolution_at(to, 0.0))
      all.push_back({from, to, std::abs(piece.omega)});
  }
}

std::vector<Swing> swings_given(const Model& model) {
  std::vector<Swing> all;
  for (const Load& load : model.loads) add_swings(load.history, all);
  for (const Contact& contact : model.contacts) {
    add_swings(contact.normal_force, all);
    add_swings(contact.surface_motion, all);
  }
  for (const Output& output : model.outputs)
    for_each_linear(output, [&](const Output& o) {
      for (const Output::Given& given : o.given) add_swings(given.history, all);
    });
  return all;
}

}  // namespace

Reach reach_of(const FastModes& modes, const Output& linear) {
  return {modes.form_norm(linear.u), modes.form_norm(linear.v), modes.form_norm(linear.a)};
}

double added(const Ripple& ripple, const Reach& reach, const Output& linear, const ForceLayout& layout) {
  double sum = reach.u * ripple.u + reach.v * ripple.v + reach.a * ripple.a;
  for (const Output::ContactForces& f : linear.forces)
    sum += std::abs(f.N) * ripple.forces[static_cast<Eigen::Index>(layout.normal(f.contact))] +
           std::abs(f.T) * ripple.forces[static_cast<Eigen::Index>(layout.tangent(f.contact))];
  return sum;
}

Pace::Pace(const Model& model, double t_end) : model_(model), t_end_(t_end) { loads_changed(); }

void Pace::loads_changed() {
  struct Change {
    double t, omega;
    bool begins;
  };
  std::vector<Change> ends;
  for (const Swing& swing : swings_given(model_)) {
    ends.push_back({swing.from, swing.omega, true});
    ends.push_back({swing.to, swing.omega, false});
  }
  std::sort(ends.begin(), ends.end(), [](const Change& a, const Change& b) { return a.t < b.t; });
  changes_.clear();
  fastest_.assign(1, 0.0);
  std::multiset<double> acting;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (ends[i].begins)
      acting.insert(ends[i].omega);
    else
      acting.erase(acting.find(ends[i].omega));
    if (i + 1 < ends.size() && ends[i + 1].t == ends[i].t) continue;
    changes_.push_back(ends[i].t);
    fastest_.push_back(acting.empty() ? 0.0 : *acting.rbegin());
  }
}

double Pace::of_all(double radians, double begin, double end) {
  given_ = 1.0 / t_end_;
  auto next = std::upper_bound(changes_.begin(), changes_.end(), begin);
  do given_ = std::max(given_, fastest_[static_cast<std::size_t>(next - changes_.begin())]);
  while (next != changes_.end() && *next++ < end);
  return std::max(given_, std::min(model_.omega_max, radians / (end - begin)));
}

double Pace::of_what_counts(const FastModes& modes, double all,
                            const std::function<bool(const Ripple&)>& is_rounding) const {
  const auto quiet_above = [&](double omega) {
    const auto ripple = modes.fast_mode_bound(omega);
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
