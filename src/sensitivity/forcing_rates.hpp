// forcing_rates.hpp: what a parameter makes of everything that acts, on one side of an instant.
//
//   P_p = sum_i ( d_i,p f_i + d_i f_i,p ),   q_p, s_p: compressions and motions of surfaces, as series in
//   time tau_p: of the instants at which the forcing is not smooth
#pragma once

#include "motion/forcing.hpp"
#include "sensitivity/history_rates.hpp"

namespace signorini {

/// As ForcingSeries: rows of `count` coefficients, one a contact; columns of `load`.
struct ForcingRatesSeries {
  std::size_t count = 0;
  bool loaded = false;   ///< load is not zero
  Eigen::MatrixXd load;  ///< n x count
  std::vector<double> pressing, surface;
};

class ForcingRates {
 public:
  /// Of the pieces in force on the side of t. Both must outlive it.
  ForcingRates(const Model& model, const ModelDerivative& derivative, double t, Side side);

  void expand(double t, double scale, std::size_t count, ForcingRatesSeries& out) const;

 private:
  struct Part {
    const Piece* piece = nullptr;
    const Piece* rates = nullptr;  ///< null: it does not change
  };
  const Model* model_;
  const ModelDerivative* derivative_;
  std::vector<Part> loads_, pressing_, surface_;
};

/// A breakpoint that moves.
struct MovingBreakpoint {
  double time = 0.0, rate = 0.0;
  int load = -1;  ///< index into Model::loads; -1: of a contact
};
/// Those of all histories within `resolution` of t at which something changes.
[[nodiscard]] std::vector<MovingBreakpoint> breakpoints_at(const Model& model,
                                                           const ModelDerivative& derivative, double t,
                                                           double resolution);

}  // namespace signorini
