// state_systems.hpp: the linear systems of contact states, with one cache of their factorisations.
//
//   const StateSystemPtr system = systems.system_of(states);      nullptr: rows are linearly dependent
//
// Limits of the cache: in a periodic motion a contact sticks and slips in both directions, which makes about four states per
// contact, so 1024 states cover cycles of 256 contacts. A dense system contains up to (40^2 + 2 * 40 * 38) doubles, 37 kB.
// Computing it again costs as much as the solves of a decision, so a missing system at most doubles the time of a decision.
// 16 MiB contain 400 such systems, or factors with a million entries. Larger factors exceed processor caches.
//
// States in which forces follow from displacements and velocities alone share one factorisation of M
// (linear/mass_factors.hpp). Their systems are not cached, because making one takes no longer than a search in the cache.
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

// The factored linear system of one contact state; never changed after its construction.
//
//   | M w_a + C w_v + K w_u    n   t |  x = b      w: 1 for the unknown quantity of a degree of freedom
//   | rows of the contacts         . |             (linear/unknowns.hpp), else 0
//
// FactorisedStates is the part that depends on the states alone. Systems that differ only in anchors share it, because
// anchors are constants of rows. If friction depends on the slip rate or on N, the friction coefficients are in the matrix,
// and a system is valid only for its coefficients, initially the kinetic ones. Unknowns: n degrees of freedom, then N and T
// of each contact (linear/unknowns.hpp).

/// Largest number of unknowns for which a dense inverse is faster than a sparse solve.
inline constexpr std::size_t max_dense_size = 40;

struct FactorisedStates {
  linear::Unknowns unknowns;
  std::vector<linear::DofKind> kinds;  ///< one entry per degree of freedom
  /// Motions without mass and damping; the column of its degree of freedom represents each motion.
  std::vector<linear::UndampedMotion> undamped;
  std::vector<linear::PrescribedDof> prescribed;
  /// Forces of contacts that constrain the same motion redundantly.
  std::vector<linear::SharedForces> shared;
  std::vector<std::size_t> rate_dependent;  ///< contacts that slip with a varying friction coefficient
  bool massless = false;                    ///< true: some degrees of freedom have no mass
  bool regular = false;                     ///< false: rows are linearly dependent, so there is no inverse
  linear::TriangularFactors sparse;         ///< sparse factors; empty if `inverse` or `by_mass` is used
  /// Solver by the factors of M; used if forces follow from displacements and velocities alone.
  std::optional<linear::MassSolver> by_mass;
  /// Matrices by columns: the inverse A^-1, and the responses of the unknowns to a unit of u or v of each degree of freedom:
  /// x = A^-1 b + from_u u + from_v v. from_u and from_v exist only if all degrees of freedom have mass.
  std::vector<double> inverse, from_u, from_v;

  [[nodiscard]] bool dense() const { return !inverse.empty(); }
  /// x := A^-1 x; work: scratch for unknowns.size() numbers.
  void solve(double* x, double* work) const;
  /// Memory in use, in bytes.
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

  /// System of the given contact states; nullptr: its rows are linearly dependent, so forces would not be unique.
  [[nodiscard]] StateSystemPtr system_of(const contact::ContactStates& states);
  /// The same system with the given tangent rows for the contacts in FactorisedStates::rate_dependent. It is not cached,
  /// because slip rates and forces do not recur. nullptr: the matrix is singular.
  [[nodiscard]] StateSystemPtr with_friction(const StateSystem& system, std::span<const Form> tangents);

  /// True if other sticking or closed contacts keep contact c at rest on its surface, so that sticking of c would add no
  /// constraint. With H z = 0 (linear/redundant_rows.hpp) the slip rate of c is -z.s'/z_c, where s contains the positions of
  /// all surfaces. The rate is zero from t on if all derivatives of z.s are zero. If other contacts fix the body of c while
  /// the surface of c moves, c slips.
  [[nodiscard]] bool held_by_others(std::size_t c, contact::ContactStates states, const Forcing& forcing,
                                    double t) const;

  /// True if contact c sticks alone in this system, or with others whose surfaces move as its own does.
  [[nodiscard]] bool holds_as_one(std::size_t c, const StateSystem& system, const Forcing& forcing,
                                  double t) const;
  /// True if other contacts keep the gap of contact c at its value.
  [[nodiscard]] bool gap_held_by_others(std::size_t c, contact::ContactStates states) const;

  /// Replaces slip_plus and slip_minus by static_limit_plus and static_limit_minus for contacts for which held_by_others() is
  /// true, so that they keep their static friction; does the inverse for contacts for which it is false. Contacts whose static
  /// and kinetic coefficients are equal stay unchanged.
  void mark_static_limits(contact::ContactStates& states, const Forcing& forcing, double t) const;

  /// Groups of two or more contacts that may constrain the same motion. may_share(): true if the contact is in such a group.
  [[nodiscard]] const std::vector<std::vector<std::size_t>>& sharing() const {
    return matrix_.redundant_rows().groups();
  }
  [[nodiscard]] bool may_share(std::size_t contact) const {
    return matrix_.redundant_rows().may_share(contact);
  }

  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] const linear::SystemMatrices& structure() const { return structure_; }
  /// Number of systems in the cache.
  [[nodiscard]] std::size_t cached_count() const { return cache_.size(); }
  /// Memory of the cache in bytes.
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
  const std::vector<linear::DofKind> own_kinds_;  // kinds from the structure alone
  const bool massless_;
  linear::SystemMatrix matrix_;  // the matrix in which systems are assembled
  std::vector<linear::Weights> weights_;
  std::shared_ptr<const linear::TriangularFactors> mass_;  // factors of M; nullptr: not used for this model
  base::LruCache<std::vector<State>, std::shared_ptr<const FactorisedStates>> cache_;
  // Contacts that other contacts may hold and whose static friction exceeds the kinetic friction.
  std::vector<std::size_t> static_limit_contacts_;
  StateSystemPtr last_;  // result of the last system_of()
  long made_ = 0;
};

// Removes integration drift from the constraints of a contact state.
//
//   n . u + g0 = 0,  n . v = 0     at closed rigid contacts
//   t . v = s'                     at contacts that stick without tangential stiffness

/// Changes u and v as little as possible, in the norm of M, so that they satisfy the constraints of the contact state at t.
/// Returns the impulses of the contacts that correspond to the change of v, along n and t, in the order of forces; empty: no
/// change.
Eigen::VectorXd project_constraints(const Model& model, const StateSystem& system, const Forcing& forcing,
                                    double t, Vector& u, Vector& v);

}  // namespace signorini::motion
