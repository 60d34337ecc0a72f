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
// The motion is the engine's own: closed in `exact`, the polynomial of the step in `ida`, average
// acceleration in `newmark`, which is in equilibrium at the ends of its steps only: there stand its extremes of
// forces and accelerations. Losses only grow, so their extremes stand in rows.
#pragma once

#include <vector>

#include "run/audit.hpp"
#include "run/chebyshev.hpp"

namespace signorini {

/// The value of an output; losses: of all contacts.
[[nodiscard]] double value_of(const Output& output, double t, Side side, const Point& point,
                              const std::vector<double>& losses);

class ResponseWatch {
 public:
  /// Both must outlive it. Nothing is done where the model has no outputs.
  /// dense: between the ends of a step, too, forces and accelerations are in equilibrium with the motion.
  ResponseWatch(const Model& model, double t_end, Recorder& recorder, bool dense);

  /// The model's loads are others from here on.
  void loads_changed();
  [[nodiscard]] bool any() const { return !model_.outputs.empty(); }
  /// A row, with the losses of all contacts so far; a = M^-1 (...) must be in the point where any output needs it.
  void row(double t, Side side, const Point& point, const std::vector<double>& losses);
  /// Keeps the side before an instant at which something happens; `row` after it writes both.
  void before(double t, const Point& point, const std::vector<double>& losses);
  /// The inside of a step.
  void inside(Stepper& engine, double begin, double end);
  /// Greatest |sum of reactions - loads + inertia| of the rows.
  [[nodiscard]] const Extreme& reactions() const { return reactions_; }
  [[nodiscard]] const std::vector<OutputExtremes>& extremes() const { return extremes_; }

 private:
  struct Part {
    double begin = 0.0, end = 0.0;
    std::vector<char> open;  // outputs that are not settled there
  };

  void evaluate(double t, Side side, const Point& point, const std::vector<double>& losses,
                std::vector<double>& values) const;
  void write(double t, const std::vector<double>& values);
  void see(std::size_t output, double t, double value);
  /// Closes what is settled; false: nothing is left.
  [[nodiscard]] bool look(Stepper& engine, Part& part, double begin);
  void sample(Stepper& engine, const Part& part, double begin, std::size_t point);
  [[nodiscard]] bool settled(std::size_t output, Stepper& engine, const Part& part, std::size_t stride);
  void sharpen(std::size_t output, Stepper& engine, const Part& part, std::size_t stride);

  const Model& model_;
  Recorder& recorder_;
  double t_end_;
  double radian_ = 0.0;  // of the fastest motion or load
  bool dense_;
  bool began_ = false;
  std::vector<OutputExtremes> extremes_;
  std::vector<double> values_, last_, before_, none_;
  std::vector<double> magnitudes_;  // of the terms of each output, until now
  double last_t_ = 0.0, before_t_ = -1.0;
  std::vector<Chebyshev::Values> samples_;
  Point point_;
  Extreme reactions_;
};

}  // namespace signorini
