// orbit.hpp: periodic motions of a scene, and their stability.
//
//   z = (u, v, T of contacts with a tangential spring)      the state at a section of the period
//   R(z) = z(T; z) - z = 0                                  forced: T is that of the loads, or n times it
//   R(z, T) = 0,  z' . dz = 0                               driven by itself (belts): T is unknown, too
//   R(z, T) = 0,  z' . dz = 0,  E(z) = E*                   conservative, at a given energy
//   Phi = dz(T)/dz,   multipliers = eig Phi                 |multiplier| < 1: disturbances die out
//
// Newton's method solves R = 0. Phi goes through every event (sensitivity.hpp), so the convergence is quadratic as
// long as the sequence of events stays.
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
  /// Of the loads; absent: as the scene's periodic loads say.
  std::optional<double> period = {};
  /// Of a conservative motion: what is stored, all the time. Nothing drives such a scene; `period` is then the guess that the
  /// search begins with.
  std::optional<double> energy = {};
  int times = 1;       ///< the orbit closes after so many periods of the loads
  int transient = 20;  ///< periods that are run before Newton's method begins
  /// Residual over amplitude that Newton's method aims at; it goes on as long as the residual falls.
  double tolerance = 1e-12;
};

/// Kind of loss of stability.
enum class OrbitLoss { none, fold, flip, neimark_sacker };
[[nodiscard]] const char* to_string(OrbitLoss loss);

/// Newton's method, one iteration.
struct OrbitStep {
  double residual = 0.0;  ///< max |R| over amplitude, before the step
  double damping = 1.0;   ///< part of the step that was taken; 0: none, it ended here
};

struct Orbit {
  bool found = false;
  std::string reason;       ///< why none was found, or what is not known of it; one sentence
  double period = 0.0;      ///< after which the motion repeats itself
  bool autonomous = false;  ///< the period is that of the motion, not of loads
  /// Loads, compressions and surfaces are at this time of the scene where the orbit's time is 0.
  double phase = 0.0;
  double residual = 0.0;   ///< max |z(T) - z| over amplitude
  double amplitude = 0.0;  ///< half the greatest range of a displacement, rotations left out; length
  std::vector<OrbitStep> steps;

  /// Of all directions in which the state at the section may move; by magnitude, descending. Of an autonomous orbit
  /// one of them is 1, along the motion.
  std::vector<std::complex<double>> multipliers;
  /// How far a simple multiplier may be off: the change between Phi from this state and Phi from its image a period later, and
  /// the error that both share: rounding of Phi, what the steps of its tangents leave, and with `ida` 100 rtol, each times the
  /// greatest entry of Phi. Rounding of the phase omega T in modes, which turns a multiplier along the circle, is not in it.
  double multiplier_error = 0.0;
  /// Nothing: a multiplier is on the unit circle within its error, or, of a conservative motion, within the square root of it,
  /// by which two equal multipliers move apart.
  std::optional<bool> stable;
  OrbitLoss loss = OrbitLoss::none;
  double max_multiplier = 0.0;  ///< greatest magnitude, without those of families and of time
  /// Directions with a multiplier of 1, one orbit beside the other: what holds still all the time, one name each. The
  /// orbit found is the one that is nearest to where the search began.
  std::vector<std::string> families;

  /// Events of one period, from phase on, one at the orbit's time 0 first; no jumps of loads.
  std::vector<Event> sequence;
  Energy cycle;          ///< change over one period: of what is dissipated, of works, of what is stored
  double section = 0.0;  ///< time after `phase` at which Newton's method closed the orbit
  SavedState start;      ///< the state at the orbit's time 0
};

/// Errors: SceneError and UsageError for scenes without a period and without a belt, for loads that do not repeat with
/// `period`, for an energy where something drives or damps the motion, for engines and laws that have no tangents (exact and
/// ida have). A search that fails is a value: found is false, and `reason` says why. `recorder`: asked for `progress` only,
/// which may stop the search.
[[nodiscard]] Orbit find_orbit(const SceneReader& read, const OrbitOptions& options = {},
                               Recorder* recorder = nullptr);

