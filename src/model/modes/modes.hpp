// modes.hpp: the lowest and the highest circular frequency of a structure and its contacts.
//
//   K x = omega^2 M x
//
// M may be singular. Lowest: M x = mu K x with K positive definite, omega = 1 / sqrt(mu_max); motions that
// are constrained to zero are eliminated. Highest: massless degrees of freedom are condensed,
// K_c = K_dd - K_dm K_mm^-1 K_md, and omega^2 is the largest eigenvalue of (K_c, M_dd). Dense up to 200
// degrees of freedom; above that part by part (parts.hpp), large parts by iteration.
#pragma once

#include <vector>

#include "model/assembly/springs.hpp"
#include "signorini/model.hpp"

namespace signorini::modes {

/// Number of degrees of freedom up to which the dense solver is used, because it is faster than the sparse one there.
/// Chosen value; both give the same results.
inline constexpr int dense_up_to = 200;

/// Constraints by contacts, for frequencies: springs, and forms that are fixed to zero.
struct ContactConstraints {
  std::vector<assembly::LineSpring> springs;
  std::vector<Combination> fixed;

  /// Adds the normal of a closed contact: its spring, or a fixed form. Does nothing for a contact with a given normal force.
  void add_normal(const Contact& contact);
};

/// Constraints of all contacts k with closed[k], in both directions: compliant ones by kn and kt; sliders by
/// kt, or fixed along the tangent if they have no kt; rigid ones fixed in both directions.
[[nodiscard]] ContactConstraints constrain_contacts(const std::vector<Contact>& contacts,
                                                    const std::vector<bool>& closed);

/// Lowest circular frequency, rad per time; 0 if some motion has no stiffness, or if nothing with mass can
/// move.
[[nodiscard]] double lowest_frequency(const SparseMatrix& mass, const SparseMatrix& stiffness,
                                      const ContactConstraints& holding);

/// Highest circular frequency, rad per time, with all contact springs; an estimate for large structures. 0
/// without stiffness.
[[nodiscard]] double highest_frequency(const Model& model);

// Accuracy limit of the lowest frequency due to the rounding of the matrices.
//
//   delta omega^2 = x^T dK x,   |dK_ij| <= eps/2 |K_ij| with random signs:
//   delta omega / omega = eps/4 sqrt( sum (x_i K_ij x_j)^2 ) / x^T K x
//
// Entries of K are rounded during assembly, and x^T K x is a small difference of large terms: on a mesh of n elements
// the loss is of order n^3 or more. Neither a smaller tolerance nor another engine removes this error; times of events
// have the same error.

/// delta omega / omega of the mode with the frequency closest to model.omega1, with contact springs; 0 if there
/// is no mode.
[[nodiscard]] double rounding_floor(const Model& model);

}  // namespace signorini::modes
