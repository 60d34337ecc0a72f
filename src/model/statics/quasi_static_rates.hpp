// quasi_static_rates.hpp: quasi-static rates of contacts that touch or are at their friction limits.
//
//   w = q + M z,   w >= 0,   z >= 0,   w . z = 0        unknowns and conditions: frictional.hpp, smallest_motion.hpp
//
// Lemke's method is tried first. With friction M is not copositive-plus, and the method may end in a ray although there
// is a solution. Then all combinations of the contacts' alternatives are tried:
//
//   touching      w = 0 for          at its limit   w = 0 for
//   stick         none               stick          none
//   slip +, -     that slip          slip           that slip
//   open          opening and slip, whose sign is free: N' = 0, T' = 0
//
// If several combinations satisfy the conditions, the one with the smallest |z| is taken: this choice is independent of
// the scene's orientation, reflection and numbering.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "model/statics/smallest_motion.hpp"
#include "signorini/contact.hpp"

namespace signorini::statics {

struct QuasiStaticRates {
  Eigen::VectorXd z;       ///< one per unknown
  bool ambiguous = false;  ///< true: other rates also satisfy the conditions
};

/// Returns the rates z; nullopt if no combination satisfies the conditions, or if there are more than max_combinations.
/// The largest entry of q must have magnitude one. Unknowns of one contact must be adjacent, its opening first.
[[nodiscard]] std::optional<QuasiStaticRates> quasi_static_rates(const Eigen::MatrixXd& m,
                                                                 const Eigen::VectorXd& q,
                                                                 const std::vector<Unknown>& unknowns);

/// Chosen value: this number of combinations takes less than a second.
inline constexpr std::size_t max_combinations = 20'000;

// State of a contact during quasi-static loading, and its distance from the limits.
//
//   f |N| - s T >= 0, s = +-1       while the contact sticks
//   touching: g = 0 and N = 0       neither compressed nor separated

/// State of one contact. gap_rate, N_rate, T_rate: derivatives by the load factor of the stage, which runs from 0 to 1.
struct LimitMargin {
  State state = State::open;
  double gap = 0.0, N = 0.0, T = 0.0;
  double gap_rate = 0.0, N_rate = 0.0, T_rate = 0.0;
  /// Rate of the gap without displacements; nonzero only while an interference is applied.
  double given_gap_rate = 0.0;
  int normal = -1, tangent = -1;  ///< indices of the constraint rows of N and T; -1: no active row
};

/// State of a contact before any load.
[[nodiscard]] LimitMargin undeformed(const Contact& contact);

/// Friction coefficient of the current state: kinetic in slip, otherwise static.
[[nodiscard]] double friction_of(const Contact& contact, const LimitMargin& standing);
/// Margin f |N| - s T before slip in the direction s; force.
[[nodiscard]] double margin_of(const Contact& contact, const LimitMargin& standing, int s);

/// Threshold below which a force is zero; greatest: the largest force so far.
[[nodiscard]] double force_tolerance(double greatest);
/// True if the contact has neither a gap nor a compression. zero: threshold of forces; travelled: sum of the
/// magnitudes of the gap's terms.
[[nodiscard]] bool touching(const Contact& contact, const LimitMargin& standing, double zero,
                            double travelled);

}  // namespace signorini::statics
