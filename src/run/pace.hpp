// pace.hpp: how fast the motion of a step turns, as far as outputs show it.
//
//   omega   the least rate, to a factor of 2, above which all motion together is rounding of every output:
//             reach_u U + reach_v V + reach_a A + sum |N_k| n_k + |T_k| t_k  <=  what counts        (engine/ripple.hpp)
//
// A stiff structure at rest has modes whose swings are nothing but the rounding of its displacements. They turn
// thousands of times faster than the motion, and their peaks are nobody's. Loads and their like count as they are, while
// they act: a pulse turns fast between its ends, and what it leaves behind does not.
#pragma once

#include <functional>
#include <vector>

#include "engine/dense_output.hpp"

namespace signorini {

/// Of the parts of a linear output.
struct Reach {
  double u = 0.0, v = 0.0, a = 0.0;
};
[[nodiscard]] Reach reach_of(const FastModes& modes, const Output& linear);
/// What a ripple may add to it.
[[nodiscard]] double added(const Ripple& ripple, const Reach& reach, const Output& linear,
                           const ForceLayout& layout);

/// All rates in rad per time.
class Pace {
 public:
  /// The model must outlive it.
  Pace(const Model& model, double t_end);

  /// The model's loads are others from here on.
  void loads_changed();
  /// Of structure and loads, in a step whose motion turns by so many radians (StepFacts::radians).
  [[nodiscard]] double of_all(double radians, double begin, double end);
  /// In the step that of_all() was asked about. No more than `all`, and no less than loads ask for.
  [[nodiscard]] double of_what_counts(const FastModes& modes, double all,
                                      const std::function<bool(const Ripple&)>& is_rounding) const;
  /// At which a run turns by so many radians.
  [[nodiscard]] double fastest(double radians) const { return radians / t_end_; }

 private:
  const Model& model_;
  double t_end_;
  std::vector<double> changes_;  // times at which the fastest load changes, ascending
  std::vector<double> fastest_;  // before the first of them, from each of them on
  double given_ = 0.0;           // the fastest load of the step, and at least 1/t_end
};

}  // namespace signorini
