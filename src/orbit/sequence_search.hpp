// sequence_search.hpp: where along a step of a branch the sequence of events changes.
//
//   d(x)      a stretch between two events, a part of the period, at part x of the step
//   d^2 = c (x* - x) + ...      near x*, where d vanishes because a guard grazes
//   d   = c (x* - x) + ...      where two events change their order
//
// x as a polynomial of d^2, or of d, through the last three places with one sequence gives x* = x(0). The next place lies
// beyond x* or before it, by the error of this guess, so that the interval shrinks from both sides. Without a guess it is
// halved.
//
//   SequenceSearch search(stretches_of(a, T), stretches_of(b, T), enough);
//   while (!search.done()) { x = search.next(); ...; search.see(x, same, stretches_of(there, T)); }
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "signorini/event.hpp"

namespace signorini {

/// Stretches between the events of a period, and from the last one to the first of the next period; parts of the period.
[[nodiscard]] std::vector<double> stretches_of(const std::vector<Event>& events, double period);

class SequenceSearch {
 public:
  /// Stretches at the begin of the step, x = 0, and at its end, x = 1. enough: the width that ends the search.
  SequenceSearch(std::vector<double> at_begin, std::vector<double> at_end, double enough);

  [[nodiscard]] bool done() const { return !(bounds_[1] - bounds_[0] > enough_); }

  /// The place to try next.
  [[nodiscard]] double next();
  /// What is found at x: the sequence of the begin or not, and its stretches; empty: not known.
  void see(double x, bool as_at_begin, std::vector<double> stretches);
  [[nodiscard]] double low() const { return bounds_[0]; }
  [[nodiscard]] double high() const { return bounds_[1]; }

 private:
  struct Place {
    double x;
    std::vector<double> stretches;
  };
  struct Guess {
    double x, from;  // from: the nearest place that it is made of
  };
  [[nodiscard]] std::optional<Guess> guess_from(const std::vector<Place>& places) const;

  std::array<double, 2> bounds_{0.0, 1.0};
  std::array<std::vector<Place>, 2> sides_;  // as at the begin; as at the end. The last one is the nearest
  std::optional<Guess> guess_;               // the last one
  double enough_, doubt_;  // doubt: of a guess, relative to its distance from where it was made
};

}  // namespace signorini
