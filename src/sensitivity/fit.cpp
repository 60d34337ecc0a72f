#include "signorini/fit.hpp"

#include <fmt/core.h>
#include <gsl/gsl_blas.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "base/text.hpp"
#include "result/csv.hpp"
#include "sensitivity/fit_problem.hpp"
#include "sensitivity/parameter.hpp"
#include "signorini/error.hpp"

namespace signorini {
namespace {

constexpr std::size_t most_iterations = 50;
constexpr int max_restarts = 8;  // restarts from the other side of a kink; chosen value
// Convergence limits for relative changes of the keys and of the sum of squares. They are above the rounding errors of the
// derivatives and far below the resolution of measurements.
constexpr double key_tolerance = 1e-9, gradient_tolerance = 1e-12, sum_tolerance = 0.0;
// Step length, relative to a key's sigma, below which a step is insignificant. Chosen value.
constexpr double insignificant_step = 0.1;
// Two slopes are opposite if a convex combination of them is shorter than this fraction of the longer slope. Chosen value.
constexpr double opposite = 1e-3;
// Smallest probability of chi squared in an accepted fit; this limit rejects one correct fit in a million.
constexpr double least_probability = 1e-6;
// Without sigmas: largest norm of the residuals, relative to the measured numbers, in an accepted fit. Chosen value; a wrong
// unit gives about 1.
constexpr double max_relative_residual = 0.5;

/// While an object of this class exists, GSL returns error codes instead of aborting the program.
class GslErrorsReturned {
 public:
  GslErrorsReturned() : before_(gsl_set_error_handler_off()) {}
  ~GslErrorsReturned() { gsl_set_error_handler(before_); }
  GslErrorsReturned(const GslErrorsReturned&) = delete;
  GslErrorsReturned& operator=(const GslErrorsReturned&) = delete;

 private:
  gsl_error_handler_t* before_;
};

std::vector<double> keys_of(const gsl_vector* x) {
  std::vector<double> keys;
  for (std::size_t p = 0; p < x->size; ++p) keys.push_back(gsl_vector_get(x, p));
  return keys;
}
int gsl_residuals(const gsl_vector* x, void* problem, gsl_vector* f) {
  return static_cast<sensitivity::FitProblem*>(problem)->residuals(keys_of(x), *f) ? GSL_SUCCESS
                                                                                   : GSL_EFAILED;
}
int gsl_derivatives(const gsl_vector* x, void* problem, gsl_matrix* J) {
  return static_cast<sensitivity::FitProblem*>(problem)->derivatives(keys_of(x), *J) ? GSL_SUCCESS
                                                                                     : GSL_EFAILED;
}

using Workspace = std::unique_ptr<gsl_multifit_nlinear_workspace, void (*)(gsl_multifit_nlinear_workspace*)>;

/// Result of one descent by the Levenberg-Marquardt method.
struct FitMinimum {
  std::vector<double> keys;
  double chi_squared = 0.0;
  int status = GSL_SUCCESS, iterations = 0;
};

FitMinimum descend(sensitivity::FitProblem& problem, const std::vector<double>& from) {
  gsl_multifit_nlinear_fdf fdf{};
  fdf.f = gsl_residuals;
  fdf.df = gsl_derivatives;
  fdf.n = problem.rows();
  fdf.p = problem.keys();
  fdf.params = &problem;
  gsl_multifit_nlinear_parameters settings = gsl_multifit_nlinear_default_parameters();
  settings.trs = gsl_multifit_nlinear_trs_lm;
  const Workspace w(gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &settings, fdf.n, fdf.p),
                    gsl_multifit_nlinear_free);
  const gsl_vector_const_view first = gsl_vector_const_view_array(from.data(), from.size());
  FitMinimum place{from, 0.0, gsl_multifit_nlinear_init(&first.vector, &fdf, w.get()), 0};
  int info = 0;
  if (place.status == GSL_SUCCESS) {
    place.status = gsl_multifit_nlinear_driver(most_iterations, key_tolerance, gradient_tolerance,
                                               sum_tolerance, nullptr, nullptr, &info, w.get());
    if (info == GSL_ENOPROG)
      place.status = GSL_ENOPROG;  // the driver returns EMAXITER if the first step fails
    place.keys = keys_of(gsl_multifit_nlinear_position(w.get()));
    place.iterations = static_cast<int>(gsl_multifit_nlinear_niter(w.get()));
  }
  const gsl_vector* f = gsl_multifit_nlinear_residual(w.get());
  gsl_blas_ddot(f, f, &place.chi_squared);
  return place;
}

/// True if some convex combination of the two vectors is nearly zero.
bool are_opposite(const std::vector<double>& a, const std::vector<double>& b) {
  double aa = 0.0, bb = 0.0, ab = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    aa += a[i] * a[i];
    bb += b[i] * b[i];
    ab += a[i] * b[i];
  }
  const double apart = aa - 2.0 * ab + bb;
  const double part = apart > 0.0 ? std::clamp((bb - ab) / apart, 0.0, 1.0) : 0.0;
  const double left = part * part * aa + 2.0 * part * (1.0 - part) * ab + (1.0 - part) * (1.0 - part) * bb;
  return left <= opposite * opposite * std::max(aa, bb);
}

