// sequence_search.hpp: locates a change of the sequence of events along a step of a branch.
//
//   d(x)      length of a stretch between two events, relative to the period, at position x of the step
//   d^2 = c (x* - x) + ...      near x*, where d vanishes because a guard grazes
//   d   = c (x* - x) + ...      where two events exchange their order
//
// A polynomial x(d^2), or x(d), through the last three positions with the same sequence gives the guess x* =
// x(0). The next position is tried before or beyond x*, at a distance equal to the estimated error of this
// guess, so that the interval that contains the change shrinks from both sides. Without a guess the interval is halved.
//
//   SequenceSearch search(stretches_of(a, T), stretches_of(b, T), enough);
//   while (!search.done()) { x = search.next(); ...; search.update(x, same, stretches_of(at_x, T)); }
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "signorini/event.hpp"

namespace signorini::orbit {

/// Lengths of the stretches between successive events of a period, and from the last event to the first event of the
/// next period; relative to the period.
[[nodiscard]] std::vector<double> stretches_of(const std::vector<Event>& events, double period);

class SequenceSearch {
 public:
  /// Lengths of stretches at the beginning of the step, x = 0, and at its end, x = 1. enough: width of the
  /// interval at which the search ends.
  SequenceSearch(std::vector<double> at_begin, std::vector<double> at_end, double enough);

  [[nodiscard]] bool done() const { return !(bounds_[1] - bounds_[0] > enough_); }

  /// Position, between 0 and 1, at which the caller computes the next orbit.
  [[nodiscard]] double next();
  /// Enters the result at position x. as_at_begin: true if the sequence is that of the step's beginning;
  /// stretches: empty if unknown.
  void update(double x, bool as_at_begin, std::vector<double> stretches);
  [[nodiscard]] double low() const { return bounds_[0]; }
  [[nodiscard]] double high() const { return bounds_[1]; }

 private:
  struct Place {
    double x;
    std::vector<double> stretches;
  };
  struct Guess {
    double x, from;  // from: the last position in the extrapolation to x, nearest to the change
  };
  [[nodiscard]] std::optional<Guess> guess_from(const std::vector<Place>& places) const;

  std::array<double, 2> bounds_{0.0, 1.0};
  // Positions with the sequence of the step's beginning, and with that of its end. The position nearest to
  // the change is last.
  std::array<std::vector<Place>, 2> sides_;
  std::optional<Guess> guess_;
  double enough_, guess_error_;  // guess_error_: estimated error of the guess / its distance from Guess::from
};

}  // namespace signorini::orbit
