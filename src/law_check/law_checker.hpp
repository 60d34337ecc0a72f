// law_checker.hpp: checks whether the recorded data of an instant satisfy the contact laws.
//
//   momentum       M (v+ - v-) = sum n Pn + t Pt over all recorded impulses, on degrees of freedom with mass
//   capture        |n . M^-1 c| <= largest speed of a contact that is regarded as at rest; c: capture impulses, which
//                  bring persistent contacts to rest
//   restitution    0 <= Pn _|_ g'+ + e min(g'-, 0) >= 0,    e = 0 where e |g'-| is slower than capture_velocity
//   Coulomb        |Pt| <= fs Pn,   Pt = -fk Pn sign ut'+ in slip;   |T| <= fs |N|,   T = -s fk N in slip
//   necessity      a contact changes its state only if its old state, with u, v+ and the new states of its neighbours,
//                  would violate one of its guards
//   sufficiency    just after the instant, the equations (rows) and guards of the new state are satisfied
//   guard          a guard of the old state is zero at the time of its event
//   continuity     u is continuous; T and p of contacts that stick before or after are continuous, too
//
// The laws are implemented independently of the solver, from docs/theory-checks.md. This folder uses the model, the
// constants of contacts and the rounding constants, but no code that decides states, advances the motion or locates
// events, so that an error in that code cannot be repeated here.
#pragma once

#include <array>
#include <memory>

#include "law_check/instant_record.hpp"
#include "signorini/result.hpp"

namespace signorini::law_check {

/// Deviations allowed in a correct run in addition to rounding, in the units of the model (rtol: relative); 0: none.
struct LawLimits {
  double rtol = 0.0, displacement = 0.0, rotation = 0.0, velocity = 0.0, angular_velocity = 0.0, force = 0.0;
  double capture_velocity = 0.0;  ///< for contacts without their own capture_velocity
  /// Step of an engine that enforces contact laws only at the ends of steps; 0: other engines.
  double step = 0.0;
  /// True if the engine computes flights that are lower than the rounding of their gaps; false: it treats them as rest.
  bool resolves_low_flights = true;
};

struct ContactKinematics;

class LawChecker {
 public:
  LawChecker(const Model& model, const LawLimits& limits);
  ~LawChecker();
  LawChecker(const LawChecker&) = delete;
  LawChecker& operator=(const LawChecker&) = delete;

  /// Checks all laws at an instant; empty: all are satisfied.
  [[nodiscard]] std::vector<Violation> check_instant(const InstantRecord& record) const;
  /// Checks the guards of all contacts, and the balance of massless parts, at a point between two instants.
  [[nodiscard]] std::vector<Violation> check_point(double t, const CheckedSide& now) const;
  /// Checks the motion between two instants from its two ends: `from` just after one instant, `to` just before the next
  /// one, at t.
  [[nodiscard]] std::vector<Violation> check_stretch(double t, const CheckedSide& from,
                                                     const CheckedSide& to) const;
  /// Checks M a + C v + K u + contact forces = P just after an instant, on degrees of freedom with mass. load: P.
  [[nodiscard]] std::vector<Violation> check_equilibrium(double t, const CheckedSide& side,
                                                         const Vector& load) const;
  /// Checks the guards of the state of contact k, as far as its motion m is known. accelerates: g'' and ut'' are known;
  /// of_held: constraint_force_terms(), or 0 for a stricter check.
  void check_contact(double t, std::size_t k, const ContactState& state, const ContactKinematics& m,
                     bool accelerates, double of_held, std::vector<Violation>& found) const;
  /// Largest sum of absolute terms in a row of the equation of motion: constraint forces are differences of these terms.
  [[nodiscard]] double constraint_force_terms(const CheckedSide& side) const;
  /// Bound of the terms of a sum over modes that gives x, for translations and rotations:
  /// x = sum phi q,  sum_k |phi_ik q_k| <= sqrt((M^-1)_ii x^T M x),  since sum phi phi^T = M^-1 and sum q^2 = x^T M x.
  [[nodiscard]] std::array<double, 2> modal_size(const Vector& x) const;
  /// modal_size() of any x with the norm sqrt(x^T M x) = norm.
  [[nodiscard]] std::array<double, 2> modal_size(double norm) const;
  /// Twice the elastic energy, u^T K u; K includes the springs of all contacts.
  [[nodiscard]] double twice_energy(const Vector& u) const;
  /// Factor s of contact k in |n v| + |t v| <= s sqrt(2 * energy), from |n v| <= sqrt(n M^-1 n) sqrt(v^T M v). It bounds the
  /// velocity that a rounding error of u causes a quarter of a period later. 0: contact k acts on a massless part.
  [[nodiscard]] double speed_per_energy_root(std::size_t k) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace signorini::law_check