class Fitter {
 public:
  Fitter(sensitivity::FitProblem& problem, const Measurements& measured)
      : problem_(problem),
        measured_(measured),
        f_(gsl_vector_alloc(problem.rows())),
        J_(gsl_matrix_alloc(problem.rows(), problem.keys())) {}

  void run(const std::vector<double>& start) {
    place_ = descend(problem_, start);
    iterations_ = place_.iterations;
    int restarts = 0;
    while (examine_both_sides() && ++restarts < max_restarts) {
    }
  }

  void take_into(Fit& result) {
    const bool known = linear_at(place_.keys);
    result.iterations = iterations_;
    result.chi_squared = place_.chi_squared;
    result.freedom = static_cast<long>(problem_.rows()) - static_cast<long>(here_.rank);
    at_bound_.assign(result.keys.size(), false);
    for (const auto& [p, side] : incomplete_sides_)
      at_bound_[p] = at_bound_[p] || (known && side * here_.slope[p] < 0.0);
    std::vector<std::string> bounds;
    for (std::size_t p = 0; p < result.keys.size() && !settled(); ++p)
      if (at_bound_[p]) bounds.push_back(result.keys[p].path);
    result.reason = bounds.empty() ? reason(known) : reason_at_bounds(bounds);
    if (!known || !settled()) result.issues.push_back(result.reason);
    if (known) take_keys(result);
    explain(result);
  }

