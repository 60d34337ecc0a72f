// verify.hpp: comparison of IDA with the paper's Newmark algorithm on one scene.
//
//   newmark at dt, dt/2, dt/4 -> order, R, bar                 (richardson.hpp)
//   |ida - R| <= bar + error bound in IDA's certificate
//
// This inequality is checked for the times of events and, at VerifyRequest::rows output times, for
// displacements, velocities, N and T of the contacts, and outputs. Output times that may be before an event
// in one run and after it in another are omitted. If all runs are complete, extremes of outputs are compared
// with the extremes of newmark's finest step. All comparisons end at the first instant from which IDA's
// sequence is not certain, or newmark's sequence changes with its step.
//
//   agree      all differences are allowed, to the end of the run
//   differ     one difference is too large: the result names the event or quantity, the time and the difference
//   undecided  steps are too coarse, or the sequence is not certain to the end; or newmark's bar is too
//              small, because the third engine (exact, if it accepts the scene) agrees with IDA
//
// Without a dt, the step is halved from a coarse one until the sequence and the orders have settled, or until
// the next run would exceed VerifyRequest::max_seconds.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "signorini/certify.hpp"

namespace signorini::verify {

struct VerifyRequest {
  RunSpec run;
  /// Largest of newmark's three steps; absent: chosen automatically.
  std::optional<double> dt;
  int rows = 200;  ///< number of output times
  /// Limit for the expected wall time of newmark's finest run.
  double max_seconds = 30.0;
  std::function<bool()> go_on = [] { return true; };  ///< returns false if the user interrupts
};

/// Comparison of one value: the time of an event, or the value of a column at an output time.
struct Observation {
  double t = 0.0;
  double ida = 0.0, ida_error = 0.0;
  double richardson = 0.0, bar = 0.0;
  std::optional<double> exact;

  [[nodiscard]] double difference() const;
  [[nodiscard]] double allowed() const { return bar + ida_error; }
  [[nodiscard]] bool agrees() const { return difference() <= allowed(); }
  /// True if the third engine, exact, agrees with IDA and not with newmark.
  [[nodiscard]] bool exact_agrees() const;
};

struct VerifiedEvent {
  int contact = 0;
  EventType type = EventType::slip;
  State from = State::open, to = State::open;
  Observation time;
};

/// All quantities of one kind: "event_time", "displacement", "rotation", "velocity", "angular_velocity", "force",
/// "output [UNIT]", "extremes [UNIT]".
struct VerifiedKind {
  std::string name, unit;
  std::optional<double> order;  ///< observed order; nullopt: differences consist of rounding
  std::size_t compared = 0, disagreeing = 0, exact_agreements = 0;
  Observation worst;                 ///< observation with the largest difference relative to the allowed one
  std::string where;                 ///< column of `worst`; empty for events
  std::optional<Observation> first;  ///< first observation that disagrees
  std::string first_where;
  double greatest_bar = 0.0;
};

/// Doubling the step dt changes displacements by `change`, relative to the largest displacement.
struct StepTest {
  double dt = 0.0, change = 0.0;
};

enum class Agreement { agree, differ, undecided };

struct Verification {
  Agreement verdict = Agreement::undecided;
  std::string sentence;
  std::vector<double> dt;  ///< steps of newmark: h, h/2, h/4
  double until = 0.0;      ///< end of the compared time
  std::vector<VerifiedKind> kinds;
  std::vector<VerifiedEvent> events;
  std::vector<StepTest> step_tests;
  /// Largest dt whose doubling changes displacements by less than `paper_change`.
  std::optional<double> paper_dt;
  std::string exact_result;  ///< result of the third engine, exact
  CertifiedReport ida;
  bool interrupted = false;
};

/// Limit of StepTest::change in the paper's criterion for the step; the paper gives no number.
inline constexpr double paper_change = 0.01;

/// Compares IDA with newmark. own: IDA's model, which differs from `model` only in tests. Errors: SceneError
/// for scenes that IDA or newmark refuses.
[[nodiscard]] Verification verify(const Model& model, const Model& own, const VerifyRequest& request);

[[nodiscard]] const char* to_string(Agreement verdict);

}  // namespace signorini::verify
