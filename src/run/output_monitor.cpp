#include "run/output_monitor.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "run/output_resolution.hpp"

namespace signorini::run {
namespace {

double given_at(const Output::Given& given, double t, motion::Side side) {
  return (side == motion::Side::after ? given.history.piece(t) : given.history.piece_before(t)).value(t);
}

double restored(const Output::Restoring& r, const motion::Point& point, const ForceLayout& layout) {
  return r.factor * (-point.N(layout, r.contact) - r.scene_force) * r.slip.dot(point.u);
}

void take(OutputReading& all, const OutputReading& part) {
  if (part.greatest > all.greatest) all.greatest = part.greatest, all.at_greatest = part.at_greatest;
  if (part.least < all.least) all.least = part.least, all.at_least = part.at_least;
}

}  // namespace

double value_of(const Output& output, double t, motion::Side side, const motion::Point& point,
                const ForceLayout& layout, const std::vector<double>& losses) {
  if (output.loss) return *output.loss < losses.size() ? losses[*output.loss] : 0.0;
  double sum = output.constant + output.u.dot(point.u) + output.v.dot(point.v);
  if (!output.a.terms.empty() && point.a.size() > 0) sum += output.a.dot(point.a);
  for (const Output::ContactForces& f : output.forces)
    sum += f.N * point.N(layout, f.contact) + f.T * point.T(layout, f.contact);
  for (const Output::Restoring& r : output.restoring) sum += restored(r, point, layout);
  for (const Output::Given& g : output.given) sum += given_at(g, t, side);
  return sum;
}

OutputReading along_stretch(const Output& output, std::size_t i,
                            const base::PolynomialInterpolation::Values& values) {
  const Output::Segment& stretch = output.segments[i];
  const base::PolynomialInterpolation::Extremes e =
      base::PolynomialInterpolation::extremes(values, stretch.at.size());
  const auto place = [&](double x) {
    return OutputPlace{static_cast<int>(i), stretch.begin + x * (stretch.end - stretch.begin)};
  };
  return {std::max(e.greatest, -e.least), e.greatest, e.least, place(e.at_greatest), place(e.at_least)};
}

OutputReading reading_of(const Output& output, double t, motion::Side side, const motion::Point& point,
                         const ForceLayout& layout, const std::vector<double>& losses) {
  OutputReading all;
  if (output.segments.empty()) {
    all.value = all.greatest = all.least = value_of(output, t, side, point, layout, losses);
    return all;
  }
  for (std::size_t i = 0; i < output.segments.size(); ++i) {
    const std::vector<Output>& at = output.segments[i].at;
    base::PolynomialInterpolation::Values values{};
    for (std::size_t j = 0; j < at.size(); ++j) values[j] = value_of(at[j], t, side, point, layout, losses);
    const OutputReading part = along_stretch(output, i, values);
    if (i == 0)
      all = part;
    else
      take(all, part);
  }
  all.value = std::max(all.greatest, -all.least);
  return all;
}

double magnitude_of(const Output& output, double t, motion::Side side, const motion::Point& point,
                    const ForceLayout& layout) {
  double sum = std::abs(output.constant) + output.u.magnitude(point.u) + output.v.magnitude(point.v);
  if (!output.a.terms.empty() && point.a.size() > 0) sum += output.a.magnitude(point.a);
  for (const Output::ContactForces& f : output.forces)
    sum += std::abs(f.N * point.N(layout, f.contact)) + std::abs(f.T * point.T(layout, f.contact));
  for (const Output::Restoring& r : output.restoring) sum += std::abs(restored(r, point, layout));
  for (const Output::Given& g : output.given) sum += std::abs(given_at(g, t, side));
  return sum;
}

namespace {

// Two extremes are equal if their relative difference is smaller than this; the earlier extreme is then reported.
constexpr double tie = rounding::few_operations;
// Allowed error of p, as a fraction of |r|, if the turning points of p are used. A phase error d of a turning point changes
// the extreme by about |r| d^2.
constexpr double located = 1e-12;
// Length of a part in radians of the fastest motion: five points detect whether the motion oscillates there. Chosen value;
// a single peak that is narrower than a fifth of a part may be missed.
constexpr double longest = 32.0;
// Limit of the number of parts in a run. So many parts have at least 1e8 points, whose evaluation takes hours for most models.
// Chosen value.
constexpr double max_pieces = 1e7;
// Motion below this fraction of the allowed error need not be resolved: a polynomial through 17 points has an error of
// less than four times the unresolved motion (1 + the Lebesgue constant of the points).
constexpr double hidden = 0.25;

/// Allowed error e of the polynomial of half the degree, so that p has an error of at most `accuracy`. varies: variation of
/// the values in the part. Errors of degree n, relative to this variation, are proportional to (length of the part)^(n+1).
double resolved(std::size_t stride, double varies, double accuracy) {
  if (!(varies > accuracy)) return accuracy;
  const double power = stride == 1 ? 9.0 / 17.0 : stride == 2 ? 5.0 / 9.0 : 3.0 / 5.0;
  return varies * std::pow(accuracy / varies, power);
}

/// True if the output depends on displacements and velocities only.
bool is_of_motion(const Output& linear) {
  return linear.a.terms.empty() && linear.forces.empty() && linear.restoring.empty();
}

}  // namespace

OutputMonitor::OutputMonitor(const Model& model, double t_end, Recorder& recorder, bool dense)
    : model_(model),
      recorder_(recorder),
      fast_mode_cutoff_(model, t_end),
      dense_(dense),
      extremes_(model.outputs.size()) {
  for (std::size_t i = 0; i < model.outputs.size(); ++i) {
    const Output& output = model.outputs[i];
    if (output.segments.empty()) watched_.push_back({i, -1, forms_.size(), 1});
    for (std::size_t j = 0; j < output.segments.size(); ++j) {
      const std::size_t points = output.segments[j].at.size();
      watched_.push_back({i, static_cast<int>(j), forms_.size() + j * points, points});
    }
    for_each_linear(output, [&](const Output& o) { forms_.push_back(&o); });
  }
  magnitudes_.resize(forms_.size());
  samples_.resize(forms_.size());
}

void OutputMonitor::evaluate(double t, motion::Side side, const motion::Point& point,
                             const std::vector<double>& losses, std::vector<OutputReading>& readings) const {
  readings.clear();
  for (const Output& output : model_.outputs)
    readings.push_back(reading_of(output, t, side, point, model_.layout, losses));
}

void OutputMonitor::update_extremes(std::size_t i, double t, const OutputReading& r) {
  OutputExtremes& e = extremes_[i];
  const double equal_to_most = tie * std::abs(e.maximum), equal_to_least = tie * std::abs(e.minimum);
  if (r.greatest > e.maximum + equal_to_most ||
      (t < e.t_maximum && r.greatest >= e.maximum - equal_to_most)) {
    e.maximum = std::max(r.greatest, e.maximum);
    e.t_maximum = t;
    e.at_maximum = r.at_greatest;
  }
  if (r.least < e.minimum - equal_to_least || (t < e.t_minimum && r.least <= e.minimum + equal_to_least)) {
    e.minimum = std::min(r.least, e.minimum);
    e.t_minimum = t;
    e.at_minimum = r.at_least;
  }
}

void OutputMonitor::write(double t, const std::vector<OutputReading>& readings) {
  std::vector<double> values;
  for (const OutputReading& r : readings) values.push_back(r.value);
  if (began_ && t == last_t_ && values == last_) return;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const OutputReading& r = readings[i];
    if (!began_) extremes_[i] = {r.greatest, r.least, r.value, t, t, r.at_greatest, r.at_least};
    update_extremes(i, t, r);
    extremes_[i].last = r.value;
  }
  began_ = true;
  last_t_ = t;
  recorder_.response(t, values);
  last_ = std::move(values);
}

