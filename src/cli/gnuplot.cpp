#include "cli/gnuplot.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <optional>
#include <thread>

#include "cli/terminal.hpp"

namespace signorini::cli {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int no_program = 127, no_reason = 126;  // exit codes as in a shell
constexpr int no_end = 124;                       // exit code as in timeout
constexpr std::chrono::seconds patience{60};      // a picture takes a second or two
constexpr std::size_t most_said = 1 << 16;
constexpr std::size_t most_contacts = 24;  // a sixth of a second each; a displacement picture covers this
                                           // number of nodes

struct Ended {
  int code = 0;
  std::string said;
};

// Only async-signal-safe calls are allowed between fork and exec.
[[noreturn]] void become_gnuplot(const char* folder, const char* script, int said) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // no one would wait for the picture
  const int nothing = open("/dev/null", O_RDWR);
  dup2(nothing, STDIN_FILENO);
  dup2(nothing, STDOUT_FILENO);
  dup2(said, STDERR_FILENO);
  if (chdir(folder) == 0) execlp("gnuplot", "gnuplot", "-d", script, static_cast<char*>(nullptr));
  _exit(errno == ENOENT ? no_program : no_reason);
}

/// Reads gnuplot's output, up to `most_said` bytes, until it closes its end; false if it takes too long or writes too
/// much.
bool listen(int end, Clock::time_point last, std::string& said) {
  std::array<char, 4096> buffer{};
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(last - Clock::now());
    pollfd ready{end, POLLIN, 0};
    const int found = left.count() > 0 ? poll(&ready, 1, static_cast<int>(left.count())) : 0;
    if (found < 0 && errno == EINTR) continue;
    if (found <= 0) return false;
    const ssize_t n = read(end, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return true;
    said.append(buffer.data(), static_cast<std::size_t>(n));
    if (said.size() > most_said) return false;
  }
}

/// The child's exit code; nullopt if it has not ended by then.
std::optional<int> wait_for(pid_t child, Clock::time_point last) {
  for (;;) {
    int status = 0;
    if (waitpid(child, &status, WNOHANG) == child) return WIFEXITED(status) ? WEXITSTATUS(status) : no_reason;
    if (Clock::now() > last) return std::nullopt;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

Ended run_gnuplot(const std::filesystem::path& script) {
  const std::string folder = script.parent_path().string(), name = script.filename().string();
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return {no_reason, "no pipe"};
  const pid_t child = fork();
  if (child == 0) {
    setpgid(0, 0);  // a process group, so that its children can be ended, too
    close(ends[0]);
    become_gnuplot(folder.c_str(), name.c_str(), ends[1]);
  }
  close(ends[1]);
  if (child < 0) {
    close(ends[0]);
    return {no_reason, "no process"};
  }
  const auto last = Clock::now() + patience;
  std::string said;
  const bool silent = listen(ends[0], last, said);
  close(ends[0]);
  if (silent)
    if (const auto code = wait_for(child, last)) return {*code, said};
  setpgid(child, child);  // if the child has not done so itself
  kill(-child, SIGKILL);
  while (waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
  }
  return {no_end, said.size() > most_said ? "it said more than 64 kB and was ended"
                                          : fmt::format("not done after {} s, and ended", patience.count())};
}

}  // namespace

std::vector<std::filesystem::path> first_ones(const std::vector<std::filesystem::path>& scripts) {
  std::vector<std::filesystem::path> first;
  std::size_t contacts = 0;
  for (const auto& script : scripts)
    if (!script.filename().string().starts_with("contact-") || contacts++ < most_contacts)
      first.push_back(script);
  return first;
}

Drawing draw(const std::vector<std::filesystem::path>& scripts) {
  Drawing drawing;
  std::size_t failed = 0;
  for (const auto& script : scripts) {
    const Ended ended = run_gnuplot(script);
    if (ended.code == no_program) return {Drawing::Kind::no_gnuplot, ""};
    if (ended.code == 0) continue;
    if (failed++ == 0) drawing = {Drawing::Kind::failed, script.string() + ": " + ended.said};
    if (ended.code == no_end)
      return drawing;  // an error of the program, not of the picture: the next one would hang as well
  }
  if (failed > 1)
    drawing.message +=
        fmt::format("\n{} of {} pictures failed; the others are drawn", failed, scripts.size());
  else if (failed == 1 && scripts.size() > 1)
    drawing.message += "\nthe other pictures are drawn";
  return drawing;
}

std::string draw_pictures(const std::filesystem::path& directory,
                          const std::vector<std::filesystem::path>& scripts, const std::string& later) {
  if (scripts.empty()) return "";
  const std::string folder = (directory / "plots").string();
  const std::vector<std::filesystem::path> first = first_ones(scripts);
  const Drawing drawing = draw(first);
  const std::string more =
      first.size() == scripts.size()
          ? ""
          : fmt::format(", of the first {} contacts; gnuplot contact-NAME.gp there draws another's",
                        most_contacts);
  if (drawing.kind == Drawing::Kind::drawn) return "pictures: " + folder + "/*.png and *.svg" + more + "\n";
  if (drawing.kind == Drawing::Kind::no_gnuplot)
    return "pictures: no gnuplot on PATH; its scripts are in " + folder + later + "\n";
  print_note("gnuplot failed: " + drawing.message);
  return first.size() > 1 ? "pictures: " + folder + "/*.png and *.svg, as far as they could be drawn\n" : "";
}

}  // namespace signorini::cli
