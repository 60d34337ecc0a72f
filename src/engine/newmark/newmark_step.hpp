// newmark_step.hpp: one step of the average acceleration method (Newmark, beta = 1/4, gamma = 1/2) with given contact states.
//
//   u1 = u0 + h v0 + h^2/4 (a0 + a1),   v1 = v0 + h/2 (a0 + a1)
//   M a1 + C v1 + K u1 + sum ( n N1 + t T1 ) = P(t1),   rows of the contacts at t1
//
// Equilibrium and the contact laws are satisfied at the end of every step, not only for h -> 0. The row T = -s f N of a
// slipping contact is the paper's compensating load (11); predictor and corrector are one solve.
// The unknown of a degree of freedom is a1 if it has mass, v1 if it has a damper but no mass, u1 if it has neither. No equation
// is divided by h, so a step may be as short as the resolution of time.
//
// Step lengths recur (dt), or are irregular (steps to an event). In large structures (at least min_condensed_size unknowns)
// with compliant contacts and a narrow band, the matrix is factorised anew for every irregular length, and the factors for
// recurring lengths are updated after changes of contact states (linear/condensed_matrix.hpp). In other structures:
//   after a change of contact states at a recurring length    low-rank update of the last factors (linear/mass_factors.hpp),
//                                                             until its solves have taken as long as a factorisation
//   at an irregular length, contact states unchanged          refinement x += A_last^-1 (b - A x) with the last irregular
//                                                             factors, until the correction is below rounding
#pragma once

#include <optional>

#include "base/containers.hpp"
#include "engine/newmark/local_step.hpp"
#include "linear/condensed_matrix.hpp"
#include "linear/mass_factors.hpp"
#include "linear/system_matrix.hpp"
#include "linear/undamped_motion.hpp"
#include "motion/point.hpp"
#include "signorini/model.hpp"
#include "signorini/result.hpp"

namespace signorini::newmark {

/// Relative difference below which step lengths are regarded as equal. So the last step of a segment may be slightly longer
/// than dt. Chosen: far above the rounding error of t/dt for 1e6 steps, far below the error of a step.
inline constexpr double length_tolerance = 1e-9;

class NewmarkStep {
 public:
  /// Key of the coefficients that the contact rows contribute to the matrix: equal keys mean equal matrices.
  using Key = std::vector<int>;

  /// widest_band: largest band width for which a matrix is factorised as a band matrix.
  NewmarkStep(const Model& model, const linear::SystemMatrices& structure,
              std::size_t widest_band = linear::CondensedMatrix::max_width);

  /// Sets the rows (normal and tangential law) of all contacts and takes ownership of them.
  void set(Key key, std::vector<Rows> rows);
  /// Sets the rows of all contacts, shared with the caller, who must not change them afterwards.
  void set(Key key, std::shared_ptr<const std::vector<Rows>> rows);
  /// Rows passed by value to set(): their constants may be changed without a new factorisation.
  [[nodiscard]] std::vector<Rows>& own_rows() { return *own_rows_; }
  [[nodiscard]] const std::vector<Rows>& rows() const { return *rows_; }
  /// Takes a step of length h from `from` at t1 - h to `to` at t1. kept: true if steps of this length will recur, so that the
  /// factors are stored. Returns false if the matrix is singular.
  [[nodiscard]] bool take(const motion::Forcing& forcing, const motion::Point& from, double t1, double h,
                          bool kept, motion::Point& to);
  /// Motion of one contact at the end of a step like that of take(), computed from a neighbourhood of the contact; all other
  /// entries of the point are invalid. whole: motion at the end of the step of length `longer` from the same `from`. Null if
  /// this method is not available for the structure, or would not save time.
  [[nodiscard]] const motion::Point* local_end(std::size_t contact, const motion::Forcing& forcing,
                                               const motion::Point& from, double t1, double h,
                                               const motion::Point& whole, double longer);
  /// Doubles the radius of the neighbourhood of local_end(). Called if a result of local_end() was inaccurate.
  void double_radius();
  /// Writes the numbers of factorisations and solves so far into the counters.
  void count(Counters& counters) const;

