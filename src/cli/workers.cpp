#include "cli/workers.hpp"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <exception>
#include <map>
#include <new>
#include <system_error>

#include "cli/terminal.hpp"
#include "signorini/error.hpp"

namespace signorini::cli {

namespace {

/// SIGINT, SIGTERM and SIGCHLD wait to be asked for: no signal is lost between a look and a sleep.
class HeldSignals {
 public:
  HeldSignals() {
    sigemptyset(&held_);
    for (const int signal : {SIGINT, SIGTERM, SIGCHLD}) sigaddset(&held_, signal);
    sigprocmask(SIG_BLOCK, &held_, &before_);
  }
  ~HeldSignals() { sigprocmask(SIG_SETMASK, &before_, nullptr); }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

  /// The next one, 0 if none comes in a fifth of a second.
  [[nodiscard]] int next() const {
    const timespec patience{0, 200'000'000};
    return std::max(sigtimedwait(&held_, nullptr, &patience), 0);
  }
  void restore() const { sigprocmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t held_{}, before_{};
};

[[noreturn]] void be_worker(pid_t parent, const HeldSignals& signals,
                            const std::function<void(std::size_t)>& work, std::size_t task) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // nobody would take the result
  if (getppid() != parent) _exit(static_cast<int>(ExitCode::bug));
  // Ctrl-C reaches the whole group: the parent alone decides, so that no row is taken for a crash.
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_IGN);
  signals.restore();
  ExitCode code = ExitCode::done;
  try {
    work(task);
  } catch (const Error& error) {
    print_error(error.what());
    code = error.code();
  } catch (const std::bad_alloc&) {
    print_error("out of memory");
    code = ExitCode::bug;
  } catch (const std::exception& error) {
    print_error(std::string("a bug in Signorini: ") + error.what());
    code = ExitCode::bug;
  }
  _exit(static_cast<int>(code));
}

class Pool {
 public:
  Pool(const HeldSignals& signals, const std::function<void(std::size_t)>& work)
      : signals_(signals), work_(work), parent_(getpid()) {}
  ~Pool() { end_all(); }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  [[nodiscard]] std::size_t size() const { return running_.size(); }

  void start(std::size_t task) {
    const pid_t child = fork();
    if (child == 0) be_worker(parent_, signals_, work_, task);
    if (child < 0) throw FileError("fork", "no process: " + std::generic_category().message(errno));
    running_[child] = task;
  }

  /// Those that have ended by now.
  std::vector<WorkerEnd> ended() {
    std::vector<WorkerEnd> list;
    for (auto it = running_.begin(); it != running_.end();) {
      int status = 0;
      const pid_t child = waitpid(it->first, &status, WNOHANG);
      if (child == 0 || (child < 0 && errno == EINTR)) {
        ++it;
        continue;
      }
      const bool exited = child > 0 && WIFEXITED(status);
      const bool killed = child > 0 && WIFSIGNALED(status);
      list.push_back({it->second, exited ? WEXITSTATUS(status) : 1, killed ? WTERMSIG(status) : 0});
      it = running_.erase(it);
    }
    return list;
  }

  void end_all() {
    for (const auto& [child, task] : running_) kill(child, SIGKILL);
    for (const auto& [child, task] : running_)
      while (waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
      }
    running_.clear();
  }

 private:
  const HeldSignals& signals_;
  const std::function<void(std::size_t)>& work_;
  pid_t parent_;
  std::map<pid_t, std::size_t> running_;
};

}  // namespace

bool run_workers(const std::vector<std::size_t>& tasks, std::size_t jobs,
                 const std::function<void(std::size_t)>& work,
                 const std::function<bool(const WorkerEnd&)>& ended,
                 const std::function<void(std::size_t)>& idle) {
  const HeldSignals signals;
  Pool pool(signals, work);
  bool go_on = true;
  std::size_t next = 0;
  while ((go_on && next < tasks.size()) || pool.size() > 0) {
    while (go_on && next < tasks.size() && pool.size() < jobs) pool.start(tasks[next++]);
    idle(pool.size());
    const int signal = signals.next();
    for (const WorkerEnd& end : pool.ended()) go_on = ended(end) && go_on;
    if (signal == SIGINT || signal == SIGTERM) return false;
  }
  return true;
}

}  // namespace signorini::cli
