// levels.hpp: the next states of all contacts whose forces may jump, at one instant together.
//
//   order k = 0, 1, 2, ...:  r^(k) = b^(k) + W f^(k)        r: g'' and ut'' of those that are undecided
//
// Rigid contacts with g = g' = 0 and sliders that stick rigidly move each other through M. On the level of
// accelerations that is a Coulomb problem (decide/coulomb_problem.hpp) with the forces as unknowns. A contact
// whose force and acceleration are both zero, or whose friction is just at its limit, stays undecided and
// goes into the same problem of the next derivative, with all decided ones in force. What is undecided after
// the last known derivative stays as it was. Contacts that nothing couples have a problem a block.
//
// A problem without solution, or with several that differ in their accelerations, is Painleve's: friction
// couples the tangent to the normal so strongly that pressing a sliding contact pushes it into the ground. It
// is refused with its numbers.
// Source: Glocker 2001, chapters 4 to 6; Painleve 1895.
#pragma once

#include <optional>

#include "decide/coulomb_problem.hpp"
#include "decide/delassus.hpp"
#include "decide/guard_signs.hpp"
#include "motion/jet.hpp"
#include "signorini/trace.hpp"

namespace signorini {

/// A contact that takes part, and what is known of it beforehand.
struct Participant {
  std::size_t contact = 0;
  bool slipping = false;  ///< t . v is not the surface's velocity: it slides along `sign`
  int sign = 0;
  double sliding_friction = 0.0;  ///< coefficient while it slips, at its slip rate
  bool kinetic = false;           ///< its slip has begun at this instant: the static coefficient is gone
  bool bears_limit = false;       ///< its static limit falls, and others hold it there
  std::size_t block = 0;          ///< those of different blocks do not move each other
};

class Levels {
 public:
  Levels(ModeSystems& systems, JetMaker& jets) : model_(systems.model()), systems_(systems), jets_(jets) {}

  /// Changes the states of the participants in `mode`; old: what they were. known: what follows for their
  /// guards, one a contact.
  [[nodiscard]] Refusal decide(const Instant& instant, const Forcing& forcing,
                               const std::vector<Participant>& participants, const Mode& old, Mode& mode,
                               std::vector<KnownGuards>& known);

 private:
  enum class Standing : unsigned char { apex, limit, decided };
  struct Entry {
    Participant who;
    Standing standing = Standing::apex;
  };
  /// The Coulomb problem of one block and order.
  struct Level {
    std::size_t order = 0, block = 0;
    std::vector<std::size_t> entries, contacts;  // that are undecided, and their contacts
    CoulombProblem problem;
    Eigen::VectorXd noise;  // of problem.b
    ModeSystemPtr system;
  };
  [[nodiscard]] CoulombItem item_of(const Entry& entry, const Forcing& forcing, double t) const;
  void fill(const Instant& instant, const Forcing& forcing, const std::vector<Entry>& entries,
            const std::vector<MotionJet>& jets, Level& level) const;
  [[nodiscard]] bool pose(const Instant& instant, const Forcing& forcing, const std::vector<Entry>& entries,
                          const Mode& mode, std::vector<Level>& levels);
  [[nodiscard]] Refusal solve_level(Level& level, std::optional<CoulombSolution>& solution) const;
  [[nodiscard]] bool settle(const Level& level, const CoulombSolution& solution, std::vector<Entry>& entries,
                            Mode& mode, std::vector<KnownGuards>& known) const;
  [[nodiscard]] Refusal refusal(const Level& level, const Enumerated& all) const;

  const Model& model_;
  ModeSystems& systems_;
  JetMaker& jets_;
};

/// Of contacts that stick, no forces are the only ones.
[[nodiscard]] Refusal dependent_rows(std::vector<std::size_t> contacts = {});
/// Why a contact that sticks rigidly has no force of its own, where no mass is behind its tangent; else empty.
[[nodiscard]] std::string holds_no_mass(const Model& model, const Contact& contact);

}  // namespace signorini
