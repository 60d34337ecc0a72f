#include "run/energy_sum.hpp"

#include <algorithm>

#include "base/rounding.hpp"
#include "scene/quantities.hpp"

namespace signorini {
namespace {

constexpr std::size_t energy_values = energy_columns.size() + 1;

/// Change of one line at t: its value by `jump`, its slope by `bend`.
struct Change {
  double t = 0.0;
  EnergyValues jump{}, bend{};
};

EnergyValues slope_between(const EnergyRow& a, const EnergyRow& b) {
  EnergyValues slope;
  for (std::size_t i = 0; i < energy_values; ++i) slope[i] = (b.values[i] - a.values[i]) / (b.t - a.t);
  return slope;
}

/// Row on the straight line between two rows.
EnergyRow row_at(double t, const EnergyRow& a, const EnergyRow& b) {
  const EnergyValues slope = slope_between(a, b);
  EnergyRow row{t, a.values};
  for (std::size_t i = 0; i < energy_values; ++i) row.values[i] += slope[i] * (t - a.t);
  return row;
}

/// Removes the changes of the line up to `until`, which the line reaches; one row remains there.
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
      energy_(factor_of(unit::energy, whole.unit)),
      curves_(energy_values, {t_end * time_, {.most = most}}) {}

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
    const bool balance = i + 1 == energy_values;  // the balance consists of rounding
    curves_[i].close({balance ? 0.0 : rounding::of_elimination * greatest});
    curves.names.emplace_back(balance ? balance_column : energy_columns[i].name);
    curves.points.push_back(curves_[i].take());
  }
}

}  // namespace signorini
