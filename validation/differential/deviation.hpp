// deviation.hpp: how far one run is from another, row by row and event by event.
//
//   u(i) = max over dofs |u_a - u_b| / (scale + max |u|)    at output time i, and the greatest so far
//   time(contact, j) = |t_a - t_b|                          of the contact's j-th event, greatest so far
//   aligned, split                                          how many events have partners; where none has
//
// "So far", since errors of an earlier time are carried on: a deviation that passes through zero is no
// promise. Rows between an event's two times are left out of v and force: one run has jumped, the other not
// yet. A value that is not finite is infinitely far from any other.
#pragma once

#include <limits>
#include <map>
#include <string>
#include <vector>

#include "differential/track.hpp"

namespace signorini::differential {

/// What differences are relative to: the scene's scale plus the greatest value of the reference.
struct Weights {
  std::vector<double> u, v;  ///< one a degree of freedom
  double force = 1.0;
};
[[nodiscard]] Weights weights_of(const Model& model, const Track& reference);

struct Deviation {
  static constexpr double never = std::numeric_limits<double>::infinity();
  std::vector<double> u, v, force;  ///< one a row of the reference before the split; dimensionless
  std::map<std::string, std::vector<double>> time;  ///< by contact, one an aligned event
  /// The sum of both t_uncertainty in the same order, greatest so far.
  std::map<std::string, std::vector<double>> uncertainty;
  std::size_t aligned = 0;  ///< events with partners
  double until = never;     ///< the split's time
  double reached = 0.0;     ///< to where rows were compared: the split, or the earlier end
  bool complete = false;    ///< no split, and neither run was given up
  std::string split;        ///< what stands there; empty: none
  /// How many t_uncertainty lie between the events at the split and their next neighbours in the same run:
  /// few, and what happens there is smaller than the run's tolerance (the last hits before a contact rests).
  double room = never;

  [[nodiscard]] bool splits() const { return !split.empty(); }
  /// The greater of both everywhere; the earlier split, but compared to where either of them was.
  void include(const Deviation& other);
};

/// Over the time that both runs reached. Rows are taken by their common grid.
[[nodiscard]] Deviation deviation(const Track& reference, const Track& other, const Weights& weights,
                                  double t_end);

/// Do both runs hit at the first event that differs, one comes to rest with it, and the other after flights
/// that are all lower than rounding? A flight of length tau under a is a tau^2/8 high, the motion of the run
/// of the size a t_end^2.
[[nodiscard]] bool rests_by_rounding(const Track& a, const Track& b, double t_end);

}  // namespace signorini::differential
