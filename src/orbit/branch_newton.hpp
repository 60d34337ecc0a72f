// branch_newton.hpp: Newton's method across a branch of orbits.
//
//   y = y0 + ds t,   t: the direction of the branch, |t| = 1
//   [ dG/dy ]        [ -G ]
//   [  t^T  ] dy  =  [  0 ]         so that folds are passed
//
// Norm: the range of the parameter counts as 1, and a state all of whose kinds change by a few of their amplitudes. A
// coordinate with little mass counts less, by sqrt(m_i/m): the fast mode shapes of a fine mesh are in it.
//
// Far from folds the parameter is held while Newton's method corrects the state: a key that moves the period turns the
// phases of fast mode shapes by omega dT, and dG/ds means little a step further on.
#pragma once

#include "orbit/branch_map.hpp"
#include "orbit/special_points.hpp"

namespace signorini {

/// Residual over amplitude that corrections aim at, unless the noise of the map is greater.
inline constexpr double corrected_to = 1e-11;

/// Cosine of two directions that count as one. Chosen.
inline constexpr double alike = 0.9;

/// A point of the branch, as a secant needs it.
struct BranchPlace {
  OrbitPoint begin;
  double duration = 0.0, s = 0.0;
};

/// What a correction ended with.
struct Corrected {
  bool done = false;
  std::string reason;  ///< why not
  BranchState state;
  OrbitPass pass;
  double residual = 0.0;
  int iterations = 0;
  Vector
      by_s;  ///< B^T dG/ds at this point, and the row of the energy if there is one; empty: not asked for yet
  Eigen::MatrixXd monodromy;  ///< with multipliers and tests: of examine()
  Multipliers multipliers;
  double error = 0.0;      ///< error_of() the monodromy matrix
  std::size_t ones = 0;    ///< multipliers that are 1 for reasons of their own
  Eigen::MatrixXd family;  ///< of families(), once asked for
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
  /// are 1 for reasons of their own as at the point before; absent: those that are, where no special point is near. known:
  /// `before` is the direction.
  Vector examine(Corrected& at, const Vector& before, std::optional<std::size_t> ones = {},
                 bool known = false) const;
  /// Whether corrections hold the parameter along this direction.
  [[nodiscard]] static bool holds(const Vector& t);
  /// Directions of families: so many columns as multipliers are 1 for reasons of their own, in y, of length 1.
  [[nodiscard]] const Eigen::MatrixXd& families(Corrected& at) const;
  /// A way along the branch: what leads along families no longer counts in the length of a step.
  struct Way {
    Vector across;  ///< without families, of length 1
    Vector drift;   ///< along families, for each unit of that; at most 1
  };
  [[nodiscard]] Way split(Corrected& at, const Vector& way) const;
  /// Coordinates at the section, dT/T, s of the orbit of twice the period that leaves at a flip.
  [[nodiscard]] Vector flip_direction(const Corrected& at) const;
  /// The same of the branch that crosses the one along t at a branch point.
  [[nodiscard]] Vector other_direction(Corrected at, const Vector& t) const;
  /// Of such coordinates, of length 1.
  [[nodiscard]] Vector in_norm(const Vector& raw) const;
  /// How far v leads along t, as corrections keep it: of t itself 1.
  [[nodiscard]] static double along(const Vector& v, const Vector& t) {
    return holds(t) ? v[v.size() - 1] / t[t.size() - 1] : v.dot(t);
  }
  /// From a point before to this one; nothing where the state at the section has other unknowns.
  [[nodiscard]] std::optional<Vector> difference(const BranchPlace& from, const Corrected& to) const;
  /// Of length 1; nothing where both points are one.
  [[nodiscard]] std::optional<Vector> secant(const BranchPlace& from, const Corrected& to) const;
  /// The noise of the map (shooting.hpp) is what the next corrections can reach.
  void hear_noise(const OrbitPass& first, const OrbitPass& second);
  [[nodiscard]] double noise() const { return noise_; }
  /// Residual at which a correction is done that gets no further.
  [[nodiscard]] double closed_at_last() const;
  /// Where dz/ds is along the motion: the time by which the orbit at the section is later, a unit of s.
  [[nodiscard]] std::optional<double> shift(const Corrected& at, const Vector& t) const;

 private:
  [[nodiscard]] Vector without_families(Corrected& at, const Vector& t) const;
  [[nodiscard]] double energy_missing(const Corrected& c) const;
  void close_damped(Corrected& c, Eigen::Index unknowns) const;
  [[nodiscard]] Vector tangent(Corrected& at, const Vector& before) const;
  [[nodiscard]] std::string refusal(const OrbitPass& pass, Eigen::Index unknowns) const;
  [[nodiscard]] Eigen::MatrixXd jacobian(const BranchState& state, const OrbitPass& pass,
                                         const Vector& by_s) const;
  [[nodiscard]] Vector by_parameter(const BranchState& state, const OrbitPass& pass) const;

  BranchMap& map_;
  Vector sizes_;           // of x, in scales: what counts as 1 in the norm
  double greatest_ = 0.0;  // amplitude of the state along the branch, in scales
  double noise_ = 0.0;     // of the map, over the amplitude
};

}  // namespace signorini
