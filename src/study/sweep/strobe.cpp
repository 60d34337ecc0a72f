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
  const std::size_t at = text.find('@');
  const std::string name = text.substr(0, at);
  std::vector<std::string> types, contacts;
  for (const EventTypeName& type : all_event_types) {
    types.emplace_back(type.name);
    if (name == type.name) strobe.event = type.type;
  }
  for (const Contact& contact : model.contacts) contacts.push_back(contact.name);
  if (std::find(types.begin(), types.end(), name) == types.end())
    throw UsageError(fmt::format("{}: found \"{}\", expected a period, EVENT or EVENT@CONTACT{}", option,
                                 name, suggestion(name, types)));
  if (at == std::string::npos) return strobe;
  strobe.contact = text.substr(at + 1);
  if (std::find(contacts.begin(), contacts.end(), strobe.contact) == contacts.end())
    throw UsageError(fmt::format("{}: unknown contact \"{}\"{}", option, strobe.contact,
                                 suggestion(strobe.contact, contacts)));
  return strobe;
}

std::vector<StrobeColumn> strobe_columns(const Model& model) {
  std::vector<StrobeColumn> list;
  for (const Column& column : model.columns) {
    const std::string unit = model.turns(column) ? "rad" : model.units.length;
    list.push_back({column.name, column.velocity ? unit + "/" + model.units.time : unit, false});
  }
  for (const Output& output : model.outputs)
    list.push_back({output.name, unit_text(output.unit, model.units), true});
  return list;
}

void StrobeRecorder::event(const Event& event) {
  Relay::event(event);
  if (strobe_.period > 0.0 || event.type != strobe_.event) return;
  const bool ours = strobe_.contact.empty() ||
                    (event.contact >= 0 &&
                     model_.contacts[static_cast<std::size_t>(event.contact)].name == strobe_.contact);
  if (ours) event_ = event.t;
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
  for (const Column& column : model_.columns)
    point.values.push_back((column.velocity ? *now.v : *now.u)[column.dof]);
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
