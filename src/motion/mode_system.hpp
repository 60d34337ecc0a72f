// mode_system.hpp: the linear system of one contact state, factorised: an immutable value.
//
//   | M w_a + C w_v + K w_u    n   t |  x = b      w: 1 for the unknown quantity of a degree of freedom
//   | rows of the contacts         . |             (linear/dof_kinds.hpp), else 0
//
// The part that depends on the states alone is a FactorisedMode, shared by all anchors: anchors are constants of rows.
// Friction that depends on the slip rate is in the matrix: such a system is valid for the friction coefficients that it
// was made with, initially the kinetic ones.
// Shapes: n degrees of freedom, then N and T of each contact (linear/unknowns.hpp).
#pragma once

#include <memory>
#include <optional>

#include "contact/mode.hpp"
#include "linear/mass_factors.hpp"
#include "linear/pinned.hpp"
#include "linear/shared_rows.hpp"
#include "linear/triangular_factors.hpp"
#include "linear/undamped_motion.hpp"
#include "linear/unknowns.hpp"

namespace signorini {

/// Limit of unknowns up to which a dense inverse is faster than a sparse solve.
inline constexpr std::size_t most_dense = 40;

struct FactorisedMode {
  Unknowns unknowns;
  std::vector<DofKind> kinds;  ///< one for each degree of freedom
  /// The column of such a degree of freedom represents a whole motion.
  std::vector<UndampedMotion> undamped;
  std::vector<Pinned> pinned;
  std::vector<SharedForces> shared;   ///< rigid contacts that constrain one motion together
  std::vector<std::size_t> by_rate;   ///< contacts that slip with rate-dependent friction
  bool massless = false;              ///< some degrees of freedom are massless
  bool regular = false;               ///< false: rows are linearly dependent; there is no inverse
  TriangularFactors sparse;           ///< empty if `inverse` or `by_mass` is used
  std::optional<MassSolver> by_mass;  ///< used if the forces follow from places and velocities alone
  /// Column by column: A^-1, and the responses of the unknowns to a unit of u or v of each degree of freedom, if all
  /// have mass: x = A^-1 b + from_u u + from_v v.
  std::vector<double> inverse, from_u, from_v;

  [[nodiscard]] bool dense() const { return !inverse.empty(); }
  /// x := A^-1 x; work: scratch for unknowns.size() numbers.
  void solve(double* x, double* work) const;
  /// Memory in use.
  [[nodiscard]] std::size_t bytes() const;
};

class ModeSystem {
 public:
  ModeSystem(Mode mode, std::vector<Rows> rows, std::shared_ptr<const FactorisedMode> factorised)
      : mode_(std::move(mode)), rows_(std::move(rows)), factorised_(std::move(factorised)) {}

  [[nodiscard]] const Mode& mode() const { return mode_; }
  [[nodiscard]] const std::vector<Rows>& rows() const { return rows_; }
  [[nodiscard]] const FactorisedMode& factorised() const { return *factorised_; }
  [[nodiscard]] const std::vector<DofKind>& kinds() const { return factorised_->kinds; }
  [[nodiscard]] const std::vector<UndampedMotion>& undamped() const { return factorised_->undamped; }
  [[nodiscard]] const Unknowns& unknowns() const { return factorised_->unknowns; }
  void solve(double* x, double* work) const { factorised_->solve(x, work); }

 private:
  Mode mode_;
  std::vector<Rows> rows_;
  std::shared_ptr<const FactorisedMode> factorised_;
};

using ModeSystemPtr = std::shared_ptr<const ModeSystem>;

}  // namespace signorini
