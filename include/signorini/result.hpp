// result.hpp: results of a run: events, histories, audit, counters, outcome.
//
//   E_kin + E_el + E_contact + D_friction + D_damping + D_impact - W_loads - W_surface = const
//
// A Recorder receives rows during the run; Result is the Recorder that keeps them in memory.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "signorini/contact.hpp"
#include "signorini/engine.hpp"
#include "signorini/event.hpp"
#include "signorini/model.hpp"
#include "signorini/trace.hpp"

namespace signorini {

/// One contact at an output time. slip: p, see contact.hpp; N and T: force. Signs: docs/theory.md.
struct ContactSample {
  State state = State::open;
  double gap = 0.0, ut = 0.0, vt = 0.0, slip = 0.0, N = 0.0, T = 0.0;
  double memory = 0.0;  ///< p of a user law
};

/// Energies at one instant; dissipated energy and work are sums since t = 0. Unit: force * length.
struct Energy {
  double kinetic = 0.0, elastic = 0.0, contact = 0.0;
  double damping = 0.0, friction = 0.0, impact = 0.0;  ///< dissipated
  double loads = 0.0, surface = 0.0;                   ///< work done on the structure
  [[nodiscard]] double stored() const { return kinetic + elastic + contact; }
  [[nodiscard]] double balance() const { return stored() + damping + friction + impact - loads - surface; }
};

/// Names of the energies in files. `balance`, Energy::balance(), has no member.
struct EnergyColumn {
  const char* name;
  double Energy::*value;
};
inline constexpr std::array energy_columns = {
    EnergyColumn{"kinetic", &Energy::kinetic},   EnergyColumn{"elastic", &Energy::elastic},
    EnergyColumn{"contact", &Energy::contact},   EnergyColumn{"damping", &Energy::damping},
    EnergyColumn{"friction", &Energy::friction}, EnergyColumn{"impact", &Energy::impact},
    EnergyColumn{"loads", &Energy::loads},       EnergyColumn{"surface", &Energy::surface},
};
inline constexpr const char* balance_column = "balance";

/// State at an output time. u, v: physical degrees of freedom.
struct Sample {
  double t = 0.0;
  const Vector* u = nullptr;
  const Vector* v = nullptr;
  std::vector<ContactSample> contacts;
  Energy energy;
};

/// A row of motion.csv.
struct MotionRow {
  double t = 0.0;
  ContactSample sample;
};

/// A row of curves.csv.
struct CurvePoint {
  double t = 0.0, value = 0.0;
};

/// Data of curves.csv: displacements and energies for a picture; each curve has its own times.
struct Curves {
  std::vector<std::string> names;
  std::vector<std::vector<CurvePoint>> points;  ///< one list per name; t never decreases
};

/// State on one side of an instant, for all degrees of freedom of the model (in a reduced model: mode amplitudes).
struct InstantSide {
  Vector u, v, a;                    ///< acceleration after the instant; empty before the instant
  std::vector<ContactState> states;  ///< one for each contact
  Vector forces;                     ///< forces of all contacts, in the order of the model's layout
};

/// Impulse of one impact on a rigid contact. Successive impacts at an instant are numbered 1, 2, ...
struct InstantImpact {
  int contact = 0, impact_number = 1;
  double normal = 0.0, tangent = 0.0;  ///< on the body along n and t; force * time
};

/// An instant at which contact states were decided, changed or not: two rows of instants.csv.
struct InstantRow {
  double t = 0.0;
  double resolution = 0.0;  ///< two times closer than this are treated as one instant
  /// Largest violation of a guard, as a multiple of its rounding error, in states that were accepted although rounding left
  /// the decision open.
  double tolerated_violation = 0.0;
  /// Engine `exact`: condition number of the mode shapes, by which rounding errors of modal sums are multiplied.
  double eigenvector_condition = 1.0;
  bool start = false;       ///< true: the instant is the start of the run
  bool breakpoint = false;  ///< true: the forcing is not smooth at this instant
  bool load_jumps = false;
  /// True: a guard is zero at this instant. False: the instant is the end of a step in which a change of state was detected.
  bool located = true;
  InstantSide before, after;
  std::vector<InstantImpact> impacts;
  /// Impulses along n and t in addition to the impact law, in the order of forces. They stop contacts that stay closed, and
  /// remove the remainder that rounding and tolerances leave in velocities that are zero. Empty: none.
  Vector capture_impulses;
  std::vector<int> released;  ///< contacts from which massless parts separate instantaneously
};

/// Changes that an observer may make during a run.
class Steering {
 public:
  virtual ~Steering() = default;
  /// From the present instant on, replaces the history of the load with this name ("load 1", or a given name) by a function
  /// of the run's time that includes the amplitude. Outputs that contain the load change too. Errors: SceneError if the load
  /// is not a force or moment, or if the engine refuses the history.
  virtual void set_load(const std::string& name, const History& history) = 0;
};

class Recorder {
 public:
  virtual ~Recorder() = default;
  /// Called for each row of events.csv.
  virtual void event(const Event& event) = 0;
  /// Called at each output time.
  virtual void sample(const Sample& sample) = 0;
  /// Called at the times of RunSpec::frames with a deformed shape.
  virtual void frame(const Sample& /*sample*/) {}
  /// True if `motion` and `curves` are used; recording their data slows the run slightly.
  [[nodiscard]] virtual bool wants_motion() const { return false; }
  /// Called at the end of a run, once per contact, with the contact's motion for a picture (run/motion_record.hpp).
  virtual void motion(int /*contact*/, const std::vector<MotionRow>& /*rows*/) {}
  /// Called once at the end of a run, with displacements and energies over time for a picture (run/curve_record.hpp).
  virtual void curves(const Curves& /*curves*/) {}
  /// Called with the model's outputs at output times and on both sides of every instant, so t never decreases.
  virtual void response(double /*t*/, const std::vector<double>& /*values*/) {}
  /// True if `instant` is used; each call copies several vectors of the model's size.
  [[nodiscard]] virtual bool wants_instants() const { return false; }
  /// Called after the events of an instant; the first call is for the start of the run.
  virtual void instant(const InstantRow& /*instant*/) {}
  /// True if `steer` is used. A steered run takes the same steps, but computes a sample after each step.
  [[nodiscard]] virtual bool steers() const { return false; }
  /// Called with the current state at the start, at the end of every engine step, and after every event and breakpoint. A
  /// change by `run` acts from then on, like a jump of a load. Return false to end the run.
  virtual bool steer(const Sample& /*now*/, Steering& /*run*/) { return true; }
  /// Called with the current time before and after each instant, after each row and at the end of each step; return false to
  /// interrupt the run. It then ends at this time, and records no later row.
  virtual bool progress(double /*t*/) { return true; }
};

/// How a run ended. Exit code: done 0, stopped 4, interrupted 130.
struct Outcome {
  enum class Kind { done, stopped, interrupted } kind = Kind::done;
  double t = 0.0;      ///< time reached
  std::string reason;  ///< one sentence with time, contact and guard; empty if `done`
  Refusal refusal;     ///< details if the contact states could not be decided
};

/// Largest violation of a condition, its time and its contact.
struct Extreme {
  double value = 0.0;  ///< unit: see the member of Audit
  double t = 0.0;
  int contact = -1;
};

struct Audit {
  Extreme gap;          ///< (6) -(g - N/kn), penetration beyond the spring's deformation, length
  Extreme tension;      ///< (6) N > 0 (tension), force
  Extreme product;      ///< (6) |(g - N/kn) N|, energy
  Extreme friction;     ///< (7) |T| - T_U, force; T_U: static limit in stick, kinetic in slip
  Extreme direction;    ///< (7) -T p' > 0 (T acts along the slip), power
  Extreme equilibrium;  ///< residual of the equation of motion, force
  Extreme penetration;  ///< rigid contacts: |g| if closed, -g if open, length
  Extreme energy;       ///< |balance(t) - balance(0)|
  /// Sum of reactions minus loads and inertia, force; only if a reaction output is requested.
  std::optional<Extreme> reactions;
  /// Number of contacts that rest at their friction limit within rounding error, and the largest | |T| - T_U | of them, force.
  long contacts_at_limit = 0;
  Extreme at_limit;
  double length_scale = 1.0, force_scale = 1.0, power_scale = 1.0, energy_scale = 1.0;
  long impulses_on_closed = 0;        ///< number of impulses on contacts that were closed
  double work_of_loads = 0.0;         ///< largest |W_loads(t)|
  std::vector<double> friction_work;  ///< dissipation of each contact
  Energy initial, final;

