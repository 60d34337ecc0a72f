// verify.hpp: IDA against the paper's Newmark algorithm, on one scene.
//
//   newmark at dt, dt/2, dt/4 -> order, R, bar                 (richardson.hpp)
//   |ida - R| <= bar + what IDA's certificate says of its own error
//
// at every event and output time: for the times of events, displacements, velocities, N and T of the contacts,
// and outputs, at as many output times as `VerifyRequest::rows`. Output times that an event of one run may have
// passed and of another not are left out. Extremes of outputs, where all runs are complete, against the finest
// step of newmark. Everything counts up to the first instant from which IDA's sequence
// is not certain, or that of newmark changes with its step.
//
//   agree      all of it does, to the end
//   differ     something does not: which event or quantity, when, by how much
//   undecided  steps are too coarse, or something is not certain to the end;
//              or the third witness, exact where it takes the scene, stands
//              with IDA, so that it is newmark's bar that is too short
//
// Without a dt it is halved from some coarse one until the sequence and the orders have settled, as far as
// the expected cost allows.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "signorini/certify.hpp"

namespace signorini {

struct VerifyRequest {
  RunSpec run;
  std::optional<double> dt;                           ///< the coarsest of three; absent: found
  int rows = 200;                                     ///< output times
  double most_seconds = 30.0;                         ///< expected, of the finest run of newmark
  std::function<bool()> go_on = [] { return true; };  ///< false: the user asks for a stop
};

/// What was compared at one instant: of an event its time, else a column.
struct Observation {
  double t = 0.0;
  double ida = 0.0, ida_error = 0.0;
  double richardson = 0.0, bar = 0.0;
  std::optional<double> exact;

  [[nodiscard]] double difference() const;
  [[nodiscard]] double allowed() const { return bar + ida_error; }
  [[nodiscard]] bool agrees() const { return difference() <= allowed(); }
  /// The third witness stands with IDA, and not with newmark.
  [[nodiscard]] bool witnessed() const;
};

struct VerifiedEvent {
  int contact = 0;
  EventType type = EventType::slip;
  State from = State::open, to = State::open;
  Observation time;
};

/// All quantities of one kind: "event_time", "displacement", "rotation", "velocity", "angular_velocity",
/// "force", "output [UNIT]", "extremes [UNIT]".
struct VerifiedKind {
  std::string name, unit;
  std::optional<double> order;  ///< nothing: differences are rounding
  std::size_t compared = 0, disagreeing = 0, witnessed = 0;
  Observation worst;                 ///< of the greatest difference beside what is allowed
  std::string where;                 ///< its column; empty for events
  std::optional<Observation> first;  ///< that disagrees
  std::string first_where;
  double greatest_bar = 0.0;
};

/// Doubling the step to dt changes displacements by `change` of the greatest.
struct StepTest {
  double dt = 0.0, change = 0.0;
};

enum class Agreement { agree, differ, undecided };

struct Verification {
  Agreement verdict = Agreement::undecided;
  std::string sentence;
  std::vector<double> dt;  ///< of newmark: h, h/2, h/4
  double until = 0.0;      ///< up to where all was compared
  std::vector<VerifiedKind> kinds;
  std::vector<VerifiedEvent> events;
  std::vector<StepTest> step_tests;
  std::optional<double> paper_dt;  ///< the greatest dt whose doubling changes less than `paper_change`
  std::string witness;             ///< of exact: what it says
  CertifiedReport ida;
  bool interrupted = false;
};

/// Of the greatest displacement; the paper gives no number.
inline constexpr double paper_change = 0.01;

/// `own`: IDA's model; the same but in tests. Errors: SceneError for what IDA or newmark refuse.
[[nodiscard]] Verification verify(const Model& model, const Model& own, const VerifyRequest& request);

[[nodiscard]] const char* to_string(Agreement verdict);

}  // namespace signorini
