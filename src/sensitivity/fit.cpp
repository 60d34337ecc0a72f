#include "signorini/fit.hpp"

#include <fmt/core.h>
#include <gsl/gsl_blas.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit_nlinear.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>

#include "base/number.hpp"
#include "sensitivity/parameter.hpp"

namespace signorini {
namespace {

constexpr std::size_t most_iterations = 50;
// Relative changes of the keys, and of the sum of squares, below which it ends: above what rounding leaves of the
// derivatives, far below what measurements tell.
constexpr double key_tolerance = 1e-9, gradient_tolerance = 1e-12, sum_tolerance = 0.0;
// In sigmas, of an event that a trial does not have: such a trial is never better.
constexpr double missing = 1e8;

class FitProblem {
 public:
  FitProblem(const SceneReader& read, const std::vector<std::string>& paths, const Measurements& measured,
             const std::function<bool()>& go_on)
      : read_(read), paths_(paths), measured_(measured), go_on_(go_on), times_(times_of(measured)) {}

  [[nodiscard]] std::size_t rows() const { return measured_.rows.size(); }
  [[nodiscard]] int runs() const { return runs_; }
  [[nodiscard]] const std::exception_ptr& failure() const { return failure_; }

  /// (x_i - m_i)/sigma_i at these keys; false: something was thrown, see failure().
  bool residuals(const gsl_vector* x, gsl_vector* f) {
    if (!run(x)) return false;
    for (std::size_t i = 0; i < rows(); ++i) {
      const double rest = impossible_ ? EventRates::none : residual(i);
      gsl_vector_set(f, i, std::isfinite(rest) ? rest / measured_.rows[i].sigma : missing);
    }
    return true;
  }
  bool derivatives(const gsl_vector* x, gsl_matrix* J) {
    if (!run(x)) return false;
    for (std::size_t i = 0; i < rows(); ++i)
      for (std::size_t p = 0; p < paths_.size(); ++p) {
        const double rate = rate_of(i, p);
        gsl_matrix_set(J, i, p, std::isfinite(rate) ? rate / measured_.rows[i].sigma : 0.0);
      }
    return true;
  }
  /// x_i - m_i of the last run; NaN: it has none.
  [[nodiscard]] double residual(std::size_t i) const {
    const Measurement& m = measured_.rows[i];
    if (m.event == 0) {
      const auto [row, column] = place_of(m);
      return row < last_.values.size() ? last_.values[row][column] - m.value : EventRates::none;
    }
    return has(m) ? last_.events[m.event - 1].t - m.value : EventRates::none;
  }
  /// What is measured and not there, or has no derivative, at the last keys; empty: nothing.
  [[nodiscard]] std::string gap() const {
    for (std::size_t i = 0; i < rows(); ++i) {
      const Measurement& m = measured_.rows[i];
      if (m.event > 0 && !has(m))
        return fmt::format("the run has {} events, and no event {} of contact '{}'", last_.events.size(),
                           m.event, m.contact);
      for (std::size_t p = 0; p < paths_.size(); ++p)
        if (!std::isfinite(rate_of(i, p)))
          return fmt::format("row {} has no derivative by {}: {}", i + 1, paths_[p],
                             last_.parameters[p].reason);
    }
    return {};
  }

 private:
  static std::vector<double> times_of(const Measurements& measured) {
    std::vector<double> times;
    for (const Measurement& m : measured.rows)
      if (m.event == 0) times.push_back(m.t);
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
  }

