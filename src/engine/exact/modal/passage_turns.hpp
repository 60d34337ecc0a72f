// passage_turns.hpp: extreme values of N, T, g and ut within a passage, in modes.
//
//   places where a peak may exceed the earlier range: first by slow modes, then with ripples of the size of rounding
//
// A proof (modal_proof.hpp, damped_proof.hpp) is a step of length unit() that was expanded from a point, and offers
//   within(at, known, x_end)                     the part of [0, x_end] without a turn beyond the known ranges
//   expand_beside(at, known, share, remaining)   a new step, with ripples up to that share of the ranges; its length
//   see_begin(at, time, turning, turns)          turning points at a point itself
//   series(at)                                   the contacts' slow parts on the step
#pragma once

#include <algorithm>
#include <utility>

#include "base/rounding.hpp"
#include "engine/exact/modal/modal_flow.hpp"

namespace signorini {

/// Bounds on the contribution of fast modes, relative to the range of the quantity. Localising a peak needs ripples of
/// the size of rounding. Excluding a peak needs only ripples that leave the answer decidable: larger ones allow longer
/// steps, but do not separate a value near the greatest one so far from a greater one. Chosen values.
inline constexpr double fine_ripple = rounding::of_elimination, greatest_ripple = 1e-4, least_ripple = 1e-10,
                        ripple_step = 10.0;

/// advance(from, step, to): the closed form. begin: the time of `from`; observed: the passage begins with a segment,
/// whose beginning was already examined.
template <class Proof, class Advance>
void find_passage_turns(Proof& proof, const Advance& advance, const ModalPoint& from, double begin,
                        double length, bool observed, TurningPoints& turning, LastTurns& turns) {
  if (!observed) proof.see_begin(from, begin, turning, turns);
  const double x_end = length / proof.unit(), x = proof.within(from, turning, x_end);
  if (x >= x_end) return;
  double done = x * proof.unit();
  ModalPoint point, next;
  advance(from, done, point);
  const auto go = [&](double step) {
    advance(point, step, next);
    std::swap(point, next);
    done += step;
  };
  double share = greatest_ripple;
  for (bool moved = true; done < length;) {
    // A quantity that was monotone up to here may turn at this very point.
    if (moved) proof.see_begin(point, begin + done, turning, turns);
    const double look = proof.expand_beside(point, turning, share, length - done);
    const double safe = look > 0.0 ? proof.within(point, turning, look / proof.unit()) * proof.unit() : 0.0;
    moved = safe > 0.0;
    if (moved) go(safe);
    if (moved && safe >= look) {
      share = std::min(greatest_ripple, share * ripple_step);
      continue;
    }
    if (!moved && share > least_ripple) {
      share = std::max(least_ripple, share / ripple_step);
      continue;
    }
    // At the end of the passage a slope may be only rounding and then has no direction.
    if (!(done < length)) return;
    const double step = proof.expand_beside(point, turning, fine_ripple, length - done);
    if (!(step > 0.0)) return;
    Series clock;
    clock.t = begin + done;
    clock.scale = proof.unit();
    const auto ends = observed && !(done > 0.0) ? TurningPoints::Ends::first_part : TurningPoints::Ends::part;
    turning.find(proof.series(point), clock, 0.0, step / proof.unit(), ends);
    for (const TurningPoints::Turn& turn : turning.turns()) turns[turn.kind] = turn.time;
    go(step);
    moved = true;
  }
}

}  // namespace signorini
