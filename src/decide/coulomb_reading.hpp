// coulomb_reading.hpp: what the solution of a Coulomb problem says within its noise.
//
//   df = |A^-1| db,   dr = db + |W_A| df       A: rows and columns of W of the forces that act, |.| entrywise
//
// db: of the right side. At least what a contact alone would make of it, and the rounding of the problem's
// greatest entry in units that make the diagonal of W one. Units: those of forces and responses.
#pragma once

#include "decide/coulomb_problem.hpp"

namespace signorini {

class CoulombReading {
 public:
  /// Both must outlive it. noise: of problem.b, >= 0.
  CoulombReading(const CoulombProblem& problem, const CoulombSolution& solution,
                 const Eigen::VectorXd& noise);

  [[nodiscard]] const CoulombItem& item(std::size_t i) const { return problem_.items[i]; }
  [[nodiscard]] double force(Eigen::Index row) const { return solution_.force[row]; }
  [[nodiscard]] double response(Eigen::Index row) const { return solution_.response[row]; }
  /// Compression of item i, and its coefficient of friction by the solution.
  [[nodiscard]] double pressing(std::size_t i) const;
  [[nodiscard]] double friction(std::size_t i) const;

  [[nodiscard]] double zero_force(Eigen::Index row) const;
  [[nodiscard]] bool is_zero_response(Eigen::Index row) const;
  /// Friction clearly inside its cone answers to rest, whatever rounding has left of that.
  [[nodiscard]] bool is_inside_cone(std::size_t i) const;

 private:
  const CoulombProblem& problem_;
  const CoulombSolution& solution_;
  Eigen::VectorXd force_noise_, response_noise_;
};

}  // namespace signorini
