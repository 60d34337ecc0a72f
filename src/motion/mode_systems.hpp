// mode_systems.hpp: source of the systems of contact states: one cache of factorisations, by state.
//
//   const ModeSystemPtr system = systems.of(mode);        null: rows are linearly dependent
//
// Bounds: a periodic motion takes each contact through stick and slip both ways, about four states for each contact, so
// 1024 states cover cycles of 256 contacts. A dense system contains up to (40^2 + 2 * 40 * 38) numbers, 37 kB, and the
// solves of a decision cost as much as making the system again: a missing system at most doubles the time of a
// decision. 16 MiB hold 400 such systems, or the factors of a million entries, beyond which processor caches end and a
// factorisation costs more than a look-up in any case. States whose forces follow from places and velocities alone
// share one factorisation of M (linear/mass_factors.hpp), are made as fast as they would be found, and are not cached.
#pragma once

#include <span>

#include "base/bounded_cache.hpp"
#include "linear/system_matrix.hpp"
#include "motion/forcing.hpp"
#include "motion/mode_system.hpp"

namespace signorini {

inline constexpr CacheBounds mode_bounds{1024, std::size_t{16} << 20};

class ModeSystems {
 public:
  /// Both arguments must outlive the object.
  ModeSystems(const Model& model, const Structure& structure, CacheBounds bounds = mode_bounds);

  /// The system of a contact state. Null: its rows are linearly dependent, so forces would not be unique.
  [[nodiscard]] ModeSystemPtr of(const Mode& mode);
  /// The same system with these coefficients of friction for the contacts `by_rate`. It is not cached, since slip rates
  /// do not recur. Null: singular.
  [[nodiscard]] ModeSystemPtr at_friction(const ModeSystem& system, std::span<const Form> tangents);

  /// True if other sticking or touching contacts hold contact c at rest on its surface, so that its sticking would add
  /// no constraint. With H z = 0 of the rows in force its slip rate is -z.s'/z_c, s the motions of the surfaces: zero
  /// from t on if all derivatives of z.s are zero. A contact held by others on a moving surface slips.
  [[nodiscard]] bool held_by_others(std::size_t c, Mode mode, const Forcing& forcing, double t) const;

  /// Marks slips of contacts that others hold, and that keep their static friction (State::held_plus); if both
  /// coefficients are equal there is no difference.
  void tell_held(Mode& mode, const Forcing& forcing, double t) const;

  /// Lists of two or more contacts that may constrain one motion together; may_share(): membership.
  [[nodiscard]] const std::vector<std::vector<std::size_t>>& sharing() const {
    return matrix_.shared_rows().groups();
  }
  [[nodiscard]] bool may_share(std::size_t contact) const { return matrix_.shared_rows().may_share(contact); }

  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] const Structure& structure() const { return structure_; }
  /// Number and size of the cached systems.
  [[nodiscard]] std::size_t held() const { return cache_.size(); }
  [[nodiscard]] std::size_t bytes() const { return cache_.bytes(); }
  /// Number of systems made so far.
  [[nodiscard]] long made() const { return made_; }

 private:
  [[nodiscard]] std::vector<Rows> rows_beside(const Mode& mode) const;
  [[nodiscard]] FactorisedMode describe(const Mode& mode, const std::vector<Rows>& rows) const;
  void factorise(const std::vector<Rows>& rows, FactorisedMode& mode);
  [[nodiscard]] std::shared_ptr<const FactorisedMode> by_mass(const Mode& mode,
                                                              const std::vector<Rows>& rows);
  [[nodiscard]] std::shared_ptr<const FactorisedMode> cached(const Mode& mode, const std::vector<Rows>& rows);
  void invert(const std::vector<Rows>& rows, FactorisedMode& mode);

  const Model& model_;
  const Structure& structure_;
  const std::vector<DofKind> own_kinds_;  // kinds by the structure alone
  const bool massless_;
  SystemMatrix matrix_;  // matrix in which systems are assembled
  std::vector<Weights> weights_;
  std::shared_ptr<const TriangularFactors> mass_;  // null: not used for this model
  BoundedCache<std::vector<State>, std::shared_ptr<const FactorisedMode>> cache_;
  std::vector<std::size_t> holdable_;  // contacts that others may hold at a static limit above kinetic
  ModeSystemPtr last_;                 // the last system returned
  long made_ = 0;
};

}  // namespace signorini
