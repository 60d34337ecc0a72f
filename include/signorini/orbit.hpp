// orbit.hpp: periodic motions of a scene, and their stability.
//
//   z = (u, v, T of contacts with a tangential spring)      the state at a section of the period
//   R(z) = z(T; z) - z = 0                                  forced: T is the period of the loads, or n times it
//   R(z, T) = 0,  z' . dz = 0                               self-excited (belts): T is unknown, too
//   R(z, T) = 0,  z' . dz = 0,  E(z) = E*                   conservative, at a given energy
//   Phi = dz(T)/dz,   multipliers = eig Phi                 |multiplier| < 1: disturbances die out
//
// Newton's method solves R = 0. Phi is computed through every event (sensitivity.hpp), so the convergence is quadratic
// as long as the sequence of events does not change.
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
  /// Period of the loads; absent: taken from the scene's periodic loads.
  std::optional<double> period = {};
  /// Energy of a conservative motion. Such a scene has no excitation; `period` then is the initial guess of the search.
  std::optional<double> energy = {};
  int times = 1;       ///< the orbit closes after this number of load periods
  int transient = 20;  ///< periods simulated before Newton's method begins
  /// Target of Newton's method: residual / amplitude; the iteration continues as long as the residual decreases.
  double tolerance = 1e-12;
};

/// Type of loss of stability.
enum class OrbitLoss { none, fold, flip, neimark_sacker };
[[nodiscard]] const char* to_string(OrbitLoss loss);

/// One iteration of Newton's method.
struct OrbitStep {
  double residual = 0.0;  ///< max |R| / amplitude, before the step
  double damping = 1.0;   ///< fraction of the step that was taken; 0: none, the iteration ended here
};

struct Orbit {
  bool found = false;
  std::string reason;       ///< reason why no orbit was found, or what remains unknown about it; one sentence
  double period = 0.0;      ///< time after which the motion repeats itself
  bool autonomous = false;  ///< the motion determines the period, not the loads
  /// Time of the scene (loads, compressions, surfaces) at the orbit's time 0.
  double phase = 0.0;
  double residual = 0.0;   ///< max |z(T) - z| / amplitude
  double amplitude = 0.0;  ///< half the largest range of a displacement, rotations excluded; length
  std::vector<OrbitStep> steps;

  /// Multipliers of all directions in which the state at the section can move, by descending magnitude. An autonomous
  /// orbit has one multiplier 1, along the motion.
  std::vector<std::complex<double>> multipliers;
  /// Error bound of a simple multiplier: the change between Phi from this state and Phi from its image one period
  /// later, plus errors common to both: rounding of Phi, steps of its tangents, and with `ida` 100 rtol, each times the
  /// largest entry of Phi. Not included: rounding of the phase omega T in modes, which rotates a multiplier along the
  /// circle.
  double multiplier_error = 0.0;
  /// nullopt: a multiplier is on the unit circle within its error. For a conservative motion the square root of the
  /// error counts, by which two equal multipliers separate.
  std::optional<bool> stable;
  OrbitLoss loss = OrbitLoss::none;
  double max_multiplier = 0.0;  ///< largest magnitude, multipliers of families and of time excluded
  /// Directions with a multiplier of 1 along a family of orbits: conserved quantities, one name each. The search
  /// returns the orbit of the family nearest to its starting point.
  std::vector<std::string> families;

  /// Events of one period from phase on, the one at the orbit's time 0 first; no jumps of loads.
  std::vector<Event> sequence;
  Energy cycle;          ///< changes over one period: dissipation, works, stored energy
  double section = 0.0;  ///< time after `phase` at which Newton's method closed the orbit
  SavedState start;      ///< state at the orbit's time 0
};

/// Searches for a periodic motion. Of `recorder` only `progress` is called, which may stop the search. A
/// failed search is a value: found is false, and `reason` says why. Errors are SceneError and UsageError:
///   a scene without a period and without a belt;  loads that do not repeat with `period`
///   a given energy in a driven or damped scene;  an engine or law without tangents (exact and ida have them)
[[nodiscard]] Orbit find_orbit(const SceneReader& read, const OrbitOptions& options = {},
                               Recorder* recorder = nullptr);

