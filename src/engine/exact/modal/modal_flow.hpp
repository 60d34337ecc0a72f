// modal_flow.hpp: interface of a method that computes the motion in a segment in modes, for engine `exact`.
//
//   start -> pass -> advance -> rearm -> pass ...       motion, forces and works: at any point in between
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

/// An interval that contains no event before its end.
struct Passage {
  double length = 0.0;
  std::optional<std::size_t> triggered;  ///< slot of the guard that reaches zero at the end; nullopt: none
  bool unseen = false;                   ///< see TriggeredGuard::never_positive
  std::vector<std::size_t> touches;      ///< slots of guards that touch zero within rounding in the interval
};

/// Time of the last turning point of each TurningPointDetector::TurningPoint::kind.
using LastTurningTimes = std::map<std::size_t, double>;

/// Sums of the magnitudes of the terms of a motion, in the norm of M: terms of the amplitudes of the unconstrained modes, of
/// their rates, and of omega times the amplitudes.
struct SumTerms {
  double amplitude = 0.0, rate = 0.0, omega_amplitude = 0.0;
};

class ModalFlow {
 public:
  virtual ~ModalFlow() = default;
  /// Starts a segment, which must stay valid until the next start. q, rate: amplitudes of the unconstrained modes and their
  /// rates at its beginning. now: receives the same motion in the modes of the flow. Returns the reason why the flow cannot
  /// compute the segment, or an empty string.
  [[nodiscard]] virtual std::string start(const engine::Segment& segment, const Vector& q, const Vector& rate,
                                          ModalPoint& now) = 0;
  /// Longest interval from `at` that provably contains no event before its end; at most `remaining` long.
  [[nodiscard]] virtual Passage pass(const ModalPoint& at, double remaining) = 0;
  /// Called after a passage without an event: arms waiting guards that are clearly positive at `at`.
  virtual void rearm(const ModalPoint& at) = 0;
  /// Computes `to`, the motion at the time `time` after `from`, in closed form.
  virtual void advance(const ModalPoint& from, double time, ModalPoint& to) const = 0;
  /// Writes the amplitudes of the unconstrained modes, their rates and, if change is not null, their accelerations.
  virtual void motion(const ModalPoint& at, Vector& q, Vector& rate, Vector* change) const = 0;
  /// Writes N and T of all contacts into a point whose u and v are known.
  virtual void forces(const ModalPoint& at, motion::Point& point) const = 0;
  /// Time derivative of a guard at time t.
  [[nodiscard]] virtual double slope(std::size_t slot, const ModalPoint& at, const motion::Point& point,
                                     double t) const = 0;
  /// Sum of the magnitudes of the terms of a guard, to which its rounding error is relative.
  [[nodiscard]] virtual double magnitude(std::size_t slot, const ModalPoint& at) const = 0;
  /// Finds extremes of N, T, g and ut beyond their earlier ranges in the last passage, from `from` at time `begin`. observed:
  /// the passage is the first of a step, so its beginning was already examined.
  virtual void find_turning_points(const ModalPoint& from, double begin, double length, bool observed,
                                   events::TurningPointDetector& turning, LastTurningTimes& turns) = 0;
  /// Adds the works between two points of the segment. time: length of this interval.
  virtual void add_works(const ModalPoint& from, const ModalPoint& to, double time,
                         motion::WorkIntegrals& works) const = 0;
  /// Same meaning as FastModes::fast_mode_bound(), for the interval of length `time` from `from`.
  [[nodiscard]] virtual std::optional<engine::FastModeBound> fast_mode_bound(const ModalPoint& from,
                                                                             double time,
                                                                             double omega) const = 0;
  /// The uncoupled modes of the contact states. Null if the flow uses complex modes.
  [[nodiscard]] virtual ModalSystem* modes() { return nullptr; }
  /// See StepFacts::eigenvector_condition; for the current segment.
  [[nodiscard]] virtual double eigenvector_condition() const = 0;
  /// Magnitudes of the terms in the sums over modes, for the rounding error of cancellation. A flow without cancellation returns
  /// zeros.
  [[nodiscard]] virtual SumTerms terms(const ModalPoint& /*at*/) const { return {}; }
  /// Number of contact states whose modes were computed.
  [[nodiscard]] virtual long states_made() const = 0;
};

// Cache of unconstrained modes, and of complex modes of contact states, for all runs of one structure.
//
//   ModalCache memory;      ListenerNeeds::modal->memory = &memory: for successive runs, e.g. of orbits and branches
//
// Computing the complex modes of a contact state takes as long as computing many periods of the motion. The modes depend on the
// structure alone. Only the list of pairs with a small sum of roots (RootSums::slow in damped_system.hpp) depends on the length
// of the run. Stored data are computed for 8 times the length of the first run. These data are used for runs up to this length,
// and for runs up to 1e4 times shorter. In the shortest runs the works of listed pairs are less accurate; the motion is not
// affected.

class ModalSystem;

class ModalCache {
 public:
  struct Entry {
    Entry(const Model& of, double longest) : model(of), basis(model), t_end(longest) {}
    Entry(const Entry&) = delete;
    Entry& operator=(const Entry&) = delete;
    const Model model;  ///< its load histories and initial state are not used
    const UnconstrainedBasis basis;
    const double t_end;
    std::unique_ptr<DampedSystem> damped;  ///< null before the first use
  };

  /// Returns the stored data if they fit this structure and the run length t_end, otherwise new data.
  [[nodiscard]] std::shared_ptr<Entry> entry_for(const Model& model, double t_end);

 private:
  std::shared_ptr<Entry> kept_;
};

/// Data that the engine shares with a listener of its run.
struct SharedModalData {
  ModalCache* memory = nullptr;  ///< data of earlier runs, or null
  ModalSystem* modes = nullptr;  ///< set by the engine: its uncoupled modes, or null
};

// Extreme values of N, T, g and ut within a passage, in modes.
//
//   1. intervals in which an extreme beyond the earlier range is possible, from the slow modes and a bound on the fast modes
//   2. in these intervals, steps so short that the fast modes contribute only rounding
//
// A Proof (modal_proof.hpp, damped_proof.hpp) represents a step of length step_length() from a point. It has these functions:
//   length_without_turning(at, known, x_end)         x up to which [0, x_end] contains no extreme beyond the ranges
//   expand_for_turning(at, known, share, remaining)  begins a new step, on which the fast modes contribute at most this
//                                                    share of each range; returns the length of the step
//   find_turning_at_start(at, time, turning, turns)  finds extremes at the point `at`
//   series(at)                                       slow parts of the contacts' quantities on the step

/// Admissible contribution of fast modes, relative to the range of the quantity; chosen. To locate an extreme, the contribution
/// must be as small as rounding. To exclude an extreme, a larger limit allows longer steps, but fails if the quantity is close
/// to its greatest value so far.
inline constexpr double fine_fast_share = rounding::elimination, max_fast_share = 1e-4,
                        min_fast_share = 1e-10, fast_share_step = 10.0;

/// Finds the turning points in a passage of this length from `from` at time `begin`. advance(from, step, to) computes the
/// motion in closed form. observed: the passage is the first of a step, so its beginning was already examined.
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
    // A quantity that was monotone in the last step may have an extreme at this point.
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
    // Stop at the end of the passage: a slope there may be only a rounding error without a significant sign.
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
