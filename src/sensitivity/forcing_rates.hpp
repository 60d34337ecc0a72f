// forcing_rates.hpp: derivatives of the forcing, on one side of an instant, and of the static start by a
// parameter.
//
//   P_p = sum_i ( d_i,p f_i + d_i f_i,p )     loads, as series in time
//   q_p, s_p                                  normal forces and surface motions, as series in time
//   tau_p                                     instants at which the forcing is not smooth
#pragma once

#include <optional>

#include "motion/forcing.hpp"
#include "sensitivity/model_derivative.hpp"

namespace signorini::sensitivity {

// Derivative of a history's piece by a parameter, as a series in time.
//
//   f = sum c_j s^j + a sin(w s + phi),   s = t - t0
//   f_p = sum c_j,p s^j - t0,p f' + a_p sin(w s + phi) + a cos(w s + phi) (w_p s + phi_p)

/// out[k] += factor scale^k / k! (d/dt)^k f_p at t, 0 <= k < count.
void add_rate_series(const Piece& piece, const Piece& rates, double t, double scale, std::size_t count,
                     double factor, double* out);

/// Same layout as ForcingSeries: rows of `count` coefficients, one per contact; columns of `load`.
struct ForcingRatesSeries {
  std::size_t count = 0;
  bool loaded = false;   ///< load is not zero
  Eigen::MatrixXd load;  ///< n x count
  std::vector<double> applied_normal_force, surface;
};

class ForcingRates {
 public:
  /// Uses the pieces in force on the given side of t. Both arguments must outlive the object.
  ForcingRates(const Model& model, const ModelDerivative& derivative, double t, motion::Side side);

  /// Series of `count` coefficients around t, in (time - t)/scale.
  void expand(double t, double scale, std::size_t count, ForcingRatesSeries& out) const;

 private:
  struct Part {
    const Piece* piece = nullptr;
    const Piece* rates = nullptr;  ///< null: no change
  };
  const Model* model_;
  const ModelDerivative* derivative_;
  std::vector<Part> loads_, applied_normal_force_, surface_;
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

// Derivative of the static start by a parameter.
//
//   (K + sum_closed kn n n^T) w = P_p - K_p u0 - sum_closed ( n_p N + n N_p ),   N_p = kn_p g + kn (g0_p + n_p . u0)
//   rigid contacts: K w + sum n N_p = P_p - K_p u0 - sum n_p N,   n . w = -g0_p - n_p . u0
//   t_h . w = -t_h,p . u0 at contacts that hold a free motion
//
// A difference of two equilibria has the rounding of their solves divided by the step; this derivative has
// the rounding of one solve.

/// w for a model with a frictionless static start; nullopt if the matrix remains singular.
[[nodiscard]] std::optional<Vector> static_rate(const Model& model, const ModelDerivative& derivative);

}  // namespace signorini::sensitivity