  [[nodiscard]] bool has(const Measurement& m) const {
    if (m.event > last_.events.size()) return false;
    const int contact = last_.events[m.event - 1].contact;
    return m.contact.empty() ||
           (contact >= 0 && last_.contacts[static_cast<std::size_t>(contact)] == m.contact);
  }
  [[nodiscard]] std::pair<std::size_t, std::size_t> place_of(const Measurement& m) const {
    const auto column = std::find(last_.columns.begin(), last_.columns.end(), m.column);
    if (column == last_.columns.end())
      throw UsageError(fmt::format("the run has no column \"{}\"", m.column));
    const auto row = std::find(last_.times.begin(), last_.times.end(), m.t);
    return {static_cast<std::size_t>(row - last_.times.begin()),
            static_cast<std::size_t>(column - last_.columns.begin())};
  }
  [[nodiscard]] double rate_of(std::size_t i, std::size_t p) const {
    const Measurement& m = measured_.rows[i];
    if (m.event > 0) return has(m) ? last_.event_rates[m.event - 1][p].t : EventRates::none;
    const auto [row, column] = place_of(m);
    return row < last_.value_rates[p].size() ? last_.value_rates[p][row][column] : EventRates::none;
  }

  /// Of the keys x, unless it was the last.
  bool run(const gsl_vector* x) {
    std::vector<double> keys;
    for (std::size_t p = 0; p < paths_.size(); ++p) keys.push_back(gsl_vector_get(x, p));
    if (keys == keys_) return true;
    keys_ = keys;
    if (go_on_ && !go_on_()) return false;
    try {
      last_ = sensitivities([&](const std::vector<Override>& changes) { return scene_at(keys, changes); },
                            paths_);
      for (const Measurement& m : measured_.rows)
        if (m.event == 0) static_cast<void>(place_of(m));
      impossible_ = false;
    } catch (const Error&) {  // not through GSL's frames
      if (runs_ == 0) failure_ = std::current_exception();
      impossible_ = true;
    }
    ++runs_;
    return !failure_;
  }
  [[nodiscard]] Scene scene_at(const std::vector<double>& keys, const std::vector<Override>& changes) const {
    std::vector<Override> all;
    for (std::size_t p = 0; p < paths_.size(); ++p) all.push_back(set_to(paths_[p], keys[p]));
    if (!times_.empty()) {
      std::string list;
      for (const double t : times_) list += (list.empty() ? "[" : ", ") + shortest(t);
      all.push_back({"run.output_times", list + "]"});
    }
    all.insert(all.end(), changes.begin(), changes.end());
    return read_(all);
  }

  const SceneReader& read_;
  const std::vector<std::string>& paths_;
  const Measurements& measured_;
  const std::function<bool()>& go_on_;
  std::vector<double> times_, keys_;
  Sensitivities last_;
  std::exception_ptr failure_;
  int runs_ = 0;
  bool impossible_ = false;  // the scene is refused with these keys
};

/// GSL's errors are values while this lives, not the end of the program.
class GslErrorsReturned {
 public:
  GslErrorsReturned() : before_(gsl_set_error_handler_off()) {}
  ~GslErrorsReturned() { gsl_set_error_handler(before_); }
  GslErrorsReturned(const GslErrorsReturned&) = delete;
  GslErrorsReturned& operator=(const GslErrorsReturned&) = delete;

