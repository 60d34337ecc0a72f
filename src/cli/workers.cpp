#include "cli/workers.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <deque>
#include <exception>
#include <list>
#include <new>
#include <optional>
#include <system_error>
#include <utility>

#include "cli/terminal.hpp"
#include "signorini/error.hpp"

namespace signorini::cli {
namespace {

constexpr int poll_timeout_ms = 200;  // ms, longest wait for reports before `idle` is called
// Tasks per worker: the current task, and one that waits in the worker's pipe.
constexpr std::size_t max_tasks_per_worker = 2;

/// Owner of a file descriptor; the destructor closes it.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~Descriptor() {
    if (fd_ >= 0) close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int get() const { return fd_; }
  void reset() { *this = Descriptor(); }

 private:
  int fd_ = -1;
};

[[noreturn]] void fail(const char* what) {
  throw FileError(what, "cannot be created: " + std::generic_category().message(errno));
}

struct Pipe {
  Descriptor out, in;  // out: the end for reading; in: the end for writing
  Pipe() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) fail("pipe");
    out = Descriptor(ends[0]);
    in = Descriptor(ends[1]);
  }
};

/// Blocks SIGINT and SIGTERM and makes them readable from fd(), so that no signal is lost between a check and a wait.
class SignalDescriptor {
 public:
  SignalDescriptor() {
    sigemptyset(&held_);
    for (const int signal : {SIGINT, SIGTERM}) sigaddset(&held_, signal);
    sigprocmask(SIG_BLOCK, &held_, &before_);
    fd_ = Descriptor(signalfd(-1, &held_, SFD_CLOEXEC | SFD_NONBLOCK));
    if (fd_.get() < 0) fail("signalfd");
  }
  ~SignalDescriptor() { restore(); }
  SignalDescriptor(const SignalDescriptor&) = delete;
  SignalDescriptor& operator=(const SignalDescriptor&) = delete;
  [[nodiscard]] int fd() const { return fd_.get(); }
  void restore() const { sigprocmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t held_{}, before_{};
  Descriptor fd_;
};

/// Writes all bytes to a pipe; returns false if the other end is closed.
bool send(int fd, const void* data, std::size_t size) {
  const char* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t n = write(fd, at, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

bool receive(int fd, void* data, std::size_t size) {
  char* at = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t n = read(fd, at, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

struct Head {
  static constexpr std::int64_t not_done = -1;

  std::uint64_t task = 0, length = 0;
  std::int64_t code = 0;
};

/// Sends a report to the parent in one block; returns false if the parent has closed its end.
bool report(int fd, std::uint64_t task, std::int64_t code, std::string text) {
  const Head head{task, text.size(), code};
  text.insert(0, reinterpret_cast<const char*>(&head), sizeof head);
  return send(fd, text.data(), text.size());
}

/// Executes one task in a worker; returns the exit code and the report of the task.
std::pair<ExitCode, std::string> execute_task(const Work& work, std::size_t task, const SendReport& tell) {
  try {
    return {ExitCode::done, work(task, tell)};
  } catch (const Error& error) {
    print_error(error.what());
    return {error.code(), ""};
  } catch (const std::bad_alloc&) {
    print_error("out of memory");
  } catch (const std::exception& error) {
    print_error(std::string("a bug in Signorini: ") + error.what());
  }
  return {ExitCode::bug, ""};
}

/// Closes all file descriptors except a, b and the standard streams. Otherwise a worker would keep the lock of a directory
/// for some milliseconds after its parent was killed.
void close_other_descriptors(int a, int b) {
  const auto low = static_cast<unsigned>(std::min(a, b)), high = static_cast<unsigned>(std::max(a, b));
  if (low > 3) (void)close_range(3, low - 1, 0);
  if (high > low + 1) (void)close_range(low + 1, high - 1, 0);
  (void)close_range(high + 1, ~0U, 0);
}

[[noreturn]] void be_worker(pid_t parent, const SignalDescriptor& signals, const Work& work, int tasks,
                            int reports) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // the worker ends with its parent
  if (getppid() != parent) _exit(static_cast<int>(ExitCode::bug));
  // Ctrl-C sends SIGINT to the whole process group. Workers ignore it, because their end would look like a crash; the
  // parent ends them.
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  signals.restore();
  close_other_descriptors(tasks, reports);
  std::uint64_t task = 0;
  while (receive(tasks, &task, sizeof task)) {
    const SendReport tell = [&](const std::string& text) {
      (void)report(reports, task, Head::not_done, text);
    };
    auto [code, text] = execute_task(work, static_cast<std::size_t>(task), tell);
    if (!report(reports, task, static_cast<std::int64_t>(code), std::move(text))) break;
    if (code == ExitCode::bug) _exit(0);  // memory may be corrupt: a new process continues with the next task
  }
  _exit(0);
}

/// Data of the parent about one worker.
struct Worker {
  pid_t process = 0;
  Descriptor tasks, reports;
  std::deque<std::size_t> given;  // tasks sent to the worker; the first is in progress
  std::string heard;              // received bytes of an incomplete report
  std::string reported;           // received parts of the report of the current task
};

class Pool {
 public:
  Pool(const SignalDescriptor& signals, const Work& work)
      : signals_(signals), work_(work), parent_(getpid()) {}
  ~Pool() { end_all(); }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  [[nodiscard]] std::size_t size() const { return workers_.size(); }
  [[nodiscard]] std::size_t tasks_in_progress() const {
    std::size_t sum = 0;
    for (const Worker& w : workers_) sum += w.given.size();
    return sum;
  }

  void start() {
    Pipe tasks, reports;
    const pid_t child = fork();
    if (child < 0)
      throw FileError("fork", "cannot start a process: " + std::generic_category().message(errno));
    if (child == 0) {
      tasks.in.reset();
      workers_.clear();  // closes the inherited pipes of other workers
      be_worker(parent_, signals_, work_, tasks.out.get(), reports.in.get());
    }
    Worker worker;
    worker.process = child;
    worker.tasks = std::move(tasks.in);
    worker.reports = std::move(reports.out);
    fcntl(worker.reports.get(), F_SETFL, O_NONBLOCK);
    workers_.push_back(std::move(worker));
  }

  /// Sends a first task to each worker without one, then a second task that waits in the worker's pipe.
  void send_tasks(std::deque<std::size_t>& queue) {
    for (std::size_t ahead = 1; ahead <= max_tasks_per_worker; ++ahead)
      for (Worker& w : workers_) {
        if (queue.empty()) return;
        if (w.given.size() >= ahead) continue;
        const std::uint64_t task = queue.front();
        w.given.push_back(queue.front());  // if the worker has died, listen() detects it and returns the task
        queue.pop_front();
        (void)send(w.tasks.get(), &task, sizeof task);
      }
  }

  /// Waits for reports or a signal. If a worker has died, its waiting tasks return to the queue. Returns true after a
  /// signal, which ends all tasks.
  bool listen(std::deque<std::size_t>& queue, std::vector<TaskResult>& ends) {
    std::vector<pollfd> watched{{signals_.fd(), POLLIN, 0}};
    for (const Worker& w : workers_) watched.push_back({w.reports.get(), POLLIN, 0});
    if (poll(watched.data(), watched.size(), poll_timeout_ms) <= 0) return false;
    for (auto worker = workers_.begin(); worker != workers_.end();) {
      const bool alive = read_reports(*worker, ends);
      if (alive) {
        ++worker;
        continue;
      }
      remove_dead_worker(*worker, queue, ends);
      worker = workers_.erase(worker);
    }
    signalfd_siginfo signal{};
    return (watched[0].revents & POLLIN) != 0 && receive(signals_.fd(), &signal, sizeof signal);
  }

  void end_all() {
    for (const Worker& w : workers_) kill(w.process, SIGKILL);
    for (const Worker& w : workers_) (void)reap(w.process);
    workers_.clear();
  }

 private:
  static int reap(pid_t process) {
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
  }

  /// Reads the complete reports of a worker; returns false if the worker has closed its pipe.
  static bool read_reports(Worker& w, std::vector<TaskResult>& ends) {
    char block[65536];
    bool open = true;
    for (;;) {
      const ssize_t n = read(w.reports.get(), block, sizeof block);
      if (n > 0) {
        w.heard.append(block, static_cast<std::size_t>(n));
        if (static_cast<std::size_t>(n) == sizeof block) continue;
        break;
      }
      if (n < 0 && errno == EINTR) continue;
      open = n < 0 && errno == EAGAIN;
      break;
    }
    Head head;
    std::size_t done = 0;
    while (w.heard.size() - done >= sizeof head) {
      std::memcpy(&head, w.heard.data() + done, sizeof head);
      if (w.heard.size() - done - sizeof head < head.length) break;
      done += sizeof head;
      w.reported.append(w.heard, done, static_cast<std::size_t>(head.length));
      done += static_cast<std::size_t>(head.length);
      if (head.code == Head::not_done) continue;
      ends.push_back({static_cast<std::size_t>(head.task), static_cast<int>(head.code), 0,
                      std::exchange(w.reported, std::string())});
      if (!w.given.empty()) w.given.pop_front();
    }
    w.heard.erase(0, done);
    return open;
  }

  static void remove_dead_worker(Worker& w, std::deque<std::size_t>& queue, std::vector<TaskResult>& ends) {
    const int status = reap(w.process);
    const bool clean = WIFEXITED(status) && WEXITSTATUS(status) == 0;  // the worker ended between two tasks
    if (!w.given.empty() && !clean) {
      ends.push_back({w.given.front(), WIFEXITED(status) ? WEXITSTATUS(status) : 1,
                      WIFSIGNALED(status) ? WTERMSIG(status) : 0, std::move(w.reported)});
      w.given.pop_front();
    }
    queue.insert(queue.begin(), w.given.begin(), w.given.end());
  }

  const SignalDescriptor& signals_;
  const Work& work_;
  pid_t parent_;
  std::list<Worker> workers_;
};

}  // namespace

bool run_workers(const std::vector<std::size_t>& tasks, std::size_t jobs, const Work& work,
                 const std::function<bool(const TaskResult&)>& ended,
                 const std::function<void(std::size_t)>& idle) {
  const SignalDescriptor signals;
  const auto pipes = std::signal(SIGPIPE, SIG_IGN);  // writing to a dead worker would raise SIGPIPE
  Pool pool(signals, work);
  std::deque<std::size_t> queue(tasks.begin(), tasks.end());
  bool go_on = true, whole = true;
  while (whole && ((go_on && !queue.empty()) || pool.tasks_in_progress() > 0)) {
    while (go_on && pool.size() < std::min(jobs, queue.size() + pool.tasks_in_progress())) pool.start();
    if (go_on) pool.send_tasks(queue);
    idle(pool.tasks_in_progress());
    std::vector<TaskResult> ends;
    whole = !pool.listen(queue, ends);
    for (const TaskResult& end : ends) go_on = ended(end) && go_on;
  }
  pool.end_all();
  std::signal(SIGPIPE, pipes);
  return whole;
}

namespace {

std::vector<std::string> values_of(const std::vector<Override>& point) {
  std::vector<std::string> values;
  for (const Override& change : point) values.push_back(change.value);
  return values;
}

}  // namespace

SweepTasks::SweepTasks(sweep::SweepDirectory& directory, sweep::RowTask common, bool keep)
    : directory_(directory), common_(std::move(common)), keep_(keep) {
  const sweep::SweepSpec& spec = directory.spec();
  if (spec.carry.on) length_ = spec.vary.back().values.size();
  for (std::size_t first = 0; first < directory.points().size(); first += length_) {
    bool missing = false;
    for (std::size_t i = first; i < first + length_; ++i)
      missing = missing || (spec.share.holds(i) && !directory.rows().contains(i));
    // An incomplete chain of rows is computed again from its first row, because final states are not stored in files.
    if (missing) list_.push_back(first);
  }
}

sweep::RowTask SweepTasks::task(std::size_t index) const {
  sweep::RowTask task = common_;
  const auto& point = directory_.points()[index];
  task.index = index;
  task.values = values_of(point);
  task.changes.insert(task.changes.end(), point.begin(), point.end());
  if (keep_) task.keep = directory_.run_directory(index);
  return task;
}

std::string SweepTasks::work(std::size_t first, const SendReport& tell) const {
  if (!directory_.spec().carry.on) return sweep::row_line(sweep::compute_row(task(first)));
  std::optional<SavedState> carried;
  const std::size_t last = first + length_ - 1;
  for (std::size_t i = first; i < last; ++i) tell(sweep::row_line(sweep::compute_row(task(i), carried)));
  return sweep::row_line(sweep::compute_row(task(last), carried));
}

void SweepTasks::take(const TaskResult& end) {
  if (!end.report.empty()) directory_.add(end.report);
  const auto reported = static_cast<std::size_t>(std::count(end.report.begin(), end.report.end(), '\n'));
  for (std::size_t i = end.task + reported; i < end.task + length_; ++i) {
    sweep::SweepRow row;
    row.index = i;
    row.values = values_of(directory_.points()[i]);
    row.outcome = "crashed";
    row.reason = end.signal != 0 ? fmt::format("the process was ended by signal {} ({})", end.signal,
                                               strsignal(end.signal))
                                 : fmt::format("the process ended with exit code {}", end.code);
    directory_.add(row);
  }
}

}  // namespace signorini::cli
