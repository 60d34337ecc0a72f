#include "cli/sweep_tasks.hpp"

#include <fmt/core.h>

#include <cstring>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "result/csv.hpp"

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
    // A chain that is not whole begins anew: its states are in no file.
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

std::string SweepTasks::work(std::size_t first) const {
  std::optional<SavedState> carried;
  std::string text;
  for (std::size_t i = first; i < first + length_; ++i) {
    text = row_text(directory_.spec().carry.on ? compute_row(task(i), carried) : compute_row(task(i)));
    write_file(directory_.row_file(i), text);
  }
  return length_ == 1 ? text : "";
}

void SweepTasks::take(const WorkerEnd& end) {
  const bool whole = end.code == 0 && end.signal == 0;
  if (length_ == 1 && whole) return directory_.take(end.task, end.report);
  std::error_code error;
  for (std::size_t i = end.task; i < end.task + length_; ++i) {
    if (whole || (length_ > 1 && std::filesystem::exists(directory_.row_file(i), error))) {
      directory_.take(i);
      continue;
    }
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