 private:
  static std::string reason_at_bounds(const std::vector<std::string>& keys) {
    const bool one = keys.size() == 1;
    return fmt::format(
        "{} {}: the sum of squares decreases further beyond the bound{}, but there the scene refuses the "
        "value or the run lacks measured events",
        base::join_texts(keys), one ? "is at its bound" : "are at their bounds", one ? "" : "s");
  }
  /// Linearises the residuals at these keys, or at keys nearby if two events coincide.
  bool linear_at(const std::vector<double>& keys) {
    if (!problem_.residuals(keys, *f_)) return false;
    if (!problem_.derivatives(keys, *J_)) return false;
    here_ = sensitivity::linear_fit(*f_, *J_, problem_.size(), problem_.measured_norm());
    return true;
  }
  /// Variance of the residuals: 1 if the measurements have sigmas, otherwise estimated from chi squared.
  [[nodiscard]] double factor() const {
    const std::size_t rows = problem_.rows();
    return measured_.has_sigma || rows <= here_.rank
               ? 1.0
               : place_.chi_squared / static_cast<double>(rows - here_.rank);
  }
  /// True if the linearised step from these keys ends at the result of the descent, within tolerances.
  [[nodiscard]] bool leads_to_result(const std::vector<double>& keys) const {
    for (std::size_t p = 0; p < keys.size(); ++p) {
      if (!here_.determined[p]) continue;
      const double sigma = std::sqrt(factor() * here_.covariance[p][p]);
      const double near =
          std::max(sensitivity::FitProblem::kink_offset * problem_.size()[p], insignificant_step * sigma);
      if (!(std::abs(keys[p] + here_.step[p] - place_.keys[p]) <= near)) return false;
    }
    return true;
  }
  /// Examines both sides of every key, and descends from a side on which the sum of squares decreases away from the result.
  /// Returns true if a lower sum was found.
  bool examine_both_sides() {
    level_ = linear_at(place_.keys) && leads_to_result(place_.keys);
    decreases_at_side_ = has_kink_ = false;
    slopes_.clear();
    incomplete_sides_.clear();
    for (std::size_t p = 0; p < problem_.keys(); ++p)
      for (const double side : {1.0, -1.0}) {
        std::vector<double> keys = place_.keys;
        keys[p] += side * sensitivity::FitProblem::kink_offset * problem_.size()[p];
        if (!problem_.complete(keys)) {
          incomplete_sides_.emplace_back(p, side);
          continue;
        }
        if (!linear_at(keys)) continue;
        std::vector<double> slope = here_.slope;
        for (std::size_t k = 0; k < slope.size(); ++k) slope[k] *= problem_.size()[k];
        slopes_.push_back(slope);
        if (leads_to_result(keys)) continue;
        has_kink_ = true;
        if (side * slope[p] >= 0.0) continue;  // the sum increases
        const FitMinimum other = descend(problem_, keys);
        iterations_ += other.iterations;
        if (other.chi_squared < place_.chi_squared) {
          place_ = other;
          return true;
        }
        decreases_at_side_ = true;
      }
    return false;
  }
  /// True if the sum of squares has a minimum at the result: with slope zero, or at a kink with opposite slopes.
  [[nodiscard]] bool settled() const {
    if (level_) return !decreases_at_side_;
    if (decreases_at_side_ || !has_kink_) return false;
    for (std::size_t i = 0; i < slopes_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (are_opposite(slopes_[i], slopes_[j])) return true;
    return false;
  }
  [[nodiscard]] std::string reason(bool known) const {
    if (!known) {
      const std::string& why = problem_.no_derivative();
      return why.empty() ? "the fit was interrupted" : why;
    }
    if (settled())
      return level_ ? "the sum of squares has its minimum"
                    : "the sum of squares has its minimum where two events coincide, so that its slope jumps";
    if (place_.status == GSL_EMAXITER)
      return fmt::format("the fit has not converged after {} steps", most_iterations);
    if (place_.status == GSL_EFAILED) {
      const std::string& why = problem_.no_derivative();
      return why.empty() ? "the fit was interrupted" : why;
    }
    return "no step reduces the sum of squares, but its slope is not zero";
  }

  void take_keys(Fit& result) const {
    std::vector<std::string> loose;
    const std::size_t count = result.keys.size();
    constexpr double none = EventRates::none;
    result.covariance.assign(count, std::vector<double>(count, none));
    for (std::size_t i = 0; i < count; ++i) {
      if (!here_.determined[i]) loose.push_back(result.keys[i].path);
      for (std::size_t j = 0; j < count; ++j)
        if (here_.determined[i] && here_.determined[j])
          result.covariance[i][j] = factor() * here_.covariance[i][j];
      result.keys[i].value = here_.determined[i] ? place_.keys[i] : none;
      result.keys[i].sigma = at_bound_[i] ? none : std::sqrt(result.covariance[i][i]);
    }
    if (!loose.empty())
      result.issues.push_back(
          fmt::format("the measurements do not determine {}: {} can change without a change of the measured "
                      "numbers; fix {}, or measure another quantity",
                      base::join_texts(loose), loose.size() == 1 ? "this key" : "these keys",
                      loose.size() == 1 ? "this key" : "one of these keys"));
  }

  /// Reports an issue if the residuals are too large to be explained by measurement errors.
  void explain(Fit& result) const {
    if (result.freedom <= 0) return;
    const char* advice = "check the units, the event numbers and the simplifications of the scene";
    if (measured_.has_sigma) {
      result.probability = gsl_cdf_chisq_Q(result.chi_squared, static_cast<double>(result.freedom));
      if (!(result.probability >= least_probability))
        result.issues.push_back(
            fmt::format("chi squared is {:.3g} for {} degrees of freedom: the measurements differ from the "
                        "run by more than their sigmas; {}, or remove the column sigma",
                        result.chi_squared, result.freedom, advice));
      return;
    }
    const double measured = problem_.measured_norm();
    const double left = measured > 0.0 ? std::sqrt(result.chi_squared) / measured : 0.0;
    if (!(left <= max_relative_residual))
      result.issues.push_back(fmt::format(
          "the norm of the residuals is {:.2g} times the norm of the measured numbers: the run does not "
          "explain the measurements; {}",
          left, advice));
  }

  sensitivity::FitProblem& problem_;
  const Measurements& measured_;
  sensitivity::GslVector f_;
  sensitivity::GslMatrix J_;
  sensitivity::LinearFit here_;
  FitMinimum place_;
  std::vector<std::vector<double>>
      slopes_;  // slopes of the sum of squares at keys near the result, per key size
  int iterations_ = 0;
  std::vector<std::pair<std::size_t, double>>
      incomplete_sides_;  // keys and sides at which a run is incomplete
  // true for keys at whose bound the sum of squares still decreases
  std::vector<bool> at_bound_;
  bool level_ = false;              // true: the slope is zero at the result
  bool has_kink_ = false;           // true: the slopes on both sides of some key differ
  bool decreases_at_side_ = false;  // true: the sum decreases on some side, but no lower sum was found
};

}  // namespace

