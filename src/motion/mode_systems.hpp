// mode_systems.hpp: where mode systems come from: one cache of what is factorised, by the states.
//
//   const ModeSystemPtr system = systems.of(mode);        null: rows are linearly dependent
//
// Bounds: a cycle of a motion takes each contact through stick and slip both ways, some four modes a
// contact, so 1024 modes are those of cycles of 256 contacts. A dense mode holds up to
// (40^2 + 2 * 40 * 38) numbers, 37 kB, and a decision solves with it as often as it takes to make it again:
// what is not held costs a decision twice its time at most. 16 MiB hold 400 such modes, or the factors of
// a million entries, beyond which caches of processors end and a factorisation outweighs a look-up in any
// case. States whose forces follow from places and velocities alone share one factorisation of M
// (linear/mass_factors.hpp), are made as fast as they would be found, and are not held.
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
  /// Both must outlive it.
  ModeSystems(const Model& model, const Structure& structure, CacheBounds bounds = mode_bounds);

  /// The system of a mode. Null: its rows are linearly dependent, forces would not be unique.
  [[nodiscard]] ModeSystemPtr of(const Mode& mode);
  /// The same system with these coefficients of friction for the contacts `by_rate`. It is not kept: slip
  /// rates do not return. Null: singular.
  [[nodiscard]] ModeSystemPtr at_friction(const ModeSystem& system, std::span<const Form> tangents);

  /// Others that stick or touch hold contact c at rest on its surface: sticking, it would hold nothing more. With H z = 0 of
  /// the rows in force its slip rate is -z.s'/z_c, s the motions of the surfaces: zero from t on where all derivatives of z.s
  /// are. What others hold beside a surface that moves slips.
  [[nodiscard]] bool held_by_others(std::size_t c, Mode mode, const Forcing& forcing, double t) const;

  /// Tells slips that others hold, and that keep their static friction (State::held_plus), from those that do not; where
  /// both coefficients are one there is no difference.
  void tell_held(Mode& mode, const Forcing& forcing, double t) const;

  /// Contacts, two at least a list, that may hold one motion together; is one of them?
  [[nodiscard]] const std::vector<std::vector<std::size_t>>& sharing() const {
    return matrix_.shared_rows().groups();
  }
  [[nodiscard]] bool may_share(std::size_t contact) const { return matrix_.shared_rows().may_share(contact); }

  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] const Structure& structure() const { return structure_; }
  /// Number and size of the systems held now.
  [[nodiscard]] std::size_t held() const { return cache_.size(); }
  [[nodiscard]] std::size_t bytes() const { return cache_.bytes(); }
  /// Systems made so far.
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
  const std::vector<DofKind> own_kinds_;  // by the structure alone
  const bool massless_;
  SystemMatrix matrix_;  // the workshop
  std::vector<Weights> weights_;
  std::shared_ptr<const TriangularFactors> mass_;  // null: not of use here
  BoundedCache<std::vector<State>, std::shared_ptr<const FactorisedMode>> cache_;
  std::vector<std::size_t> holdable_;  // contacts that may be held at a static limit above the kinetic one
  ModeSystemPtr last_;                 // handed out last
  long made_ = 0;
};

}  // namespace signorini
