// result.hpp: what a run yields: events, histories, audit, counters, outcome.
//
//   E_kin + E_el + E_contact + D_friction + D_damping + D_impact - W_loads - W_surface = const
//
// A Recorder receives rows as they come; Result is the Recorder that keeps them in memory.
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

/// One contact at an output time.
struct ContactSample {
  State state = State::open;
  double gap = 0.0, ut = 0.0, vt = 0.0, slip = 0.0, N = 0.0, T = 0.0;
  double memory = 0.0;  ///< p of a law of one's own
};

/// The energies at one instant; dissipations and works since t = 0. Unit: force * length.
struct Energy {
  double kinetic = 0.0, elastic = 0.0, contact = 0.0;
  double damping = 0.0, friction = 0.0, impact = 0.0;  ///< dissipated
  double loads = 0.0, surface = 0.0;                   ///< work done on the structure
  [[nodiscard]] double stored() const { return kinetic + elastic + contact; }
  [[nodiscard]] double balance() const { return stored() + damping + friction + impact - loads - surface; }
};

/// The energies by name; `balance` follows from them.
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

/// The state at an output time. u, v: of the physical degrees of freedom.
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

/// curves.csv: displacements and energies as a picture needs them, each with times of its own.
struct Curves {
  std::vector<std::string> names;
  std::vector<std::vector<CurvePoint>> points;  ///< a list a name; t ascends, and may repeat
};

/// One side of an instant: of all degrees of freedom of the model, those of a reduced one are amplitudes.
struct InstantSide {
  Vector u, v, a;                    ///< a: after the instant; just before it empty
  std::vector<ContactState> states;  ///< one a contact
  Vector forces;                     ///< of all contacts, in the order of the model's layout
};

/// What a rigid contact takes of one impact; those of an instant come one after the other, turn 1, 2, ...
struct InstantBlow {
  int contact = 0, turn = 1;
  double normal = 0.0, tangent = 0.0;  ///< on the body along n and t; force * time
};

/// An instant at which states were decided, whether any changed or not: two rows of instants.csv.
struct InstantRow {
  double t = 0.0;
  double resolution = 0.0;  ///< times closer than this are one instant
  double forgiven = 0.0;    ///< by how many of their roundings states fail that were said to be undecided
  double dependence = 1.0;  ///< of the modes of engine `exact`: what roundings of their sums are greater by
  bool start = false;       ///< of the run
  bool breakpoint = false;  ///< the forcing is not smooth here
  bool load_jumps = false;
  bool located =
      true;  ///< a guard is zero here; false: the end of a step, at which states were found to differ
  InstantSide before, after;
  std::vector<InstantBlow> blows;
  /// Impulses along n and t that no law of impact gives, slots as those of forces: what stays is set to rest, and
  /// what rounding and tolerances have left of velocities that are zero is taken out. Empty: none.
  Vector captures;
  std::vector<int> released;  ///< contacts that parts without mass left at once
};

/// What whoever follows a run may change in it.
class Steering {
 public:
  virtual ~Steering() = default;
  /// From the present instant on the load of this name ("load 1", or its own) is another function of the time
  /// of the run, amplitude included; outputs follow. Errors: SceneError for a name that is no force or moment,
  /// and for a history that the engine refuses.
  virtual void set_load(const std::string& name, const History& history) = 0;
};

class Recorder {
 public:
  virtual ~Recorder() = default;
  virtual void event(const Event& event) = 0;
  virtual void sample(const Sample& sample) = 0;
  /// At the times of RunSpec::frames: a deformed shape.
  virtual void frame(const Sample& /*sample*/) {}
  /// Whether `motion` and `curves` are of use: they cost a little.
  [[nodiscard]] virtual bool wants_motion() const { return false; }
  /// At the end of a run, once a contact: its motion as a picture needs it (run/motion_record.hpp).
  virtual void motion(int /*contact*/, const std::vector<MotionRow>& /*rows*/) {}
  /// At the end of a run, once: the rest of what a picture needs (run/curve_record.hpp).
  virtual void curves(const Curves& /*curves*/) {}
  /// The model's outputs, at output times and on both sides of every instant; t ascends, and may repeat.
  virtual void response(double /*t*/, const std::vector<double>& /*values*/) {}
  /// Whether `instant` is of use: each hands over several vectors as long as the model.
  [[nodiscard]] virtual bool wants_instants() const { return false; }
  /// After the events of the instant; the first one is the start.
  virtual void instant(const InstantRow& /*instant*/) {}
  /// Whether `steer` is of use: it ends no step, but makes a sample at each.
  [[nodiscard]] virtual bool steers() const { return false; }
  /// At the start, at the end of every step of the engine, and after every event and breakpoint: the state
  /// there. What is changed holds from there on, as after a jump of a load. Return false to end the run.
  virtual bool steer(const Sample& /*now*/, Steering& /*run*/) { return true; }
  /// Called often with the time reached; return false to ask for a stop (an interrupt).
  virtual bool progress(double /*t*/) { return true; }
};

/// How a run ended. Exit code: done 0, stopped 4, interrupted 130.
struct Outcome {
  enum class Kind { done, stopped, interrupted } kind = Kind::done;
  double t = 0.0;      ///< reached
  std::string reason;  ///< one sentence with time, contact, guard; empty when done
  Refusal refusal;     ///< where it stopped because states could not be decided
};

/// A greatest violation, where it happened, and the scale that it is relative to.
struct Extreme {
  double value = 0.0;  ///< in the unit of the scale
  double t = 0.0;
  int contact = -1;
};

