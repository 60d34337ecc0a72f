// landings.hpp: time, impulse, peak force and duration of every closure of a contact.
//
//   impulse = sum of Pn at hits + integral of -N dt,   from the instant of closing to that of opening
//
// Forces are never impulses divided by a step: a hit without a closure has an impulse and a peak force of zero.
#pragma once

#include "engine/stepper.hpp"

namespace signorini {

class Landings {
 public:
  explicit Landings(const Model& model)
      : model_(model), ended_(model.contacts.size()), now_(model.contacts.size()) {}

  void begin(double t, const Mode& mode);
  /// Adds the integrals of -N since the last call.
  void add(const Works& works);
  void observe(std::size_t contact, double N);
  void instant(double t, const Decision& decision, const Mode& old_mode);
  /// Ends the landings that last at t. One list per contact.
  [[nodiscard]] std::vector<std::vector<Landing>> finish(double t, const Mode& mode) const;

 private:
  const Model& model_;
  std::vector<std::vector<Landing>> ended_;  // one list per contact
  std::vector<Landing> now_;                 // one entry per contact; valid while its landing lasts
  std::vector<bool> lasts_;
};

}  // namespace signorini
