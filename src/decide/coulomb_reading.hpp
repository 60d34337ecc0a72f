// coulomb_reading.hpp: values of a Coulomb problem's solution that are significant within its noise.
//
//   df = |A^-1| db,   dr = db + |W_A| df       A: rows and columns of W of the acting forces, |.| entrywise
//
// db: noise of the right-hand side. Each df is at least the noise for the contact alone, and at least the rounding of
// the problem's largest entry, in units that make the diagonal of W one. Units: those of forces and responses.
#pragma once

#include "decide/coulomb_problem.hpp"

namespace signorini {

class CoulombReading {
 public:
  /// Problem and solution must outlive the object. noise: of problem.b, >= 0.
  CoulombReading(const CoulombProblem& problem, const CoulombSolution& solution,
                 const Eigen::VectorXd& noise);

  [[nodiscard]] const CoulombItem& item(std::size_t i) const { return problem_.items[i]; }
  [[nodiscard]] double force(Eigen::Index row) const { return solution_.force[row]; }
  [[nodiscard]] double response(Eigen::Index row) const { return solution_.response[row]; }
  /// Compression of item i, and its coefficient of friction in the solution.
  [[nodiscard]] double pressing(std::size_t i) const;
  [[nodiscard]] double friction(std::size_t i) const;

  [[nodiscard]] double zero_force(Eigen::Index row) const;
  [[nodiscard]] bool is_zero_response(Eigen::Index row) const;
  /// True if friction is clearly inside its cone: the contact is then at rest, whatever rounding is left in its
  /// response.
  [[nodiscard]] bool is_inside_cone(std::size_t i) const;

 private:
  const CoulombProblem& problem_;
  const CoulombSolution& solution_;
  Eigen::VectorXd force_noise_, response_noise_;
};

}  // namespace signorini
