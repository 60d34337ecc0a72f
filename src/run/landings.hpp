// landings.hpp: what each stay of a contact on its ground brought: when, how hard, how long.
//
//   impulse = sum of Pn at hits + integral of -N dt,   from the instant of closing to that of opening
//
// Forces are never impulses divided by a step: a hit without a stay has an impulse and a peak force of zero.
#pragma once

#include "engine/stepper.hpp"

namespace signorini {

class Landings {
 public:
  explicit Landings(const Model& model)
      : model_(model), ended_(model.contacts.size()), now_(model.contacts.size()) {}

  void begin(double t, const Mode& mode);
  /// Integrals of -N since the last call.
  void add(const Works& works);
  void observe(std::size_t contact, double N);
  void instant(double t, const Decision& decision, const Mode& old_mode);
  /// Closes those that last at t. One list a contact.
  [[nodiscard]] std::vector<std::vector<Landing>> finish(double t, const Mode& mode) const;

 private:
  const Model& model_;
  std::vector<std::vector<Landing>> ended_;  // one list a contact
  std::vector<Landing> now_;                 // one a contact, where it lasts
  std::vector<bool> lasts_;
};

}  // namespace signorini