/// The scene of one period of the orbit, starting on the orbit.
[[nodiscard]] Scene orbit_scene(const SceneReader& read, const Orbit& orbit);

/// A point of a branch from which it can be continued.
struct BranchCheckpoint {
  double parameter = 0.0;
  bool towards_to = true;                   ///< the branch is followed towards `to`
  Orbit orbit;                              ///< period, phase, autonomous, start
  std::vector<std::string> sequences = {};  ///< sequences of events met so far, by number
  std::size_t point_count = 0;              ///< number of Branch::points up to this checkpoint
};

/// Settings for a branch of orbits over a key of the scene.
struct BranchOptions {
  OrbitOptions orbit = {};
  std::string path;  ///< path of the key; "energy": energy of conservative motions (OrbitOptions::energy)
  double from = 0.0, to = 0.0;  ///< first and last value of the parameter
  /// Largest step: change of the parameter relative to its range, together with the change of the state
  /// relative to the amplitude.
  double step = 0.02;
  int most_points = 1000;  ///< limit for each branch
  /// Number of successive branch switches: at a flip to the branch of twice the period, and at branch points. 0: the
  /// first branch alone.
  int switches = 0;
  std::optional<BranchCheckpoint> resume_from = {};  ///< continues from this checkpoint, without its point
  /// Called after each point of the first branch with a function that makes its checkpoint (cost: a run of one period),
  /// so that an interrupted branch can be resumed.
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
  long events = 0;  ///< number in one period
  int branch = 1;   ///< 1: the first branch; others as in Branch::sides
  /// Reasons why the point is special, joined with "+"; empty: none.
  /// At a located point:
  ///   "fold"             the parameter reverses its direction
  ///   "flip", "neimark-sacker", "branch point"
  ///   "sequence"         the last point with its sequence
  ///   "end"              no step continues, as at a graze where two orbits meet and vanish
  /// Elsewhere, for a change since the point before:
  ///   "fold"             the parameter reverses at a corner of the branch, where the sequence changes
  ///   "stability"        stability is gained or lost
  ///   "sequence"         the sequence has changed
  ///   "restart"          the branch before could not be continued
  ///   "switched"         the first point of a side branch
  std::string special;
};

/// A branch that leaves another branch.
struct SideBranch {
  int number = 2, from = 1;  ///< numbers as in BranchPoint::branch
  std::string kind;          ///< "flip", "branch point"
  double parameter = 0.0;    ///< parameter at which it leaves
  std::string end;           ///< reason for its end, one sentence
  /// True: it reached an end of the range, or, with twice the period, returned to an orbit of the simple period.
  bool complete = false;
};

struct Branch {
  std::vector<BranchPoint> points;
  std::vector<std::string> sequences;  ///< by number, from 1: "stop contact, stop separation"
  std::string end;                     ///< reason for its end, one sentence
  /// True: it reached `to`, or returned to `from` behind a fold without a gap (`end` then gives the value beyond which
  /// it has no orbit). False: it ended on the way, returned behind a gap, or was interrupted.
  bool complete = false;
  bool interrupted = false;
  std::optional<BranchCheckpoint> last;  ///< last checkpoint of the first branch, if it has a point
  std::vector<SideBranch> sides;         ///< in the order in which they were followed
};

/// Pseudo-arclength continuation of the orbit that find_orbit finds at `from`. `seen` is called for every
/// point. `recorder`: as for find_orbit. Errors: those of find_orbit; UsageError for a key that is not a
/// number.
[[nodiscard]] Branch continue_branch(const SceneReader& read, const BranchOptions& options,
                                     Recorder* recorder = nullptr,
                                     const std::function<void(const BranchPoint&)>& seen = {});

}  // namespace signorini
