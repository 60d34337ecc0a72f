#include "run/part_rows.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "motion/clock.hpp"
#include "run/curve_record.hpp"

namespace signorini {
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

PartRows::PartRows(const Model& whole, const std::vector<PartModel>& parts, double t_end, Recorder& recorder,
                   Report& report)
    : whole_(whole),
      parts_(parts),
      recorder_(recorder),
      report_(report),
      energy_sum_(whole, t_end, most_points_of(drawn_columns(whole).size())),
      order_(whole, report) {}

std::size_t PartRows::pass_on(double t, bool last) {
  const std::size_t events = pass_on_events(t, last);
  pass_on_rows(t, &PartRecorder::rows, &Recorder::sample);
  pass_on_rows(t, &PartRecorder::frames, &Recorder::frame);
  energy_sum_.take(energy_lines_, t);
  return events;
}

std::size_t PartRows::pass_on_events(double t, bool last) {
  std::vector<Event> all;
  for (PartRecorder* part : of_)
    for (; !part->events.empty() && (part->events.front().t < t || (last && part->events.front().t == t));
         part->events.pop_front())
      all.push_back(std::move(part->events.front()));
  std::stable_sort(all.begin(), all.end(), [](const Event& a, const Event& b) {
    return std::pair(a.t, a.contact >= 0) < std::pair(b.t, b.contact >= 0);
  });
  for (const Event& event : all) {
    if (event.contact < 0) {
      if (std::exchange(jumped_, event.t) == event.t) continue;
      ++report_.counters.time_events;
      order_.load_jump(event.t);
    }
    // The length of its step is unknown here; it is at most the length of the run.
    if (event.t_uncertainty) order_.event(event, resolution_at(event.t, event.t));
    if (event.contact < 0 || event.type != EventType::time) ++report_.events_by_type[to_string(event.type)];
    recorder_.event(event);
  }
  return all.size();
}

void PartRows::pass_on_rows(double t, Rows rows, void (Recorder::*to)(const Sample&)) {
  const auto complete = [&] {
    return std::all_of(of_.begin(), of_.end(), [&](PartRecorder* part) {
      return !(part->*rows).empty() && (part->*rows).front().t <= t;
    });
  };
  Vector u(whole_.size()), v(whole_.size());
  while (complete()) {
    Sample sample;
    sample.t = (of_.front()->*rows).front().t;
    sample.u = &u;
    sample.v = &v;
    sample.contacts.resize(whole_.contacts.size());
    for (std::size_t i = 0; i < of_.size(); ++i) {
      const PartRecorder::Row& row = (of_[i]->*rows).front();
      const PartModel& part = parts_[i];
      for (std::size_t j = 0; j < part.dofs.size(); ++j) {
        u[part.dofs[j]] = row.u[static_cast<Eigen::Index>(j)];
        v[part.dofs[j]] = row.v[static_cast<Eigen::Index>(j)];
      }
      for (std::size_t k = 0; k < part.contacts.size(); ++k)
        sample.contacts[part.contacts[k]] = row.contacts[k];
      add_to(sample.energy, row.energy);
      (of_[i]->*rows).pop_front();
    }
    (recorder_.*to)(sample);
  }
}

void PartRows::pass_on_motion(double t, const std::vector<PartRecorder*>& from) {
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

}  // namespace signorini
