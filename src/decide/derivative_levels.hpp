// derivative_levels.hpp: decides the next states of all contacts whose forces may jump at an instant.
//
//   order k = 0, 1, 2, ...:  r^(k) = b^(k) + W f^(k)      r: g'' and ut'' of undecided contacts; f: their forces
//
// Rigid contacts with g = g' = 0 and rigidly sticking sliders are coupled through M. At order 0 (accelerations) this is a
// Coulomb problem (decide/coulomb_problem.hpp) with the forces as unknowns. A contact stays undecided if its force and its
// acceleration are both zero, or if its friction is exactly at its limit. An undecided contact enters the same problem for the
// next derivative, with all decided contacts as constraints. A contact that is undecided after the last known derivative keeps
// its state. There is one problem for each block of coupled contacts.
//
// Feet of one body at rest are decided by the forces of least norm (decide/resting_forces.hpp) if forces within the cones can
// hold the body. Otherwise these levels decide.
//
// If a problem has no solution, or several solutions with different accelerations, this is Painleve's paradox: friction couples
// tangent and normal so strongly that pressing a sliding contact pushes it into the ground. The decision is then refused; the
// message contains the numbers of the problem.
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

/// A contact that is decided together with other contacts, and known data of this contact.
struct Participant {
  std::size_t contact = 0;
  bool slipping = false;  ///< true: the slip rate is not zero; the contact slides in direction `sign`
  int sign = 0;
  double sliding_friction = 0.0;  ///< coefficient of friction at the contact's slip rate
  bool kinetic = false;  ///< true: slip begins at this instant, so the static coefficient does not apply
  bool stays_at_limit = false;  ///< true: the static limit is exceeded, but other contacts prevent slip
  std::size_t block = 0;        ///< number of the block; contacts of different blocks are not coupled
};

class DerivativeLevels {
 public:
  DerivativeLevels(motion::StateSystems& systems, motion::JetMaker& jets)
      : model_(systems.model()), systems_(systems), jets_(jets) {}

  /// Decides the states of the participants and writes them to `states`. A participant that no derivative decides keeps its
  /// state in `old`. known: receives the signs of the participants' guards; one entry per contact.
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
  /// The Coulomb problem of one block of contacts at one order of derivatives.
  struct Level {
    std::size_t order = 0, block = 0;
    std::vector<std::size_t> entries, contacts;  // indices of undecided entries, and their contacts
    CoulombProblem problem;
    Eigen::VectorXd noise;  // noise of problem.b
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

/// Refusal for sticking contacts whose forces are not unique because their constraint rows are linearly dependent.
[[nodiscard]] Refusal dependent_rows(std::vector<std::size_t> contacts = {});
/// Message if the force of a rigidly sticking contact is not unique, because its tangent moves no mass; otherwise empty.
[[nodiscard]] std::string massless_stick_error(const Model& model, const Contact& contact);

}  // namespace signorini::decide
