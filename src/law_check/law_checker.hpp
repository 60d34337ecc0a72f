// law_checker.hpp: checks an instant by the laws alone, from its recorded data.
//
//   momentum       M (v+ - v-) = sum n Pn + t Pt over all recorded impulses, on degrees of freedom with mass
//   capture        |n . M^-1 c| <= speed that a resting contact may have had, c: impulses that no law of impact gives
//   restitution    0 <= Pn _|_ g'+ + e min(g'-, 0) >= 0,    e = 0 where e |g'-| is slower than capture_velocity
//   Coulomb        |Pt| <= fs Pn,   Pt = -fk Pn sign ut'+ while it slides;   |T| <= fs |N|,   T = -s fk N
//   necessity      a contact changes its state only if one of its guards is violated by its old rows, with
//                  u, v+ and the new states of its neighbours
//   sufficiency    rows and guards of the new state hold just after
//   guard          a guard of the old state is zero at the time of its event
//   continuity     u; T and p of contacts that stick before or after
//
// The laws are implemented independently, from docs/theory-checks.md. This folder includes the model, the constants of
// contacts and the rounding constants, and no code that decides, advances or locates events: an error there cannot be
// repeated here.
#pragma once

#include <array>
#include <memory>

#include "law_check/instant_record.hpp"
#include "signorini/result.hpp"

namespace signorini::law_check {

/// Deviations allowed in a correct run, in addition to rounding. Absolute, in the units of the model; 0: none.
struct LawLimits {
  double rtol = 0.0, displacement = 0.0, rotation = 0.0, velocity = 0.0, angular_velocity = 0.0, force = 0.0;
  double capture_velocity = 0.0;  ///< for contacts that have none of their own
  double step = 0.0;  ///< step of engines that enforce contacts at the ends of steps only; 0: other engines
  bool resolves_low_flights =
      true;  ///< flights lower than the rounding of their gaps are computed, not treated as rest
};

struct ContactKinematics;

class LawChecker {
 public:
  LawChecker(const Model& model, const LawLimits& limits);
  ~LawChecker();
  LawChecker(const LawChecker&) = delete;
  LawChecker& operator=(const LawChecker&) = delete;

  /// Checks all laws at an instant. Empty: they hold.
  [[nodiscard]] std::vector<Violation> check_instant(const InstantRecord& record) const;
  /// Checks guards and rows at a point of the motion within a stretch.
  [[nodiscard]] std::vector<Violation> check_point(double t, const CheckedSide& now) const;
  /// Checks both ends of the stretch up to t: just after one instant, and just before the next.
  [[nodiscard]] std::vector<Violation> check_stretch(double t, const CheckedSide& from,
                                                     const CheckedSide& to) const;
  /// Checks M a + C v + K u + contact forces = P, with mass, just after an instant. load: P.
  [[nodiscard]] std::vector<Violation> check_equilibrium(double t, const CheckedSide& side,
                                                         const Vector& load) const;
  /// Checks the guards of one contact's state, as far as its motion is known. accelerates: g'' and ut'' are
  /// known; of_held: size of the terms whose differences are the constraint forces.
  void check_contact(double t, std::size_t k, const ContactState& state, const ContactKinematics& m,
                     bool accelerates, double of_held, std::vector<Violation>& found) const;
  /// Size of the terms whose differences are the constraint forces.
  [[nodiscard]] double constraint_force_terms(const CheckedSide& side) const;
  /// Largest terms of a sum over modes that yields x, for translations and rotations:
  /// x = sum phi q,  sum_k |phi_ik q_k| <= sqrt((M^-1)_ii x^T M x),  since sum phi phi^T = M^-1 and sum q^2 = x^T M x.
  [[nodiscard]] std::array<double, 2> modal_size(const Vector& x) const;
  /// modal_size() of an x with this norm, sqrt(x^T M x).
  [[nodiscard]] std::array<double, 2> modal_size(double norm) const;
  /// Twice the elastic energy, u^T K u, with springs of contacts in K.
  [[nodiscard]] double twice_energy(const Vector& u) const;
  /// Largest velocity along n and t of contact k for a given energy, divided by the root of twice the energy:
  /// |n v| <= sqrt(n M^-1 n) sqrt(v^T M v). Rounding of u becomes velocity a quarter of a period later. 0: contact k
  /// acts on no mass.
  [[nodiscard]] double speed_per_energy_root(std::size_t k) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace signorini::law_check
