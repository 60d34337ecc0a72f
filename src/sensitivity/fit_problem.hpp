// fit_problem.hpp: residuals of measurements and their derivatives, run by run.
//
//   f_i(p) = (x_i(p) - m_i) / sigma_i,   J_ij = df_i/dp_j
//
// An event that a run with other keys has not, or a scene that is refused, is a residual of `missing` sigmas. A
// derivative that does not exist, because two events meet at these keys, is taken from the side from which the keys came;
// where there is none either, there is none: J is never filled up.
#pragma once

#include <gsl/gsl_matrix.h>
#include <gsl/gsl_vector.h>

#include <exception>

#include "signorini/fit.hpp"

namespace signorini {

class FitProblem {
 public:
  /// In sigmas, of an event that a trial does not have: such a trial is never better.
  static constexpr double missing = 1e8;
  /// Of a key's size: how far beside the keys the other side of a kink is looked at. Far above the rounding of the
  /// derivatives, 1e-9, and of the keys at which a fit ends; far below what measurements tell.
  static constexpr double beside = 1e-6;

  /// All of them must outlive it.
  FitProblem(const SceneReader& read, const std::vector<std::string>& paths, const Measurements& measured,
             const std::function<bool()>& go_on);

  [[nodiscard]] std::size_t rows() const { return measured_.rows.size(); }
  [[nodiscard]] std::size_t keys() const { return paths_.size(); }
  [[nodiscard]] int runs() const { return runs_; }
  [[nodiscard]] const std::exception_ptr& failure() const { return failure_; }
  /// Why the last derivatives could not be had.
  [[nodiscard]] const std::string& no_derivative() const { return no_derivative_; }
  /// Of each key: its value, or what is typical where it is zero.
  [[nodiscard]] const std::vector<double>& size() const { return size_; }
  /// The norm of m_i / sigma_i.
  [[nodiscard]] double measured_norm() const;

  /// Runs at these keys, and at others beside them where derivatives are missing there: moves the keys then. Errors: what
  /// the data and the run say that they have not in common.
  void start(std::vector<double>& keys);
  /// False: something was thrown at the first run, or an interrupt.
  bool residuals(const std::vector<double>& keys, gsl_vector& f);
  /// False: those, or no derivatives.
  bool derivatives(const std::vector<double>& keys, gsl_matrix& J);
  /// Whether the run at these keys has everything that was measured, with derivatives.
  bool complete(const std::vector<double>& keys);
  /// x_i - m_i of the last run; NaN: it has none.
  [[nodiscard]] double residual(std::size_t row) const;
  /// What the last run has not of what was measured; empty: nothing. `row`: where it is.
  [[nodiscard]] std::string not_there(std::size_t& row) const;
  /// An error at a row of the measurements.
  [[noreturn]] void refuse(std::size_t row, const std::string& message) const;

 private:
  [[nodiscard]] bool has(const Measurement& m) const;
  [[nodiscard]] std::string name_of(const Event& event) const;
  [[nodiscard]] std::pair<std::size_t, std::size_t> place_of(const Measurement& m) const;
  [[nodiscard]] double rate_of(std::size_t row, std::size_t key) const;
  /// Which row has no derivative by which key, and why; empty: none.
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
  bool impossible_ = false;  // the scene is refused with these keys
};

}  // namespace signorini
