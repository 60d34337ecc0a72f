#include "study/sweep/strobe.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/excerpt.hpp"
#include "base/number.hpp"
#include "base/suggest.hpp"
#include "signorini/error.hpp"
#include "study/prepared_run.hpp"

namespace signorini {

Strobe parse_strobe(const std::string& text, const Model& model) {
  const std::string option = "--strobe " + text;
  if (!is_plain_text(text)) throw UsageError(excerpt(option) + ": found bytes that are no plain UTF-8 text");
  Strobe strobe;
  strobe.text = text;
  if (const std::optional<double> period = parse_number(text)) {
    if (!(*period > 0.0) || !std::isfinite(*period)) throw UsageError(option + ": expected a period above 0");
    strobe.period = *period;
    return strobe;
  }
  const std::optional<EventQuery> event = parse_event_query(option, text, model);
  if (!event) {
    const std::string name = text.substr(0, text.find('@'));
    throw UsageError(fmt::format("{}: found \"{}\", expected a period, EVENT or EVENT@CONTACT{}", option,
                                 name, suggestion(name, event_names())));
  }
  strobe.event = *event;
  return strobe;
}

std::vector<StrobeColumn> strobe_columns(const Model& model) {
  std::vector<StrobeColumn> list;
  for (const Column& column : model.columns) list.push_back({column.name, model.unit_of(column), false});
  for (const Output& output : model.outputs)
    list.push_back({output.name, unit_text(output.unit, model.units), true});
  return list;
}

void StrobeRecorder::event(const Event& event) {
  Relay::event(event);
  if (strobe_.period == 0.0 && strobe_.event.meets(event, model_)) event_ = event.t;
}

void StrobeRecorder::sample(const Sample& sample) {
  Relay::sample(sample);
  if (strobe_.period == 0.0) return;
  const double turns = std::round(sample.t / strobe_.period);
  // Rows are at k times the period as numbers go; the end of the run is a row, too.
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * std::abs(sample.t);
  if (turns < 1.0 || std::abs(sample.t - turns * strobe_.period) > rounding) return;
  if (!points_.empty() && points_.back().t == sample.t) points_.pop_back();  // its other side
  add(sample);
}

bool StrobeRecorder::steer(const Sample& now, Steering& run) {
  if (event_ && now.t >= *event_) {
    event_.reset();
    add(now);
  }
  return Relay::steer(now, run);
}

void StrobeRecorder::response(double t, const std::vector<double>& values) {
  Relay::response(t, values);
  t_outputs_ = t;
  outputs_ = values;
  if (!points_.empty() && points_.back().t == t) fill_outputs(points_.back());
}

void StrobeRecorder::add(const Sample& now) {
  if (now.t < settle_) return;
  StrobePoint point{now.t, {}};
  for (const Column& column : model_.columns) point.values.push_back(column.of(*now.u, *now.v));
  point.values.resize(model_.columns.size() + model_.outputs.size(),
                      std::numeric_limits<double>::quiet_NaN());
  if (t_outputs_ == now.t) fill_outputs(point);
  points_.push_back(std::move(point));
}

void StrobeRecorder::fill_outputs(StrobePoint& point) const {
  std::copy(outputs_.begin(), outputs_.end(),
            point.values.begin() + static_cast<std::ptrdiff_t>(model_.columns.size()));
}

RunSpec strobed(RunSpec run, const Strobe& strobe) {
  run = without_rows(std::move(run));
  if (strobe.period == 0.0) return run;
  run.output_times.reset();
  run.output_dt = strobe.period;
  return run;
}

}  // namespace signorini
