// pace.hpp: frequency of the motion in a step that outputs show.
//
//   omega   the lowest rate, to a factor of 2, above which all motion together is rounding of every output:
//             reach_u U + reach_v V + reach_a A + sum |N_k| n_k + |T_k| t_k  <=  threshold        (engine/ripple.hpp)
//
// A stiff structure at rest has modes whose oscillations are the rounding of its displacements. Their frequencies are
// thousands of times higher than those of the motion, and their peaks have no meaning. Loads and other histories count
// with their own frequency while they act: a pulse is fast between its ends, and its consequences are not.
#pragma once

#include <functional>
#include <vector>

#include "engine/dense_output.hpp"

namespace signorini {

/// Norms of the parts of a linear output.
struct Reach {
  double u = 0.0, v = 0.0, a = 0.0;
};
[[nodiscard]] Reach reach_of(const FastModes& modes, const Output& linear);
/// Upper bound of the contribution of a ripple to a linear output.
[[nodiscard]] double added(const Ripple& ripple, const Reach& reach, const Output& linear,
                           const ForceLayout& layout);

/// Frequencies in a run. All rates are in rad per time.
class Pace {
 public:
  /// The model must outlive the object.
  Pace(const Model& model, double t_end);

  /// Updates the frequencies after a change of the model's loads.
  void loads_changed();
  /// Rate of structure and loads, in a step whose motion turns by so many radians (StepFacts::radians).
  [[nodiscard]] double of_all(double radians, double begin, double end);
  /// Rate that outputs show, in the step of the last of_all(): at most `all`, and at least that of loads.
  [[nodiscard]] double of_what_counts(const FastModes& modes, double all,
                                      const std::function<bool(const Ripple&)>& is_rounding) const;
  /// Rate at which the phase advances by so many radians in the whole run.
  [[nodiscard]] double fastest(double radians) const { return radians / t_end_; }

 private:
  const Model& model_;
  double t_end_;
  std::vector<double> changes_;  // times at which the fastest acting load changes, ascending
  std::vector<double> fastest_;  // its rate before the first of these times, and from each of them on
  double given_ = 0.0;           // fastest load in the step, at least 1/t_end
};

}  // namespace signorini