/// The scene of one period of the orbit, beginning on it.
[[nodiscard]] Scene orbit_scene(const SceneReader& read, const Orbit& orbit);

/// A point of a branch from which it can be continued.
struct BranchMark {
  double parameter = 0.0;
  bool towards_to = true;                   ///< the parameter moves towards `to` there
  Orbit orbit;                              ///< period, phase, autonomous, start
  std::vector<std::string> sequences = {};  ///< those that the branch has met, by number
  std::size_t points = 0;                   ///< of Branch::points up to the mark
};

/// A branch of orbits over a key of the scene.
struct BranchOptions {
  OrbitOptions orbit = {};
  std::string path;  ///< of the key; "energy": what conservative motions store (OrbitOptions::energy)
  double from = 0.0, to = 0.0;  ///< its first and last value
  double step =
      0.02;  ///< greatest, of the range; a step counts changes of the state by parts of the amplitude as well
  int most_points = 1000;  ///< of each branch
  /// So many times in a row the walk changes to a branch that leaves at a flip, with twice the period, or at a branch
  /// point. 0: the first branch alone.
  int switches = 0;
  std::optional<BranchMark> resumed = {};  ///< continues from there, without that point
  /// Hears after each point of the first branch of a function that makes its mark, which costs a run of a period: so a
  /// branch that is killed can be resumed.
  std::function<void(const std::function<BranchMark()>&)> marks = {};
};

struct BranchPoint {
  double parameter = 0.0, period = 0.0, amplitude = 0.0;
  std::vector<double> minima, maxima;  ///< one an output, over the period
  double max_multiplier = 0.0, multiplier_error = 0.0, residual = 0.0;
  std::optional<bool> stable;
  OrbitLoss loss = OrbitLoss::none;
  int sequence =
      0;  ///< number of the sequence of events, from 1 on, in the order in which the branch meets them
  long events = 0;  ///< in one period
  int branch = 1;   ///< 1: of the first orbit; else that of Branch::sides
  /// A point that was located: "fold" (the parameter turns), "flip", "neimark-sacker", "branch point", "sequence" (the last one
  /// with its sequence), "end" (no step leads further, as at a graze where two orbits meet and vanish). Else what lies between
  /// the point before and this one: "fold" (the parameter turns at a corner of the branch, where the sequence changes),
  /// "stability" (gained or lost), "sequence", "restart" (the branch before could not be followed on); "switched": the first
  /// point beside the branch that it leaves; several with "+"
  std::string special;
};

/// A branch that leaves another one.
struct SideBranch {
  int number = 2, from = 1;  ///< of BranchPoint::branch
  std::string kind;          ///< "flip", "branch point"
  double parameter = 0.0;    ///< where it leaves
  std::string end;           ///< why it ends, one sentence
  /// It reached an end of the range; or, of twice the period, it came back to an orbit of the simple one.
  bool complete = false;
};

struct Branch {
  std::vector<BranchPoint> points;
  std::vector<std::string> sequences;  ///< by number, from 1 on: "stop contact, stop separation"
  std::string end;                     ///< why it ends, one sentence
  /// It reached `to`; or it came back to `from` behind a fold, having met no gap: `end` then says beyond which value it has no
  /// orbit. False: it ended on the way, came back behind a gap, or was interrupted.
  bool complete = false;
  bool interrupted = false;
  std::optional<BranchMark> last;  ///< of the first branch, if it has a point
  std::vector<SideBranch> sides;   ///< in the order in which they were followed
};

/// Pseudo-arclength continuation of the orbit that find_orbit finds at `from`. seen: hears of every point, and may stop.
/// Errors: those of find_orbit, UsageError for a key that is no number.
[[nodiscard]] Branch follow(const SceneReader& read, const BranchOptions& options,
                            Recorder* recorder = nullptr,
                            const std::function<void(const BranchPoint&)>& seen = {});

}  // namespace signorini
