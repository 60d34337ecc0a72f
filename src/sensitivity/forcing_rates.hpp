// forcing_rates.hpp: derivatives with respect to a parameter of the forcing on one side of an instant.
//
//   P_p = sum_i ( d_i,p f_i + d_i f_i,p )     loads, as series in time
//   q_p, s_p                                  normal forces and surface motions, as series in time
//   tau_p                                     breakpoints of the forcing
#pragma once

#include <vector>

#include "motion/forcing.hpp"
#include "sensitivity/model_derivative.hpp"

namespace signorini::sensitivity {

// Derivative of a history's piece with respect to a parameter, as a series in time.
//
//   f = sum c_j s^j + a sin(w s + phi),   s = t - t0
//   f_p = sum c_j,p s^j - t0,p f' + a_p sin(w s + phi) + a cos(w s + phi) (w_p s + phi_p)

/// out[k] += factor scale^k / k! (d/dt)^k f_p(t) for 0 <= k < count.
void add_rate_series(const Piece& piece, const Piece& rates, double t, double scale, std::size_t count,
                     double factor, double* out);

/// Derivatives of the forcing, stored like ForcingSeries: rows of `count` coefficients, one row per contact; `load` by columns.
struct ForcingDerivatives {
  std::size_t count = 0;
  bool loaded = false;   ///< false: `load` is zero
  Eigen::MatrixXd load;  ///< n x count
  std::vector<double> applied_normal_force, surface;
};

class ForcingRates {
 public:
  /// Takes the pieces that are valid on the given side of t. Both arguments must outlive the object.
  ForcingRates(const Model& model, const ModelDerivative& derivative, double t, motion::Side side);

  /// Computes series with `count` coefficients about t, in powers of (time - t)/scale.
  void expand(double t, double scale, std::size_t count, ForcingDerivatives& out) const;

 private:
  struct Part {
    const Piece* piece = nullptr;
    const Piece* rates = nullptr;  ///< nullptr: the piece does not depend on the parameter
  };
  const Model* model_;
  const ModelDerivative* derivative_;
  std::vector<Part> loads_, applied_normal_force_, surface_;
};

/// A breakpoint at `time`; rate: its derivative with respect to the parameter.
struct MovingBreakpoint {
  double time = 0.0, rate = 0.0;
  int load = -1;  ///< index into Model::loads; -1: a contact's history
};
/// All breakpoints of histories within `resolution` of t; those that do not move have the rate 0.
[[nodiscard]] std::vector<MovingBreakpoint> breakpoints_at(const Model& model,
                                                           const ModelDerivative& derivative, double t,
                                                           double resolution);

}  // namespace signorini::sensitivity
