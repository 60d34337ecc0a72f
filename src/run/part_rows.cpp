#include "run/part_rows.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "base/rounding.hpp"
#include "motion/point.hpp"
#include "run/curve_record.hpp"
#include "scene/quantities.hpp"

namespace signorini::run {
namespace {

void add_to(Energy& sum, const Energy& part) {
  for (const EnergyColumn& column : energy_columns) sum.*column.value += part.*column.value;
}

}  // namespace

void PartRecorder::event(const Event& event) {
  Event own = event;
  if (own.contact >= 0) own.contact = static_cast<int>(part_.contacts[static_cast<std::size_t>(own.contact)]);
  events.push_back(std::move(own));
}

void PartRecorder::motion(int contact, const std::vector<MotionRow>& drawn_rows) {
  motions.resize(part_.contacts.size());
  motions[static_cast<std::size_t>(contact)] = drawn_rows;
}

PartRecorder::Row PartRecorder::row_of(const Sample& sample) {
  return {sample.t, *sample.u, *sample.v, sample.contacts, sample.energy};
}

PartRows::PartRows(const Model& whole, const std::vector<assembly::PartModel>& parts, double t_end,
                   Recorder& recorder, Report& report)
    : whole_(whole),
      parts_(parts),
      recorder_(recorder),
      report_(report),
      energy_sum_(whole, t_end, max_curve_points(drawn_columns(whole).size())),
      order_(whole, report) {}

std::size_t PartRows::forward(double t, bool last) {
  std::size_t events = 0;
  while (!stopped_at_ && complete(t, &PartRecorder::rows)) {
    const double at = recorders_.front()->rows.front().t;
    events += forward_events(at, true);
    forward_row(&PartRecorder::rows, &Recorder::sample);
    if (!recorder_.progress(at)) stopped_at_ = at;
  }
  if (!stopped_at_) events += forward_events(t, last);
  const double end = stopped_at_.value_or(t);
  while (complete(end, &PartRecorder::frames)) forward_row(&PartRecorder::frames, &Recorder::frame);
  energy_sum_.take(energy_lines_, end);
  return events;
}

std::size_t PartRows::forward_events(double t, bool last) {
  std::vector<Event> all;
  for (PartRecorder* part : recorders_)
    for (; !part->events.empty() && (part->events.front().t < t || (last && part->events.front().t == t));
         part->events.pop_front())
      all.push_back(std::move(part->events.front()));
  std::stable_sort(all.begin(), all.end(), [](const Event& a, const Event& b) {
    return std::pair(a.t, a.contact >= 0) < std::pair(b.t, b.contact >= 0);
  });
  for (const Event& event : all) {
    if (event.contact < 0) {
      if (std::exchange(last_load_jump_, event.t) == event.t) continue;
      ++report_.counters.time_events;
      order_.load_jump(event.t);
    }
    // The length of the step is unknown here; t is an upper bound.
    if (event.t_uncertainty) order_.event(event, motion::resolution_at(event.t, event.t));
    if (event.contact < 0 || event.type != EventType::time) ++report_.events_by_type[to_string(event.type)];
    recorder_.event(event);
  }
  return all.size();
}

bool PartRows::complete(double t, Rows rows) const {
  return std::all_of(recorders_.begin(), recorders_.end(), [&](PartRecorder* part) {
    return !(part->*rows).empty() && (part->*rows).front().t <= t;
  });
}

void PartRows::forward_row(Rows rows, void (Recorder::*to)(const Sample&)) {
  Vector u(whole_.size()), v(whole_.size());
  Sample sample;
  sample.t = (recorders_.front()->*rows).front().t;
  sample.u = &u;
  sample.v = &v;
  sample.contacts.resize(whole_.contacts.size());
  for (std::size_t i = 0; i < recorders_.size(); ++i) {
    const PartRecorder::Row& row = (recorders_[i]->*rows).front();
    const assembly::PartModel& part = parts_[i];
    for (std::size_t j = 0; j < part.dofs.size(); ++j) {
      u[part.dofs[j]] = row.u[static_cast<Eigen::Index>(j)];
      v[part.dofs[j]] = row.v[static_cast<Eigen::Index>(j)];
    }
    for (std::size_t k = 0; k < part.contacts.size(); ++k)
      sample.contacts[part.contacts[k]] = row.contacts[k];
    add_to(sample.energy, row.energy);
    (recorders_[i]->*rows).pop_front();
  }
  (recorder_.*to)(sample);
}

void PartRows::forward_motion(double t, const std::vector<PartRecorder*>& from) {
  if (!recorder_.wants_motion()) return;
  std::vector<const std::vector<MotionRow>*> motions(whole_.contacts.size());
  for (std::size_t i = 0; i < from.size(); ++i)
    for (std::size_t k = 0; k < from[i]->motions.size(); ++k)
      motions[parts_[i].contacts[k]] = &from[i]->motions[k];
  for (std::size_t k = 0; k < motions.size(); ++k)
    if (motions[k] != nullptr) recorder_.motion(static_cast<int>(k), *motions[k]);
  energy_sum_.take(energy_lines_, t);
  Curves curves = displacements_of(from);
  energy_sum_.write(curves);
  recorder_.curves(curves);
}

Curves PartRows::displacements_of(const std::vector<PartRecorder*>& from) const {
  std::map<std::string, const std::vector<CurvePoint>*> of_name;
  for (const PartRecorder* part : from)
    for (std::size_t i = 0; i < part->drawn.names.size(); ++i)
      of_name[part->drawn.names[i]] = &part->drawn.points[i];
  Curves curves;
  for (const Column& column : drawn_columns(whole_)) {
    curves.names.push_back(column.name);
    curves.points.push_back(*of_name.at(column.name));
  }
  return curves;
}

namespace {

constexpr std::size_t energy_values = energy_columns.size() + 1;

/// Change of one line at t: the value changes by `jump`, the slope by `bend`.
struct Change {
  double t = 0.0;
  EnergyValues jump{}, bend{};
};

EnergyValues slope_between(const EnergyRow& a, const EnergyRow& b) {
  EnergyValues slope;
  for (std::size_t i = 0; i < energy_values; ++i) slope[i] = (b.values[i] - a.values[i]) / (b.t - a.t);
  return slope;
}

/// Row at t on the straight line between two rows.
EnergyRow row_at(double t, const EnergyRow& a, const EnergyRow& b) {
  const EnergyValues slope = slope_between(a, b);
  EnergyRow row{t, a.values};
  for (std::size_t i = 0; i < energy_values; ++i) row.values[i] += slope[i] * (t - a.t);
  return row;
}

/// Appends the changes of the line up to `until` to `changes`, and removes their rows; one row at `until` remains. The line
/// must reach `until`.
void take_changes(EnergyLine& line, double until, std::vector<Change>& changes) {
  EnergyValues slope{};
  const auto add_change = [&](double t, const EnergyValues& next, const EnergyValues& jump) {
    Change change{t, jump, {}};
    for (std::size_t i = 0; i < energy_values; ++i) change.bend[i] = next[i] - slope[i];
    slope = next;
    changes.push_back(change);
  };
  while (line.size() > 1 && line[1].t <= until) {
    const EnergyRow from = line.front();
    line.pop_front();
    EnergyValues jump{};
    if (line.front().t > from.t) {
      add_change(from.t, slope_between(from, line.front()), jump);
    } else {
      for (std::size_t i = 0; i < energy_values; ++i) jump[i] = line.front().values[i] - from.values[i];
      add_change(from.t, {}, jump);
    }
  }
  if (line.size() > 1 && line.front().t < until) {
    const EnergyRow end = row_at(until, line[0], line[1]);
    add_change(line.front().t, slope_between(line[0], line[1]), {});
    line.front() = end;
  }
  add_change(until, {}, {});
}

}  // namespace

EnergyValues values_of(const Energy& energy) {
  EnergyValues values;
  for (std::size_t i = 0; i < energy_columns.size(); ++i) values[i] = energy.*energy_columns[i].value;
  values.back() = energy.balance();
  return values;
}

EnergySum::EnergySum(const Model& whole, double t_end, std::size_t most)
    : time_(whole.unit.time),
      energy_(scene::factor_of(unit::energy, whole.unit)),
      curves_(energy_values, {t_end * time_, {.max_rows = most}}) {}

void EnergySum::take(const std::vector<EnergyLine*>& lines, double until) {
  EnergyValues value{}, slope{};
  for (const EnergyLine* line : lines) {
    if (line->empty()) return;
    until = std::min(until, line->back().t);
    for (std::size_t i = 0; i < energy_values; ++i) value[i] += line->front().values[i];
  }
  if (lines.empty() || until < lines.front()->front().t) return;
  double t = lines.front()->front().t;
  std::vector<Change> changes;
  for (EnergyLine* line : lines) take_changes(*line, until, changes);
  std::stable_sort(changes.begin(), changes.end(),
                   [](const Change& a, const Change& b) { return a.t < b.t; });
  for (auto next = changes.cbegin(); next != changes.cend();) {
    for (std::size_t i = 0; i < energy_values; ++i) value[i] += slope[i] * (next->t - t);
    t = next->t;
    add(t, value);
    bool jumps = false;
    for (; next != changes.cend() && next->t == t; ++next)
      for (std::size_t i = 0; i < energy_values; ++i) {
        jumps = jumps || next->jump[i] != 0.0;
        value[i] += next->jump[i];
        slope[i] += next->bend[i];
      }
    if (jumps) add(t, value);
  }
}

void EnergySum::add(double t, const EnergyValues& values) {
  for (std::size_t i = 0; i < energy_values; ++i) curves_[i].add({t * time_, values[i] * energy_});
}

void EnergySum::write(Curves& curves) {
  double greatest = 0.0;
  for (std::size_t i = 0; i + 1 < energy_values; ++i) greatest = std::max(greatest, curves_[i].size(0));
  for (std::size_t i = 0; i < energy_values; ++i) {
    const bool balance = i + 1 == energy_values;  // the balance is only rounding error: no threshold
    curves_[i].close({balance ? 0.0 : rounding::elimination * greatest});
    curves.names.emplace_back(balance ? balance_column : energy_columns[i].name);
    curves.points.push_back(curves_[i].take());
  }
}

}  // namespace signorini::run
