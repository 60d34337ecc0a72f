#include "cli/gnuplot.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "cli/terminal.hpp"

namespace signorini::cli {

namespace {

constexpr int no_program = 127;

struct Ended {
  int code = 0;
  std::string said;
};

// Between fork and exec only async-signal-safe calls.
[[noreturn]] void become_gnuplot(const char* folder, const char* script, int said) {
  const int nothing = open("/dev/null", O_RDWR);
  dup2(nothing, STDIN_FILENO);
  dup2(nothing, STDOUT_FILENO);
  dup2(said, STDERR_FILENO);
  if (chdir(folder) == 0) execlp("gnuplot", "gnuplot", "-d", script, static_cast<char*>(nullptr));
  _exit(errno == ENOENT ? no_program : 126);
}

Ended run_gnuplot(const std::filesystem::path& script) {
  const std::string folder = script.parent_path().string(), name = script.filename().string();
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return {126, "no pipe"};
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    become_gnuplot(folder.c_str(), name.c_str(), ends[1]);
  }
  close(ends[1]);
  Ended ended;
  std::array<char, 4096> buffer{};
  for (;;) {
    const ssize_t n = read(ends[0], buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    ended.said.append(buffer.data(), static_cast<std::size_t>(n));
  }
  close(ends[0]);
  if (child < 0) return {126, "no process"};
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  ended.code = WIFEXITED(status) ? WEXITSTATUS(status) : 126;
  return ended;
}

}  // namespace

Drawing draw(const std::vector<std::filesystem::path>& scripts) {
  for (const auto& script : scripts) {
    const Ended ended = run_gnuplot(script);
    if (ended.code == no_program) return {Drawing::Kind::no_gnuplot, ""};
    if (ended.code != 0) return {Drawing::Kind::failed, script.string() + ": " + ended.said};
  }
  return {};
}

std::string draw_pictures(const std::filesystem::path& directory,
                          const std::vector<std::filesystem::path>& scripts, const std::string& later) {
  if (scripts.empty()) return "";
  const std::string folder = (directory / "plots").string();
  const Drawing drawing = draw(scripts);
  if (drawing.kind == Drawing::Kind::drawn) return "pictures: " + folder + "/*.png and *.svg\n";
  if (drawing.kind == Drawing::Kind::no_gnuplot)
    return "pictures: no gnuplot on PATH; its scripts are in " + folder + later + "\n";
  print_note("gnuplot failed: " + drawing.message);
  return "";
}

}  // namespace signorini::cli
