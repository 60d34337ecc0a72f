// modal_flow.hpp: interface of a method by which engine `exact` follows a segment in modes.
//
//   start -> pass -> advance -> rearm -> pass ... ;   motion, forces and works at any point in between
//
// There are two methods: uncoupled modes for damping proportional to the mass (proportional_flow.hpp), and complex
// modes for all other linear laws (damped_flow.hpp).
#pragma once

#include <map>
#include <optional>
#include <string>

#include "base/rounding.hpp"
#include "engine/exact/modal/oscillators.hpp"
#include "engine/falls/turning_points.hpp"
#include "engine/stepper.hpp"

namespace signorini {

class ModalSystem;

/// A stretch without an event, or up to one.
struct Passage {
  double length = 0.0;
  std::optional<std::size_t> fired;  ///< slot of the guard that reaches zero at its end
  bool unseen = false;               ///< Fired::unseen
  std::vector<std::size_t> touches;  ///< slots whose guards touch zero within rounding
};

/// Last turning point of each kind: see TurningPoints::Turn.
using LastTurns = std::map<std::size_t, double>;

/// Sums of magnitudes: of the amplitudes of open modes, in the norm of M; of their rates; of omega times the
/// amplitudes.
struct SumTerms {
  double place = 0.0, rate = 0.0, swing = 0.0;
};

class ModalFlow {
 public:
  virtual ~ModalFlow() = default;
  /// q, rate: amplitudes of the open modes at the beginning; now: the same motion in this flow's modes. The segment
  /// must live until the next start. Returns the reason why the segment cannot be followed; empty: it can.
  [[nodiscard]] virtual std::string start(const Segment& segment, const Vector& q, const Vector& rate,
                                          ModalPoint& now) = 0;
  [[nodiscard]] virtual Passage pass(const ModalPoint& at, double remaining) = 0;
  /// Called after a passage without an event: updates the armed guards.
  virtual void rearm(const ModalPoint& at) = 0;
  virtual void advance(const ModalPoint& from, double time, ModalPoint& to) const = 0;
  /// Amplitudes of the open modes, their rates and, if change is not null, their accelerations.
  virtual void motion(const ModalPoint& at, Vector& q, Vector& rate, Vector* change) const = 0;
  /// N and T of all contacts, at a point whose u and v are known.
  virtual void forces(const ModalPoint& at, Point& point) const = 0;
  /// Rate of a guard at time t.
  [[nodiscard]] virtual double slope(std::size_t slot, const ModalPoint& at, const Point& point,
                                     double t) const = 0;
  /// Sum of the magnitudes of a guard's terms.
  [[nodiscard]] virtual double magnitude(std::size_t slot, const ModalPoint& at) const = 0;
  /// Finds places in the last passage, which begins at time `begin`, where N, T, g and ut turn beyond their earlier
  /// ranges. observed: the beginning is that of a step and was already examined.
  virtual void find_turns(const ModalPoint& from, double begin, double length, bool observed,
                          TurningPoints& turning, LastTurns& turns) = 0;
  virtual void add_works(const ModalPoint& from, const ModalPoint& to, double time, Works& works) const = 0;
  /// Same meaning as FastModes::fast_mode_bound, from that point on for the given time.
  [[nodiscard]] virtual std::optional<Ripple> ripple(const ModalPoint& from, double time,
                                                     double omega) const = 0;
  /// The uncoupled modes of contact states; null: the flow uses complex modes.
  [[nodiscard]] virtual ModalSystem* modes() { return nullptr; }
  /// StepFacts::eigenvector_condition of the segment.
  [[nodiscard]] virtual double dependence() const = 0;
  /// Sums of terms that cancel in the sum over modes.
  [[nodiscard]] virtual SumTerms terms(const ModalPoint& /*at*/) const { return {}; }
  /// Number of contact states whose modes were computed.
  [[nodiscard]] virtual long states_made() const = 0;
};

}  // namespace signorini