 private:
  using Factors = std::shared_ptr<const linear::TriangularFactors>;
  [[nodiscard]] bool solve_condensed(double h, bool kept);
  [[nodiscard]] bool solve_kept(double h);
  [[nodiscard]] bool solve_irregular(double h);
  [[nodiscard]] bool factor(linear::SystemMatrix& matrix, double h, bool fresh);
  void set_weights(double h);
  [[nodiscard]] bool update(double h);
  [[nodiscard]] bool refine(double h);
  [[nodiscard]] std::vector<linear::ChangedRow> changed_rows() const;
  void set_residual(const Vector& b, const Vector& x, double h);
  void predict(const motion::Point& from, double h);
  void read_motion(const motion::Point& from, double h, motion::Point& to) const;

  const Model& model_;
  const linear::SystemMatrices& structure_;
  Key key_;
  std::shared_ptr<std::vector<Rows>> own_rows_;
  std::shared_ptr<const std::vector<Rows>> rows_;
  const std::vector<linear::DofKind>
      own_kinds_;  // kinds of the structure's degrees of freedom without contacts
  const bool massless_;
  linear::MotionKinds kinds_in_states_;  // kinds in the current contact states: they determine the unknowns
  linear::SystemMatrix workspace_;
  base::LruCache<std::pair<Key, double>, Factors> kept_;  // factors by rows and step length
  linear::SystemMatrix irregular_;                        // matrix for a length that will not recur
  Key irregular_key_;
  double irregular_h_ = 0.0;  // 0: irregular_ has no factors
  Factors last_;              // factors of the last recurring step length; null after a change of rows
  double last_h_ = 0.0;
  const bool saves_factorisations_;
  std::optional<linear::CondensedRows> condensed_;         // used if the band is narrow
  std::optional<linear::CondensedMatrix> kept_band_;       // band matrix for step lengths that recur
  std::optional<linear::CondensedMatrix> irregular_band_;  // band matrix for other step lengths
  std::optional<LocalStep> local_step_;
  // Factors for the current rows, as a low-rank update of the factors for base_rows_; both for the step length base_h_.
  linear::WoodburyFactors updated_;
  std::vector<Rows> base_rows_;  // rows of the base matrix
  double base_h_ = 0.0;
  bool updates_valid_ = false;           // updated_ is valid for the current rows
  double spent_ = 0.0;                   // operations of solves with updated_ since the rows changed
  Vector irregular_x_, rest_, product_;  // last solution at an irregular length; work arrays
  std::vector<linear::Weights> weights_;
  Vector u_, v_, x_, work_;  // known parts of u1 and v1; right-hand side and solution; work array
  long solves_ = 0;
};

// Works of the loads and of the surfaces, and dissipated energies, in a step of the average acceleration method.
//
//   loads     1/2 (P0 + P1) . du
//   damping   h v^T C v + sum_closed cn vn dg          v, vn: means of both ends
//   friction  1/2 (T0 + T1) dp
//   surface  -1/2 (T0 + T1) ds
//
// With these works the energy balance of a step is exact up to rounding, because the trapezoidal rule conserves the energy of a
// linear system.

class NewmarkWorkIntegrals {
 public:
  NewmarkWorkIntegrals(const Model& model, const linear::SystemMatrices& structure)
      : model_(model), structure_(structure), du_(model.size()), v_(model.size()) {}

  /// Adds factor times the works of the step from `a` at t0 to `b` at t1 to `works`. The contact states are constant in the
  /// step.
  void add(const motion::Forcing& forcing, const contact::ContactStates& states, const motion::Point& a,
           double t0, const motion::Point& b, double t1, double factor, motion::WorkIntegrals& works);

 private:
  const Model& model_;
  const linear::SystemMatrices& structure_;
  Vector du_, v_;
};

// Step length in a short segment for which the impulses of the loads are accurate.
//
//   J = int f dt ~ T(1024),   T(n) = h sum'' f(t_i): impulse in n steps of average acceleration
//   dt    if steps of this length have |T - J| <= int |f| / 16
//   h     otherwise: h = segment / 2^k with the smallest k for which |T(2^k) - J| <= 1e-4 int |f|
//
// Reason: a half sine is zero at its beginning and end, so one step over its whole length yields no impulse, and two steps
// yield an impulse that is a fifth too small. For tables dt is always used, because a step ends at each row of a table.

/// Number of steps of length dt from which on a segment uses dt: the impulse of a half wave of this length then has an error of
/// only 1/200.
inline constexpr double short_segment_steps = 16.0;

/// Step length for the segment from `begin` to `end`, at most dt, for accurate impulses of loads and given normal forces. No
/// discontinuity of a history may be inside the segment.
[[nodiscard]] double segment_step_length(const Model& model, double begin, double end, double dt);

}  // namespace signorini::newmark
