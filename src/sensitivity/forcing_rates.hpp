// forcing_rates.hpp: derivatives of the forcing by a parameter, on one side of an instant.
//
//   P_p = sum_i ( d_i,p f_i + d_i f_i,p ),   q_p, s_p: of normal forces and surface motions, as series in
//   time tau_p: of the instants at which the forcing is not smooth
#pragma once

#include "motion/forcing.hpp"
#include "sensitivity/history_rates.hpp"

namespace signorini {

/// Same layout as ForcingSeries: rows of `count` coefficients, one per contact; columns of `load`.
struct ForcingRatesSeries {
  std::size_t count = 0;
  bool loaded = false;   ///< load is not zero
  Eigen::MatrixXd load;  ///< n x count
  std::vector<double> pressing, surface;
};

class ForcingRates {
 public:
  /// Uses the pieces in force on the given side of t. Both arguments must outlive the object.
  ForcingRates(const Model& model, const ModelDerivative& derivative, double t, Side side);

  void expand(double t, double scale, std::size_t count, ForcingRatesSeries& out) const;

 private:
  struct Part {
    const Piece* piece = nullptr;
    const Piece* rates = nullptr;  ///< null: no change
  };
  const Model* model_;
  const ModelDerivative* derivative_;
  std::vector<Part> loads_, pressing_, surface_;
};

/// A breakpoint that depends on the parameter.
struct MovingBreakpoint {
  double time = 0.0, rate = 0.0;
  int load = -1;  ///< index into Model::loads; -1: a contact's history
};
/// Moving breakpoints of all histories within `resolution` of t.
[[nodiscard]] std::vector<MovingBreakpoint> breakpoints_at(const Model& model,
                                                           const ModelDerivative& derivative, double t,
                                                           double resolution);

}  // namespace signorini
