// workers.hpp: tasks in processes of their own, a few at a time.
//
//   const Ending ending = run_workers(tasks, jobs, work, ended);
//
// Processes, not threads: a run that crashes or fills the memory takes no other with it. SIGINT and SIGTERM
// end all of them at once; what a task writes must be whole or not there.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace signorini::cli {

/// How one process ended.
struct WorkerEnd {
  std::size_t task = 0;
  int code = 0;    ///< exit code; that of an Error which `work` threw
  int signal = 0;  ///< that ended it, or 0
};

/// `work` runs in the new process, whose exit code is 0, or what its exception says (the message goes to
/// stderr). `ended` runs here, in the order of the ends, and says whether to go on. `idle` runs here now and
/// then, with the number of processes. Returns false when interrupted. Errors: FileError where no process can
/// be started; all others have ended then.
[[nodiscard]] bool run_workers(const std::vector<std::size_t>& tasks, std::size_t jobs,
                               const std::function<void(std::size_t)>& work,
                               const std::function<bool(const WorkerEnd&)>& ended,
                               const std::function<void(std::size_t)>& idle);

}  // namespace signorini::cli
