// branch_newton.hpp: Newton's method across a branch of orbits.
//
//   y = y0 + ds t,   t: the direction of the branch, |t| = 1
//   [ dG/dy ]        [ -G ]
//   [  t^T  ] dy  =  [  0 ]         so that folds are passed
//
// Norm: the range of the parameter counts as 1, and a state all of whose kinds change by a few of their amplitudes.
#pragma once

#include "orbit/branch_map.hpp"
#include "orbit/special_points.hpp"

namespace signorini {

/// Residual over amplitude that corrections aim at.
inline constexpr double corrected_to = 1e-11;

/// What a correction ended with.
struct Corrected {
  bool done = false;
  std::string reason;  ///< why not
  BranchState state;
  OrbitPass pass;
  double residual = 0.0;
  int iterations = 0;
  Vector by_s;                ///< B^T dG/ds at this point; empty: not asked for yet
  Eigen::MatrixXd monodromy;  ///< with multipliers and tests: of examine()
  Multipliers multipliers;
  std::size_t ones = 0;  ///< multipliers that are 1 for reasons of their own
  TestValues tests;
};

class BranchNewton {
 public:
  /// map must outlive it.
  explicit BranchNewton(BranchMap& map) : map_(map) {}

  /// What counts as 1 in the norm follows from this pass. t: a direction that is to mean the same.
  void measure(const OrbitPass& pass, Vector* t = nullptr);
  /// Unknowns of y at the section of a pass.
  [[nodiscard]] Eigen::Index size(const OrbitPass& pass) const {
    return OrbitSection(map_.model(), pass.begin).size() + (map_.autonomous() ? 2 : 1);
  }
  /// Along the parameter alone.
  [[nodiscard]] Vector upwards(const OrbitPass& pass, double sign) const {
    Vector t = Vector::Zero(size(pass));
    t[t.size() - 1] = sign;
    return t;
  }
  [[nodiscard]] BranchState moved(const BranchState& from, const OrbitPass& pass, const Vector& dy) const;
  /// by_s: of the point before, which serves as long as Newton's method converges; empty: none.
  [[nodiscard]] Corrected correct(BranchState guess, const Vector& t, const Vector& by_s) const;
  /// The direction of the branch, towards where `before` points; multipliers and test functions. ones: as many multipliers
  /// are 1 for reasons of their own as at the point before; absent: those that are, where no special point is near.
  Vector examine(Corrected& at, const Vector& before, std::optional<std::size_t> ones = {}) const;
  /// Where dz/ds is along the motion: the time by which the orbit at the section is later, a unit of s.
  [[nodiscard]] std::optional<double> shift(const Corrected& at, const Vector& t) const;

 private:
  [[nodiscard]] std::string refusal(const OrbitPass& pass, Eigen::Index unknowns) const;
  [[nodiscard]] Eigen::MatrixXd jacobian(const BranchState& state, const OrbitPass& pass,
                                         const Vector& by_s) const;
  [[nodiscard]] Vector by_parameter(const BranchState& state, const OrbitPass& pass) const {
    return OrbitSection(map_.model(), pass.begin).basis().transpose() * map_.by_parameter(state, pass);
  }

  BranchMap& map_;
  double amplitude_ = 1.0;  // of x, in scales: what counts as 1 in the norm
};

}  // namespace signorini
