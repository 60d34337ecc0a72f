// frequencies.hpp: the first natural frequencies of a structure with given contact constraints, and their damping
// ratios.
//
//   K x = omega^2 M x,   T^T x = 0,   zeta = x^T C x / (2 omega x^T M x)
//
// M and K may be singular. Motions with mass but without stiffness are the free motions, omega = 0; the other modes are
// M-orthogonal to them. Motions with neither mass nor stiffness (a massless node supported only by an open contact) are
// not modes and stay at rest. Dense up to 200 degrees of freedom; above, part by part (parts.hpp), large parts by
// inverse subspace iteration (Bathe, Finite Element Procedures, section 11.6).
#pragma once

#include <vector>

#include "model/modes/modes.hpp"
#include "signorini/model.hpp"

namespace signorini::modes {

struct NaturalMode {
  double omega = 0.0;          ///< rad per time, > 0
  double damping_ratio = 0.0;  ///< from C, coupling between modes neglected
};

struct Frequencies {
  int free_motions = 0;            ///< number of modes with omega = 0, unstable modes included
  int unstable = 0;                ///< number of unstable modes among the free motions: omega^2 < 0
  std::vector<NaturalMode> modes;  ///< the lowest modes with omega > 0, ascending
};

/// Returns the `count` lowest modes with omega > 0. The matrices are n x n, with both triangles stored.
[[nodiscard]] Frequencies lowest_frequencies(const SparseMatrix& mass, const SparseMatrix& damping,
                                             const SparseMatrix& stiffness, const ContactConstraints& holding,
                                             int count);

/// Constraints along the normals of all contacts, with free tangents.
[[nodiscard]] ContactConstraints constrain_normals(const std::vector<Contact>& contacts);

// Number of modes below a frequency, without computation of the modes.
//
//   number of omega_i^2 < s  =  number of negative pivots of  K - s M = L D L^T
//
// Sylvester's law of inertia. Massless degrees of freedom, on which K is positive definite, contribute no negative
// pivots. Source: Bathe, Finite Element Procedures, section 11.4 (Sturm sequence check).

/// Number of modes with omega^2 < s, where s = `square` > 0; repeated modes and free motions are included. If K - s M
/// is singular up to rounding, modes up to s (1 + 1e-5) are counted. Returns -1 if no factorisation near s is accurate.
[[nodiscard]] int count_modes_below(const SparseMatrix& mass, const SparseMatrix& stiffness, double square);

}  // namespace signorini::modes
