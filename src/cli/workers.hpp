// workers.hpp: runs tasks, such as rows of a sweep, in a few persistent processes, one task after another.
//
//   const bool whole = run_workers(tasks, jobs, work, ended, idle);
//
//   parent --- task -->  pipe  --> worker:  for each task: work(task), then
//   parent <-- report -- pipe <--           { task, exit code, length, return value of work }, after the parts it sent
//
// Processes, not threads: a run that crashes or exhausts the memory affects no other (docs/decisions/sweep-workers.md).
// A worker that dies loses only its current task, and is restarted; the task waiting in its pipe goes to another
// worker. SIGINT and SIGTERM end all of them at once; files of a task must be written atomically.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "study/sweep/sweep_directory.hpp"

namespace signorini::cli {

/// Result of one task.
struct TaskResult {
  std::size_t task = 0;
  int code = 0;        ///< exit code; for an Error thrown by `work`, the exit code of the error
  int signal = 0;      ///< signal that ended its process, or 0
  std::string report;  ///< parts that `work` sent, and its return value; if the worker died, only the parts
};

/// Sends a part of the report before the task is done. It is kept if the worker dies.
using SendReport = std::function<void(const std::string&)>;
using Work = std::function<std::string(std::size_t task, const SendReport&)>;

/// Runs all tasks. `work` runs in a worker, which sends its report to this process; an exception becomes an
/// exit code (the message goes to stderr). `ended` runs in this process, in the order of completion, and
/// returns whether to continue. `idle` runs in this process periodically, with the number of tasks in
/// progress. Returns false if interrupted. Errors: FileError if no process can be started; all others have
/// ended by then.
[[nodiscard]] bool run_workers(const std::vector<std::size_t>& tasks, std::size_t jobs, const Work& work,
                               const std::function<bool(const TaskResult&)>& ended,
                               const std::function<void(std::size_t)>& idle);

/// The rows of a sweep as tasks for workers. A task is one row or, if rows continue each other, all rows
/// along the last range.
class SweepTasks {
 public:
  /// common: settings of all rows; keep: the run of each row is also kept. The directory must outlive the
  /// object.
  SweepTasks(sweep::SweepDirectory& directory, sweep::RowTask common, bool keep);

  /// Missing tasks, by the index of their first row.
  [[nodiscard]] const std::vector<std::size_t>& list() const { return list_; }
  [[nodiscard]] std::size_t rows() const { return list_.size() * length_; }

  /// Runs in a worker: computes the rows and sends their lines; the last line is the return value.
  [[nodiscard]] std::string work(std::size_t first, const SendReport& tell) const;
  /// Takes the rows of a finished task; rows lost by a crash become rows with that message.
  void take(const TaskResult& end);

 private:
  [[nodiscard]] sweep::RowTask task(std::size_t index) const;

  sweep::SweepDirectory& directory_;
  sweep::RowTask common_;
  bool keep_;
  std::size_t length_ = 1;
  std::vector<std::size_t> list_;
};

}  // namespace signorini::cli
