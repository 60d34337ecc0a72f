// branch_newton.hpp: Newton's method orthogonal to a branch of orbits, and the choice of a member of a
// family.
//
//   y = y0 + ds t,   t: the direction of the branch, |t| = 1
//   [ dG/dy ]        [ -G ]
//   [  t^T  ] dy  =  [  0 ]         regular at folds
//
// Norm: the full range of the parameter has length 1, and a change of the state by a few amplitudes of each
// kind also has length 1. A coordinate with little mass, such as in the fast mode shapes of a fine mesh, has
// the smaller weight sqrt(m_i/m), m: largest mass.
//
// Far from folds Newton's method keeps the parameter fixed and corrects only the state. A key that changes the period
// rotates the phases of fast mode shapes by omega dT. Therefore dG/ds of the last point is not valid at the next point.
#pragma once

#include "orbit/branch_map.hpp"
#include "orbit/special_points.hpp"

namespace signorini::orbit {

/// Target for residual / amplitude, unless the noise of the map is larger.
inline constexpr double correction_tolerance = 1e-11;

/// Two directions are regarded as equal if the cosine of the angle between them exceeds this value. Chosen value.
inline constexpr double same_direction_cosine = 0.9;

/// Data of a point of the branch from which a secant is computed.
struct SecantPoint {
  OrbitPoint begin;
  double duration = 0.0, s = 0.0;
};

/// Result of a correction.
struct CorrectedPoint {
  bool done = false;
  std::string reason;  ///< reason for a failure
  BranchState state;
  OrbitPass pass;
  double residual = 0.0;
  int iterations = 0;
  /// B^T dG/ds at this point; if the energy is prescribed, the last row is its derivative; empty: not
  /// computed yet.
  Vector derivative_by_s;
  Eigen::MatrixXd monodromy;  ///< set by examine(), like multipliers and tests
  Multipliers multipliers;
  double error = 0.0;      ///< error of the monodromy matrix, from error_of()
  std::size_t ones = 0;    ///< number of structural multipliers 1 (special_points.hpp)
  Eigen::MatrixXd family;  ///< result of families(), computed on request
  TestValues tests;
};

class BranchNewton {
 public:
  /// map must outlive the object.
  explicit BranchNewton(BranchMap& map) : map_(map) {}