void OutputMonitor::before(double t, const motion::Point& point, const std::vector<double>& losses) {
  if (!has_outputs()) return;
  evaluate(t, motion::Side::before, point, losses, before_);
  before_t_ = t;
}

void OutputMonitor::row(double t, motion::Side side, const motion::Point& point,
                        const std::vector<double>& losses) {
  if (!has_outputs()) return;
  evaluate(t, side, point, losses, readings_);
  if (before_t_ == t) write(t, before_);
  before_t_ = -1.0;
  write(t, readings_);
  for (const Output& sum : model_.reaction_sums) {
    const double off = std::abs(value_of(sum, t, side, point, model_.layout, none_));
    if (off > reactions_.value) reactions_ = {off, t, -1};
  }
}

void OutputMonitor::search_step(engine::DenseOutput& motion, double begin, double end) {
  if (!has_outputs() || !(end > begin)) return;
  std::vector<char> open, at_end(model_.outputs.size(), 0);
  for (const Watched& watched : watched_) {
    const std::span forms = std::span(forms_).subspan(watched.first, watched.count);
    const bool loss = forms.front()->loss.has_value();
    const bool between =
        !loss && (dense_ || std::all_of(forms.begin(), forms.end(),
                                        [](const Output* linear) { return is_of_motion(*linear); }));
    open.push_back(between ? 1 : 0);
    if (!between && !loss) at_end[watched.output] = 1;
  }
  if (std::find(at_end.begin(), at_end.end(), 1) != at_end.end()) {
    motion.evaluate(end, point_);
    motion.accelerate(end, point_);
    for (std::size_t i = 0; i < at_end.size(); ++i)
      if (at_end[i] != 0)
        update_extremes(
            i, end, reading_of(model_.outputs[i], end, motion::Side::before, point_, model_.layout, none_));
  }
  radian_ = 1.0 / turning(motion, {begin, end, open});
  const double pieces = std::max(1.0, std::ceil((end - begin) / (longest * radian_)));
  double from = begin;
  for (double k = 1.0; k <= pieces; ++k) {
    const double to = k == pieces ? end : begin + k / pieces * (end - begin);
    std::vector<Part> parts{{from, to, open}};
    from = to;
    while (!parts.empty()) {
      Part part = std::move(parts.back());
      parts.pop_back();
      if (!sample_part(motion, part, begin)) continue;
      const double middle = 0.5 * (part.begin + part.end);
      // The earlier half is searched first, because the first of equal extremes is reported.
      parts.push_back({middle, part.end, part.open});
      parts.push_back({part.begin, middle, std::move(part.open)});
    }
  }
}

