// modal_flow.hpp: interface of a method by which engine `exact` follows a segment in modes.
//
//   start -> pass -> advance -> rearm -> pass ... ;   motion, forces and works at any point in between
//
// There are two methods: uncoupled modes for damping proportional to the mass (proportional_flow.hpp), and complex
// modes for all other linear laws (damped_flow.hpp).
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "base/rounding.hpp"
#include "engine/events/turning_points.hpp"
#include "engine/exact/modal/damped_system.hpp"
#include "engine/exact/modal/oscillators.hpp"
#include "engine/stepper.hpp"

namespace signorini::modal {

class ModalSystem;

/// An interval without an event, or up to the first one.
struct Passage {
  double length = 0.0;
  std::optional<std::size_t> triggered;  ///< slot of the guard that reaches zero at its end
  bool unseen = false;                   ///< TriggeredGuard::never_positive
  std::vector<std::size_t> touches;      ///< slots whose guards touch zero within rounding
};

/// Time of the last turning point of each TurningPointDetector::TurningPoint::kind.
using LastTurningTimes = std::map<std::size_t, double>;

/// Magnitudes, in the norm of M, of the terms whose sums are the amplitudes of the unconstrained modes, their
/// rates, and omega times the amplitudes.
struct SumTerms {
  double amplitude = 0.0, rate = 0.0, omega_amplitude = 0.0;
};

class ModalFlow {
 public:
  virtual ~ModalFlow() = default;
  /// q, rate: amplitudes of the unconstrained modes at the beginning, and their rates; now: receives the same
  /// motion in this flow's modes. The segment must live until the next start. Returns the reason why the
  /// segment cannot be followed; empty: it can.
  [[nodiscard]] virtual std::string start(const engine::Segment& segment, const Vector& q, const Vector& rate,
                                          ModalPoint& now) = 0;
  /// The next interval from `at`, of length `remaining` at most, for which the proof succeeds.
  [[nodiscard]] virtual Passage pass(const ModalPoint& at, double remaining) = 0;
  /// Called after a passage without an event: updates the armed guards.
  virtual void rearm(const ModalPoint& at) = 0;
  /// The motion `time` later, in closed form.
  virtual void advance(const ModalPoint& from, double time, ModalPoint& to) const = 0;
  /// Amplitudes of the unconstrained modes, their rates and, if change is not null, their accelerations.
  virtual void motion(const ModalPoint& at, Vector& q, Vector& rate, Vector* change) const = 0;
  /// N and T of all contacts, at a point whose u and v are known.
  virtual void forces(const ModalPoint& at, motion::Point& point) const = 0;
  /// Rate of a guard at time t.
  [[nodiscard]] virtual double slope(std::size_t slot, const ModalPoint& at, const motion::Point& point,
                                     double t) const = 0;
  /// Sum of the magnitudes of a guard's terms.
  [[nodiscard]] virtual double magnitude(std::size_t slot, const ModalPoint& at) const = 0;
  /// Finds extremes of N, T, g and ut beyond their earlier ranges in the last passage, which begins at time
  /// `begin`. observed: the passage begins with a step, whose beginning was already examined.
  virtual void find_turning_points(const ModalPoint& from, double begin, double length, bool observed,
                                   events::TurningPointDetector& turning, LastTurningTimes& turns) = 0;
  /// Adds the works between two points of the segment, which are `time` apart.
  virtual void add_works(const ModalPoint& from, const ModalPoint& to, double time,
                         motion::WorkIntegrals& works) const = 0;
  /// Same meaning as FastModes::fast_mode_bound, for the given time from `from` on.
  [[nodiscard]] virtual std::optional<engine::FastModeBound> fast_mode_bound(const ModalPoint& from,
                                                                             double time,
                                                                             double omega) const = 0;
  /// The uncoupled modes of contact states; null: the flow uses complex modes.
  [[nodiscard]] virtual ModalSystem* modes() { return nullptr; }
  /// StepFacts::eigenvector_condition of the segment.
  [[nodiscard]] virtual double eigenvector_condition() const = 0;
  /// Magnitudes of the terms in the sums over modes; 0: the terms do not cancel.
  [[nodiscard]] virtual SumTerms terms(const ModalPoint& /*at*/) const { return {}; }
  /// Number of contact states whose modes were computed.
  [[nodiscard]] virtual long states_made() const = 0;
};

// Unconstrained modes, and complex modes of contact states, stored for all runs of one structure.
//
//   ModalCache memory;      ListenerNeeds::modal->memory = &memory: successive runs, e.g. of orbits and their branches
//
// Computing the complex modes of a state takes as long as many periods of motion with them. They depend on
// the structure alone, except for the choice of pairs of modes whose sum of roots is small relative to the
// run (damped_system.hpp). Stored data are computed for runs 8 times as long as the first one. They are used
// for runs up to this length, and for runs shorter by a factor of at most 1e4. In the shortest runs the works
// of such pairs are less accurate; the motion is not affected.

class ModalSystem;

class ModalCache {
 public:
  struct Entry {
    Entry(const Model& of, double longest) : model(of), basis(model), t_end(longest) {}
    Entry(const Entry&) = delete;
    Entry& operator=(const Entry&) = delete;
    const Model model;  ///< load histories and start are unused; directions of loads count
    const UnconstrainedBasis basis;
    const double t_end;
    std::unique_ptr<DampedSystem> damped;  ///< created on request
  };

