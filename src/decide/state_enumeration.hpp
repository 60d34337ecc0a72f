// state_enumeration.hpp: tries all combinations of the contact states of a block, and measures their violations in multiples
// of rounding errors.
//
//   relative violation of a combination of states = max over the block's guards of ( -g^(k) / zero^(k) )
//                           where g^(k) is negative and no lower derivative is positive
//
// Relative violation 0: no guard fails. A combination is acceptable if its relative violation does not exceed the condition
// number of the block. Used for blocks that rounding leaves undecided, at the cost of one jet per combination.
#pragma once

#include <optional>
#include <string>

#include "decide/rigid_contact_solver.hpp"

namespace signorini::decide {

class StateEnumeration {
 public:
  StateEnumeration(motion::StateSystems& systems, motion::JetMaker& jets)
      : model_(systems.model()), systems_(systems), jets_(jets) {}

  /// Limit of the number of contacts for which all combinations are tried; the cost is up to 4^5 jets.
  static constexpr std::size_t max_contacts = 5;

  /// A contact with the states that it may take.
  struct Choice {
    std::size_t contact = 0;
    std::vector<ContactState> states;
  };
  /// States that a participant (a touching contact that is decided with other contacts) may take.
  [[nodiscard]] Choice choice(const Participant& participant) const;
  /// States that any other contact may take. state, before: state and motion of the contact just before the instant.
  [[nodiscard]] Choice choice(std::size_t contact, const ContactState& state,
                              const ContactMotion& before) const;

  struct BestCombination {
    contact::ContactStates contact_states;
    double relative_violation = 0.0;
    double condition = 1.0;  ///< condition() of the contacts with choices
    /// Another consistent combination with different accelerations; empty: there is none.
    contact::ContactStates alternative;
    /// True if there is no alternative and the violation is small enough to be a rounding error.
    [[nodiscard]] bool acceptable() const;
  };
  /// The combination with the smallest violation. Contacts without a choice keep their states in `contact_states`. known:
  /// known signs of guards, one entry per contact. nullopt: there are no choices or too many, or no combination has unique
  /// forces.
  [[nodiscard]] std::optional<BestCombination> best_combination(const Instant& instant,
                                                                const motion::Forcing& forcing,
                                                                const Block& block,
                                                                const std::vector<Choice>& choices,
                                                                const std::vector<KnownGuards>& known,
                                                                const contact::ContactStates& contact_states);

  /// Condition number of W (decide/delassus.hpp) for the constraint forces of these contacts, with these contacts open in the
  /// structure. Spring forces are not constraint forces and are not included. NaN: unknown.
  [[nodiscard]] double condition(const std::vector<std::size_t>& contacts,
                                 contact::ContactStates contact_states);

 private:
  struct Evaluation {
    double relative_violation = 0.0;
    Vector a;
  };
  [[nodiscard]] std::optional<Evaluation> evaluate(const Instant& instant, const motion::Forcing& forcing,
                                                   const Block& block, const std::vector<KnownGuards>& known,
                                                   const contact::ContactStates& contact_states);
  const Model& model_;
  motion::StateSystems& systems_;
  motion::JetMaker& jets_;
};

/// Message about a best combination with an alternative: "several motions continue from this instant: one with 'first'
/// stick, 'second' slip+; another with ...".
[[nodiscard]] std::string several_motions(const Model& model,
                                          const std::vector<StateEnumeration::Choice>& choices,
                                          const StateEnumeration::BestCombination& best);

}  // namespace signorini::decide
