// instant_record.hpp: data of an instant that the law checker examines.
//
//   before: u, v-, states-, N-, T-     impulses P_k, captures c_k     after: u, v+, a+, states+, N+, T+
//
// The record contains data only: no decision, no engine. It is filled once per instant, by a run
// (run/run_law_checker.hpp) or from a directory of results (study/law_check/directory_law_checker.hpp).
// The data that it points to must outlive it. Units: those of the model.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "signorini/model.hpp"

namespace signorini::law_check {

/// Given motion of one contact: the motion of its surface and the compression of a slider.
struct Driven {
  double s = 0.0, ds = 0.0, dds = 0.0;  ///< displacement, velocity, acceleration of the surface
  double q = 0.0, dq = 0.0, ddq = 0.0;  ///< normal_force and its rates
  /// Drift of the velocity of a rigidly sticking contact from that of the surface, for steps of given length h: the
  /// error of the trapezoidal rule for its acceleration since the last instant, h^2/12 (|s'''| there + |s'''| here) +
  /// h^3/12 |s''''|.
  double drift = 0.0;
};

/// One side of an instant, or a point of the motion between two instants.
struct CheckedSide {
  const Vector* u = nullptr;
  const Vector* v = nullptr;
  const Vector* a = nullptr;  ///< null: unknown
  const std::vector<ContactState>* mode = nullptr;
  const Vector* forces = nullptr;  ///< forces of all contacts, in the order of `layout`
  ForceLayout layout = {};
  std::vector<Driven> driven;      ///< one entry per contact
  std::vector<Vector> loads = {};  ///< P, P', P''; empty: all degrees of freedom have mass
  /// Largest displacement and velocity of the run so far (translations; rotations): the accuracy of sums over modes,
  /// and of solves, is relative to these. 0: use the values of this side.
  std::array<double, 2> max_u = {0.0, 0.0}, max_v = {0.0, 0.0};
  /// Largest terms of the sums over modes that give this side's accelerations.
  std::array<double, 2> acceleration_terms = {0.0, 0.0};
  /// Difference between two sums over modes of the same motion, as the root of twice its energy. 0: no sum over modes.
  double modal_mismatch = 0.0;
  /// One entry per contact: largest velocity that the energies of the run's displacements could produce. Null: unknown.
  const double* energy_speeds = nullptr;
};

/// Impulse on the body at one contact in one impact, along n and t. Unit: force * time. Impacts of one
/// instant are successive. Every touching contact has one entry for each impact; the entry may be zero.
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
  double guard_rate = 0.0, t_uncertainty = -1.0;  ///< negative: no guard reached zero
  /// Forces of the row, just before and just after.
  double N = 0.0, T = 0.0, N_after = 0.0, T_after = 0.0;
  double vn = 0.0, vn_after = 0.0, vt = 0.0, vt_after = 0.0;
  double impulse_n = 0.0, impulse_t = 0.0;  ///< 0: not in the row
  std::optional<double> gap = {};
};

struct InstantRecord {
  double t = 0.0;
  double resolution = 0.0;  ///< times closer than this count as one instant
  CheckedSide before, after;
  std::vector<RecordedImpulse> impulses;  ///< in the order of the impacts; empty: no impact
  Vector captures;                        ///< laid out as forces, along n and t; empty: none
  std::vector<RecordedEvent> events;
  std::vector<std::size_t> released;  ///< contacts that massless parts left instantaneously
  bool start = false;                 ///< start of the run: `before` is guessed from the gaps, or continued
  bool continues = false;   ///< continues another run: `before` has the contacts as that run left them
  bool breakpoint = false;  ///< the forcing is not smooth here
  bool load_jumps = false;
  bool located = true;  ///< the engine locates the zeros of guards
  double eigenvector_condition =
      1.0;  ///< StepFacts::eigenvector_condition of the motion before; 1: no modes, or orthogonal ones
  double forgiven = 0.0;  ///< states reported as undecided fail by this factor of their rounding
};

}  // namespace signorini::law_check
