#include "cli/sweep_tasks.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>

namespace signorini::cli {
namespace {

std::vector<std::string> values_of(const std::vector<Override>& point) {
  std::vector<std::string> values;
  for (const Override& change : point) values.push_back(change.value);
  return values;
}

}  // namespace

SweepTasks::SweepTasks(SweepDirectory& directory, RowTask common, bool keep)
    : directory_(directory), common_(std::move(common)), keep_(keep) {
  const SweepSpec& spec = directory.spec();
  if (spec.carry.on) length_ = spec.vary.back().values.size();
  for (std::size_t first = 0; first < directory.points().size(); first += length_) {
    bool missing = false;
    for (std::size_t i = first; i < first + length_; ++i)
      missing = missing || (spec.share.holds(i) && !directory.rows().contains(i));
    // An incomplete chain restarts: its states are in no file.
    if (missing) list_.push_back(first);
  }
}

RowTask SweepTasks::task(std::size_t index) const {
  RowTask task = common_;
  const auto& point = directory_.points()[index];
  task.index = index;
  task.values = values_of(point);
  task.changes.insert(task.changes.end(), point.begin(), point.end());
  if (keep_) task.keep = directory_.run_directory(index);
  return task;
}

std::string SweepTasks::work(std::size_t first, const Tell& tell) const {
  if (!directory_.spec().carry.on) return row_line(compute_row(task(first)));
  std::optional<SavedState> carried;
  const std::size_t last = first + length_ - 1;
  for (std::size_t i = first; i < last; ++i) tell(row_line(compute_row(task(i), carried)));
  return row_line(compute_row(task(last), carried));
}

void SweepTasks::take(const WorkerEnd& end) {
  if (!end.report.empty()) directory_.add(end.report);
  const auto told = static_cast<std::size_t>(std::count(end.report.begin(), end.report.end(), '\n'));
  for (std::size_t i = end.task + told; i < end.task + length_; ++i) {
    SweepRow row;
    row.index = i;
    row.values = values_of(directory_.points()[i]);
    row.outcome = "crashed";
    row.reason = end.signal != 0 ? fmt::format("ended by signal {} ({})", end.signal, strsignal(end.signal))
                                 : fmt::format("exit code {}", end.code);
    directory_.add(row);
  }
}

}  // namespace signorini::cli