/// Rate, in rad per time, of the fastest motion that outputs show in a step.
double OutputMonitor::turning(engine::DenseOutput& motion, const Part& step) {
  const engine::StepFacts facts = motion.facts();
  double omega = fast_mode_cutoff_.max_rate(facts.phase_angle, step.begin, step.end);
  const engine::FastModes* modes = facts.fast_modes;
  if (omega * (step.end - step.begin) > longest && modes != nullptr && modes->fast_mode_bound(omega)) {
    for (std::size_t j = 0; j < Chebyshev::count; ++j) sample(motion, step, step.begin, j);
    for (std::size_t k = 0; k < watched_.size(); ++k)
      if (step.open[k] != 0 && watched_[k].stretch >= 0) update_from_samples(watched_[k], step, 1);
    for (std::size_t i = form_norms_.size(); i < forms_.size(); ++i)
      form_norms_.push_back(form_norm_of(*modes, *forms_[i]));
    const engine::FastModeBound whole = modes->term_sizes();
    omega = fast_mode_cutoff_.output_rate(
        *modes, omega, [&](const engine::FastModeBound& r) { return is_rounding(r, whole); });
  }
  // The limit of max_pieces never applies to a step that is a single part.
  const double most =
      std::max(fast_mode_cutoff_.fastest(max_pieces * longest), longest / (step.end - step.begin));
  if (omega > most && !coarse_warning_)
    coarse_warning_ = fmt::format(
        "outputs: the phase of the fastest motion advances by {:.2g} radians in the run, but extremes were "
        "searched for in intervals of {:.2g} radians of this phase, so a peak may be missed",
        omega / fast_mode_cutoff_.fastest(1.0), omega / most * longest);
  return std::min(omega, most);
}