struct Audit {
  Extreme gap;          ///< (6) g < 0 beyond N/kn, length
  Extreme tension;      ///< (6) N > 0, force
  Extreme product;      ///< (6) |g N| with g - N/kn, energy
  Extreme friction;     ///< (7) |T| - T_U, force; static limit in stick, kinetic in slip
  Extreme direction;    ///< (7) -T p' > 0, power
  Extreme equilibrium;  ///< residual of the equation of motion, force
  Extreme penetration;  ///< rigid contacts, length
  Extreme energy;       ///< |balance(t) - balance(0)|
  /// Sum of the reactions less that of loads and inertia, force; where a reaction is asked for.
  std::optional<Extreme> reactions;
  double length_scale = 1.0, force_scale = 1.0, power_scale = 1.0, energy_scale = 1.0;
  long impulses_on_closed = 0;        ///< impulses that contacts took while they were closed
  double work_of_loads = 0.0;         ///< greatest |W_loads(t)|
  std::vector<double> friction_work;  ///< dissipated by each contact
  Energy initial, final;
};

struct Counters {
  long steps = 0, residuals = 0, jacobians = 0, factorisations = 0, refactorisations = 0, solves = 0;
  long error_test_failures = 0, convergence_failures = 0, guard_evaluations = 0, restarts = 0;
  long rolled_back = 0;  ///< events that lay inside a step and were found by the polynomial check
  long time_events = 0;
  // exact in modes: combinations of contact states, proven stretches, segments left to the Taylor series
  long contact_states = 0, proof_steps = 0, fallbacks = 0;
  std::map<int, long> steps_by_order;
};

/// Peak of |u(t) - u(0)| over all steps, at the node of a contact.
struct Peak {
  double tangential = 0.0, normal = 0.0;  ///< along the contact's tangent and normal
  double N = 0.0, T = 0.0;                ///< greatest |N|, |T|
};

/// A value and its first time.
struct Turn {
  double value = 0.0, t = 0.0;
};

/// What a support bears, with signs: over all steps and instants, those of Peak among them. least N: the greatest
/// compression. Slip is that of the contact, in the state before the run's first event and at its end.
struct SupportLoad {
  Turn least_N, greatest_N, least_T, greatest_T;
  double slip_at_start = 0.0, slip_at_end = 0.0;
  [[nodiscard]] double residual_slip() const { return slip_at_end - slip_at_start; }
};

/// One stay of a contact on its ground; a hit that rebounds at once has start = end.
struct Landing {
  double start = 0.0, end = 0.0;
  double impulse = 0.0;     ///< of hits and of -N over the stay, force * time
  double peak_force = 0.0;  ///< greatest -N
};

/// On a stretch of an output (Output::stretches): the station on its piece.
struct OutputPlace {
  int stretch = -1;  ///< -1: the output has none
  double station = 0.0;
};

/// Extremes of one output over the whole motion, not only its rows, and its last value. Where it has stretches: over all
/// places, with their signs; its values are magnitudes.
struct OutputExtremes {
  double maximum = 0.0, minimum = 0.0, last = 0.0;  ///< in the unit of the output
  double t_maximum = 0.0, t_minimum = 0.0;          ///< the first time, where several are equal to rounding
  OutputPlace at_maximum = {}, at_minimum = {};
};

/// Which engine computes, and how.
struct Method {
  Engine engine = Engine::ida;  ///< never automatic
  bool automatic = false;       ///< the engine was chosen by the program
  std::string reason;           ///< why; "as given" where it was not
  double accuracy = 0.0;        ///< value of its accuracy key (engine.hpp): rtol, dt, or 0
  int max_order = 5;
  std::string max_order_reason;
  std::string flow = {}, flow_reason = {};  ///< exact: "modal" or "taylor", and why

  /// "as given" or "auto: ..."
  [[nodiscard]] std::string engine_reason() const { return (automatic ? "auto: " : "") + reason; }
};

/// A law that an instant, or the motion between two, breaks (src/witness/witness.hpp).
struct Violation {
  double t = 0.0;
  std::string event;  ///< type of the contact's event; "start", "load", "between", or "" for another contact
  int contact = -1;   ///< -1: of the structure
  std::string law;    ///< "momentum", "restitution", ...
  double value = 0.0, limit = 0.0;
  Unit unit = {};      ///< of value and limit
  bool grave = false;  ///< nothing that was recorded, and no tolerance, explains it: the run ends there
};

/// What the witness of a run has found.
struct Testimony {
  long checked = 0, violated = 0;     ///< instants and stretches that were checked; violations, all of them
  std::vector<Violation> violations;  ///< the first hundred
};

/// Everything about a run but its rows.
struct Report {
  Outcome outcome;
  Method method;
  Counters counters;
  Audit audit;
  std::vector<Peak> peaks;                     ///< one a contact
  std::vector<SupportLoad> supports;           ///< one a contact
  std::vector<std::vector<Landing>> landings;  ///< one list a contact; empty for sliders
  std::vector<OutputExtremes> response;        ///< one an output
  std::map<std::string, long> events_by_type;
  long undecided = 0;  ///< decisions that rounding left open: the states that fail least were taken
  /// When rounding first left states open on which what follows hangs; empty: never.
  std::optional<double> forgiven_at;
  Testimony witness;
  std::vector<std::string> warnings;  ///< one sentence each
  double wall_time = 0.0;             ///< s, integration without reading and assembling
};

/// Keeps all rows in memory.
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