  /// Energy to which errors of energies are relative: the exchanged energy, or force_scale * length_scale if the structure is
  /// at rest, so that the exchanged energy is only rounding.
  [[nodiscard]] double energy_reference() const {
    constexpr double least_exchange = 1e-9;  // fraction of force_scale * length_scale; chosen value
    const double of_scales = force_scale * length_scale;
    return energy_scale > least_exchange * of_scales ? energy_scale : of_scales;
  }
};

struct Counters {
  long steps = 0, residuals = 0, jacobians = 0, factorisations = 0, refactorisations = 0, solves = 0;
  long error_test_failures = 0, convergence_failures = 0, guard_evaluations = 0, restarts = 0;
  /// Number of events inside a step that only the check of the step's polynomial found.
  long rolled_back = 0;
  long time_events = 0;
  // Counters of `exact` in modes. contact_states: contact states whose modes were computed. proof_steps: intervals in which
  // the modes gave the first event or proved that there is none. fallbacks: segments computed with Taylor series instead.
  long contact_states = 0, proof_steps = 0, fallbacks = 0;
  std::map<int, long> steps_by_order;
};

/// Largest displacements |u(t) - u(0)| of a contact's node and largest contact forces, over all steps.
struct Peak {
  double tangential = 0.0, normal = 0.0;  ///< along the contact's tangent and normal
  double N = 0.0, T = 0.0;                ///< largest |N|, |T|
};

/// An extreme value and the first time at which it occurs.
struct TimedExtreme {
  double value = 0.0, t = 0.0;
};

/// Extreme forces and slip of a contact, with signs, over all steps and instants. min_N is the largest compression.
/// slip_at_start is the slip after the decision at the start, slip_at_end the slip at the end of the run.
struct SupportLoad {
  TimedExtreme min_N, max_N, min_T, max_T;
  double slip_at_start = 0.0, slip_at_end = 0.0;
  [[nodiscard]] double residual_slip() const { return slip_at_end - slip_at_start; }
};

/// One contact phase, from closing to opening. For an impact with immediate rebound start = end.
struct Landing {
  double start = 0.0, end = 0.0;
  double impulse = 0.0;     ///< impulse of impacts and of -N over the phase, force * time
  double peak_force = 0.0;  ///< largest -N in the phase, force
};

/// Position of an extreme on a segment of an output (Output::segments): station on the segment's piece.
struct OutputPlace {
  int segment = -1;  ///< index of the segment; -1: the output has no segments
  double station = 0.0;
};

/// Extremes of one output over the whole motion, not only at its rows, and its last value. For an output with segments the
/// extremes have signs and cover all places, while rows contain magnitudes.
struct OutputExtremes {
  double maximum = 0.0, minimum = 0.0, last = 0.0;  ///< in the unit of the output
  double t_maximum = 0.0, t_minimum = 0.0;  ///< if several extremes are equal up to rounding: the first time
  OutputPlace at_maximum = {}, at_minimum = {};
};

/// Engine of a run and its settings.
struct Method {
  Engine engine = Engine::ida;  ///< the engine that was used; never automatic
  bool automatic = false;       ///< true: the program chose the engine
  std::string reason;           ///< reason for the choice; "as given" unless automatic
  double accuracy = 0.0;        ///< value of the engine's accuracy key (engine.hpp): rtol, dt, or 0
  int max_order = 5;
  std::string max_order_reason;
  std::string flow = {}, flow_reason = {};  ///< exact: "modal" or "taylor", and the reason

