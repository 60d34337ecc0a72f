// contact_kinematics.hpp: motion of a contact for the law checker, guards of its states, and their rounding.
//
//   g = g0 + n.u,  ut = t.u - s,  g' = n.v,  ut' = t.v - s',  g'' = n.a,  ut'' = t.a - s''
//   size of n.x, the scale of its rounding error: |n| |x|, x on the contact's own degrees of freedom
#pragma once

#include <array>

#include "law_check/law_checker.hpp"

namespace signorini {

/// Units of the checked quantities.
namespace seen {
inline constexpr Unit force{1, 0, 0}, length{0, 1, 0}, velocity{0, 1, -1}, impulse{1, 0, 1},
    moment_impulse{1, 1, 1};
}

}  // namespace signorini

namespace signorini::law_check {

/// Motion and forces of one contact: g, ut, their first and second rates, and the applied normal force q with its rates.
struct ContactKinematics {
  double N = 0.0, T = 0.0, g = 0.0, ut = 0.0, dg = 0.0, dut = 0.0, ddg = 0.0, ddut = 0.0, q = 0.0, dq = 0.0,
         ddq = 0.0;
  // Sums of the sizes of terms: displacement_size for g and ut, velocity_size for g' and ut', acceleration_size for g'', ut''.
  double displacement_size = 0.0, velocity_size = 0.0, acceleration_size = 0.0;
};

/// Value of a guard, which is positive while the contact can remain in its state. size: sum of the sizes of its terms.
struct GuardValue {
  const char* law = "";
  double value = 0.0, size = 0.0;
  double rate = 0.0;       ///< rate of the value; 0: the motion does not determine it
  double tolerance = 0.0;  ///< error of the value that the engine's tolerances allow

  [[nodiscard]] const Unit& unit() const;  ///< unit of the value
};

struct GuardValues {
  std::array<GuardValue, 3> list;
  std::size_t count = 0;
  void add(const GuardValue& guard) { list[count++] = guard; }
  [[nodiscard]] const GuardValue* begin() const { return list.data(); }
  [[nodiscard]] const GuardValue* end() const { return list.data() + count; }
};

/// Motion and forces of contact k on one side of an instant.
[[nodiscard]] ContactKinematics kinematics(const Contact& contact, std::size_t k, const CheckedSide& side);
/// Direction of slip: +1 or -1 in a slip state, otherwise 0.
[[nodiscard]] int slip_direction(State state);
/// Friction coefficient |T|/|N| of a sliding contact for this slip rate and this N.
[[nodiscard]] double friction_at(const Contact& c, double slip_rate, double N);
/// Friction coefficient in a given state: static friction if the contact is at its static limit, otherwise friction_at().
[[nodiscard]] double friction_in(const Contact& c, State state, double slip_rate, double N);
/// Guards of a state, for a motion whose forces satisfy the equations (rows) of this state.
[[nodiscard]] GuardValues guards_of(const Contact& contact, const ContactState& state,
                                    const ContactKinematics& m, const LawLimits& limits);
/// True if another rigidly sticking contact of the same kind acts on a common degree of freedom. At its friction limit,
/// contact k may then be held at rest by the other contact, and its slip rate is only rounding.
[[nodiscard]] bool may_be_held_by_neighbour(const Model& model, std::size_t k);
/// Sum of the sizes of the terms of kn g + cn g', a force.
[[nodiscard]] double normal_force_size(const Contact& contact, const ContactKinematics& m);

// Quick check of guards and rows, with limits that do not include the rounding of all their terms.
//
//   guards   g >= 0          -N >= 0,  fs |N| - |T| >= 0          s p' >= 0
//   rows     |N - kn g - cn g'| <= c eps |N|      |T - kt (ut - p)| <= c eps (|T| + kt |p|)      |T + s fk N| <= c eps |T|
//
// The limits of the laws (laws.hpp) include the sizes of all terms, which are sums over degrees of freedom. The quick
// check omits these sums, so its limits are never larger: a contact that passes it satisfies the laws.

/// True if no guard of the state is negative. False if a guard is negative, or if this check cannot decide.
[[nodiscard]] bool guards_are_satisfied(const Contact& contact, std::size_t k, const ContactState& state,
                                        const CheckedSide& side);
/// True if N and T satisfy the rows of the state. False if they do not, or if this check cannot decide. rest: speed up to
/// which a contact is regarded as at rest.
[[nodiscard]] bool rows_are_satisfied(const Contact& contact, std::size_t k, const ContactState& state,
                                      const CheckedSide& side, double rest);

}  // namespace signorini::law_check