 private:
  gsl_error_handler_t* before_;
};

int gsl_residuals(const gsl_vector* x, void* problem, gsl_vector* f) {
  return static_cast<FitProblem*>(problem)->residuals(x, f) ? GSL_SUCCESS : GSL_EFAILED;
}
int gsl_derivatives(const gsl_vector* x, void* problem, gsl_matrix* J) {
  return static_cast<FitProblem*>(problem)->derivatives(x, J) ? GSL_SUCCESS : GSL_EFAILED;
}

using Workspace = std::unique_ptr<gsl_multifit_nlinear_workspace, void (*)(gsl_multifit_nlinear_workspace*)>;
using GslMatrix = std::unique_ptr<gsl_matrix, void (*)(gsl_matrix*)>;

std::string end_of(int status, int info) {
  if (status == GSL_SUCCESS)
    return info == 1   ? "the keys change no more"
           : info == 2 ? "the sum of squares is least"
                       : "it changes no more";
  if (status == GSL_EMAXITER) return "it has not settled after 50 steps";
  if (status == GSL_ENOPROG) return "no step makes the sum of squares less";
  return "it was interrupted";
}

void take_result(gsl_multifit_nlinear_workspace* w, const FitProblem& problem, bool has_sigma, Fit& result) {
  const std::size_t count = result.keys.size();
  const GslMatrix covariance(gsl_matrix_alloc(count, count), gsl_matrix_free);
  gsl_multifit_nlinear_covar(gsl_multifit_nlinear_jac(w), 0.0, covariance.get());
  const gsl_vector* f = gsl_multifit_nlinear_residual(w);
  gsl_blas_ddot(f, f, &result.chi_squared);
  const double freedom = static_cast<double>(problem.rows() - count);
  const double factor = has_sigma || freedom == 0.0 ? 1.0 : result.chi_squared / freedom;
  for (std::size_t i = 0; i < count; ++i) {
    result.covariance.emplace_back();
    for (std::size_t j = 0; j < count; ++j)
      result.covariance[i].push_back(factor * gsl_matrix_get(covariance.get(), i, j));
    result.keys[i].value = gsl_vector_get(gsl_multifit_nlinear_position(w), i);
    result.keys[i].sigma = std::sqrt(result.covariance[i][i]);
  }
}

}  // namespace

Fit fit(const SceneReader& read, const std::vector<std::string>& paths, const Measurements& measured,
        const std::function<bool()>& go_on) {
  if (measured.rows.size() < paths.size() || paths.empty())
    throw UsageError(fmt::format("found {} measured numbers for {} keys, expected at least as many",
                                 measured.rows.size(), paths.size()));
  const GslErrorsReturned quiet;
  Fit result;
  const Scene scene = read({});
  std::vector<double> start;
  for (const std::string& path : paths) {
    start.push_back(value_of(scene, path));
    result.keys.push_back({path, start.back(), start.back(), 0.0});
  }
  FitProblem problem(read, paths, measured, go_on);
  gsl_multifit_nlinear_fdf fdf{};
  fdf.f = gsl_residuals;
  fdf.df = gsl_derivatives;
  fdf.n = problem.rows();
  fdf.p = paths.size();
  fdf.params = &problem;
  gsl_multifit_nlinear_parameters settings = gsl_multifit_nlinear_default_parameters();
  settings.trs = gsl_multifit_nlinear_trs_lm;
  const Workspace w(gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &settings, fdf.n, fdf.p),
                    gsl_multifit_nlinear_free);
  const gsl_vector_const_view first = gsl_vector_const_view_array(start.data(), start.size());
  int info = 0;
  int status = gsl_multifit_nlinear_init(&first.vector, &fdf, w.get());
  if (problem.failure()) std::rethrow_exception(problem.failure());
  if (status == GSL_SUCCESS) {
    if (const std::string why = problem.gap(); !why.empty()) throw UsageError("at the start " + why);
    status = gsl_multifit_nlinear_driver(most_iterations, key_tolerance, gradient_tolerance, sum_tolerance,
                                         nullptr, nullptr, &info, w.get());
    if (problem.failure()) std::rethrow_exception(problem.failure());
    take_result(w.get(), problem, measured.has_sigma, result);
  }
  std::vector<double> at;
  for (const FittedKey& key : result.keys) at.push_back(key.value);
  const gsl_vector_const_view last = gsl_vector_const_view_array(at.data(), at.size());
  const std::unique_ptr<gsl_vector, void (*)(gsl_vector*)> f(gsl_vector_alloc(problem.rows()),
                                                             gsl_vector_free);
  static_cast<void>(problem.residuals(&last.vector, f.get()));
  for (std::size_t i = 0; i < problem.rows(); ++i) result.residuals.push_back(problem.residual(i));
  result.converged = status == GSL_SUCCESS || (status == GSL_ENOPROG && result.chi_squared < missing);
  result.reason = end_of(status, info);
  result.iterations = static_cast<int>(gsl_multifit_nlinear_niter(w.get()));
  result.runs = problem.runs();
  return result;
}

}  // namespace signorini
