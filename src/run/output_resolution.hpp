// output_resolution.hpp: frequency of the motion in a step that outputs show.
//
//   omega   the lowest rate, to a factor of 2, above which all motion together is rounding of every output
//           (engine/dense_output.hpp):
//             reach_u U + reach_v V + reach_a A + sum |N_k| n_k + |T_k| t_k  <=  threshold
//
// A stiff structure at rest has modes whose oscillations are the rounding of its displacements. Their frequencies are
// thousands of times higher than those of the motion, and their peaks have no meaning. Loads and other histories count
// with their own frequency while they act: a pulse is fast between its ends, and its consequences are not.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "base/curves.hpp"
#include "engine/dense_output.hpp"
#include "run/curve_record.hpp"

namespace signorini::run {

/// Norms of the parts of a linear output on u, v and a: reach_u, reach_v, reach_a.
struct FormNorm {
  double u = 0.0, v = 0.0, a = 0.0;
};
/// Norms of a linear output, from the engine's modes.
[[nodiscard]] FormNorm form_norm_of(const engine::FastModes& modes, const Output& linear);
/// Upper bound of the contribution of a ripple to a linear output.
[[nodiscard]] double fast_mode_contribution(const engine::FastModeBound& ripple, const FormNorm& reach,
                                            const Output& linear, const ForceLayout& layout);

/// Frequencies in a run. All rates are in rad per time.
class FastModeCutoff {
 public:
  /// The model must outlive the object.
  FastModeCutoff(const Model& model, double t_end);

  /// Updates the frequencies after a change of the model's loads.
  void loads_changed();
  /// Rate of structure and loads in a step whose motion advances by this phase angle, in rad
  /// (StepFacts::phase_angle).
  [[nodiscard]] double max_rate(double radians, double begin, double end);
  /// Rate of the motion that outputs show in the step of the last max_rate(): at least that of loads, at most
  /// `all`.
  [[nodiscard]] double output_rate(
      const engine::FastModes& modes, double all,
      const std::function<bool(const engine::FastModeBound&)>& is_rounding) const;
  /// Rate at which the phase advances by so many radians in the whole run.
  [[nodiscard]] double fastest(double radians) const { return radians / t_end_; }

 private:
  const Model& model_;
  double t_end_;
  std::vector<double> changes_;  // times at which the fastest acting load changes, ascending
  std::vector<double> fastest_;  // its rate before the first of these times, and from each of them on
  double load_rate_ = 0.0;       // fastest load in the step, at least 1/t_end
};

// Peaks in time of the largest value of p(x, t): at each time a polynomial in x along a segment of an output.
//
//   f_i(t)   values at the points of the segment, each at the Chebyshev points of the part (curve_record.hpp)
//   bound    of the ends f_0, f_m, plus twice the bound of the distances of the others from the line between them
//   peak     x*(t) is the position of the largest p(., t); p_t(x*(t), t) = 0 with a change from + to -: the largest of
//            several smooth branches has kinks, but none of them is a peak
//
// The smallest value is minus the largest one of -p.

struct ValueBounds {
  double least = 0.0, greatest = 0.0;
};

/// Least and greatest value of one function at its points.
[[nodiscard]] ValueBounds at_points(const Chebyshev::Values& values, std::size_t stride);
/// Bounds that also hold between the points: if p rises at one point and decreases at the next, it is below
/// both tangents.
[[nodiscard]] ValueBounds between_points(const Chebyshev::Values& values, std::size_t stride);

/// Bounds of p on the segment. `between`: the bounds also hold between the Chebyshev points in time.
[[nodiscard]] ValueBounds bounds_along(std::span<const Chebyshev::Values> f, std::size_t stride,
                                       bool between);

/// Times in [-1, 1], between the points, of peaks of p's largest (sign 1) or smallest (-1) value, if the tangents allow
/// a value above (below) `known`.
[[nodiscard]] std::vector<double> peaks_along(std::span<const Chebyshev::Values> f, std::size_t stride,
                                              double sign, double known);

/// Values at the points of the segment at time x.
[[nodiscard]] base::PolynomialInterpolation::Values values_along(std::span<const Chebyshev::Values> f,
                                                                 std::size_t stride, double x);

}  // namespace signorini::run
