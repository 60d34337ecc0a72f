// mass_factors.hpp: the system of states whose forces follow from places and velocities alone.
//
//   | M  H | | a |   | b |      f = B^-1 q   contact by contact, two by two
//   | 0  B | | f | = | q |      a = M^-1 (b - H f)
//
// This is the matrix of linear/system_matrix.hpp if every degree of freedom has mass and no row of a contact contains
// an acceleration: compliant contacts, sliders. M is the same in all such states, so that one factorisation serves them
// all, and a change of state costs none.
#pragma once

#include <memory>

#include "contact/law.hpp"
#include "linear/structure.hpp"
#include "linear/triangular_factors.hpp"

namespace signorini {

/// Factors of M. Null: M is singular to working precision.
[[nodiscard]] std::shared_ptr<const TriangularFactors> mass_factors(const Structure& structure);

/// B of each contact: N and T in its normal row, then in its tangent row.
struct OwnForces {
  double normal_N = 1.0, normal_T = 0.0, tangent_N = 0.0, tangent_T = 1.0;
};

/// Forces of all contacts. Empty: a row contains an acceleration, or does not determine its force.
[[nodiscard]] std::vector<OwnForces> own_forces(const std::vector<Rows>& rows);

class MassSolver {
 public:
  /// The model must outlive the object.
  MassSolver(const Model& model, std::shared_ptr<const TriangularFactors> mass, std::vector<OwnForces> forces)
      : model_(&model), mass_(std::move(mass)), forces_(std::move(forces)) {}

  /// x := A^-1 x: n degrees of freedom, then N and T of each contact; work: room for n numbers.
  void solve(double* x, double* work) const;
  /// Memory that is not shared.
  [[nodiscard]] std::size_t bytes() const { return forces_.size() * sizeof(OwnForces); }

 private:
  const Model* model_;
  std::shared_ptr<const TriangularFactors> mass_;
  std::vector<OwnForces> forces_;
};

}  // namespace signorini
