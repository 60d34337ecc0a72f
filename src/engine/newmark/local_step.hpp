// local_step.hpp: the end of a step at one contact, from its neighbourhood in the structure.
//
//   A_WW x_W = b_W - A_WO y      A, b, x: the step's (newmark_step.hpp), condensed (linear/condensed_matrix.hpp)
//   y = a0 + h/H (a1 - a0)       motion outside W, from a step of length H with the same beginning
//
// W contains the places of the band up to a radius from those of the contact. The influence of places outside
// decays like the entries of A^-1; the error of y is of second order. The error has no proven bound: the
// caller checks the result by a step of the whole structure, and doubles the radius if that step differs.
#pragma once

#include "linear/band_factors.hpp"
#include "linear/condensed_matrix.hpp"
#include "motion/point.hpp"

namespace signorini::newmark {

class LocalStep {
 public:
  /// Both arguments must outlive the object.
  LocalStep(const Model& model, const linear::CondensedRows& rows);

  /// End of the step from `from` at t1 - h to t1, valid only at the contact. rows: rows of the contact
  /// states, with the matrix pattern of the constructor's rows; whole: the end of the step of length `longer`
  /// (H) from `from`. Null: W is too large a part of the structure, or elimination loses digits.
  [[nodiscard]] const motion::Point* end(std::size_t contact, const motion::Forcing& forcing,
                                         const std::vector<Rows>& rows, const motion::Point& from, double t1,
                                         double h, const motion::Point& whole, double longer);
  /// Doubles the radius.
  void double_radius() { radius_ *= 2; }

 private:
  struct Window {
    std::size_t begin = 0, end = 0;              // W
    std::size_t outer_begin = 0, outer_end = 0;  // W and the places that couple to it
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
  std::optional<linear::BandFactors> band_;  // sized for the last window
  linear::Weights weights_;
  Vector load_, b_;                    // by degree of freedom, valid in W only; by place of W
  std::vector<Places> loads_;          // range of degrees of freedom on which each load acts
  std::vector<double> by_N_, by_T_;    // factors of N and T; one entry for each place on which a contact acts
  std::vector<std::size_t> contacts_;  // contacts in the window
  motion::Point end_;                  // u, v: their known parts, until read
};

}  // namespace signorini::newmark
