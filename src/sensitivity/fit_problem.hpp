// fit_problem.hpp: residuals of measurements and their derivatives, for the fit.
//
//   f_i(p) = (x_i(p) - m_i) / sigma_i,   J_ij = df_i/dp_j
//
// An event that is missing in a run with other keys, or a refused scene, is a residual of
// missing_event_residual sigmas. If two events coincide at these keys, a derivative does not exist; it is
// replaced by that of the side from which the keys came. If that does not exist either, the derivative is
// missing: J is never filled with guesses.
#pragma once

#include <gsl/gsl_matrix.h>
#include <gsl/gsl_vector.h>
#include <exception>
#include <memory>
#include <vector>

#include "signorini/fit.hpp"

namespace signorini::sensitivity {

class FitProblem {
 public:
  /// Residual, in sigmas, of an event that a trial lacks: such a trial is never an improvement.
  static constexpr double missing_event_residual = 1e8;
  /// Distance to the other side of a kink, relative to a key's size. Far above the rounding of the derivatives, 1e-9,
  /// and of the keys at the end of a fit; far below the resolution of measurements.
  static constexpr double kink_offset = 1e-6;

  /// All arguments must outlive the object.
  FitProblem(const SceneReader& read, const std::vector<std::string>& paths, const Measurements& measured,
             const std::function<bool()>& go_on);

  [[nodiscard]] std::size_t rows() const { return measured_.rows.size(); }
  [[nodiscard]] std::size_t keys() const { return paths_.size(); }
  [[nodiscard]] int runs() const { return runs_; }
  [[nodiscard]] const std::exception_ptr& failure() const { return failure_; }
  /// Reason why the last derivatives are not available.
  [[nodiscard]] const std::string& no_derivative() const { return no_derivative_; }
  /// Size of each key: its value, or a typical size if it is zero.
  [[nodiscard]] const std::vector<double>& size() const { return size_; }
  /// The norm of m_i / sigma_i.
  [[nodiscard]] double measured_norm() const;

  /// Runs at these keys. If derivatives are missing there, it runs at keys beside them and moves `keys`.
  /// Errors: data that do not fit the run.
  void start(std::vector<double>& keys);
  /// Computes f. Returns false after an exception in the first run, or an interrupt.
  bool residuals(const std::vector<double>& keys, gsl_vector& f);
  /// Computes J. Returns false for the same reasons as residuals(), or if a derivative is missing.
  bool derivatives(const std::vector<double>& keys, gsl_matrix& J);
  /// True if the run at these keys has everything that was measured, with derivatives.
  bool complete(const std::vector<double>& keys);
  /// x_i - m_i of the last run; NaN if the run lacks x_i.
  [[nodiscard]] double residual(std::size_t row) const;
  /// A measured quantity that the last run lacks, and its row; empty if the run has all.
  [[nodiscard]] std::string missing_quantity(std::size_t& row) const;
  /// Throws an error at a row of the measurements.
  [[noreturn]] void refuse(std::size_t row, const std::string& message) const;

 private:
  [[nodiscard]] bool has(const Measurement& m) const;
  [[nodiscard]] std::string name_of(const Event& event) const;
  [[nodiscard]] std::pair<std::size_t, std::size_t> place_of(const Measurement& m) const;
  [[nodiscard]] double rate_of(std::size_t row, std::size_t key) const;
  /// Sentence about a row and a key without a derivative, with the reason; empty if there are none.
  [[nodiscard]] std::string missing_rate() const;
  bool run(const std::vector<double>& keys);
  [[nodiscard]] Scene scene_at(const std::vector<double>& keys, const std::vector<Override>& changes) const;

  const SceneReader& read_;
  const std::vector<std::string>& paths_;
  const Measurements& measured_;
  const std::function<bool()>& go_on_;
  std::vector<double> times_, keys_, size_;
  std::vector<double> known_;  // the last keys with all derivatives
  Sensitivities last_;
  std::exception_ptr failure_;
  std::string no_derivative_;
  int runs_ = 0;
  bool scene_refused_ = false;  // the scene is refused with these keys
};

// Linearised least-squares problem at one point.
//
//   J = U S V^T D      D: norms of J's columns
//   step = - D^-1 V S^+ U^T f                    minimises |f + J step|
//   covariance = D^-1 V (S^+)^2 V^T D^-1
//
// S^+: without singular values that are zero to rounding. Keys with a component there are undetermined.

struct GslFree {
  void operator()(gsl_matrix* m) const { gsl_matrix_free(m); }
  void operator()(gsl_vector* v) const { gsl_vector_free(v); }
};
using GslMatrix = std::unique_ptr<gsl_matrix, GslFree>;
using GslVector = std::unique_ptr<gsl_vector, GslFree>;

struct LinearFit {
  std::vector<double> step, slope;  ///< slope: J^T f
  std::vector<std::vector<double>> covariance;
  std::vector<bool> determined;
  std::size_t rank = 0;
};

/// Solution of the linearised problem. f: residuals over their sigmas; J: their derivatives, with at least as
/// many rows as keys; size: size of each key; measured: norm of the measured numbers over their sigmas, to
/// which rounding is relative.
[[nodiscard]] LinearFit linear_fit(const gsl_vector& f, const gsl_matrix& J, const std::vector<double>& size,
                                   double measured);

}  // namespace signorini::sensitivity
