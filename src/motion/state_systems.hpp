// state_systems.hpp: source of the systems of contact states: one cache of factorisations, by state.
//
//   const StateSystemPtr system = systems.system_of(states);      null: rows are linearly dependent
//
// Limits of the cache: in a periodic motion a contact sticks and slips both ways, about four states for each
// contact, so 1024 states cover cycles of 256 contacts. A dense system contains up to (40^2 + 2 * 40 * 38)
// numbers, 37 kB. Making it again costs as much as the solves of a decision, so a missing system at most
// doubles the time of a decision. 16 MiB hold 400 such systems, or factors with a million entries. Larger
// factors exceed processor caches.
//
// States whose forces follow from displacements and velocities alone share one factorisation of M
// (linear/mass_factors.hpp). They are not cached, because making one takes no longer than finding it.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "base/containers.hpp"
#include "contact/contact_states.hpp"
#include "linear/klu.hpp"
#include "linear/mass_factors.hpp"
#include "linear/redundant_rows.hpp"
#include "linear/system_matrix.hpp"
#include "linear/undamped_motion.hpp"
#include "linear/unknowns.hpp"
#include "motion/forcing.hpp"

namespace signorini::motion {

// The linear system of one contact state, factorised: an immutable value.
//
//   | M w_a + C w_v + K w_u    n   t |  x = b      w: 1 for the unknown quantity of a degree of freedom
//   | rows of the contacts         . |             (linear/unknowns.hpp), else 0
//
// The part that depends on the states alone is a FactorisedStates. Systems that differ in anchors share it,
// because anchors are constants of rows. Friction that depends on the slip rate or on N is in the matrix:
// such a system is valid for the friction coefficients that it was made with, initially the kinetic ones.
// Shapes: n degrees of freedom, then N and T of each contact (linear/unknowns.hpp).

/// Limit of unknowns up to which a dense inverse is faster than a sparse solve.
inline constexpr std::size_t max_dense_size = 40;

struct FactorisedStates {
  linear::Unknowns unknowns;
  std::vector<linear::DofKind> kinds;  ///< one for each degree of freedom
  /// Motions without mass and damping, each represented by the column of its degree of freedom.
  std::vector<linear::UndampedMotion> undamped;
  std::vector<linear::PrescribedDof> prescribed;
  std::vector<linear::SharedForces> shared;  ///< rigid contacts that constrain one motion together
  std::vector<std::size_t> rate_dependent;   ///< contacts that slip with varying friction
  bool massless = false;                     ///< some degrees of freedom are massless
  bool regular = false;                      ///< false: rows are linearly dependent; there is no inverse
  linear::TriangularFactors sparse;          ///< empty if `inverse` or `by_mass` is used
  /// Used if forces follow from displacements and velocities alone.
  std::optional<linear::MassSolver> by_mass;
  /// Column by column: A^-1, and the responses of the unknowns to a unit of u or v of each degree of freedom, if all
  /// have mass: x = A^-1 b + from_u u + from_v v.
  std::vector<double> inverse, from_u, from_v;

  [[nodiscard]] bool dense() const { return !inverse.empty(); }
  /// x := A^-1 x; work: scratch for unknowns.size() numbers.
  void solve(double* x, double* work) const;
  /// Memory in use.
  [[nodiscard]] std::size_t bytes() const;
};

class StateSystem {
 public:
  StateSystem(contact::ContactStates states, std::vector<Rows> rows,
              std::shared_ptr<const FactorisedStates> factorised)
      : states_(std::move(states)), rows_(std::move(rows)), factorised_(std::move(factorised)) {}

  [[nodiscard]] const contact::ContactStates& states() const { return states_; }
  [[nodiscard]] const std::vector<Rows>& rows() const { return rows_; }
  [[nodiscard]] const FactorisedStates& factorised() const { return *factorised_; }
  [[nodiscard]] const std::vector<linear::DofKind>& kinds() const { return factorised_->kinds; }
  [[nodiscard]] const std::vector<linear::UndampedMotion>& undamped() const { return factorised_->undamped; }
  [[nodiscard]] const linear::Unknowns& unknowns() const { return factorised_->unknowns; }
  void solve(double* x, double* work) const { factorised_->solve(x, work); }

 private:
  contact::ContactStates states_;
  std::vector<Rows> rows_;
  std::shared_ptr<const FactorisedStates> factorised_;
};

using StateSystemPtr = std::shared_ptr<const StateSystem>;

inline constexpr base::CacheLimits state_cache_limits{1024, std::size_t{16} << 20};

class StateSystems {
 public:
  /// Both arguments must outlive the object.
  StateSystems(const Model& model, const linear::SystemMatrices& structure,
               base::CacheLimits bounds = state_cache_limits);

