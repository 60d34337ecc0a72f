// fit_problem.hpp: residuals of a fit's measurements, and their derivatives.
//
//   f_i(p) = (x_i(p) - m_i) / sigma_i,   J_ij = df_i/dp_j
//
// If a run with other keys lacks a measured event, or its scene is refused, the residual is missing_event_residual sigmas. If
// two events coincide at the keys, a derivative does not exist; the derivative on the side from which the keys came is then
// used. If that derivative does not exist either, J is reported as unavailable.
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
  /// Residual, in sigmas, of an event that a trial run lacks; it is so large that such a trial is never an improvement.
  static constexpr double missing_event_residual = 1e8;
  /// Distance to the other side of a kink of the sum of squares, relative to a key's size. It is far above rounding errors of
  /// derivatives (1e-9) and of the keys at the end of a fit, and far below the resolution of measurements.
  static constexpr double kink_offset = 1e-6;

  /// All arguments must outlive the object.
  FitProblem(const SceneReader& read, const std::vector<std::string>& paths, const Measurements& measured,
             const std::function<bool()>& go_on);

  [[nodiscard]] std::size_t rows() const { return measured_.rows.size(); }
  [[nodiscard]] std::size_t keys() const { return paths_.size(); }
  [[nodiscard]] int runs() const { return runs_; }
  [[nodiscard]] const std::exception_ptr& failure() const { return failure_; }
  /// Reason why the last derivatives are not available; empty if they are.
  [[nodiscard]] const std::string& no_derivative() const { return no_derivative_; }
  /// Size of each key: its magnitude at the start, or a typical magnitude if it is zero.
  [[nodiscard]] const std::vector<double>& size() const { return size_; }
  /// Norm of the vector m_i / sigma_i.
  [[nodiscard]] double measured_norm() const;

  /// Runs with these keys. If derivatives do not exist there, runs with keys nearby and changes `keys`. Errors: measurements
  /// that do not fit the run.
  void start(std::vector<double>& keys);
  /// Computes f. Returns false if the first run threw an exception (see failure()), or after an interrupt.
  bool residuals(const std::vector<double>& keys, gsl_vector& f);
  /// Computes J. Returns false if the first run threw an exception, after an interrupt, or if a derivative does not exist.
  bool derivatives(const std::vector<double>& keys, gsl_matrix& J);
  /// True if the run with these keys contains all measured quantities and their derivatives.
  bool complete(const std::vector<double>& keys);
  /// x_i - m_i in the last run; NaN if the run does not contain x_i.
  [[nodiscard]] double residual(std::size_t row) const;
  /// Message about a measured quantity that the last run does not contain, and its row; empty if the run contains all.
  [[nodiscard]] std::string missing_quantity(std::size_t& row) const;
  /// Throws an error that names the file and line of a measurement.
  [[noreturn]] void refuse(std::size_t row, const std::string& message) const;

 private:
  [[nodiscard]] bool has(const Measurement& m) const;
  [[nodiscard]] std::string name_of(const Event& event) const;
  [[nodiscard]] std::pair<std::size_t, std::size_t> place_of(const Measurement& m) const;
  [[nodiscard]] double rate_of(std::size_t row, std::size_t key) const;
  /// Sentence about a measurement and a key without a derivative, with the reason; empty if all derivatives exist.
  [[nodiscard]] std::string missing_rate() const;
  bool run(const std::vector<double>& keys);
  [[nodiscard]] Scene scene_at(const std::vector<double>& keys, const std::vector<Override>& changes) const;

  const SceneReader& read_;
  const std::vector<std::string>& paths_;
  const Measurements& measured_;
  const std::function<bool()>& go_on_;
  std::vector<double> times_, keys_, size_;
  std::vector<double> known_;  // the last keys at which all derivatives existed
  Sensitivities last_;
  std::exception_ptr failure_;
  std::string no_derivative_;
  int runs_ = 0;
  bool scene_refused_ = false;  // true: the reader or the engine refuses the scene with these keys
};

// Linearised least-squares problem at one set of keys.
//
//   J = U S V^T D      D: diagonal matrix of the norms of J's columns
//   step = - D^-1 V S^+ U^T f                    minimises |f + J step|
//   covariance = D^-1 V (S^+)^2 V^T D^-1
//
// S^+ omits singular values that are zero up to rounding. Keys with a component in such a direction are undetermined.

struct GslFree {
  void operator()(gsl_matrix* m) const { gsl_matrix_free(m); }
  void operator()(gsl_vector* v) const { gsl_vector_free(v); }
};
using GslMatrix = std::unique_ptr<gsl_matrix, GslFree>;
using GslVector = std::unique_ptr<gsl_vector, GslFree>;

struct LinearFit {
  std::vector<double> step, slope;  ///< step: change of the keys; slope: J^T f
  std::vector<std::vector<double>> covariance;
  std::vector<bool> determined;  ///< false: the measurements do not determine the key
  std::size_t rank = 0;          ///< number of singular values that are not zero up to rounding
};

/// Solves the linearised problem. f: residuals / sigmas; J: derivatives of f, with at least as many rows as keys; size: size
/// of each key; measured: norm of measured numbers / sigmas, to which rounding errors are relative.
[[nodiscard]] LinearFit linear_fit(const gsl_vector& f, const gsl_matrix& J, const std::vector<double>& size,
                                   double measured);

}  // namespace signorini::sensitivity
