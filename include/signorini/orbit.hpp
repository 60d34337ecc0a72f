// orbit.hpp: periodic motions of a scene, and their stability.
//
//   z = (u, v, T of contacts with a tangential spring)      the state at a fixed phase of the period (section)
//   R(z) = z(T; z) - z = 0                                  forced: T is n times the period of the loads
//   R(z, T) = 0,  z' . dz = 0                               self-excited (belts): T is a further unknown
//   R(z, T) = 0,  z' . dz = 0,  E(z) = E*                   conservative, at a given energy
//   Phi = dz(T)/dz,   multipliers = eig Phi                 |multiplier| < 1: disturbances die out
//
// Newton's method solves R = 0. Phi is computed through every event (sensitivity.hpp), so Newton's method converges
// quadratically as long as the sequence of events does not change.
//
//   Orbit orbit = find_orbit(reader_of("models/frame.toml"));
//   if (orbit.found) simulate(orbit_scene(reader_of("models/frame.toml"), orbit), recorder);     one period
//
// Units: those of the scene. Source: Leine and Nijmeijer, Dynamics and Bifurcations of Non-Smooth Mechanical Systems,
// 2004, chapters 7 and 8.
#pragma once

#include <complex>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "signorini/sensitivity.hpp"

namespace signorini {

struct OrbitOptions {
  /// Period of the loads; absent: the common period of the scene's periodic loads.
  std::optional<double> period = {};
  /// Energy of a conservative motion, in a scene without excitation. With `energy`, `period` is only the initial guess.
  std::optional<double> energy = {};
  int times = 1;       ///< number of load periods after which the orbit closes
  int transient = 20;  ///< periods simulated before Newton's method begins
  /// Target for residual / amplitude in Newton's method; the iteration continues as long as the residual decreases.
  double tolerance = 1e-12;
};

/// Type of loss of stability.
enum class OrbitLoss { none, fold, flip, neimark_sacker };
[[nodiscard]] const char* to_string(OrbitLoss loss);

/// One iteration of Newton's method.
struct OrbitStep {
  double residual = 0.0;  ///< max |R| / amplitude, before the step
  double damping = 1.0;   ///< fraction of the Newton step that was taken; 0: no step, the iteration ended
};

struct Orbit {
  bool found = false;
  /// Reason why no orbit was found, or a property of the orbit that could not be determined; one sentence.
  std::string reason;
  double period = 0.0;      ///< time after which the motion repeats, in the scene's unit of time
  bool autonomous = false;  ///< true: the motion determines the period; false: the loads do
  /// Scene time (of loads, compressions and surface motions) at the orbit's time 0.
  double phase = 0.0;
  double residual = 0.0;   ///< max |z(T) - z| / amplitude
  double amplitude = 0.0;  ///< half the largest range of a displacement, rotations excluded; length
  std::vector<OrbitStep> steps;

  /// Multipliers for all directions in which the state at the section can move, in descending magnitude. An autonomous orbit
  /// has one multiplier 1, along the motion.
  std::vector<std::complex<double>> multipliers;
  /// Error bound of a simple multiplier: the change from Phi at this state to Phi at the state one period later, plus errors
  /// common to both matrices. Common errors are rounding of Phi, steps of its tangents, and with `ida` 100 rtol, each times the
  /// largest entry of Phi. Rounding of the phase omega T in modes, which rotates a multiplier along the unit circle, is not
  /// included.
  double multiplier_error = 0.0;
  /// nullopt: a multiplier lies on the unit circle within its error. For a conservative motion the error is replaced by its
  /// square root, because two equal multipliers separate by the square root of a perturbation.
  std::optional<bool> stable;
  OrbitLoss loss = OrbitLoss::none;
  /// Largest magnitude of the multipliers, without the multipliers 1 along families and along the motion.
  double max_multiplier = 0.0;
  /// Conserved quantities, one name each. Each gives a multiplier 1 along a family of orbits; the search returns the orbit of
  /// the family nearest to its starting point.
  std::vector<std::string> families;

