// instant_record.hpp: what is recorded of an instant, as the witness takes it.
//
//   before: u, v-, mode-, N-, T-     impulses P_k, captures c_k     after: u, v+, a+, mode+, N+, T+
//
// The record holds data alone: no decision, no engine. A run fills it once an instant (run/run_witness.hpp), so does a
// directory of results (study/witness/directory_witness.hpp). What it points to outlives it. Units: those of the model.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "signorini/model.hpp"

namespace signorini {

/// What drives one contact: the motion of its surface and the compression of a slider.
struct Driven {
  double s = 0.0, ds = 0.0, dds = 0.0;  ///< place, velocity, acceleration of the surface
  double q = 0.0, dq = 0.0, ddq = 0.0;  ///< normal_force and its rates
  /// By how much steps of given length h leave the velocity of what sticks rigidly beside that of the surface: the
  /// trapezoidal rule's error of its acceleration since the last instant, h^2/12 (|s'''| there + |s'''| here) + h^3/12 |s''''|.
  double drift = 0.0;
};

/// One side of an instant, or a point of the motion between two.
struct WitnessedSide {
  const Vector* u = nullptr;
  const Vector* v = nullptr;
  const Vector* a = nullptr;  ///< null: not known
  const std::vector<ContactState>* mode = nullptr;
  const Vector* forces = nullptr;  ///< of all contacts, in the order of `layout`
  ForceLayout layout = {};
  std::vector<Driven> driven;      ///< one a contact
  std::vector<Vector> loads = {};  ///< P, P', P''; empty: all degrees of freedom have mass
  /// Greatest displacement and velocity of the run so far (translations; rotations): sums over modes, and solves, are
  /// known relative to these. 0: those of this side.
  std::array<double, 2> u_reach = {0.0, 0.0}, v_reach = {0.0, 0.0};
  std::array<double, 2> a_reach = {0.0, 0.0};  ///< of sums over modes, of this side's accelerations
  /// Of a sum over modes: what two of them of one motion differ by, the root of twice its energy. 0: it is none.
  double lost = 0.0;
  /// One a contact: the greatest that energies of the run's displacements could make of its velocities. Null: not known.
  const double* speeds = nullptr;
};

/// What a contact takes of one impact, on the body along n and t. Unit: force * time. Impacts of one instant come one
/// after the other; all contacts that touch have an entry in each, and be it of nothing.
struct RecordedImpulse {
  std::size_t contact = 0;
  int turn = 1;
  double normal = 0.0, tangent = 0.0;
};

/// A row of the events of this instant.
struct RecordedEvent {
  std::size_t contact = 0;
  std::string type;
  State from = State::open, to = State::open;
  double guard_rate = 0.0, t_uncertainty = -1.0;  ///< negative: no guard fell
  /// As the row says; just before and just after.
  double N = 0.0, T = 0.0, N_after = 0.0, T_after = 0.0;
  double vn = 0.0, vn_after = 0.0, vt = 0.0, vt_after = 0.0;
  double impulse_n = 0.0, impulse_t = 0.0;  ///< 0: the row has none
  std::optional<double> gap = {};
};

struct InstantRecord {
  double t = 0.0;
  double resolution = 0.0;  ///< times closer than this are one instant
  WitnessedSide before, after;
  std::vector<RecordedImpulse> impulses;  ///< turn by turn; empty: no rigid contact was hit
  Vector captures;                        ///< as forces, along n and t; empty: none
  std::vector<RecordedEvent> events;
  std::vector<std::size_t> released;  ///< contacts that parts without mass left at once
  bool start = false;                 ///< of the run: `before` was guessed from the gaps, unless it
  bool continues = false;   ///< goes on from another run: `before` is where that one left its contacts
  bool breakpoint = false;  ///< the forcing is not smooth here
  bool load_jumps = false;
  bool located = true;  ///< the engine finds the time at which a guard is zero
  double dependence =
      1.0;  ///< StepFacts::eigenvector_condition of the motion before; 1: of no modes, or of orthogonal ones
  double forgiven = 0.0;  ///< by how many of their roundings states fail that were said to be undecided
};

}  // namespace signorini
