// newmark_step.hpp: one step of average acceleration (Newmark, beta = 1/4, gamma = 1/2) with given rows of
// contacts.
//
//   u1 = u0 + h v0 + h^2/4 (a0 + a1),   v1 = v0 + h/2 (a0 + a1)
//   M a1 + C v1 + K u1 + sum ( n N1 + t T1 ) = P(t1),   rows of the contacts at t1
//
// Equilibrium and the contacts' laws hold at the end of every step, not only in the limit; a slipping
// contact's row T = -s f N is the paper's compensating load (11), predicted and corrected in one solve.
// The unknown of a degree of freedom is a1, v1 if it has a damper but no mass, u1 if it has neither: no division by h,
// so a step may be as short as the resolution of time.
//
// Lengths of steps recur, like dt, or are irregular, like those of steps to an event. For large structures
// (at least min_condensed_size) with compliant contacts and a narrow band, every irregular length has its own
// factorisation; the factors for recurring lengths are updated after changes of state
// (linear/condensed_matrix.hpp). Other structures:
//   after a change of state at a recurring length    an update of low rank of the last factors
//                                                    (linear/mass_factors.hpp), until its solves have cost
//                                                    as much as a factorisation
//   at a length near the last irregular one          x += A_last^-1 (b - A x), until only rounding remains
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

/// Lengths that differ by less than this fraction of a step count as equal, so that a slightly longer
/// remainder of a segment is one step. Chosen: far above the rounding of t/dt for 1e6 steps, far below the
/// error of a step.
inline constexpr double length_tolerance = 1e-9;

class NewmarkStep {
 public:
  /// Identifies the part of the rows that is in the matrix: equal keys mean equal matrices.
  using Key = std::vector<int>;

  /// widest_band: greatest width for which a matrix is factorised as a band.
  NewmarkStep(const Model& model, const linear::SystemMatrices& structure,
              std::size_t widest_band = linear::CondensedMatrix::max_width);

  /// Sets the rows of the contacts.
  void set(Key key, std::vector<Rows> rows);
  /// Same, with rows of another owner.
  void set(Key key, std::shared_ptr<const std::vector<Rows>> rows);
  /// Rows owned by this object: their constants may change without a new factorisation.
  [[nodiscard]] std::vector<Rows>& own_rows() { return *own_rows_; }
  [[nodiscard]] const std::vector<Rows>& rows() const { return *rows_; }
  /// Steps from `from` at t1 - h to `to` at t1. `kept`: steps of this length will recur, so the factorisation
  /// is kept. False: the matrix is singular.
  [[nodiscard]] bool take(const motion::Forcing& forcing, const motion::Point& from, double t1, double h,
                          bool kept, motion::Point& to);
  /// End of such a step at one contact, computed from its neighbourhood: the rest of the point is invalid. whole: the
  /// end of the step of length `longer` from the same point. Null: no neighbourhood is available, or it would not save
  /// time.
  [[nodiscard]] const motion::Point* local_end(std::size_t contact, const motion::Forcing& forcing,
                                               const motion::Point& from, double t1, double h,
                                               const motion::Point& whole, double longer);
  /// The neighbourhood used by local_end() was too small: doubles its radius.
  void double_radius();
  /// Adds the numbers of factorisations and solves so far.
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
  const std::vector<linear::DofKind> own_kinds_;  // kinds by the structure alone
  const bool massless_;
  linear::MotionKinds in_rows_;  // unknown of each degree of freedom
  linear::SystemMatrix workspace_;
  base::LruCache<std::pair<Key, double>, Factors> kept_;  // by rows and length
  linear::SystemMatrix irregular_;                        // matrix for a length that will not recur
  Key irregular_key_;
  double irregular_h_ = 0.0;  // 0: no factors
  Factors last_;              // last used factors of a kept length; null after a change of rows
  double last_h_ = 0.0;
  const bool economical_;
  std::optional<linear::CondensedRows> condensed_;         // used if the band is narrow
  std::optional<linear::CondensedMatrix> kept_band_;       // band matrix for a length that recurs
  std::optional<linear::CondensedMatrix> irregular_band_;  // for other lengths
  std::optional<LocalStep> local_step_;
  // Factors for the current rows, as changes of base_rows_; both at base_h_.
  linear::WoodburyFactors updated_;
  std::vector<Rows> base_rows_;  // rows of the base matrix
  double base_h_ = 0.0;
  bool updates_ = false;                 // updated_ is in use, for last_h_
  double spent_ = 0.0;                   // operations of solves with updated_ since the rows changed
  Vector irregular_x_, rest_, product_;  // the last solution at an irregular length; scratch
  std::vector<linear::Weights> weights_;
  Vector u_, v_, x_, work_;  // known parts of the motion, right-hand side and solution, scratch
  long solves_ = 0;
};

// Work of the loads and dissipation in a step of average acceleration.
//
//   loads     1/2 (P0 + P1) . du
//   damping   h v^T C v + sum_closed cn vn dg          v, vn: means of both ends
//   friction  1/2 (T0 + T1) dp
//   surface  -1/2 (T0 + T1) ds
//
// With these works the energy balance of a step holds up to rounding: the trapezoidal rule conserves the
// energy of a linear system.

class NewmarkWorkIntegrals {
 public:
  NewmarkWorkIntegrals(const Model& model, const linear::SystemMatrices& structure)
      : model_(model), structure_(structure), du_(model.size()), v_(model.size()) {}

  /// works += factor * works of the step from `a` at t0 to `b` at t1, in constant contact states.
  void add(const motion::Forcing& forcing, const contact::ContactStates& states, const motion::Point& a,
           double t0, const motion::Point& b, double t1, double factor, motion::WorkIntegrals& works);

 private:
  const Model& model_;
  const linear::SystemMatrices& structure_;
  Vector du_, v_;
};

// Length of the steps of a short segment, with which the impulses of its loads are accurate.
//
//   J = int f dt ~ T(1024),   T(n) = h sum'' f(t_i): impulse in n steps of average acceleration
//   dt    if steps of this length have |T - J| <= int |f| / 16
//   h     otherwise: the segment in n = 2^k parts, the fewest with |T(n) - J| <= 1e-4 int |f|
//
// A half sine is zero where it begins and ends: one step over all of it has no impulse, two steps lose a
// fifth. A dt that is short enough for a load is kept. So it is for tables, because a step ends at each of
// their rows.

/// Segments of more steps than this use dt: the impulse of a half wave of this length has an error of 1/200.
inline constexpr double short_segment_steps = 16.0;

/// Length of the steps from `begin` to `end`, at most dt; no history breaks between them. Loads and compressions are
/// considered.
[[nodiscard]] double segment_step_length(const Model& model, double begin, double end, double dt);

}  // namespace signorini::newmark
