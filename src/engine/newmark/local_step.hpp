// local_step.hpp: motion of one contact at the end of a step, computed from its neighbourhood W in the structure.
//
//   A_WW x_W = b_W - A_WO y      A, b, x: see newmark_step.hpp, condensed (linear/condensed_matrix.hpp); O: outside W
//   y = a0 + h/H (a1 - a0)       acceleration outside W, interpolated from a step of length H > h with the same beginning
//
// W contains the band positions within a radius of the positions of the contact. The influence of positions outside W decays
// like the entries of A^-1, and the error of y is of second order. No bound of the error is proven: the caller checks the
// result by a step of the whole structure, and doubles the radius if both results differ.
#pragma once

#include "linear/band_factors.hpp"
#include "linear/condensed_matrix.hpp"
#include "motion/point.hpp"

namespace signorini::newmark {

class LocalStep {
 public:
  /// Both arguments must outlive the object.
  LocalStep(const Model& model, const linear::CondensedRows& rows);

  /// Motion at the end of the step from `from` at t1 - h to t1, valid only at the contact. rows: rows of the contact states,
  /// with the sparsity pattern of the constructor's rows. whole: motion at the end of the step of length `longer` (H) from
  /// `from`. Null if W would be more than a quarter of the structure, or if the elimination loses digits.
  [[nodiscard]] const motion::Point* end(std::size_t contact, const motion::Forcing& forcing,
                                         const std::vector<Rows>& rows, const motion::Point& from, double t1,
                                         double h, const motion::Point& whole, double longer);
  /// Doubles the radius of W.
  void double_radius() { radius_ *= 2; }

 private:
  struct Window {
    std::size_t begin = 0, end = 0;              // positions in W
    std::size_t outer_begin = 0, outer_end = 0;  // positions in W or coupled to W
  };
  struct Places {
    std::size_t begin = 0, end = 0;
  };
  [[nodiscard]] std::optional<Window> window(std::size_t contact) const;
  void predict(const Window& w, const motion::Point& from, double h);
  void assemble_loads(const Window& w, const motion::Forcing& forcing, const std::vector<Rows>& rows,
                      double t1);
  [[nodiscard]] bool solve(const Window& w, const motion::Point& from, double h, const motion::Point& whole,
                           double longer);
  void read(std::size_t contact, const std::vector<Rows>& rows, double h);

  const Model& model_;
  const linear::CondensedRows& rows_;
  std::size_t radius_;
  std::optional<linear::BandFactors> band_;  // A_WW of the last window
  linear::Weights weights_;
  Vector load_, b_;                    // loads of all degrees of freedom, valid in W only; b_W, then x_W
  std::vector<Places> loads_;          // range of band positions on which each load acts
  std::vector<double> by_N_, by_T_;    // factors of N and T, one for each degree of freedom of each contact
  std::vector<std::size_t> contacts_;  // contacts in the window
  motion::Point end_;                  // result; before read(), u and v are only predictions
};

}  // namespace signorini::newmark
