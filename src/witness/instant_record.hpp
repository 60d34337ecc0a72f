// instant_record.hpp: what is recorded of an instant, as the witness takes it.
//
//   before: u, v-, mode-, N-, T-     impulses P_k, captures c_k     after: u, v+, a+, mode+, N+, T+
//
// The record holds data alone: no decision, no engine. A run fills it once an instant (run/run_witness.hpp), a directory
// of results once an event (witness/from_files.hpp). What it points to outlives it. Units: those of the model.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "signorini/model.hpp"

namespace signorini {

/// What drives one contact: the motion of its surface and the compression of a slider.
struct Driven {
  double s = 0.0, ds = 0.0, dds = 0.0;  ///< place, velocity, acceleration of the surface
  double q = 0.0, dq = 0.0;             ///< normal_force and its rate
};

/// One side of an instant, or a point of the motion between two.
struct WitnessedSide {
  const Vector* u = nullptr;
  const Vector* v = nullptr;
  const Vector* a = nullptr;  ///< null: not known
  const std::vector<ContactState>* mode = nullptr;
  const Vector* forces = nullptr;  ///< (N_1, T_1, N_2, ...)
  std::vector<Driven> driven;      ///< one a contact
  /// Greatest displacement and velocity of the run so far (translations; rotations): sums over modes, and solves, are
  /// known relative to these. 0: those of this side.
  std::array<double, 2> u_reach = {0.0, 0.0}, v_reach = {0.0, 0.0};
};

/// The impulse of one contact, on the body along n and t. Unit: force * time.
struct RecordedImpulse {
  double normal = 0.0, tangent = 0.0;
  int strikes = 0;        ///< hits that it is the sum of
  bool captured = false;  ///< its rebound was slower than capture_velocity: e = 0
  int turn = 0;           ///< hits of one instant come one after the other: which its last one was
};

/// A row of the events of this instant.
struct RecordedEvent {
  std::size_t contact = 0;
  std::string type;
  State from = State::open, to = State::open;
  double guard_rate = 0.0, t_uncertainty = -1.0;  ///< negative: no guard fell
};

struct InstantRecord {
  double t = 0.0;
  double resolution = 0.0;  ///< times closer than this are one instant
  WitnessedSide before, after;
  std::vector<RecordedImpulse> impulses;  ///< one a contact, where rigid contacts were hit; else empty
  Vector captures;                        ///< as forces, along n and t; empty: none
  std::vector<RecordedEvent> events;
  bool start = false;       ///< of the run: `before` was guessed from the gaps
  bool breakpoint = false;  ///< the forcing is not smooth here
  bool load_jumps = false;
  bool located = true;    ///< the engine finds the time at which a guard is zero
  double forgiven = 0.0;  ///< by how many of their roundings states fail that were said to be undecided
};

}  // namespace signorini