  /// Reason for the engine: "as given" or "auto: ..."
  [[nodiscard]] std::string engine_reason() const { return (automatic ? "auto: " : "") + reason; }
};

/// A law violated at an instant, or by the motion between two instants (src/law_check/law_checker.hpp).
struct Violation {
  double t = 0.0;
  std::string event;  ///< type of the contact's event; "start", "load", "between", or "" for another contact
  int contact = -1;   ///< -1: the structure
  std::string law;    ///< "momentum", "restitution", ...
  double value = 0.0, limit = 0.0;
  Unit unit = {};  ///< unit of value and limit
  /// True: no recorded quantity and no tolerance explains the violation; the run ends.
  bool unexplained = false;
};

/// Results of the law checker of a run.
struct LawCheckSummary {
  /// checked: number of checked instants and motions between instants; violated: number of all violations.
  long checked = 0, violated = 0;
  std::vector<Violation> violations;  ///< the first hundred violations
};

/// All results of a run except its rows.
struct Report {
  Outcome outcome;
  Method method;
  Counters counters;
  Audit audit;
  std::vector<Peak> peaks;                     ///< one per contact
  std::vector<SupportLoad> supports;           ///< one per contact
  std::vector<std::vector<Landing>> landings;  ///< one list per contact; empty for sliders
  std::vector<OutputExtremes> response;        ///< one per output
  std::map<std::string, long> events_by_type;
  /// Number of decisions that rounding left open; the states with the smallest violation were taken.
  long undecided = 0;
  /// First time at which rounding left states undecided that affect the later motion; empty: never.
  std::optional<double> first_undecided;
  LawCheckSummary law_checks;
  std::vector<std::string> warnings;  ///< one sentence each
  double wall_time = 0.0;             ///< time of the integration alone, s
};

/// A Recorder that keeps all rows in memory.
class Result : public Recorder {
 public:
  struct Row {
    double t;
    Vector u, v;
    std::vector<ContactSample> contacts;
    Energy energy;
  };
  void event(const Event& event) override { events.push_back(event); }
  void sample(const Sample& s) override { rows.push_back({s.t, *s.u, *s.v, s.contacts, s.energy}); }
  void response(double t, const std::vector<double>& values) override { responses.push_back({t, values}); }

  /// A row of response.csv.
  struct Response {
    double t;
    std::vector<double> values;
  };

  std::vector<Event> events;
  std::vector<Row> rows;
  std::vector<Response> responses;
  Report report;
};

}  // namespace signorini