  /// The system of a contact state. Null: its rows are linearly dependent, so forces would not be unique.
  [[nodiscard]] StateSystemPtr system_of(const contact::ContactStates& states);
  /// The same system with these tangent rows for the contacts FactorisedStates::rate_dependent. It is not
  /// cached, since slip rates and forces do not recur. Null: the matrix is singular.
  [[nodiscard]] StateSystemPtr with_friction(const StateSystem& system, std::span<const Form> tangents);

  /// True if other sticking or closed contacts keep contact c at rest on its surface, so that its own
  /// sticking would add no constraint. With H z = 0 (linear/redundant_rows.hpp) its slip rate is -z.s'/z_c,
  /// s: motions of the surfaces. The rate is zero from t on if all derivatives of z.s are zero. A contact
  /// that others hold on a moving surface slips.
  [[nodiscard]] bool held_by_others(std::size_t c, contact::ContactStates states, const Forcing& forcing,
                                    double t) const;

  /// True if contact c sticks alone in this system, or together with others whose surfaces move as its own does.
  [[nodiscard]] bool holds_as_one(std::size_t c, const StateSystem& system, const Forcing& forcing,
                                  double t) const;
  /// True if other contacts keep the gap of contact c at its value.
  [[nodiscard]] bool gap_held_by_others(std::size_t c, contact::ContactStates states) const;

  /// Gives slipping contacts that others hold the states static_limit_plus and static_limit_minus, in which
  /// they keep their static friction; contacts that are no longer held get slip_plus and slip_minus. Contacts
  /// with equal coefficients are left as they are.
  void mark_static_limits(contact::ContactStates& states, const Forcing& forcing, double t) const;

  /// Lists of two or more contacts that may constrain one motion together; may_share(): membership.
  [[nodiscard]] const std::vector<std::vector<std::size_t>>& sharing() const {
    return matrix_.redundant_rows().groups();
  }
  [[nodiscard]] bool may_share(std::size_t contact) const {
    return matrix_.redundant_rows().may_share(contact);
  }

  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] const linear::SystemMatrices& structure() const { return structure_; }
  /// Number and size of the cached systems.
  [[nodiscard]] std::size_t cached_count() const { return cache_.size(); }
  [[nodiscard]] std::size_t bytes() const { return cache_.bytes(); }
  /// Number of systems made so far.
  [[nodiscard]] long created_count() const { return made_; }

 private:
  [[nodiscard]] std::vector<Rows> rows_beside(const contact::ContactStates& states) const;
  [[nodiscard]] FactorisedStates describe(const contact::ContactStates& states,
                                          const std::vector<Rows>& rows) const;
  void factorise(const std::vector<Rows>& rows, FactorisedStates& mode);
  [[nodiscard]] std::shared_ptr<const FactorisedStates> by_mass(const contact::ContactStates& states,
                                                                const std::vector<Rows>& rows);
  [[nodiscard]] std::shared_ptr<const FactorisedStates> cached(const contact::ContactStates& states,
                                                               const std::vector<Rows>& rows);
  void invert(const std::vector<Rows>& rows, FactorisedStates& mode);

  const Model& model_;
  const linear::SystemMatrices& structure_;
  const std::vector<linear::DofKind> own_kinds_;  // kinds by the structure alone
  const bool massless_;
  linear::SystemMatrix matrix_;  // matrix in which systems are assembled
  std::vector<linear::Weights> weights_;
  std::shared_ptr<const linear::TriangularFactors> mass_;  // null: not used for this model
  base::LruCache<std::vector<State>, std::shared_ptr<const FactorisedStates>> cache_;
  // Contacts that others may hold, and whose static friction is above the kinetic one.
  std::vector<std::size_t> holdable_;
  StateSystemPtr last_;  // the last system returned
  long made_ = 0;
};

// Removes the drift from the constraints of a contact state.
//
//   n . u + g0 = 0,  n . v = 0     at closed rigid contacts
//   t . v = s'                     at contacts that stick without tangential stiffness

/// Changes u and v as little as possible, in the norm of M, so that they satisfy the constraints of the
/// contact state at t. Returns the impulses of the contacts that make this change of v, along n and t, in the
/// order of forces; empty: there are none.
Eigen::VectorXd project_constraints(const Model& model, const StateSystem& system, const Forcing& forcing,
                                    double t, Vector& u, Vector& v);

}  // namespace signorini::motion
