// landing_rates.hpp: derivatives of contact phases (run/landings.hpp) by the parameters.
//
//   impulse_p = sum of DPn at impacts + W_p(end) - W_p(start)       W: integral of -N, along the moving instants
//   peak_p    = -N_p at an extreme of N, or -DN at an instant
#pragma once

#include "sensitivity/tangent_run.hpp"

namespace signorini {

class LandingRecord {
 public:
  /// The model must outlive the object.
  LandingRecord(const Model& model, std::size_t parameters)
      : model_(model), parameters_(parameters), all_(model.contacts.size()), lasts_(all_.size(), false) {}

  void turn(const TangentSample& sample);
  void instant(const InstantMotion& motion, const std::vector<TangentState>& states);
  /// One list per contact, in machine units; open phases end at t. The only values are those of the peak force.
  [[nodiscard]] std::vector<std::vector<MovingLanding>> finish(const std::vector<TangentState>& states) const;

 private:
  struct Stay {
    MovingLanding landing;
    std::vector<double> from;  ///< W_p at its beginning, one per parameter
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
