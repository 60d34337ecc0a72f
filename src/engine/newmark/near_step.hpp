// near_step.hpp: the end of a step at one contact, from what is near to it.
//
//   A_WW x_W = b_W - A_WO y      A, b, x: the step's (newmark_step.hpp), condensed (linear/condensed_matrix.hpp)
//   y = a0 + h/H (a1 - a0)       what lies beside W, from a step of length H with the same beginning
//
// W: places of the band up to a radius from the contact's. The influence of what lies beyond decays as A^-1 does; how far
// y is off is second order. No bound is assumed: whoever looks near checks what it has led to by a whole step, and looks
// farther if that tells otherwise.
#pragma once

#include "linear/band_factors.hpp"
#include "linear/condensed_rows.hpp"
#include "motion/point.hpp"

namespace signorini {

class NearStep {
 public:
  /// Both must outlive it.
  NearStep(const Model& model, const CondensedRows& rows);

  /// The end of the step from `from` at t1 - h to t1, as far as it is seen at the contact: nothing else of it is to be read.
  /// rows: in force, those of the constructor's; whole: the end of the step of length `longer`. Null: W is no small part of
  /// the structure, or elimination loses digits.
  [[nodiscard]] const Point* end(std::size_t contact, const Forcing& forcing, const std::vector<Rows>& rows,
                                 const Point& from, double t1, double h, const Point& whole, double longer);
  /// Doubles the radius.
  void look_farther() { radius_ *= 2; }

 private:
  struct Window {
    std::size_t begin = 0, end = 0;   // W
    std::size_t first = 0, last = 0;  // with what couples to it
  };
  struct Places {
    std::size_t begin = 0, end = 0;
  };
  [[nodiscard]] std::optional<Window> window(std::size_t contact) const;
  void know_motion(const Window& w, const Point& from, double h);
  void act(const Window& w, const Forcing& forcing, const std::vector<Rows>& rows, double t1);
  [[nodiscard]] bool solve(const Window& w, const Point& from, double h, const Point& whole, double longer);
  void read(std::size_t contact, const std::vector<Rows>& rows, double h);

  const Model& model_;
  const CondensedRows& rows_;
  std::size_t radius_;
  std::optional<BandFactors> band_;  // as large as the last window
  Weights weights_;
  Vector load_, b_;                    // one a degree of freedom, true in W alone; one a place of W
  std::vector<Places> loads_;          // where each acts, from the first to the last
  std::vector<double> by_N_, by_T_;    // one a touch
  std::vector<std::size_t> contacts_;  // in the window
  Point end_;                          // u, v: what is known of them, until it is read
};

}  // namespace signorini
