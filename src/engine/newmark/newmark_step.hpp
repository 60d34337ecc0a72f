// newmark_step.hpp: one step of average acceleration (Newmark, beta = 1/4, gamma = 1/2) in given rows.
//
//   u1 = u0 + h v0 + h^2/4 (a0 + a1),   v1 = v0 + h/2 (a0 + a1)
//   M a1 + C v1 + K u1 + sum ( n N1 + t T1 ) = P(t1),   rows of the contacts at t1
//
// Equilibrium and the contacts' laws hold at the end of every step, not only in the limit; a slipping
// contact's row T = -s f N is the paper's compensating load (11), predicted and corrected in one solve.
// The unknown of a degree of freedom is a1, v1 where it has a damper but no mass, u1 where it has neither:
// nothing is divided by h, so a step may be as short as the clock tells.
//
// Large structures (`economical_from`) with compliant contacts and a narrow band are factorised anew for each length that
// will not come again; for others, factors follow changes of state (linear/condensed_matrix.hpp). Factorisations of others:
//   after a change of state at the full length   an update of low rank of the last one (linear/updated_factors.hpp), until
//                                                its solves have cost as much as a factorisation
//   at a length near the last odd one            x += A_odd^-1 (b - A x), until rounding is left
#pragma once

#include <optional>

#include "base/bounded_cache.hpp"
#include "engine/newmark/near_step.hpp"
#include "linear/condensed_matrix.hpp"
#include "linear/system_matrix.hpp"
#include "linear/undamped_motion.hpp"
#include "linear/updated_factors.hpp"
#include "motion/point.hpp"
#include "signorini/result.hpp"

namespace signorini {

/// Lengths that differ by less than this part of a step are one length: a rest of a segment that is longer is
/// taken in one step. Chosen: far above the rounding of t/dt for 1e6 steps, far below what a step is good
/// for.
inline constexpr double same_length = 1e-9;

class NewmarkStep {
 public:
  /// Names what of the rows stands in the matrix: equal keys, equal matrices.
  using Key = std::vector<int>;

  /// widest_band: up to which a matrix is factorised as a band.
  NewmarkStep(const Model& model, const Structure& structure,
              std::size_t widest_band = CondensedMatrix::widest);

  /// Puts rows in force.
  void set(Key key, std::vector<Rows> rows);
  /// The same of rows that are somebody else's.
  void set(Key key, std::shared_ptr<const std::vector<Rows>> rows);
  /// Of rows that are its own: constants may change without a new factorisation.
  [[nodiscard]] std::vector<Rows>& own_rows() { return *own_rows_; }
  [[nodiscard]] const std::vector<Rows>& rows() const { return *rows_; }
  /// From `from` at t1 - h to `to` at t1. `kept`: steps of this length will come again, so their
  /// factorisation is kept. False: the matrix is singular.
  [[nodiscard]] bool take(const Forcing& forcing, const Point& from, double t1, double h, bool kept,
                          Point& to);
  /// What of the end of such a step is seen at one contact, by what is near to it: the rest of the point is not to be read.
  /// whole: the end of the step of length `longer` from the same point. Null: nothing is near, or it would save nothing.
  [[nodiscard]] const Point* near(std::size_t contact, const Forcing& forcing, const Point& from, double t1,
                                  double h, const Point& whole, double longer);
  /// What near() has told was not near enough.
  void look_farther();
  void count(Counters& counters) const;

 private:
  using Factors = std::shared_ptr<const TriangularFactors>;
  [[nodiscard]] bool solve_condensed(double h, bool kept);
  [[nodiscard]] bool solve_kept(double h);
  [[nodiscard]] bool solve_odd(double h);
  [[nodiscard]] bool factor(SystemMatrix& matrix, double h, bool fresh);
  void weigh(double h);
  [[nodiscard]] bool update(double h);
  [[nodiscard]] bool refine(double h);
  [[nodiscard]] std::vector<ChangedRow> changed_rows() const;
  void take_rest(const Vector& b, const Vector& x, double h);
  void know_motion(const Point& from, double h);
  void read_motion(const Point& from, double h, Point& to) const;

  const Model& model_;
  const Structure& structure_;
  Key key_;
  std::shared_ptr<std::vector<Rows>> own_rows_;
  std::shared_ptr<const std::vector<Rows>> rows_;
  const std::vector<DofKind> own_kinds_;  // by the structure alone
  const bool massless_;
  MotionKinds in_rows_;  // which unknown each degree of freedom has
  SystemMatrix workshop_;
  BoundedCache<std::pair<Key, double>, Factors> kept_;  // by rows and length
  SystemMatrix odd_;                                    // for a length that will not come again
  Key odd_key_;
  double odd_h_ = 0.0;  // 0: it holds nothing
  Factors last_;        // of a length that is kept, used last; null after a change of rows
  double last_h_ = 0.0;
  const bool economical_;
  std::optional<CondensedRows> condensed_;    // where the band is narrow
  std::optional<CondensedMatrix> kept_band_;  // of those, for a length that comes again
  std::optional<CondensedMatrix> odd_band_;   // for others
  std::optional<NearStep> near_;
  UpdatedFactors updated_;       // of rows in force from base_rows_, both at base_h_
  std::vector<Rows> base_rows_;  // of its base
  double base_h_ = 0.0;
  bool updates_ = false;           // it is in force, for last_h_
  double spent_ = 0.0;             // numbers that its solves took since rows changed
  Vector odd_x_, rest_, product_;  // the last solution at an odd length; scratch
  std::vector<Weights> weights_;
  Vector u_, v_, x_, work_;  // known parts of the motion, right-hand side and solution, scratch
  long solves_ = 0;
};

}  // namespace signorini
