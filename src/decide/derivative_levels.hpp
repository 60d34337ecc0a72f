// derivative_levels.hpp: next states of all contacts whose forces may jump, decided together at one instant.
//
//   order k = 0, 1, 2, ...:  r^(k) = b^(k) + W f^(k)      r: g'' and ut'' of undecided contacts, f: forces
//
// Rigid contacts with g = g' = 0 and rigidly sticking sliders are coupled through M. On the level of accelerations this
// is a Coulomb problem (decide/coulomb_problem.hpp) with the forces as unknowns. A contact whose force and acceleration
// are both zero, or whose friction is exactly at its limit, stays undecided and enters the same problem for the next
// derivative, with all decided contacts as constraints. Contacts that are undecided after the last known derivative
// keep their states. Uncoupled contacts have one problem per block.
//
// Feet of one body that rest are decided by the forces of least norm (decide/resting_forces.hpp) as long as some forces
// within the cones hold the body; only then are they decided by these levels.
//
// A problem without solution, or with several that differ in their accelerations, is Painleve's paradox: friction
// couples the tangent to the normal so strongly that pressing a sliding contact pushes it into the ground. The decision
// is then refused with the numbers of the problem.
// Source: Glocker 2001, chapters 4 to 6; Painleve 1895.
#pragma once

#include <optional>

#include "decide/coulomb_problem.hpp"
#include "decide/delassus.hpp"
#include "decide/guard_signs.hpp"
#include "decide/resting_forces.hpp"
#include "motion/jet.hpp"
#include "signorini/trace.hpp"

namespace signorini::decide {

/// A contact that takes part, and its known data.
struct Participant {
  std::size_t contact = 0;
  bool slipping = false;  ///< t . v differs from the surface's velocity: it slides along `sign`
  int sign = 0;
  double sliding_friction = 0.0;  ///< coefficient of friction at its slip rate
  bool kinetic = false;      ///< slip has begun at this instant: the static coefficient no longer applies
  bool bears_limit = false;  ///< its static limit is exceeded, and other contacts hold it there
  std::size_t block = 0;     ///< contacts of different blocks are not coupled
};

class DerivativeLevels {
 public:
  DerivativeLevels(motion::StateSystems& systems, motion::JetMaker& jets)
      : model_(systems.model()), systems_(systems), jets_(jets) {}

  /// Sets the states of the participants in `states`; old: states before the decision; contacts that no
  /// derivative decides keep them. known: receives the signs of their guards, one entry per contact.
  [[nodiscard]] Refusal decide(const Instant& instant, const motion::Forcing& forcing,
                               const std::vector<Participant>& participants,
                               const contact::ContactStates& old, contact::ContactStates& states,
                               std::vector<KnownGuards>& known);

 private:
  enum class Status : unsigned char { apex, limit, decided };
  struct Entry {
    Participant participant;
    Status status = Status::apex;
  };
  /// The Coulomb problem of one block and order.
  struct Level {
    std::size_t order = 0, block = 0;
    std::vector<std::size_t> entries, contacts;  // indices of undecided entries, and their contacts
    CoulombProblem problem;
    Eigen::VectorXd noise;  // of problem.b
    motion::StateSystemPtr system;
  };
  [[nodiscard]] std::vector<RestingFeet> find_resting(const Instant& instant, const motion::Forcing& forcing,
                                                      const std::vector<Participant>& participants,
                                                      contact::ContactStates states);
  [[nodiscard]] Refusal decide_moving(const Instant& instant, const motion::Forcing& forcing,
                                      const std::vector<Participant>& participants,
                                      const contact::ContactStates& old, contact::ContactStates& states,
                                      std::vector<KnownGuards>& known);
  [[nodiscard]] CoulombItem item_of(const Entry& entry, const motion::Forcing& forcing, double t) const;
  void fill(const Instant& instant, const motion::Forcing& forcing, const std::vector<Entry>& entries,
            const std::vector<MotionJet>& jets, Level& level) const;
  [[nodiscard]] bool set_up_levels(const Instant& instant, const motion::Forcing& forcing,
                                   const std::vector<Entry>& entries, const contact::ContactStates& states,
                                   std::vector<Level>& levels);
  [[nodiscard]] Refusal solve_level(Level& level, std::optional<CoulombSolution>& solution) const;
  [[nodiscard]] bool apply_solution(const Level& level, const CoulombSolution& solution,
                                    std::vector<Entry>& entries, contact::ContactStates& states,
                                    std::vector<KnownGuards>& known) const;
  [[nodiscard]] Refusal refusal(const Level& level, const EnumerationResult& all) const;

  const Model& model_;
  motion::StateSystems& systems_;
  motion::JetMaker& jets_;
};

/// Refusal for sticking contacts whose forces are not unique.
[[nodiscard]] Refusal dependent_rows(std::vector<std::size_t> contacts = {});
/// Message if a rigidly sticking contact has no unique force because its tangent moves no mass; otherwise
/// empty.
[[nodiscard]] std::string holds_no_mass(const Model& model, const Contact& contact);

}  // namespace signorini::decide
