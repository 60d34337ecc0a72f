// instant_record.hpp: data of an instant that the law checker examines.
//
//   before: u, v-, states-, N-, T-     impulses P_k, captures c_k     after: u, v+, a+, states+, N+, T+
//
// The record contains only data, so that the law checker depends neither on the engine nor on the decision. It is filled
// once per instant, by a run (run/run_law_checker.hpp) or from a directory of results
// (study/law_check/directory_law_checker.hpp). The data to which the record points must outlive it. Units: those of the
// model.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "signorini/model.hpp"

namespace signorini::law_check {

/// Prescribed motion of one contact's surface, and prescribed normal force of a slider.
struct Driven {
  double s = 0.0, ds = 0.0, dds = 0.0;  ///< displacement, velocity, acceleration of the surface
  double q = 0.0, dq = 0.0, ddq = 0.0;  ///< normal_force, >= 0 in compression, and its rates
  /// For engines with fixed steps h: bound of the difference between the velocity of a rigidly sticking contact and that
  /// of its surface. It is the error of the trapezoidal rule since the last instant:
  /// h^2/12 (|s'''| after the last instant + |s'''| now) + h^3/12 |s''''|.
  double drift = 0.0;
};

/// One side of an instant, or a point of the motion between two instants.
struct CheckedSide {
  const Vector* u = nullptr;
  const Vector* v = nullptr;
  const Vector* a = nullptr;  ///< null: accelerations are not known
  const std::vector<ContactState>* mode = nullptr;
  const Vector* forces = nullptr;  ///< forces of all contacts, in the order of `layout`
  ForceLayout layout = {};
  std::vector<Driven> driven;      ///< one entry per contact
  std::vector<Vector> loads = {};  ///< P, P', P''; empty: all degrees of freedom have mass
  /// Largest displacement and velocity of the run so far, for translations and rotations. Rounding errors of sums over
  /// modes and of solves are relative to these values. 0: use the values of this side.
  std::array<double, 2> max_u = {0.0, 0.0}, max_v = {0.0, 0.0};
  /// Largest terms of the sums over modes that give the accelerations of this side, for translations and rotations.
  std::array<double, 2> acceleration_terms = {0.0, 0.0};
  /// Bound of the difference between two sums over modes of the same motion, as sqrt(2 * energy). 0: no sums over modes.
  double modal_mismatch = 0.0;
  /// One entry per contact: largest velocity that the elastic energy of the run so far could produce. Null: not known.
  const double* energy_speeds = nullptr;
};

/// Impulse on the body at one contact in one impact, along n and t. Unit: force * time. Several impacts of one instant
/// follow each other. Every touching contact has one entry for each impact; the entry may be zero.
struct RecordedImpulse {
  std::size_t contact = 0;
  int impact_number = 1;
  double normal = 0.0, tangent = 0.0;
};

/// Event row of this instant.
struct RecordedEvent {
  std::size_t contact = 0;
  std::string type;
  State from = State::open, to = State::open;
  double guard_rate = 0.0, t_uncertainty = -1.0;  ///< t_uncertainty < 0: no guard reached zero
  /// Forces in the event row, just before and just after.
  double N = 0.0, T = 0.0, N_after = 0.0, T_after = 0.0;
  double vn = 0.0, vn_after = 0.0, vt = 0.0, vt_after = 0.0;
  double impulse_n = 0.0, impulse_t = 0.0;  ///< 0 if the row has no impulse
  std::optional<double> gap = {};
};

struct InstantRecord {
  double t = 0.0;
  double resolution = 0.0;  ///< times that differ by at most this are one instant
  CheckedSide before, after;
  std::vector<RecordedImpulse> impulses;  ///< in the order of the impacts; empty: no impact
  /// Capture impulses along n and t, in the order of forces; empty: none.
  Vector captures;
  std::vector<RecordedEvent> events;
  std::vector<std::size_t> released;  ///< contacts that massless parts left instantaneously
  /// True at the start of the run: the states of `before` are guessed from the gaps, or are those of the previous run.
  bool start = false;
  /// The run continues another run: `before` has the final contact states of that run.
  bool continues = false;
  bool breakpoint = false;  ///< the forcing is not smooth here
  bool load_jumps = false;
  bool located = true;  ///< the engine locates the zeros of guards
  /// StepFacts::eigenvector_condition of the motion before the instant; 1: no modes, or orthogonal modes.
  double eigenvector_condition = 1.0;
  /// Accepted violation of states that were reported as undecided, in units of their rounding.
  double forgiven = 0.0;
};

}  // namespace signorini::law_check
