// witness.hpp: checks an instant by the laws alone, from what is recorded of it.
//
//   momentum       M (v+ - v-) = sum n Pn + t Pt over all recorded impulses, on degrees of freedom with mass
//   capture        |n . M^-1 c| <= what a contact that rests may have had, c: impulses that no law of impact gives
//   restitution    0 <= Pn _|_ g'+ + e min(g'-, 0) >= 0,    e = 0 where e |g'-| is slower than capture_velocity
//   Coulomb        |Pt| <= fs Pn,   Pt = -fk Pn sign ut'+ while it slides;   |T| <= fs |N|,   T = -s fk N
//   necessity      a contact changes its state only where its old rows, with u, v+ and the new states of its
//                  neighbours, violate one of its guards
//   sufficiency    rows and guards of the new state hold just after
//   guard          a guard of the old state is zero at the time of its event
//   continuity     u; T and p of what sticks before or after
//
// The laws are written anew from docs/theory-checks.md. This folder includes the model, the constants of contacts and the
// roundings, and nothing that decides, advances or localises: an error there cannot hide here.
#pragma once

#include <array>
#include <memory>

#include "signorini/result.hpp"
#include "witness/instant_record.hpp"

namespace signorini {

/// What a correct run may be off by, beside rounding. Absolute, in the units of the model; 0: nothing.
struct WitnessLimits {
  double rtol = 0.0, displacement = 0.0, rotation = 0.0, velocity = 0.0, angular_velocity = 0.0, force = 0.0;
  double capture_velocity = 0.0;  ///< of contacts that have none of their own
  double step = 0.0;  ///< of engines that hold contacts at the ends of their steps alone; 0: of others
  bool knows_low_flights =
      true;  ///< flights lower than the rounding of their gaps are followed, not taken as rest
};

struct Sight;

class Witness {
 public:
  Witness(const Model& model, const WitnessLimits& limits);
  ~Witness();
  Witness(const Witness&) = delete;
  Witness& operator=(const Witness&) = delete;

  /// All laws at an instant. Empty: they hold.
  [[nodiscard]] std::vector<Violation> instant(const InstantRecord& record) const;
  /// Guards and rows at a point of the motion inside a stretch.
  [[nodiscard]] std::vector<Violation> between(double t, const WitnessedSide& now) const;
  /// What both ends of the stretch up to t say: just after one instant, just before the next.
  [[nodiscard]] std::vector<Violation> stretch(double t, const WitnessedSide& from,
                                               const WitnessedSide& to) const;
  /// M a + C v + K u + contact forces = P, with mass, just after an instant. load: P.
  [[nodiscard]] std::vector<Violation> equilibrium(double t, const WitnessedSide& side,
                                                   const Vector& load) const;
  /// Guards of one contact's state, by what is known of its motion; accelerates: g'' and ut'' are. of_held: the size of
  /// the terms that forces are differences of which hold accelerations.
  void contact(double t, std::size_t k, const ContactState& state, const Sight& m, bool accelerates,
               double of_held, std::vector<Violation>& found) const;
  /// The size of the terms that forces are differences of which hold accelerations.
  [[nodiscard]] double held_forces(const WitnessedSide& side) const;
  /// The most that a sum over modes that is x may have as terms, of translations and of rotations:
  /// x = sum phi q,  sum_k |phi_ik q_k| <= sqrt((M^-1)_ii x^T M x),  since sum phi phi^T = M^-1 and sum q^2 = x^T M x.
  [[nodiscard]] std::array<double, 2> modal_size(const Vector& x) const;
  /// The same, of x with this norm.
  [[nodiscard]] std::array<double, 2> modal_size(double norm) const;
  /// u^T K u, springs of contacts in K.
  [[nodiscard]] double twice_energy(const Vector& u) const;
  /// The greatest velocity along n and t of contact k that an energy can make, over the root of twice that energy:
  /// |n v| <= sqrt(n M^-1 n) sqrt(v^T M v). Roundings of u are velocities a quarter of a period later. 0: it acts on no mass.
  [[nodiscard]] double lightness(std::size_t k) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace signorini
