// output_resolution.hpp: highest frequency that outputs show in a step.
//
//   omega   the lowest rate, to a factor of 2, such that all faster motion together is rounding in every output
//           (U, V, A, n_k, t_k: bounds of this motion, engine/dense_output.hpp):
//             reach_u U + reach_v V + reach_a A + sum |N_k| n_k + |T_k| t_k  <=  threshold
//
// A stiff structure at rest has modes whose oscillations are only rounding of its displacements. Their frequencies are
// thousands of times higher than those of the motion, and their peaks have no meaning. Loads and other histories are
// included with their own frequency while they act.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "base/curves.hpp"
#include "engine/dense_output.hpp"
#include "run/curve_record.hpp"

namespace signorini::run {

/// Norms reach_u, reach_v, reach_a of the coefficients of u, v and a in a linear output.
struct FormNorm {
  double u = 0.0, v = 0.0, a = 0.0;
};
/// Norms of a linear output, computed with the engine's modes.
[[nodiscard]] FormNorm form_norm_of(const engine::FastModes& modes, const Output& linear);
/// Upper bound of the contribution of fast motion (`fast_bound`) to a linear output, in the output's unit.
[[nodiscard]] double fast_mode_contribution(const engine::FastModeBound& fast_bound, const FormNorm& reach,
                                            const Output& linear, const ForceLayout& layout);

/// Highest frequencies of motion and loads in the steps of a run. All rates are in rad per time.
class FastModeCutoff {
 public:
  /// The model must outlive the object.
  FastModeCutoff(const Model& model, double t_end);

  /// Updates the frequencies after a change of the model's loads.
  void loads_changed();
  /// Highest rate of structure and loads in the step. radians: phase angle by which the fastest motion advances in the
  /// step (StepFacts::phase_angle).
  [[nodiscard]] double max_rate(double radians, double begin, double end);
  /// Highest rate that is visible in any output, for the step of the last call of max_rate(). The result lies between the
  /// rate of the loads and `all`. is_rounding(bound): true if motion within `bound` is rounding error in every output.
  [[nodiscard]] double output_rate(
      const engine::FastModes& modes, double all,
      const std::function<bool(const engine::FastModeBound&)>& is_rounding) const;
  /// Rate at which a phase advances by `radians` in the whole run.
  [[nodiscard]] double fastest(double radians) const { return radians / t_end_; }

 private:
  const Model& model_;
  double t_end_;
  std::vector<double> changes_;  // times at which the fastest acting load changes, ascending
  std::vector<double> fastest_;  // rate of that load: [0] before changes_[0], [i + 1] from changes_[i] on
  double load_rate_ = 0.0;       // rate of the fastest load in the step, at least 1/t_end
};

// Peaks in time of the largest value of p(x, t), which is, at each time, a polynomial in x along a segment of an output.
//
//   f_i(t)   values at the points of the segment, given at the Chebyshev points of the part (curve_record.hpp)
//   bound    the bound of the end values f_0, f_m, plus the Lebesgue constant times the largest distance of the other f_i
//            from the straight line between f_0 and f_m
//   peak     p_t(x*(t), t) = 0 with a change from + to -; x*(t): position of the largest p(., t). The largest of several
//            smooth branches has kinks, but a kink is never a peak
//
// The smallest value of p is minus the largest value of -p.

struct ValueBounds {
  double least = 0.0, greatest = 0.0;
};

/// Least and greatest value of one function at the points of the stride.
[[nodiscard]] ValueBounds at_points(const Chebyshev::Values& values, std::size_t stride);
/// Bounds that are also valid between the points: if p increases at one point and decreases at the next, p is assumed to
/// lie below both tangents.
[[nodiscard]] ValueBounds between_points(const Chebyshev::Values& values, std::size_t stride);

/// Bounds of p on the segment. between: the bounds are also valid between the Chebyshev points in time.
[[nodiscard]] ValueBounds bounds_along(std::span<const Chebyshev::Values> f, std::size_t stride,
                                       bool between);

/// Times in [-1, 1] of peaks of the largest (sign 1) or smallest (sign -1) value of p. Peaks are omitted if the tangents
/// show that they do not exceed (sign -1: do not go below) `known`.
[[nodiscard]] std::vector<double> peaks_along(std::span<const Chebyshev::Values> f, std::size_t stride,
                                              double sign, double known);

/// Values at the points of the segment at the time x in [-1, 1].
[[nodiscard]] base::PolynomialInterpolation::Values values_along(std::span<const Chebyshev::Values> f,
                                                                 std::size_t stride, double x);

}  // namespace signorini::run