/// True if the fast motion `fast_bound` is negligible in every output, at every position of its segments: it is smaller than
/// the rounding of the output's terms, the rounding of the sums over modes (`whole`), or the allowed error of p.
bool OutputMonitor::is_rounding(const engine::FastModeBound& fast_bound,
                                const engine::FastModeBound& whole) const {
  for (const Watched& watched : watched_) {
    const OutputExtremes& known = extremes_[watched.output];
    double magnitude = 0.0, most = 0.0, terms = 0.0;
    for (std::size_t i = watched.first; i < watched.first + watched.count; ++i) {
      magnitude = std::max(magnitude, magnitudes_[i]);
      most = std::max(most, fast_mode_contribution(fast_bound, form_norms_[i], *forms_[i], model_.layout));
      terms = std::max(terms, fast_mode_contribution(whole, form_norms_[i], *forms_[i], model_.layout));
    }
    const double size = std::max(std::abs(known.maximum), std::abs(known.minimum));
    const double counts =
        std::max({located * size, rounding::elimination * magnitude, rounding::many_operations * terms});
    if (!(most <= hidden * counts)) return false;
  }
  return true;
}

/// Updates the extremes of an output, or of a segment, at the points of a part.
void OutputMonitor::update_from_samples(const Watched& watched, const Part& part, std::size_t stride) {
  const std::span<const Chebyshev::Values> all = samples_of(watched);
  const Output& output = model_.outputs[watched.output];
  const double half = 0.5 * (part.end - part.begin);
  for (std::size_t j = 0; j < Chebyshev::count; j += stride) {
    const double x = Chebyshev::nodes()[j];
    base::PolynomialInterpolation::Values values{};
    for (std::size_t i = 0; i < watched.count; ++i) values[i] = all[i][j];
    update_extremes(watched.output, j + 1 == Chebyshev::count ? part.end : part.begin + half * (x + 1.0),
                    along_stretch(output, static_cast<std::size_t>(watched.stretch), values));
  }
}

std::span<const Chebyshev::Values> OutputMonitor::samples_of(const Watched& watched) const {
  return std::span(samples_).subspan(watched.first, watched.count);
}

void OutputMonitor::sample(engine::DenseOutput& motion, const Part& part, double begin, std::size_t point) {
  const double x = Chebyshev::nodes()[point];
  const double t =
      point + 1 == Chebyshev::count ? part.end : part.begin + 0.5 * (x + 1.0) * (part.end - part.begin);
  motion.interpolate(t, point_);
  const motion::Side side = t == begin ? motion::Side::after : motion::Side::before;
  for (std::size_t k = 0; k < watched_.size(); ++k) {
    if (part.open[k] == 0) continue;
    const Watched& watched = watched_[k];
    for (std::size_t i = watched.first; i < watched.first + watched.count; ++i) {
      samples_[i][point] = value_of(*forms_[i], t, side, point_, model_.layout, none_);
      // Segments have many forms, so their magnitudes are computed only once per part.
      if (watched.stretch < 0 || point == 0)
        magnitudes_[i] = std::max(magnitudes_[i], magnitude_of(*forms_[i], t, side, point_, model_.layout));
    }
    const double value = samples_[watched.first][point];
    if (watched.stretch < 0) update_extremes(watched.output, t, {value, value, value, {}, {}});
  }
}

bool OutputMonitor::sample_part(engine::DenseOutput& motion, Part& part, double begin) {
  for (const std::size_t point : {0U, 8U, 16U}) sample(motion, part, begin, point);
  for (const std::size_t stride : {4U, 2U, 1U}) {
    for (std::size_t j = stride; j < Chebyshev::count; j += 2 * stride) sample(motion, part, begin, j);
    bool left = false;
    for (std::size_t k = 0; k < watched_.size(); ++k) {
      if (part.open[k] == 0) continue;
      if (settled(watched_[k], motion, part, stride)) part.open[k] = 0;
      left = left || part.open[k] != 0;
    }
    if (!left) return false;
  }
  if (part.end - part.begin > radian_) return true;
  for (std::size_t k = 0; k < watched_.size(); ++k)
    if (part.open[k] != 0) refine(watched_[k], motion, part, 1);
  return false;
}

