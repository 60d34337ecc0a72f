// output_monitor.hpp: outputs during a run: rows, and extremes between them.
//
//   rows      at output times, and on both sides of every event instant
//   extremes  of each step's motion r, in parts of a few periods of the fastest motion:
//             p through r at 5, then 9, then 17 nested Chebyshev points of the part,
//             e = |r - the polynomial of every other point| at the new ones
//             done if p, also between its points, +- 2 e stays within the known extremes;
//             if e is below a fraction of |r|: p' = 0 gives the times, r its values there;
//             otherwise more points, then both halves, until no phase advances by over a radian in a part
//
// An output with segments (an envelope, the extremes of a stress) is evaluated segment by segment, at the
// points of each; the peaks of output_resolution.hpp then replace those of p. The fastest motion is the
// fastest one that outputs show: modes whose oscillations are rounding of every output are left out
// (output_resolution.hpp).
//
// The motion is the engine's own: a closed form in `exact`, the polynomial of the step in `ida`, average
// acceleration in `newmark`. The latter is in equilibrium at the ends of its steps only, so extremes of
// forces and accelerations are taken there. Losses never decrease, so their extremes are at the first and the
// last row.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/curves.hpp"
#include "motion/jet.hpp"
#include "run/audit.hpp"
#include "run/curve_record.hpp"
#include "run/output_resolution.hpp"

namespace signorini::run {

// Value of an output at one instant.
//
//   linear       r = u.u + v.v + a.a + sum_k ( N_k N + T_k T ) + sum_i h_i(t) + constant
//                    + sum_k c_k ( |N| - N_0 ) t.u
//   segments     r = largest |p(x)|, p through the linear outputs at their points (base/curves.hpp);
//                with the largest p, the smallest p, and their positions

struct OutputReading {
  double value = 0.0, greatest = 0.0, least = 0.0;
  OutputPlace at_greatest, at_least;
};

/// Value of a linear output; losses: of all contacts.
[[nodiscard]] double value_of(const Output& output, double t, motion::Side side, const motion::Point& point,
                              const ForceLayout& layout, const std::vector<double>& losses);
/// Value of any output; for one with segments also its extremes and their positions.
[[nodiscard]] OutputReading reading_of(const Output& output, double t, motion::Side side,
                                       const motion::Point& point, const ForceLayout& layout,
                                       const std::vector<double>& losses);
/// Extremes along the i-th segment, with their positions.
[[nodiscard]] OutputReading along_stretch(const Output& output, std::size_t i,
                                          const base::PolynomialInterpolation::Values& values);

/// Sum of the magnitudes of the terms of a linear output: the scale of its rounding error.
[[nodiscard]] double magnitude_of(const Output& output, double t, motion::Side side,
                                  const motion::Point& point, const ForceLayout& layout);

class OutputMonitor {
 public:
  /// Model and recorder must outlive the object, which is inactive if the model has no outputs. dense: forces
  /// and accelerations are in equilibrium with the motion inside a step, not only at its ends.
  OutputMonitor(const Model& model, double t_end, Recorder& recorder, bool dense);

  /// Updates the frequencies after a change of the model's loads.
  void loads_changed() { fast_mode_cutoff_.loads_changed(); }
  [[nodiscard]] bool has_outputs() const { return !model_.outputs.empty(); }
  /// Writes a row, with the losses of all contacts so far; the point must have a = M^-1 (...) if an output needs it.
  void row(double t, motion::Side side, const motion::Point& point, const std::vector<double>& losses);
  /// Keeps the side before an event instant; the following call of `row` writes both sides.
  void before(double t, const motion::Point& point, const std::vector<double>& losses);
  /// Finds extremes inside a step.
  void search_step(engine::DenseOutput& motion, double begin, double end);
  /// Largest |sum of reactions - loads + inertia| of the rows.
  [[nodiscard]] const Extreme& reactions() const { return reactions_; }
  [[nodiscard]] const std::vector<OutputExtremes>& extremes() const { return extremes_; }
  /// Warning if the motion was too fast for a search between all of its turning points.
  [[nodiscard]] const std::optional<std::string>& coarse_warning() const { return coarse_warning_; }

 private:
  /// A function of time with sample points: a linear output, or a segment of another output.
  struct Watched {
    std::size_t output = 0;
    int stretch = -1;                  ///< -1: a linear output
    std::size_t first = 0, count = 1;  ///< in forms_
  };
  struct Part {
    double begin = 0.0, end = 0.0;
    std::vector<char> open;  // watched functions that are not settled in this part
  };

  void evaluate(double t, motion::Side side, const motion::Point& point, const std::vector<double>& losses,
                std::vector<OutputReading>& readings) const;
  void write(double t, const std::vector<OutputReading>& readings);
  void update_extremes(std::size_t output, double t, const OutputReading& reading);
  [[nodiscard]] double turning(engine::DenseOutput& motion, const Part& step);
  [[nodiscard]] bool is_rounding(const engine::FastModeBound& ripple,
                                 const engine::FastModeBound& whole) const;
  void update_from_samples(const Watched& watched, const Part& part, std::size_t stride);
  [[nodiscard]] std::span<const Chebyshev::Values> samples_of(const Watched& watched) const;
  /// Samples a part and closes settled functions; false: none is left.
  [[nodiscard]] bool sample_part(engine::DenseOutput& motion, Part& part, double begin);
  void sample(engine::DenseOutput& motion, const Part& part, double begin, std::size_t point);
  [[nodiscard]] bool settled(const Watched& watched, engine::DenseOutput& motion, const Part& part,
                             std::size_t stride);
  void refine(const Watched& watched, engine::DenseOutput& motion, const Part& part, std::size_t stride);
  void refine_output(const Watched& watched, engine::DenseOutput& motion, const Part& part,
                     std::size_t stride);
  void refine_stretch(const Watched& watched, engine::DenseOutput& motion, const Part& part,
                      std::size_t stride);
  /// Updates extremes with the engine's own values at t.
  void update_from_motion(const Watched& watched, engine::DenseOutput& motion, double t);

  const Model& model_;
  Recorder& recorder_;
  FastModeCutoff fast_mode_cutoff_;
  double radian_ = 0.0;  // duration of a radian of the step's fastest motion, or of a load
  bool dense_;
  bool began_ = false;
  std::vector<OutputExtremes> extremes_;
  std::vector<OutputReading> readings_, before_;
  std::vector<double> last_, none_;
  std::vector<Watched> watched_;
  std::vector<const Output*> forms_;  // linear outputs
  std::vector<double> magnitudes_;    // largest sum of terms of each form so far
  std::vector<FormNorm> form_norms_;  // of each form, once the engine has provided modes
  double last_t_ = 0.0, before_t_ = -1.0;
  std::vector<Chebyshev::Values> samples_;  // one entry per form
  motion::Point point_;
  Extreme reactions_;
  std::optional<std::string> coarse_warning_;
};

}  // namespace signorini::run
