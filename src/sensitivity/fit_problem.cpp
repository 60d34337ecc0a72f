#include "sensitivity/fit_problem.hpp"

#include <fmt/core.h>
#include <gsl/gsl_blas.h>
#include <gsl/gsl_linalg.h>
#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "sensitivity/parameter.hpp"

namespace signorini::sensitivity {
namespace {

std::vector<double> times_of(const Measurements& measured) {
  std::vector<double> times;
  for (const Measurement& m : measured.rows)
    if (m.event == 0) times.push_back(m.t);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

}  // namespace

FitProblem::FitProblem(const SceneReader& read, const std::vector<std::string>& paths,
                       const Measurements& measured, const std::function<bool()>& go_on)
    : read_(read), paths_(paths), measured_(measured), go_on_(go_on), times_(times_of(measured)) {}

void FitProblem::refuse(std::size_t row, const std::string& message) const {
  const long line = measured_.rows[row].line;
  if (measured_.file.empty() || line == 0)
    throw UsageError(fmt::format("measured number {}: {}", row + 1, message));
  throw Error(ExitCode::scene, fmt::format("{}:{}: {}", measured_.file, line, message));
}

double FitProblem::measured_norm() const {
  double sum = 0.0;
  for (const Measurement& m : measured_.rows) sum += (m.value / m.sigma) * (m.value / m.sigma);
  return std::sqrt(sum);
}

void FitProblem::start(std::vector<double>& keys) {
  const Scene scene = read_({});
  for (std::size_t i = 0; i < rows(); ++i) {
    const Measurement& m = measured_.rows[i];
    const double t = m.event == 0 ? m.t : m.value;
    if (t > scene.run.t_end)
      refuse(i, fmt::format("t: found {}, expected a time of the run, which ends at run.t_end = {} {}", t,
                            scene.run.t_end, scene.units.time));
  }
  if (!run(keys)) return;
  size_.resize(keys.size());
  for (std::size_t p = 0; p < keys.size(); ++p) {
    constexpr double size_step_ratio = 512.0;  // ratio of a key's size to Parameter::step
    size_[p] = keys[p] != 0.0 ? std::abs(keys[p]) : size_step_ratio * std::abs(last_.parameters[p].step);
  }
  std::size_t row = 0;
  if (const std::string why = missing_quantity(row); !why.empty())
    refuse(row, "with the start values " + why);
  const std::string why = missing_rate();
  if (why.empty()) return;
  // At the start two events may coincide, as for equal contacts that start with the same friction. With slightly different
  // keys they do not coincide.
  for (std::size_t p = 0; p < keys.size(); ++p)
    for (const double side : {1.0, -1.0}) {
      std::vector<double> near = keys;
      near[p] += side * kink_offset * size_[p];
      if (!run(near) || !complete(near)) continue;
      keys = near;
      return;
    }
  throw UsageError("with the start values " + why);
}

bool FitProblem::residuals(const std::vector<double>& keys, gsl_vector& f) {
  if (!run(keys)) return false;
  for (std::size_t i = 0; i < rows(); ++i) {
    const double rest = scene_refused_ ? EventRates::none : residual(i);
    gsl_vector_set(&f, i, std::isfinite(rest) ? rest / measured_.rows[i].sigma : missing_event_residual);
  }
  return true;
}

bool FitProblem::complete(const std::vector<double>& keys) {
  std::size_t row = 0;
  return run(keys) && !scene_refused_ && missing_quantity(row).empty() && missing_rate().empty();
}

bool FitProblem::derivatives(const std::vector<double>& keys, gsl_matrix& J) {
  no_derivative_.clear();
  if (!complete(keys)) {
    if (failure_ || scene_refused_) return false;
    no_derivative_ = missing_rate();
    std::vector<double> near = keys;
    for (std::size_t p = 0; p < near.size() && !known_.empty(); ++p)
      near[p] += std::clamp(known_[p] - keys[p], -kink_offset * size_[p], kink_offset * size_[p]);
    if (near == keys || !complete(near)) return false;
  }
  known_ = keys_;
  for (std::size_t i = 0; i < rows(); ++i)
    for (std::size_t p = 0; p < paths_.size(); ++p)
      gsl_matrix_set(&J, i, p, rate_of(i, p) / measured_.rows[i].sigma);
  return true;
}

double FitProblem::residual(std::size_t i) const {
  const Measurement& m = measured_.rows[i];
  if (m.event == 0) {
    const auto [row, column] = place_of(m);
    return row < last_.values.size() ? last_.values[row][column] - m.value : EventRates::none;
  }
  return has(m) ? last_.events[m.event - 1].t - m.value : EventRates::none;
}

std::string FitProblem::missing_quantity(std::size_t& row) const {
  for (row = 0; row < rows(); ++row) {
    const Measurement& m = measured_.rows[row];
    if (m.event == 0) {
      if (!std::isfinite(residual(row)))
        return fmt::format("the run has no value of {1} at t = {2}; it ends at t = {0}",
                           last_.report.outcome.t, m.column, m.t);
    } else if (m.event > last_.events.size()) {
      return fmt::format("the run has {}, but no event {}", base::count_text(last_.events.size(), "event"),
                         m.event);
    } else if (!has(m)) {
      const std::string what = m.type.empty() ? "an event" : m.type;
      return fmt::format("event {} of the run is {}, but the measurements give {}{}", m.event,
                         name_of(last_.events[m.event - 1]), what,
                         m.contact.empty() ? "" : fmt::format(" of contact \"{}\"", m.contact));
    }
  }
  return {};
}

std::string FitProblem::name_of(const Event& event) const {
  const std::string of =
      event.contact < 0
          ? ""
          : fmt::format(" of contact \"{}\"", last_.contacts[static_cast<std::size_t>(event.contact)]);
  return fmt::format("{}{} at t = {:.9g}", to_string(event.type), of, event.t);
}

std::string FitProblem::missing_rate() const {
  for (std::size_t i = 0; i < rows(); ++i)
    for (std::size_t p = 0; p < paths_.size(); ++p)
      if (!std::isfinite(rate_of(i, p)))
        return fmt::format("measured number {} has no derivative with respect to {}: {}", i + 1, paths_[p],
                           last_.parameters[p].reason);
  return {};
}

bool FitProblem::has(const Measurement& m) const {
  if (m.event > last_.events.size()) return false;
  const Event& event = last_.events[m.event - 1];
  if (!m.type.empty() && m.type != to_string(event.type)) return false;
  return m.contact.empty() ||
         (event.contact >= 0 && last_.contacts[static_cast<std::size_t>(event.contact)] == m.contact);
}

std::pair<std::size_t, std::size_t> FitProblem::place_of(const Measurement& m) const {
  const auto column = std::find(last_.columns.begin(), last_.columns.end(), m.column);
  if (column == last_.columns.end()) throw UsageError(fmt::format("the run has no column \"{}\"", m.column));
  const auto row = std::find(last_.times.begin(), last_.times.end(), m.t);
  return {static_cast<std::size_t>(row - last_.times.begin()),
          static_cast<std::size_t>(column - last_.columns.begin())};
}

double FitProblem::rate_of(std::size_t i, std::size_t p) const {
  const Measurement& m = measured_.rows[i];
  if (m.event > 0) return has(m) ? last_.event_rates[m.event - 1][p].t : EventRates::none;
  const auto [row, column] = place_of(m);
  return row < last_.value_rates[p].size() ? last_.value_rates[p][row][column] : EventRates::none;
}

/// Runs with these keys, unless the last run already had them.
bool FitProblem::run(const std::vector<double>& keys) {
  if (failure_) return false;
  if (keys == keys_) return true;
  if (go_on_ && !go_on_()) return false;
  keys_ = keys;
  try {
    last_ =
        sensitivities([&](const std::vector<Override>& changes) { return scene_at(keys, changes); }, paths_);
    for (const Measurement& m : measured_.rows)
      if (m.event == 0) static_cast<void>(place_of(m));
    scene_refused_ = false;
  } catch (const Error&) {  // exceptions must not pass through frames of GSL
    if (runs_ == 0) failure_ = std::current_exception();
    scene_refused_ = true;
  }
  ++runs_;
  return !failure_;
}

Scene FitProblem::scene_at(const std::vector<double>& keys, const std::vector<Override>& changes) const {
  std::vector<Override> all;
  for (std::size_t p = 0; p < paths_.size(); ++p) all.push_back(set_to(paths_[p], keys[p]));
  if (!times_.empty()) {
    std::string list;
    for (const double t : times_) list += (list.empty() ? "[" : ", ") + base::format_number(t);
    all.push_back({"run.output_times", list + "]"});
  }
  all.insert(all.end(), changes.begin(), changes.end());
  return read_(all);
}

namespace {

// Derivatives are accurate to 1e-9 or better, because the differences of model data have that accuracy
// (model_derivative.hpp). If changing a key by its own size changes the measured numbers by less than this fraction, the
// change is a rounding error.
constexpr double rounding_of_rates = 1e-9;
// Limit for singular values, relative to the largest one of J with columns of norm 1. For two keys with the same effect,
// rounding errors give about 1e-9; at 1e-3 measurements may still distinguish two keys. Chosen value between both.
constexpr double dependent = 1e-6;
// A key is undetermined if its component in an undetermined combination (norm 1) exceeds this limit. Chosen value, far above
// the rounding error 1e-9 divided by `dependent`.
constexpr double takes_part = 1e-2;

}  // namespace

LinearFit linear_fit(const gsl_vector& f, const gsl_matrix& J, const std::vector<double>& size,
                     double measured) {
  const std::size_t rows = J.size1, keys = J.size2;
  LinearFit fit{
      std::vector<double>(keys, 0.0), std::vector<double>(keys, 0.0), {}, std::vector<bool>(keys, true), 0};
  fit.covariance.assign(keys, std::vector<double>(keys, 0.0));
  const GslMatrix U(gsl_matrix_alloc(rows, keys)), V(gsl_matrix_alloc(keys, keys));
  const GslVector S(gsl_vector_alloc(keys));
  gsl_matrix_memcpy(U.get(), &J);
  std::vector<double> norm(keys);
  for (std::size_t j = 0; j < keys; ++j) {
    gsl_vector_view column = gsl_matrix_column(U.get(), j);
    gsl_blas_ddot(&column.vector, &f, &fit.slope[j]);
    norm[j] = gsl_blas_dnrm2(&column.vector);
    fit.determined[j] = norm[j] * size[j] > rounding_of_rates * measured;
    gsl_vector_scale(&column.vector, fit.determined[j] ? 1.0 / norm[j] : 0.0);
  }
  gsl_linalg_SV_decomp_jacobi(U.get(), V.get(), S.get());
  const double greatest = gsl_vector_max(S.get());
  for (std::size_t k = 0; k < keys; ++k) {
    const double s = gsl_vector_get(S.get(), k);
    if (!(s > dependent * greatest)) {
      for (std::size_t j = 0; j < keys; ++j)
        if (std::abs(gsl_matrix_get(V.get(), j, k)) > takes_part) fit.determined[j] = false;
      continue;
    }
    ++fit.rank;
    double along = 0.0;
    const gsl_vector_const_view u = gsl_matrix_const_column(U.get(), k);
    gsl_blas_ddot(&u.vector, &f, &along);
    for (std::size_t i = 0; i < keys; ++i) {
      if (norm[i] == 0.0) continue;
      const double vi = gsl_matrix_get(V.get(), i, k) / norm[i];
      fit.step[i] -= vi * along / s;
      for (std::size_t j = 0; j < keys; ++j)
        if (norm[j] > 0.0) fit.covariance[i][j] += vi * gsl_matrix_get(V.get(), j, k) / norm[j] / (s * s);
    }
  }
  return fit;
}

}  // namespace signorini::sensitivity
