// workers.hpp: tasks in a few processes that stay, one task after the other.
//
//   const bool whole = run_workers(tasks, jobs, work, ended, idle);
//
//   parent --- task -->  pipe  --> worker:  for each task: work(task), then
//   parent <-- report -- pipe <--           { task, exit code, length, what work returned }, after what it told
//
// Processes, not threads: a run that crashes or fills the memory takes no other with it
// (docs/decisions/sweep-workers.md). A worker that dies costs the task at which it was, and is started anew; the
// task that waited in its pipe goes to another. SIGINT and SIGTERM end all of them at once; what a task writes
// must be whole or not there.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace signorini::cli {

/// How one task ended.
struct WorkerEnd {
  std::size_t task = 0;
  int code = 0;        ///< exit code; that of an Error which `work` threw
  int signal = 0;      ///< that ended its process, or 0
  std::string report;  ///< what `work` told and returned; of one that died: what it told
};

/// Sends a part of the report before the task is done. It is kept if the worker dies.
using Tell = std::function<void(const std::string&)>;
using Work = std::function<std::string(std::size_t task, const Tell&)>;

/// `work` runs in a worker, and its report comes here; what it throws becomes a code (the message goes to
/// stderr). `ended` runs here, in the order of the ends, and says whether to go on. `idle` runs here now and
/// then, with the number of tasks under way. Returns false when interrupted. Errors: FileError where no process
/// can be started; all others have ended then.
[[nodiscard]] bool run_workers(const std::vector<std::size_t>& tasks, std::size_t jobs, const Work& work,
                               const std::function<bool(const WorkerEnd&)>& ended,
                               const std::function<void(std::size_t)>& idle);

}  // namespace signorini::cli
