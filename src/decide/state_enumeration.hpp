// state_enumeration.hpp: tries all combinations of the states of a block, and rates their violations in units of rounding.
//
//   forgiveness of a combination of states = max over the block's guards of ( -g^(k) / zero^(k) )
//                           where g^(k) is negative and no lower derivative is positive
//
// 0: every guard holds. A combination is acceptable if its forgiveness does not exceed the condition number of the
// block. Used for blocks that rounding leaves undecided; it costs one jet per combination.
#pragma once

#include <optional>
#include <string>

#include "decide/rigid_contact_solver.hpp"

namespace signorini::decide {

class StateEnumeration {
 public:
  StateEnumeration(motion::StateSystems& systems, motion::JetMaker& jets)
      : model_(systems.model()), systems_(systems), jets_(jets) {}

  /// Largest number of contacts for which all combinations are tried: 4^5 jets.
  static constexpr std::size_t max_contacts = 5;

  /// A contact in question, and the states that it may take.
  struct Choice {
    std::size_t contact = 0;
    std::vector<ContactState> states;
  };
  /// Choice for a contact that touches and is decided with others.
  [[nodiscard]] Choice choice(const Participant& participant) const;
  /// Choice for any other contact, from its state and its motion `before`, up to the instant.
  [[nodiscard]] Choice choice(std::size_t contact, const ContactState& state,
                              const ContactMotion& before) const;

  struct BestCombination {
    contact::ContactStates contact_states;
    double relative_violation = 0.0;
    double condition = 1.0;  ///< condition number of the chosen contacts' accelerations by their own forces
    contact::ContactStates
        alternative;  ///< another consistent combination with other accelerations; empty: none
    [[nodiscard]] bool acceptable() const;
  };
  /// Best combination; other contacts keep their states in `states`. known: one entry per contact. nullopt: there are
  /// no choices or too many, or no combination has unique forces.
  [[nodiscard]] std::optional<BestCombination> best_combination(const Instant& instant,
                                                                const motion::Forcing& forcing,
                                                                const Block& block,
                                                                const std::vector<Choice>& choices,
                                                                const std::vector<KnownGuards>& known,
                                                                const contact::ContactStates& contact_states);

  /// Condition number of W for the forces that these contacts can bear, all of them open; forces of contact elements
  /// follow from displacements and are not included. NaN: unknown.
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

/// Sentence about a best combination that has a rival: "several motions continue this one, as 'first' stick, 'second'
/// slip+ and as ...".
[[nodiscard]] std::string several_motions(const Model& model,
                                          const std::vector<StateEnumeration::Choice>& choices,
                                          const StateEnumeration::BestCombination& best);

}  // namespace signorini::decide
