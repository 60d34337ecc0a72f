#include "study/sweep/stroboscopic_map.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.hpp"
#include "orbit/load_period.hpp"
#include "signorini/error.hpp"
#include "study/prepared_run.hpp"

namespace signorini::sweep {
namespace {

// Relative difference up to which two periods have a ratio of integers, as in orbit/load_period.cpp.
constexpr double same_period = 1e-9;

/// Number of complete periods in the time t.
double whole_periods(double t, double period) { return std::floor(t / period * (1.0 + same_period)); }

StroboscopicMap strobe_of_loads(const std::string& option, const Scene& scene) {
  const std::optional<double> period = orbit::load_period(scene).period;
  if (!period)
    throw UsageError(option + ": the scene has no periodic load; expected a period in place of `loads`");
  if (whole_periods(scene.run.t_end, *period) < 1.0)
    throw UsageError(fmt::format("{}: the loads' period {:g} is longer than the run, t_end = {:g}", option,
                                 *period, scene.run.t_end));
  StroboscopicMap strobe;
  strobe.text = "loads";
  strobe.period = *period;
  strobe.of_loads = true;
  return strobe;
}

}  // namespace

StroboscopicMap parse_strobe(const std::string& text, const Scene& scene, const Model& model) {
  const std::string option = "--strobe " + text;
  if (!base::is_plain_text(text))
    throw UsageError(base::excerpt(option) + ": found bytes that are not plain UTF-8 text");
  if (text == "loads") return strobe_of_loads(option, scene);
  StroboscopicMap strobe;
  strobe.text = text;
  if (const std::optional<double> period = base::parse_number(text)) {
    if (!(*period > 0.0) || !std::isfinite(*period)) throw UsageError(option + ": expected a period above 0");
    strobe.period = *period;
    return strobe;
  }
  const std::optional<EventQuery> event = parse_event_query(option, text, model);
  if (!event) {
    const std::string name = text.substr(0, text.find('@'));
    throw UsageError(fmt::format("{}: found \"{}\", expected a period, loads, EVENT or EVENT@CONTACT{}",
                                 option, name, base::suggestion(name, event_names())));
  }
  strobe.event = *event;
  return strobe;
}

std::string strobe_warning(const StroboscopicMap& strobe, const Scene& scene) {
  if (strobe.period == 0.0 || strobe.of_loads) return {};
  std::optional<double> period;
  try {
    period = orbit::load_period(scene).period;
  } catch (const SceneError&) {  // if the loads have no common period, points have no phase
    return {};
  }
  if (!period) return {};
  const double turns = strobe.period / *period;
  if (turns > 0.5 && std::abs(turns - std::round(turns)) <= same_period * turns) return {};
  return fmt::format(
      "--strobe {}: the period of the loads is {}, so the points of one run are states at different phases "
      "of the loads; use --strobe loads, which takes the period of the loads of each run",
      strobe.text, base::format_number(*period));
}

std::vector<StroboscopicColumn> strobe_columns(const Model& model) {
  std::vector<StroboscopicColumn> list;
  for (const Column& column : model.columns) list.push_back({column.name, model.unit_of(column), false});
  for (const Output& output : model.outputs)
    list.push_back({output.name, unit_text(output.unit, model.units), true});
  return list;
}

void StroboscopicRecorder::event(const Event& event) {
  run::ForwardingRecorder::event(event);
  if (strobe_.period == 0.0 && strobe_.event.matches(event, model_)) event_ = event.t;
}

void StroboscopicRecorder::sample(const Sample& sample) {
  run::ForwardingRecorder::sample(sample);
  if (strobe_.period == 0.0) return;
  const double turns = std::round(sample.t / strobe_.period);
  // Rows are at k times the period up to rounding; the end of the run is also a row.
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * std::abs(sample.t);
  if (turns < 1.0 || std::abs(sample.t - turns * strobe_.period) > rounding) return;
  // The sample before a jump of the state has the same time. The point is the state after the jump.
  if (!points_.empty() && points_.back().t == sample.t) points_.pop_back();
  add(sample);
}

bool StroboscopicRecorder::steer(const Sample& now, Steering& run) {
  if (event_ && now.t >= *event_) {
    event_.reset();
    add(now);
  }
  return run::ForwardingRecorder::steer(now, run);
}

void StroboscopicRecorder::response(double t, const std::vector<double>& values) {
  run::ForwardingRecorder::response(t, values);
  t_outputs_ = t;
  outputs_ = values;
  if (!points_.empty() && points_.back().t == t) fill_outputs(points_.back());
}

void StroboscopicRecorder::add(const Sample& now) {
  if (now.t < settle_) return;
  StroboscopicPoint point{now.t, {}};
  for (const Column& column : model_.columns) point.values.push_back(column.value(*now.u, *now.v));
  point.values.resize(model_.columns.size() + model_.outputs.size(),
                      std::numeric_limits<double>::quiet_NaN());
  if (t_outputs_ == now.t) fill_outputs(point);
  points_.push_back(std::move(point));
}

void StroboscopicRecorder::fill_outputs(StroboscopicPoint& point) const {
  std::copy(outputs_.begin(), outputs_.end(),
            point.values.begin() + static_cast<std::ptrdiff_t>(model_.columns.size()));
}

RunSpec with_strobe_rows(RunSpec run, const StroboscopicMap& strobe) {
  run = study::without_rows(std::move(run));
  if (strobe.period == 0.0) return run;
  run.output_times.reset();
  run.output_dt = strobe.period;
  if (strobe.of_loads) run.t_end = whole_periods(run.t_end, strobe.period) * strobe.period;
  return run;
}

}  // namespace signorini::sweep