Fit fit(const SceneReader& read, const std::vector<std::string>& paths, const Measurements& measured,
        const std::function<bool()>& go_on) {
  if (paths.empty()) throw UsageError("found no key, expected at least one key to fit");
  if (measured.rows.size() < paths.size())
    throw UsageError(fmt::format("found {} for {}, expected at least as many numbers as keys",
                                 base::count_text(measured.rows.size(), "measured number"),
                                 base::count_text(paths.size(), "key")));
  const GslErrorsReturned quiet;
  Fit result;
  const Scene scene = read({});
  std::vector<double> start;
  for (const std::string& path : paths) {
    start.push_back(sensitivity::value_of(scene, path));
    result.keys.push_back({path, start.back(), start.back(), 0.0});
  }
  sensitivity::FitProblem problem(read, paths, measured, go_on);
  problem.start(start);
  if (problem.failure()) std::rethrow_exception(problem.failure());
  if (problem.size().empty()) {  // interrupted before the first run
    result.reason = "the fit was interrupted";
    result.issues = {result.reason};
    result.residuals.assign(measured.rows.size(), EventRates::none);
    return result;
  }
  Fitter fitter(problem, measured);
  fitter.run(start);
  fitter.take_into(result);
  for (std::size_t i = 0; i < problem.rows(); ++i) result.residuals.push_back(problem.residual(i));
  result.converged = result.issues.empty();
  result.runs = problem.runs();
  return result;
}

// read_measurements(): reads a table of measurements.

namespace {

class MeasuredTable {
 public:
  explicit MeasuredTable(const std::string& path) : path_(path), reader_(path, result::LastLine::counts) {}

