// enumeration.hpp: all combinations of the states of a block, and how much rounding each must be forgiven.
//
//   forgiveness of a mode = max over the block's guards of ( -g^(k) / zero^(k) )
//                           where g^(k) is negative and no lower derivative is positive
//
// 0: every guard holds. A mode is acceptable if what must be forgiven is what the condition of the block
// makes of a rounding. For blocks that rounding cannot decide; it costs a jet a combination.
#pragma once

#include <optional>
#include <string>

#include "decide/touching.hpp"

namespace signorini {

class Enumeration {
 public:
  Enumeration(ModeSystems& systems, JetMaker& jets)
      : model_(systems.model()), systems_(systems), jets_(jets) {}

  /// Contacts up to which all combinations are tried: 4^5 jets.
  static constexpr std::size_t most_contacts = 5;

  /// A contact whose state is in question, and the states that it may take.
  struct Choice {
    std::size_t contact = 0;
    std::vector<ContactState> states;
  };
  /// Of a contact that touches and is decided with others.
  [[nodiscard]] Choice choice(const Participant& who) const;
  /// Of any other; before: its state and motion up to the instant.
  [[nodiscard]] Choice choice(std::size_t contact, const ContactState& state,
                              const ContactMotion& before) const;

  struct Best {
    Mode mode;
    double forgiveness = 0.0;
    double condition = 1.0;  ///< of what the chosen contacts' forces do to their accelerations
    Mode rival;              ///< another that holds as well, with other accelerations; empty: there is none
    [[nodiscard]] bool acceptable() const;
  };
  /// All others keep their states in `mode`. known: one a contact. Nothing: there are too many choices, none,
  /// or no combination has unique forces.
  [[nodiscard]] std::optional<Best> least_failing(const Instant& instant, const Forcing& forcing,
                                                  const Block& block, const std::vector<Choice>& choices,
                                                  const std::vector<KnownGuards>& known, const Mode& mode);

  /// Of W of the forces that these contacts can bear, all of them open; those of contact elements follow from
  /// displacements, and have no part in it. NaN: unknown.
  [[nodiscard]] double condition(const std::vector<std::size_t>& contacts, Mode mode);

 private:
  struct Weighed {
    double forgiveness = 0.0;
    Vector a;
  };
  [[nodiscard]] std::optional<Weighed> weigh(const Instant& instant, const Forcing& forcing,
                                             const Block& block, const std::vector<KnownGuards>& known,
                                             const Mode& mode);
  const Model& model_;
  ModeSystems& systems_;
  JetMaker& jets_;
};

/// "several motions continue this one, as 'first' stick, 'second' slip+ and as ...": of a best that has a rival.
[[nodiscard]] std::string several_motions(const Model& model, const std::vector<Enumeration::Choice>& choices,
                                          const Enumeration::Best& best);

}  // namespace signorini
