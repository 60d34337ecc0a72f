// sequence_search.hpp: locates a change of the sequence of events along a step of a branch.
//
//   d(x)      length of a stretch between two events, relative to the period, at position x of the step
//   d^2 = c (x* - x) + ...      near x*, where d vanishes because a guard grazes
//   d   = c (x* - x) + ...      where two events exchange their order
//
// A polynomial x(d^2), or x(d), through the last three places with one sequence gives x* = x(0). The next
// place is beyond x* or before it by the error of this guess, so that the interval shrinks from both sides.
// Without a guess the interval is halved.
//
//   SequenceSearch search(stretches_of(a, T), stretches_of(b, T), enough);
//   while (!search.done()) { x = search.next(); ...; search.update(x, same, stretches_of(at_x, T)); }
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "signorini/event.hpp"

namespace signorini::orbit {

/// Lengths of the stretches between the events of a period, and from the last event to the first of the next
/// period; relative to the period.
[[nodiscard]] std::vector<double> stretches_of(const std::vector<Event>& events, double period);

class SequenceSearch {
 public:
  /// Lengths of stretches at the beginning of the step, x = 0, and at its end, x = 1. enough: width of the
  /// interval at which the search ends.
  SequenceSearch(std::vector<double> at_begin, std::vector<double> at_end, double enough);

  [[nodiscard]] bool done() const { return !(bounds_[1] - bounds_[0] > enough_); }

  /// The place to try next.
  [[nodiscard]] double next();
  /// Enters the result at x. as_at_begin: the sequence is that of the beginning; stretches: empty if unknown.
  void update(double x, bool as_at_begin, std::vector<double> stretches);
  [[nodiscard]] double low() const { return bounds_[0]; }
  [[nodiscard]] double high() const { return bounds_[1]; }

 private:
  struct Place {
    double x;
    std::vector<double> stretches;
  };
  struct Guess {
    double x, from;  // from: the nearest place that it is based on
  };
  [[nodiscard]] std::optional<Guess> guess_from(const std::vector<Place>& places) const;

  std::array<double, 2> bounds_{0.0, 1.0};
  // Places with the sequence of the beginning, and of the end; the nearest place is last.
  std::array<std::vector<Place>, 2> sides_;
  std::optional<Guess> guess_;   // the last guess
  double enough_, guess_error_;  // guess_error_: of a guess, relative to its distance from the nearest place
};

}  // namespace signorini::orbit
