// response.hpp: the outputs while a run goes on: rows, and extremes between them.
//
//   rows      at output times, and on both sides of every instant at which something happens
//   extremes  of each step's motion r, in parts of a few periods of the fastest motion:
//             p through r at 5, then 9, then 17 nested Chebyshev points of the part,
//             e = |r - the polynomial of every other point| at the new ones
//             nothing to find where p, between its points too, +- 2 e stays within what was seen;
//             e below a part of |r|: p' = 0 gives the times, r its values there;
//             else more points, else both halves, until no motion turns by more than a radian in a part
//
// An output with stretches (an envelope, the extremes of a stress) is followed stretch by stretch, at the points of each:
// stretch_peaks.hpp in place of p and p'.
// The fastest motion is that of what outputs show: modes whose swings are rounding of every output have no part in it
// (pace.hpp).
//
// The motion is the engine's own: closed in `exact`, the polynomial of the step in `ida`, average
// acceleration in `newmark`, which is in equilibrium at the ends of its steps only: there stand its extremes of
// forces and accelerations. Losses only grow, so their extremes stand in rows.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "run/chebyshev.hpp"
#include "run/output_value.hpp"
#include "run/pace.hpp"

namespace signorini {

class ResponseWatch {
 public:
  /// Both must outlive it. Nothing is done where the model has no outputs.
  /// dense: between the ends of a step, too, forces and accelerations are in equilibrium with the motion.
  ResponseWatch(const Model& model, double t_end, Recorder& recorder, bool dense);

  /// The model's loads are others from here on.
  void loads_changed() { pace_.loads_changed(); }
  [[nodiscard]] bool any() const { return !model_.outputs.empty(); }
  /// A row, with the losses of all contacts so far; a = M^-1 (...) must be in the point where any output needs it.
  void row(double t, Side side, const Point& point, const std::vector<double>& losses);
  /// Keeps the side before an instant at which something happens; `row` after it writes both.
  void before(double t, const Point& point, const std::vector<double>& losses);
  /// The inside of a step.
  void inside(DenseOutput& motion, double begin, double end);
  /// Greatest |sum of reactions - loads + inertia| of the rows.
  [[nodiscard]] const Extreme& reactions() const { return reactions_; }
  [[nodiscard]] const std::vector<OutputExtremes>& extremes() const { return extremes_; }
  /// The motion was too fast for a search between all of its turns: the sentence that says so.
  [[nodiscard]] const std::optional<std::string>& coarse() const { return coarse_; }

 private:
  /// What has points in time of its own: a linear output, or a stretch of another.
  struct Watched {
    std::size_t output = 0;
    int stretch = -1;                  ///< -1: a linear output
    std::size_t first = 0, count = 1;  ///< in forms_
  };
  struct Part {
    double begin = 0.0, end = 0.0;
    std::vector<char> open;  // what is watched and not settled there
  };

  void evaluate(double t, Side side, const Point& point, const std::vector<double>& losses,
                std::vector<OutputReading>& readings) const;
  void write(double t, const std::vector<OutputReading>& readings);
  void see(std::size_t output, double t, const OutputReading& reading);
  [[nodiscard]] double turning(DenseOutput& motion, const Part& step);
  [[nodiscard]] bool is_rounding(const Ripple& ripple, const Ripple& whole) const;
  void see_samples(const Watched& watched, const Part& part, std::size_t stride);
  [[nodiscard]] std::span<const Chebyshev::Values> samples_of(const Watched& watched) const;
  /// Closes what is settled; false: nothing is left.
  [[nodiscard]] bool look(DenseOutput& motion, Part& part, double begin);
  void sample(DenseOutput& motion, const Part& part, double begin, std::size_t point);
  [[nodiscard]] bool settled(const Watched& watched, DenseOutput& motion, const Part& part,
                             std::size_t stride);
  void sharpen(const Watched& watched, DenseOutput& motion, const Part& part, std::size_t stride);
  void sharpen_output(const Watched& watched, DenseOutput& motion, const Part& part, std::size_t stride);
  void sharpen_stretch(const Watched& watched, DenseOutput& motion, const Part& part, std::size_t stride);
  /// The engine's own values there.
  void see_motion(const Watched& watched, DenseOutput& motion, double t);

  const Model& model_;
  Recorder& recorder_;
  Pace pace_;
  double radian_ = 0.0;  // of the step's fastest motion, or of a load
  bool dense_;
  bool began_ = false;
  std::vector<OutputExtremes> extremes_;
  std::vector<OutputReading> readings_, before_;
  std::vector<double> last_, none_;
  std::vector<Watched> watched_;
  std::vector<const Output*> forms_;  // linear ones
  std::vector<double> magnitudes_;    // of the terms of each form, until now
  std::vector<Reach> reaches_;        // of each form, once an engine has told them
  double last_t_ = 0.0, before_t_ = -1.0;
  std::vector<Chebyshev::Values> samples_;  // of each form
  Point point_;
  Extreme reactions_;
  std::optional<std::string> coarse_;
};

}  // namespace signorini
