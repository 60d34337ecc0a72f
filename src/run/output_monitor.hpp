// output_monitor.hpp: values of outputs during a run: rows, and extremes between rows.
//
//   rows      at output times, and on both sides of every event instant
//   extremes  of the output r(t); each step is divided into parts of a few periods of the fastest motion:
//             p: polynomial through r at 5, then 9, then 17 nested Chebyshev points of the part
//             e = |r - polynomial through every other point|, at the new points
//             the part is done if p +- 2 e, also between the points, stays within the known extremes;
//             if e is small relative to |r|, p' = 0 gives the times of extremes, and r at these times their values;
//             otherwise more points are taken, then the part is halved, until it is shorter than a radian
//
// An output with segments (an envelope, the extremes of a stress) is evaluated at the points of each segment;
// output_resolution.hpp then finds its peaks. The fastest motion excludes modes whose oscillations are only rounding in
// every output (output_resolution.hpp).
//
// The motion within a step is that of the engine: a closed form in `exact`, the polynomial of the step in `ida`, average
// acceleration in `newmark`. The motion of `newmark` is in equilibrium only at the ends of steps, so extremes of forces
// and accelerations are taken there. Losses never decrease, so their extremes are in the first and the last row.
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

/// Value of a linear output. losses: energy dissipated by friction, one entry per contact.
[[nodiscard]] double value_of(const Output& output, double t, motion::Side side, const motion::Point& point,
                              const ForceLayout& layout, const std::vector<double>& losses);
/// Value of any output; for an output with segments, also its extremes over all segments and their positions.
[[nodiscard]] OutputReading reading_of(const Output& output, double t, motion::Side side,
                                       const motion::Point& point, const ForceLayout& layout,
                                       const std::vector<double>& losses);
/// Extremes along the i-th segment, with their positions. values: the output at the points of the segment.
[[nodiscard]] OutputReading along_stretch(const Output& output, std::size_t i,
                                          const base::PolynomialInterpolation::Values& values);

/// Sum of the magnitudes of the terms of a linear output: the scale of its rounding error.
[[nodiscard]] double magnitude_of(const Output& output, double t, motion::Side side,
                                  const motion::Point& point, const ForceLayout& layout);

class OutputMonitor {
 public:
  /// Model and recorder must outlive the object, which does nothing if the model has no outputs. dense: forces and
  /// accelerations are in equilibrium with the motion inside a step, not only at its ends.
  OutputMonitor(const Model& model, double t_end, Recorder& recorder, bool dense);

  /// Updates the frequencies after a change of the model's loads.
  void loads_changed() { fast_mode_cutoff_.loads_changed(); }
  [[nodiscard]] bool has_outputs() const { return !model_.outputs.empty(); }
  /// Writes a row. losses: energy dissipated by friction since t = 0, one entry per contact. The point must contain the
  /// accelerations if an output needs them.
  void row(double t, motion::Side side, const motion::Point& point, const std::vector<double>& losses);
  /// Keeps the values just before an event instant; the following call of row() writes both sides.
  void before(double t, const motion::Point& point, const std::vector<double>& losses);
  /// Finds extremes inside a step.
  void search_step(engine::DenseOutput& motion, double begin, double end);
  /// Largest |sum of reactions - loads + inertia| of all rows, a force.
  [[nodiscard]] const Extreme& reactions() const { return reactions_; }
  [[nodiscard]] const std::vector<OutputExtremes>& extremes() const { return extremes_; }
  /// Warning if the motion has more turning points than the search could resolve; nullopt: no warning.
  [[nodiscard]] const std::optional<std::string>& coarse_warning() const { return coarse_warning_; }

 private:
  /// A function of time with sample points: a linear output, or a segment of another output.
  struct Watched {
    std::size_t output = 0;
    int stretch = -1;                  ///< index of the segment; -1: a linear output
    std::size_t first = 0, count = 1;  ///< range of indices in forms_
  };
  struct Part {
    double begin = 0.0, end = 0.0;
    std::vector<char> open;  // for each watched function: its extremes in this part are not settled yet
  };

  void evaluate(double t, motion::Side side, const motion::Point& point, const std::vector<double>& losses,
                std::vector<OutputReading>& readings) const;
  void write(double t, const std::vector<OutputReading>& readings);
  void update_extremes(std::size_t output, double t, const OutputReading& reading);
  [[nodiscard]] double turning(engine::DenseOutput& motion, const Part& step);
  [[nodiscard]] bool is_rounding(const engine::FastModeBound& fast_bound,
                                 const engine::FastModeBound& whole) const;
  void update_from_samples(const Watched& watched, const Part& part, std::size_t stride);
  [[nodiscard]] std::span<const Chebyshev::Values> samples_of(const Watched& watched) const;
  /// Samples a part and marks settled functions. Returns true if some function is not settled: the part is then halved.
  [[nodiscard]] bool sample_part(engine::DenseOutput& motion, Part& part, double begin);
  void sample(engine::DenseOutput& motion, const Part& part, double begin, std::size_t point);
  [[nodiscard]] bool settled(const Watched& watched, engine::DenseOutput& motion, const Part& part,
                             std::size_t stride);
  void refine(const Watched& watched, engine::DenseOutput& motion, const Part& part, std::size_t stride);
  void refine_output(const Watched& watched, engine::DenseOutput& motion, const Part& part,
                     std::size_t stride);
  void refine_stretch(const Watched& watched, engine::DenseOutput& motion, const Part& part,
                      std::size_t stride);
  /// Updates extremes with the output of the engine's motion at t.
  void update_from_motion(const Watched& watched, engine::DenseOutput& motion, double t);

  const Model& model_;
  Recorder& recorder_;
  FastModeCutoff fast_mode_cutoff_;
  double radian_ = 0.0;  // time in which the fastest motion or load of the step advances by one radian
  bool dense_;
  bool began_ = false;
  std::vector<OutputExtremes> extremes_;
  std::vector<OutputReading> readings_, before_;
  std::vector<double> last_, none_;
  std::vector<Watched> watched_;
  std::vector<const Output*> forms_;  // linear outputs
  std::vector<double> magnitudes_;    // for each form: largest magnitude_of() so far
  std::vector<FormNorm> form_norms_;  // one entry per form; empty until the engine has provided modes
  double last_t_ = 0.0, before_t_ = -1.0;
  std::vector<Chebyshev::Values> samples_;  // one entry per form
  motion::Point point_;
  Extreme reactions_;
  std::optional<std::string> coarse_warning_;
};

}  // namespace signorini::run
