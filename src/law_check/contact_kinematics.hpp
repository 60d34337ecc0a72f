// contact_kinematics.hpp: motion of a contact for the law checker, guards of its states, and their rounding.
//
//   g = g0 + n.u,  ut = t.u - s,  g' = n.v,  ut' = t.v - s',  g'' = n.a,  ut'' = t.a - s''
//   size of a form on x: |n| |x|, x on the contact's own degrees of freedom
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

struct ContactKinematics {
  double N = 0.0, T = 0.0, g = 0.0, ut = 0.0, dg = 0.0, dut = 0.0, ddg = 0.0, ddut = 0.0, q = 0.0, dq = 0.0,
         ddq = 0.0;
  // Sizes of the terms of g and ut, of g' and ut', of g'' and ut''.
  double displacement_size = 0.0, velocity_size = 0.0, acceleration_size = 0.0;
};

/// A guard, positive while its state holds, and the size of its terms.
struct GuardValue {
  const char* law = "";
  double value = 0.0, size = 0.0;
  double rate = 0.0;       ///< rate of the value if the motion determines it; otherwise 0
  double tolerance = 0.0;  ///< contribution of the engine's tolerances

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
/// Friction coefficient |T|/|N| for slip at this rate under this N.
[[nodiscard]] double friction_at(const Contact& c, double slip_rate, double N);
/// Friction coefficient in a given state: the static one if the contact is held at its static limit,
/// otherwise friction_at().
[[nodiscard]] double friction_in(const Contact& c, State state, double slip_rate, double N);
/// Guards of a state for a motion whose forces satisfy the state's own rows.
[[nodiscard]] GuardValues guards_of(const Contact& contact, const ContactState& state,
                                    const ContactKinematics& m, const LawLimits& limits);
/// True if another foot or slider may hold this contact at the limit of its friction: its slip rate is then the
/// rounding of the constraint that holds it.
[[nodiscard]] bool may_be_held_by_neighbour(const Model& model, std::size_t k);
/// Size of the terms of kn g + cn g'.
[[nodiscard]] double normal_force_size(const Contact& contact, const ContactKinematics& m);

// Quick check of guards and rows, without an allowance for the rounding of their terms.
//
//   g >= 0          -N >= 0,  fs |N| - |T| >= 0          s p' >= 0
//   |N - kn g - cn g'| <= c eps |N|      |T - kt (ut - p)| <= c eps (|T| + kt |p|)      |T + s fk N| <= c eps |T|
//
// Limits of the laws (laws.hpp) grow with the sizes of all terms, which are sums over degrees of freedom.
// This check omits these sums, so its limits never exceed those of the laws: a contact that passes it
// satisfies the laws.

/// True if no guard of the state is negative; false also if `side` does not determine this.
[[nodiscard]] bool guards_hold(const Contact& contact, std::size_t k, const ContactState& state,
                               const CheckedSide& side);
/// True if N and T satisfy the state's rows. rest: speed up to which a contact counts as at rest.
[[nodiscard]] bool rows_hold(const Contact& contact, std::size_t k, const ContactState& state,
                             const CheckedSide& side, double rest);

}  // namespace signorini::law_check