  /// Events of one period from `phase` on, beginning with the event at the orbit's time 0; jumps of loads are left out.
  std::vector<Event> sequence;
  Energy cycle;          ///< changes of dissipated energy, work and stored energy over one period
  double section = 0.0;  ///< time after `phase` at which Newton's method closed the orbit
  SavedState start;      ///< state at the orbit's time 0
};

/// Searches for a periodic motion. The search calls only `progress` of `recorder`, which may stop the search. A failed search
/// returns an Orbit with found = false and a `reason`. Errors are SceneError and UsageError:
///   a scene without a period and without a belt;  loads that do not repeat with `period`
///   a given energy in a driven or damped scene;  an engine or law without tangents (exact and ida have them)
[[nodiscard]] Orbit find_orbit(const SceneReader& read, const OrbitOptions& options = {},
                               Recorder* recorder = nullptr);

/// The scene for one period of the orbit, with the orbit's state as initial state.
[[nodiscard]] Scene orbit_scene(const SceneReader& read, const Orbit& orbit);

/// A point of a branch at which the continuation can restart.
struct BranchCheckpoint {
  double parameter = 0.0;
  bool towards_to = true;                   ///< true: the branch is followed from `from` towards `to`
  Orbit orbit;                              ///< period, phase, autonomous, start
  std::vector<std::string> sequences = {};  ///< sequences of events that occurred so far, by number
  std::size_t point_count = 0;              ///< number of Branch::points up to and including this checkpoint
};

/// Settings for a branch of orbits, along which one key of the scene varies.
struct BranchOptions {
  OrbitOptions orbit = {};
  /// Path of the scene key; "energy": the energy of conservative motions (OrbitOptions::energy).
  std::string path;
  double from = 0.0, to = 0.0;  ///< first and last value of the parameter
  /// Largest step, a norm of two parts: change of the parameter relative to its range, and change of the state relative to
  /// the amplitude.
  double step = 0.02;
  int most_points = 1000;  ///< largest number of points of each branch
  /// Number of successive switches to side branches: at a flip to the branch of twice the period, and at branch points. 0:
  /// only the first branch is computed.
  int switches = 0;
  /// Checkpoint at which the branch resumes; the point of the checkpoint is not repeated.
  std::optional<BranchCheckpoint> resume_from = {};
  /// Called after each point of the first branch. The argument is a function that makes the checkpoint of the point, at the
  /// cost of a run of one period; an interrupted branch can be resumed from the checkpoint.
  std::function<void(const std::function<BranchCheckpoint()>&)> on_checkpoint = {};
};

struct BranchPoint {
  double parameter = 0.0, period = 0.0, amplitude = 0.0;
  std::vector<double> minima, maxima;  ///< one per output, over the period
  double max_multiplier = 0.0, multiplier_error = 0.0, residual = 0.0;
  std::optional<bool> stable;
  OrbitLoss loss = OrbitLoss::none;
  /// Number of the sequence of events, from 1, in the order of first occurrence on the branch.
  int sequence = 0;
  long events = 0;  ///< number of events in one period
  int branch = 1;   ///< 1: the first branch; larger numbers: a branch of Branch::sides
  /// Reasons why the point is special, joined with "+"; empty: the point is not special.
  /// Reasons at a located point:
  ///   "fold"             the parameter reverses its direction along the branch
  ///   "flip", "neimark-sacker", "branch point"
  ///   "sequence"         the last point with its sequence of events
  ///   "end"              the branch ends, for example at a graze where two orbits merge and vanish
  /// At other points, for a change since the previous point:
  ///   "fold"             the parameter reverses at a corner, where the sequence of events changes
  ///   "stability"        stability is gained or lost
  ///   "sequence"         the sequence of events has changed
  ///   "restart"          the branch could not be continued from the previous point
  ///   "switched"         the first point of a side branch
  std::string special;
};

/// A branch that starts from another branch.
struct SideBranch {
  int number = 2, from = 1;  ///< numbers as in BranchPoint::branch
  std::string kind;          ///< "flip", "branch point"
  double parameter = 0.0;    ///< parameter value at which this branch leaves the branch `from`
  std::string end;           ///< reason why the side branch ends, one sentence
  /// True: the branch reached an end of the range, or a branch of twice the period returned to an orbit of the simple period.
  bool complete = false;
};

struct Branch {
  std::vector<BranchPoint> points;
  std::vector<std::string> sequences;  ///< by number, from 1: "stop contact, stop separation"
  std::string end;                     ///< reason why the first branch ends, one sentence
  /// True: the branch reached `to`, or returned to `from` after a fold (`end` then gives the value beyond which no orbit
  /// exists). False: the branch ended before, was interrupted, or returned after a gap between two pieces of the branch.
  bool complete = false;
  bool interrupted = false;
  /// Last checkpoint of the first branch; absent: the branch has no point.
  std::optional<BranchCheckpoint> last;
  std::vector<SideBranch> sides;  ///< in the order in which they were followed
};

/// Pseudo-arclength continuation, beginning with the orbit that find_orbit finds at `from`. `seen` is called after every
/// computed point; `recorder` is used as in find_orbit. Errors: those of find_orbit; UsageError for a key that is not a number.
[[nodiscard]] Branch continue_branch(const SceneReader& read, const BranchOptions& options,
                                     Recorder* recorder = nullptr,
                                     const std::function<void(const BranchPoint&)>& seen = {});

}  // namespace signorini