  Measurements read() {
    event_ = place("event_index");
    t_ = place("t");
    sigma_ = place("sigma");
    contact_ = place("contact");
    type_ = place("event");
    std::string names;
    for (const std::string& name : reader_.header()) names += (names.empty() ? "" : ",") + name;
    if (t_ == none)
      fail(1, fmt::format(
                  "found the columns \"{}\", expected a column t together with event_index, or with columns "
                  "of history.csv",
                  base::excerpt(names)));
    Measurements result;
    result.has_sigma = sigma_ != none;
    result.file = path_;
    for (line_ = 2; reader_.next_of_any_length(); ++line_) {
      if (const std::string why = reader_.row_length_error(); !why.empty()) fail(line_, why);
      if (event_ != none && !reader_.cell(event_).empty()) result.rows.push_back(event_row());
      add_columns(result.rows);
    }
    if (result.rows.empty()) fail(2, "found no measurement, expected at least one row");
    refuse_duplicates(result.rows);
    return result;
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  [[noreturn]] void fail(long line, const std::string& message) const {
    throw Error(ExitCode::scene, fmt::format("{}:{}: {}", path_, line, message));
  }
  [[noreturn]] void fail_at(std::size_t column, const std::string& message) const {
    throw Error(ExitCode::scene, fmt::format("{}:{}:{}: {}: {}", path_, line_, column + 1,
                                             base::excerpt(reader_.header()[column]), message));
  }
  /// Refuses measurements that occur twice, because they would have double weight.
  void refuse_duplicates(const std::vector<Measurement>& rows) const {
    std::map<std::tuple<std::size_t, std::string, double>, long> lines;
    for (const Measurement& m : rows) {
      const auto [first, is_new] = lines.try_emplace({m.event, m.column, m.event > 0 ? 0.0 : m.t}, m.line);
      if (is_new) continue;
      fail(m.line,
           m.event > 0
               ? fmt::format(
                     "event_index: found {} again, expected each event once; line {} has the same event",
                     m.event, first->second)
               : fmt::format("{}: found t = {} again, expected each time once; line {} has the same time",
                             base::excerpt(m.column), base::format_number(m.t), first->second));
    }
  }
  [[nodiscard]] std::size_t place(const std::string& name) const {
    const auto& header = reader_.header();
    const auto at = std::find(header.begin(), header.end(), name);
    return at == header.end() ? none : static_cast<std::size_t>(at - header.begin());
  }
  [[nodiscard]] double number_at(std::size_t column) const {
    const std::optional<double> x = base::parse_number(reader_.cell(column));
    if (!x || !std::isfinite(*x))
      fail_at(column,
              fmt::format("found \"{}\", expected a finite number", base::excerpt(reader_.cell(column))));
    return *x;
  }
  [[nodiscard]] double time() const {
    const double t = number_at(t_);
    if (t < 0.0)
      fail_at(t_,
              fmt::format("found {}, expected a time >= 0; the run starts at t = 0", base::format_number(t)));
    return t;
  }
  [[nodiscard]] double sigma() const {
    if (sigma_ == none) return 1.0;
    const double x = number_at(sigma_);
    if (!(x > 0.0)) fail_at(sigma_, fmt::format("found {}, expected a number > 0", x));
    return x;
  }
  [[nodiscard]] Measurement event_row() const {
    Measurement m;
    const double index = number_at(event_);
    if (index < 1.0 || index != std::floor(index) || index > 1e9)
      fail_at(event_, fmt::format("found {}, expected the number of a row of events.csv (1, 2, ...)", index));
    m.event = static_cast<std::size_t>(index);
    if (contact_ != none) m.contact = reader_.cell(contact_);
    if (type_ != none) m.type = reader_.cell(type_);
    m.line = line_;
    m.value = time();
    m.sigma = sigma();
    return m;
  }
  void add_columns(std::vector<Measurement>& rows) const {
    for (std::size_t c = 0; c < reader_.header().size(); ++c) {
      if (c == t_ || c == sigma_ || c == event_ || reader_.cell(c).empty()) continue;
      if (event_ != none && (c == contact_ || c == type_)) continue;
      Measurement m;
      m.line = line_;
      m.column = reader_.header()[c];
      m.t = time();
      m.value = number_at(c);
      m.sigma = sigma();
      rows.push_back(std::move(m));
    }
  }

  std::string path_;
  result::CsvReader reader_;
  std::size_t event_ = none, t_ = none, sigma_ = none, contact_ = none, type_ = none;
  long line_ = 1;
};

}  // namespace

Measurements read_measurements(const std::string& path) { return MeasuredTable(path).read(); }

}  // namespace signorini
