// workers.hpp: runs tasks, such as rows of a sweep, in a few persistent processes; each process runs its tasks in turn.
//
//   const bool whole = run_workers(tasks, jobs, work, ended, idle);
//
//   parent --- task -->  pipe  --> worker:  for each task: work(task), then
//   parent <-- report -- pipe <--           { task, exit code, length, return value of work }
//                                           work() may send parts of its report earlier
//
// Workers are processes, not threads, so that a run that crashes or exhausts the memory does not affect other runs
// (docs/decisions/sweep-workers.md). If a worker dies, only its current task is lost: a new worker replaces it, and the
// task waiting in its pipe goes to another worker. SIGINT and SIGTERM end all workers immediately, so files of a task must be
// written atomically.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "study/sweep/sweep_directory.hpp"

namespace signorini::cli {

/// Result of one task, as the parent received it.
struct TaskResult {
  std::size_t task = 0;
  int code = 0;        ///< exit code; if `work` threw an Error, the exit code of the error
  int signal = 0;      ///< signal that ended the worker process, or 0
  std::string report;  ///< parts that `work` sent, then its return value; if the worker died, only the parts
};

/// Sends a part of the report before the task is done. The part is kept even if the worker dies later.
using SendReport = std::function<void(const std::string&)>;
using Work = std::function<std::string(std::size_t task, const SendReport&)>;

/// Runs all tasks. work: runs in a worker, which sends the report to this process; an exception becomes an exit code, and
/// its message goes to stderr. ended: runs in this process, in the order of completion; returns false to stop. idle: runs
/// in this process periodically, with the number of tasks in progress. Returns false if interrupted. Errors: FileError if
/// a process cannot be started; all workers are ended first.
[[nodiscard]] bool run_workers(const std::vector<std::size_t>& tasks, std::size_t jobs, const Work& work,
                               const std::function<bool(const TaskResult&)>& ended,
                               const std::function<void(std::size_t)>& idle);

/// The rows of a sweep as tasks for workers. A task is one row; with --carry, a task is the chain of all rows along the
/// last range.
class SweepTasks {
 public:
  /// common: settings of all rows; keep: the directory of each run is also kept. The sweep directory must outlive the
  /// object.
  SweepTasks(sweep::SweepDirectory& directory, sweep::RowTask common, bool keep);

  /// Tasks that are not computed yet; a task is identified by the index of its first row.
  [[nodiscard]] const std::vector<std::size_t>& list() const { return list_; }
  [[nodiscard]] std::size_t rows() const { return list_.size() * length_; }

  /// Computes the rows of a task in a worker, and sends their lines; the last line is the return value.
  [[nodiscard]] std::string work(std::size_t first, const SendReport& tell) const;
  /// Stores the rows of a finished task; rows that were lost in a crash are stored with the outcome "crashed".
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
