// enumeration.hpp: all combinations of the states of a block, weighed by how much of rounding must be
// forgiven.
//
//   forgiveness of a mode = max over its guards of ( -g^(k) / zero^(k) )     where g^(k) is negative and no
//                                                                            lower derivative is positive
//
// 0: every guard holds. A mode is acceptable if what must be forgiven is what the condition of the block
// makes of a rounding. For blocks that rounding cannot decide; it costs a jet a combination.
#pragma once

#include <optional>

#include "decide/touching.hpp"

namespace signorini {

class Enumeration {
 public:
  Enumeration(ModeSystems& systems, JetMaker& jets)
      : model_(systems.model()), systems_(systems), jets_(jets) {}

  /// Contacts up to which all combinations are tried.
  static constexpr std::size_t most_contacts = 5;

  struct Best {
    Mode mode;
    double forgiveness = 0.0, condition = 1.0;
    [[nodiscard]] bool acceptable() const;
  };
  /// Of the block's participants; all others keep their states. Nothing: there are too many, or none.
  [[nodiscard]] std::optional<Best> least_failing(const Instant& instant, const Forcing& forcing,
                                                  const Block& block, const Mode& mode);

 private:
  [[nodiscard]] std::vector<State> choices(const Participant& who) const;
  [[nodiscard]] std::optional<double> forgiveness_of(const Instant& instant, const Forcing& forcing,
                                                     const Block& block, const Mode& mode);
  [[nodiscard]] double condition(const Block& block, Mode mode);

  const Model& model_;
  ModeSystems& systems_;
  JetMaker& jets_;
};

}  // namespace signorini