  /// Sets the units of the norm from this pass. t: null, or a direction that is converted to the new norm.
  void measure(const OrbitPass& pass, Vector* t = nullptr);
  /// Number of unknowns of y at the section of a pass.
  [[nodiscard]] Eigen::Index size(const OrbitPass& pass) const {
    return OrbitSection(map_.model(), pass.begin).size() + (map_.autonomous() ? 2 : 1);
  }
  /// Direction in which only the parameter changes. sign: 1 or -1.
  [[nodiscard]] Vector parameter_direction(const OrbitPass& pass, double sign) const {
    Vector t = Vector::Zero(size(pass));
    t[t.size() - 1] = sign;
    return t;
  }
  [[nodiscard]] BranchState moved(const BranchState& from, const OrbitPass& pass, const Vector& dy) const;
  /// Corrects `guess` orthogonally to t. by_s: dG/ds at the previous point, used while Newton's method
  /// converges fast; if empty, dG/ds is computed.
  [[nodiscard]] CorrectedPoint correct(BranchState guess, const Vector& t, const Vector& by_s) const;
  /// Returns the direction of the branch, oriented like `before`, and computes multipliers and test functions.
  /// ones: number of structural multipliers 1 at the previous point; if absent, multipliers near 1 are
  /// counted, which requires that no special point is near. known: true if `before` already is the direction.
  Vector examine(CorrectedPoint& at, const Vector& before, std::optional<std::size_t> ones = {},
                 bool known = false) const;
  /// True if Newton's method keeps the parameter constant after a step in this direction.
  [[nodiscard]] static bool fixes_parameter(const Vector& t);
  /// Directions along families of orbits: one column of length 1, in the coordinates y, per structural multiplier 1.
  [[nodiscard]] const Eigen::MatrixXd& families(CorrectedPoint& at) const;
  /// A direction along the branch, split into two parts. The part along families does not contribute to a
  /// step's length.
  struct StepDirection {
    Vector across;  ///< part without families, scaled to length 1
    Vector drift;   ///< part along families, per unit of `across`; length at most 1
  };
  [[nodiscard]] StepDirection split(CorrectedPoint& at, const Vector& way) const;
  /// Direction of the orbit of twice the period at a flip: coordinates at the section, dT/T, s.
  [[nodiscard]] Vector flip_direction(const CorrectedPoint& at) const;
  /// Direction, at a branch point, of the branch that crosses the branch with direction t.
  [[nodiscard]] Vector other_direction(CorrectedPoint at, const Vector& t) const;
  /// Converts a direction, in the coordinates of flip_direction(), to the coordinates of the norm, with length 1.
  [[nodiscard]] Vector in_norm(const Vector& raw) const;
  /// Component of v along t: v_s / t_s if Newton's method keeps the parameter constant, otherwise v . t; 1 for v = t.
  [[nodiscard]] static double along(const Vector& v, const Vector& t) {
    return fixes_parameter(t) ? v[v.size() - 1] / t[t.size() - 1] : v.dot(t);
  }
  /// Difference between two points in the norm; nullopt if the states at the section have different unknowns.
  [[nodiscard]] std::optional<Vector> difference(const SecantPoint& from, const CorrectedPoint& to) const;
  /// difference(), normalised to length 1; nullopt if both points coincide.
  [[nodiscard]] std::optional<Vector> secant(const SecantPoint& from, const CorrectedPoint& to) const;
  /// Sets noise() from two successive passes (map_noise() in shooting.hpp): the residuals of later corrections cannot
  /// become smaller. noise() is unchanged if map_noise() is unknown.
  void update_noise(const OrbitPass& first, const OrbitPass& second);
  [[nodiscard]] double noise() const { return noise_; }
  /// Residual up to which a stagnating correction is accepted.
  [[nodiscard]] double accepted_residual() const;
  /// d(time shift)/ds of the orbit at the section, if the key only shifts the orbit in time; otherwise nullopt.
  [[nodiscard]] std::optional<double> shift(const CorrectedPoint& at, const Vector& t) const;

 private:
  [[nodiscard]] Vector without_families(CorrectedPoint& at, const Vector& t) const;
  [[nodiscard]] double energy_residual(const CorrectedPoint& c) const;
  void close_damped(CorrectedPoint& c, Eigen::Index unknowns) const;
  [[nodiscard]] Vector tangent(CorrectedPoint& at, const Vector& before) const;
  [[nodiscard]] std::string refusal(const OrbitPass& pass, Eigen::Index unknowns) const;
  [[nodiscard]] Eigen::MatrixXd jacobian(const BranchState& state, const OrbitPass& pass,
                                         const Vector& by_s) const;
  [[nodiscard]] Vector parameter_derivative(const BranchState& state, const OrbitPass& pass) const;

  BranchMap& map_;
  Vector sizes_;           // changes of x that have length 1 in the norm, in the model's scales
  double greatest_ = 0.0;  // amplitude of the state, largest along the branch, in scales
  double noise_ = 0.0;     // noise of the map, relative to the amplitude
};

// Selects the orbit of a family that a branch follows.
//
//   m+ = min (f_s |N| - T),   m- = min (f_s |N| + T)      margins of a contact that never slips, over the period
//   z = z_0 + W a,   W: (Phi - I) W = 0                   the family
//   m+ = m-                                               its middle
//
// A contact that never slips may have any mean force between its limits. A member of the family with a zero
// margin grazes. If the branch continued from such a member, each step would make the contact slip once and
// end at the limit again, so every point would graze. In the middle no guard grazes until both margins are
// zero; there the contact begins to slip in both directions.
//
// Margins are linear in a if all forces are linear in a. The derivative d(margins)/da is computed as a
// difference of two runs.

/// The orbit in the middle of the family of `here`, examined along t. nullopt if `here` is already in the
/// middle or belongs to no such family, or if Newton's method finds no better orbit.
[[nodiscard]] std::optional<CorrectedPoint> representative_member(const BranchMap& map,
                                                                  const BranchNewton& newton,
                                                                  const CorrectedPoint& here,
                                                                  const Vector& t);

}  // namespace signorini::orbit
