// flow_growth.hpp: the growth rate of the motion in a contact state.
//
//   |u_(k+1)| <= W s/(k+1) |u_k|      coefficients of a Taylor series of scale s, for large k, in the norm FlowNorm
//
// The growth rate W of a contact state is computed from twenty levels of a series. On large structures most states differ from
// a known state, with rate W_0, in few compliant contacts. In the norm FlowNorm,
//   W^2 <= W_0^2 + sum over contacts that differ ( kn |M^-1 n| |n| + kt |M^-1 t| |t| + f kn |M^-1 t| |n| )
// The right-hand side is used as W^2 as long as the sum is small, which saves a new series.
#pragma once

#include "contact/contact_states.hpp"
#include "motion/taylor.hpp"
#include "signorini/model.hpp"

namespace signorini::exact {

// A norm of displacement vectors, by which the remainder of a Taylor series is bounded.
//
//   |x|^2 = x^T G x,   G = M + C / W + K_c / W^2,   W the highest circular frequency
//   |n . x| <= sqrt(n^T G^-1 n) |x|
//
// K_c is K with all contact springs, so that G is regular unless the motion is undetermined.

class FlowNorm {
 public:
  explicit FlowNorm(const Model& model);

  [[nodiscard]] double norm(const Eigen::Ref<const Vector>& x);
  /// Greatest |n . x| of contact k for |x| = 1; tangent(): greatest |t . x|.
  [[nodiscard]] double normal(std::size_t k) const { return normal_[k]; }
  [[nodiscard]] double tangent(std::size_t k) const { return tangent_[k]; }

 private:
  SparseMatrix g_;
  std::vector<double> normal_, tangent_;
  Vector product_;
};

/// Limits of the cache of growth rates: number and bytes. Large, because one rate needs a whole series but only a few bytes.
inline constexpr base::CacheLimits max_growth_rates{16384, std::size_t{1} << 20};

class FlowGrowth {
 public:
  static constexpr double margin = 1.25;  ///< safety factor on a growth rate computed from twenty levels

  /// scales: weights that make the degrees of freedom comparable; may be filled later, but before growth_rate() is called. All
  /// arguments except t_end must outlive the object.
  FlowGrowth(const Model& model, motion::Taylor& taylor, FlowNorm& norm, const std::vector<double>& scales,
             double t_end);

  /// Growth rate W of the contact states of `system`, including the margin. Unit: 1/time.
  [[nodiscard]] double growth_rate(const motion::StateSystemPtr& system);

 private:
  [[nodiscard]] double rate_from_series(const motion::StateSystemPtr& system);
  [[nodiscard]] std::optional<double> bound_from_near(const motion::StateSystem& system);
  [[nodiscard]] double stiffening(const motion::StateSystem& system, std::size_t contact);

  const Model& model_;
  motion::Taylor& taylor_;
  FlowNorm& norm_;
  const std::vector<double>& scales_;
  const double fastest_;  // bound on the rates of the structure, used for scaling
  base::LruCache<std::vector<State>, double> known_{max_growth_rates};
  std::vector<State> near_states_;   // last states whose growth rate was computed from a series; empty: none
  double near_rate_ = 0.0;           // growth rate of near_states_
  std::vector<double> stiffenings_;  // one for each contact; negative: unknown
};

}  // namespace signorini::exact