  /// Stored data for this structure, or new data; t_end: end of the run.
  [[nodiscard]] std::shared_ptr<Entry> entry_for(const Model& model, double t_end);

 private:
  std::shared_ptr<Entry> kept_;
};

/// Data shared by the engine and a listener of its run.
struct SharedModalData {
  ModalCache* memory = nullptr;  ///< from earlier runs; null: none
  ModalSystem* modes = nullptr;  ///< set by the engine: its modes; null: none, or complex ones
};

// Extreme values of N, T, g and ut within a passage, in modes.
//
//   1. places where an extreme may exceed the earlier range, from the slow modes
//   2. there, steps whose fast part is of the size of rounding
//
// A proof (modal_proof.hpp, damped_proof.hpp) is a step of length step_length() from a point, with these
// functions:
//   length_without_turning(at, known, x_end)         part of [0, x_end] without an extreme beyond the ranges
//   expand_for_turning(at, known, share, remaining)  a new step, with a fast part up to that share of the
//                                                    ranges; returns its length
//   find_turning_at_start(at, time, turning, turns)  extremes at the point `at`
//   series(at)                                       slow parts of the contacts' quantities on the step

/// Bounds on the contribution of fast modes, relative to the range of the quantity. To locate an extreme, it
/// must be of the size of rounding. To exclude an extreme, it may be larger: a larger bound allows longer
/// steps, but does not separate a value near the greatest one so far from a greater one. Chosen values.
inline constexpr double fine_fast_share = rounding::elimination, max_fast_share = 1e-4,
                        min_fast_share = 1e-10, fast_share_step = 10.0;

/// advance(from, step, to): the closed form. begin: the time of `from`; observed: the passage begins with a segment,
/// whose beginning was already examined.
template <class Proof, class Advance>
void find_turning_points_in_passage(Proof& proof, const Advance& advance, const ModalPoint& from,
                                    double begin, double length, bool observed,
                                    events::TurningPointDetector& turning, LastTurningTimes& turns) {
  if (!observed) proof.find_turning_at_start(from, begin, turning, turns);
  const double x_end = length / proof.step_length(), x = proof.length_without_turning(from, turning, x_end);
  if (x >= x_end) return;
  double done = x * proof.step_length();
  ModalPoint point, next;
  advance(from, done, point);
  const auto go = [&](double step) {
    advance(point, step, next);
    std::swap(point, next);
    done += step;
  };
  double share = max_fast_share;
  for (bool moved = true; done < length;) {
    // A quantity that was monotone up to here may have its extreme at this point.
    if (moved) proof.find_turning_at_start(point, begin + done, turning, turns);
    const double look = proof.expand_for_turning(point, turning, share, length - done);
    const double safe =
        look > 0.0
            ? proof.length_without_turning(point, turning, look / proof.step_length()) * proof.step_length()
            : 0.0;
    moved = safe > 0.0;
    if (moved) go(safe);
    if (moved && safe >= look) {
      share = std::min(max_fast_share, share * fast_share_step);
      continue;
    }
    if (!moved && share > min_fast_share) {
      share = std::max(min_fast_share, share / fast_share_step);
      continue;
    }
    // At the end of the passage a slope may be only rounding and then has no direction.
    if (!(done < length)) return;
    const double step = proof.expand_for_turning(point, turning, fine_fast_share, length - done);
    if (!(step > 0.0)) return;
    motion::Series clock;
    clock.t = begin + done;
    clock.scale = proof.step_length();
    const auto ends = observed && !(done > 0.0) ? events::TurningPointDetector::Ends::first_part
                                                : events::TurningPointDetector::Ends::part;
    turning.find(proof.series(point), clock, 0.0, step / proof.step_length(), ends);
    for (const events::TurningPointDetector::TurningPoint& turn : turning.turning_points())
      turns[turn.kind] = turn.time;
    go(step);
    moved = true;
  }
}

}  // namespace signorini::modal
