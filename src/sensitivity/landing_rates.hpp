// landing_rates.hpp: how each stay of a contact on its ground moves with the parameters: run/landings.hpp.
//
//   impulse_p = sum of DPn at hits + W_p(end) - W_p(start)       W: integral of -N, along the moving instants
//   peak_p    = -N_p where N turns, or -DN at an instant
#pragma once

#include "sensitivity/tangent_run.hpp"

namespace signorini {

class LandingRecord {
 public:
  /// The model must outlive it.
  LandingRecord(const Model& model, std::size_t parameters)
      : model_(model), parameters_(parameters), all_(model.contacts.size()), lasts_(all_.size(), false) {}

  void turn(const TangentSample& sample);
  void instant(const InstantMotion& motion, const std::vector<TangentState>& states);
  /// One list a contact, machine's units; those that last end at t. Their values: of the peak force only.
  [[nodiscard]] std::vector<std::vector<MovingLanding>> finish(const std::vector<TangentState>& states) const;

 private:
  struct Stay {
    MovingLanding landing;
    std::vector<double> from;  ///< W_p where it began, one a parameter
  };
  void begin(std::size_t contact, const std::vector<double>& start, const std::vector<TangentState>& states);
  void offer(std::size_t contact, double force, const std::vector<double>& rates);

  const Model& model_;
  std::size_t parameters_;
  std::vector<std::vector<Stay>> all_;
  std::vector<bool> lasts_;
  bool begun_ = false;
};

}  // namespace signorini
