#include "scene/history_from_spec.hpp"

#include <fmt/core.h>
#include <gsl/gsl_interp.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "base/text.hpp"

namespace signorini::scene {
namespace {

Piece polynomial(double origin, std::vector<double> coefficients) {
  Piece p;
  p.origin = origin;
  p.coefficients = std::move(coefficients);
  return p;
}

Piece sine(double origin, double omega, double phase) {
  Piece p;
  p.origin = origin;
  p.amplitude = 1.0;
  p.omega = omega;
  p.phase = phase;
  return p;
}

/// History that equals `inside` on [start, end) and is zero elsewhere.
History window(const Piece& inside, double start, double end) {
  if (std::isinf(end)) return History({start}, {Piece{}, inside});
  return History({start, end}, {Piece{}, inside, Piece{}});
}

History triangle(double start, double end) {
  const double middle = 0.5 * (start + end), slope = 1.0 / (middle - start);
  return History({start, middle, end},
                 {Piece{}, polynomial(start, {0.0, slope}), polynomial(end, {0.0, -slope}), Piece{}});
}

/// Steffen's slopes dy/dt at the n points (t, y) of a stretch of a table without jumps.
std::vector<double> steffen_slopes(const double* t, const double* y, std::size_t n) {
  std::unique_ptr<gsl_interp, void (*)(gsl_interp*)> interp(gsl_interp_alloc(gsl_interp_steffen, n),
                                                            gsl_interp_free);
  gsl_interp_init(interp.get(), t, y, n);
  std::vector<double> slopes(n);
  for (std::size_t i = 0; i < n; ++i) slopes[i] = gsl_interp_eval_deriv(interp.get(), t, y, t[i], nullptr);
  return slopes;
}

/// Appends the pieces of a stretch of a table; the n times of the stretch ascend strictly.
void append_stretch(const double* t, const double* y, std::size_t n, bool steffen,
                    std::vector<double>& starts, std::vector<Piece>& pieces) {
  std::vector<double> d;
  if (steffen && n >= 3) d = steffen_slopes(t, y, n);  // GSL needs three points; two points are a line
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double h = t[i + 1] - t[i], slope = (y[i + 1] - y[i]) / h;
    starts.push_back(t[i]);
    if (d.empty())
      pieces.push_back(polynomial(t[i], {y[i], slope}));
    else
      pieces.push_back(polynomial(t[i], {y[i], d[i], (3.0 * slope - 2.0 * d[i] - d[i + 1]) / h,
                                         (d[i] + d[i + 1] - 2.0 * slope) / (h * h)}));
  }
}

History table(const HistorySpec& spec, const std::string& key) {
  const auto& t = spec.times;
  const auto& y = spec.values;
  if (t.size() != y.size())
    throw SceneError(spec.place, key,
                     fmt::format("found {} for {}, expected one value for each time",
                                 base::count_text(y.size(), "value"), base::count_text(t.size(), "time")));
  if (t.size() < 2) throw SceneError(spec.place, key, "found fewer than two times, expected at least two");
  for (std::size_t i = 1; i < t.size(); ++i)
    if (!(t[i] >= t[i - 1]))
      throw SceneError(spec.place, key,
                       fmt::format("found time {} after {}, expected ascending times", t[i], t[i - 1]));
  std::vector<double> starts;
  std::vector<Piece> pieces{Piece{}};
  for (std::size_t from = 0; from < t.size();) {
    std::size_t to = from + 1;
    while (to < t.size() && t[to] > t[to - 1]) ++to;
    append_stretch(&t[from], &y[from], to - from, spec.steffen, starts, pieces);
    from = to;
  }
  if (starts.empty())
    throw SceneError(spec.place, key, "found equal times only, expected at least two different times");
  starts.push_back(t.back());
  pieces.push_back(spec.hold ? polynomial(t.back(), {y.back()}) : Piece{});
  return History(std::move(starts), std::move(pieces));
}

/// End of a pulse: a rectangle, triangle or half sine. Errors: SceneError if the history has no end.
double pulse_end(const HistorySpec& spec, const std::string& key) {
  if (!std::isfinite(spec.end))
    throw SceneError(spec.place, key,
                     "found no finite end time, expected one, because the history is a pulse");
  return spec.end;
}

History shape(const HistorySpec& spec, const std::string& key) {
  if (spec.type == HistoryType::table) return table(spec, key);
  if (!(spec.end > spec.start))
    throw SceneError(
        spec.place, key,
        fmt::format("found end {} with start {}, expected an end after the start", spec.end, spec.start));
  switch (spec.type) {
    case HistoryType::constant:
      if (spec.start_given) return window(polynomial(0.0, {1.0}), spec.start, spec.end);
      if (std::isinf(spec.end)) return History::constant(1.0);
      return History({spec.end}, {polynomial(0.0, {1.0}), Piece{}});
    case HistoryType::step:
      return window(polynomial(0.0, {1.0}), spec.start, spec.end);
    case HistoryType::rectangle:
      return window(polynomial(0.0, {1.0}), spec.start, pulse_end(spec, key));
    case HistoryType::triangle:
      return triangle(spec.start, pulse_end(spec, key));
    case HistoryType::half_sine: {
      const double end = pulse_end(spec, key);
      return window(sine(spec.start, std::numbers::pi / (end - spec.start), 0.0), spec.start, end);
    }
    case HistoryType::harmonic:
      return window(sine(spec.start, spec.omega, spec.phase), spec.start, spec.end);
    case HistoryType::polynomial:
      return window(polynomial(spec.start, spec.coefficients), spec.start, spec.end);
    case HistoryType::table:
      break;
  }
  return {};
}

}  // namespace

History make_history(const HistorySpec& spec, const std::string& key) try {
  if (spec.in_code) return spec.in_code->scaled(spec.amplitude, spec.offset);
  History f = shape(spec, key);
  if (spec.period > 0.0) {
    const double start = spec.type == HistoryType::table ? spec.times.front() : spec.start;
    f = f.repeated(start, spec.period, spec.rounds);
  }
  if (spec.shift != 0.0) f = f.shifted(spec.shift);
  return f.scaled(spec.amplitude, spec.offset);
} catch (const std::invalid_argument&) {  // thrown by History if rounding makes two start times equal
  throw SceneError(
      spec.place, key,
      "found start, end, shift or period whose sums overflow, or become equal by rounding; expected "
      "distinct, finite times");
}

History make_integral(const HistorySpec& spec, const std::string& key) {
  History f = make_history(spec, key);
  if (!f.has_closed_form())
    throw SceneError(spec.place, key,
                     "found a user-defined function, expected a history whose integral is known");
  return f.integrated();
}

}  // namespace signorini::scene