bool OutputMonitor::settled(const Watched& watched, engine::DenseOutput& motion, const Part& part,
                            std::size_t stride) {
  const std::span<const Chebyshev::Values> all = samples_of(watched);
  double error = 0.0;
  for (const Chebyshev::Values& values : all)
    for (std::size_t j = stride; j < Chebyshev::count; j += 2 * stride)
      error = std::max(
          error, std::abs(Chebyshev::interpolate(values, 2 * stride, Chebyshev::nodes()[j]) - values[j]));
  if (watched.stretch >= 0) error *= base::PolynomialInterpolation::lebesgue;
  const OutputExtremes& known = extremes_[watched.output];
  const auto within = [&](const ValueBounds& b, double rest) {
    return b.greatest + rest <= known.maximum && b.least - rest >= known.minimum;
  };
  const ValueBounds at = bounds_along(all, stride, false);
  if (within(at, 2.0 * error + (at.greatest - at.least))) return true;
  if (stride < 4 && within(bounds_along(all, stride, true), 2.0 * error)) return true;
  // Largest value so far, including the samples of this part.
  const double size = std::max(std::abs(known.maximum), std::abs(known.minimum));
  double magnitude = 0.0;
  for (std::size_t i = watched.first; i < watched.first + watched.count; ++i)
    magnitude = std::max(magnitude, magnitudes_[i]);
  const double asked = resolved(stride, at.greatest - at.least, located * size);
  if (error > std::max(asked, rounding::elimination * magnitude)) return false;
  refine(watched, motion, part, stride);
  return true;
}

void OutputMonitor::refine(const Watched& watched, engine::DenseOutput& motion, const Part& part,
                           std::size_t stride) {
  if (watched.stretch < 0)
    refine_output(watched, motion, part, stride);
  else
    refine_stretch(watched, motion, part, stride);
}

void OutputMonitor::update_from_motion(const Watched& watched, engine::DenseOutput& motion, double t) {
  motion.interpolate(t, point_);
  const Output& output = model_.outputs[watched.output];
  base::PolynomialInterpolation::Values values{};
  for (std::size_t i = 0; i < watched.count; ++i)
    values[i] = value_of(*forms_[watched.first + i], t, motion::Side::before, point_, model_.layout, none_);
  update_extremes(watched.output, t,
                  watched.stretch < 0
                      ? OutputReading{values[0], values[0], values[0], {}, {}}
                      : along_stretch(output, static_cast<std::size_t>(watched.stretch), values));
}

void OutputMonitor::refine_output(const Watched& watched, engine::DenseOutput& motion, const Part& part,
                                  std::size_t stride) {
  const Chebyshev::Values& values = samples_[watched.first];
  const Chebyshev::Values& nodes = Chebyshev::nodes();
  const Chebyshev::Values slope = Chebyshev::slopes(values, stride);
  const double half = 0.5 * (part.end - part.begin);
  for (std::size_t j = 0; j + stride < Chebyshev::count; j += stride) {
    if ((slope[j] > 0.0) == (slope[j + stride] > 0.0)) continue;
    const double x = Chebyshev::extremum_between(slope, stride, nodes[j], nodes[j + stride]);
    const double p = Chebyshev::interpolate(values, stride, x);
    const OutputExtremes& known = extremes_[watched.output];
    const double rest = located * std::max(std::abs(known.maximum), std::abs(known.minimum));
    if (p + rest <= known.maximum && p - rest >= known.minimum) continue;
    update_from_motion(watched, motion, part.begin + half * (x + 1.0));
  }
}

void OutputMonitor::refine_stretch(const Watched& watched, engine::DenseOutput& motion, const Part& part,
                                   std::size_t stride) {
  const std::span<const Chebyshev::Values> all = samples_of(watched);
  const double half = 0.5 * (part.end - part.begin);
  update_from_samples(watched, part, stride);
  const OutputExtremes& known = extremes_[watched.output];
  const double rest = located * std::max(std::abs(known.maximum), std::abs(known.minimum));
  for (const double x : peaks_along(all, stride, 1.0, known.maximum + rest))
    update_from_motion(watched, motion, part.begin + half * (x + 1.0));
  for (const double x : peaks_along(all, stride, -1.0, known.minimum - rest))
    update_from_motion(watched, motion, part.begin + half * (x + 1.0));
}

}  // namespace signorini::run
