// response.hpp: the outputs while a run goes on: rows, and extremes between them.
//
//   rows      at output times, and on both sides of every instant at which something happens
//   extremes  of each step's motion: p through r at nine Chebyshev points of a part of the step,
//             e = |p of five of them - r| at the other four
//             nothing to find where p +- 2 e stays within what was seen;  else p' = 0, where e is
//             below 1e-8 |r|, so that p is good to rounding (e of degree 4: O(h^5), of degree 8: O(h^9));
//             else both halves, until no motion turns by more than one radian in a part
//
// The motion is the engine's own: closed in `exact`, the polynomial of the step in `ida`, average
// acceleration in `newmark`. Losses only grow, so their extremes stand in rows.
#pragma once

#include <array>
#include <vector>

#include "run/audit.hpp"

namespace signorini {

/// The value of an output; losses: of all contacts.
[[nodiscard]] double value_of(const Output& output, double t, Side side, const Point& point,
                              const std::vector<double>& losses);

class ResponseWatch {
 public:
  /// Both must outlive it. Nothing is done where the model has no outputs.
  ResponseWatch(const Model& model, double t_end, Recorder& recorder);

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
  static constexpr std::size_t points = 9;
  using Values = std::array<double, points>;
  struct Part {
    double begin = 0.0, end = 0.0;
  };

  void evaluate(double t, Side side, const Point& point, const std::vector<double>& losses,
                std::vector<double>& values) const;
  void write(double t, const std::vector<double>& values);
  void see(std::size_t output, double t, double value);
  /// True: a part must be halved.
  [[nodiscard]] bool look(Stepper& engine, const Part& part, double begin);
  [[nodiscard]] bool look_at(std::size_t output, Stepper& engine, const Part& part, const Values& values);
  void sharpen(std::size_t output, Stepper& engine, const Part& part, const Values& values);

  const Model& model_;
  Recorder& recorder_;
  double shortest_;  // part: one radian of the fastest motion
  bool began_ = false;
  std::vector<OutputExtremes> extremes_;
  std::vector<double> values_, last_, before_, none_;
  double last_t_ = 0.0, before_t_ = -1.0;
  std::vector<Values> samples_;
  Point point_;
  Extreme reactions_;
};

}  // namespace signorini
