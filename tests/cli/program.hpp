// program.hpp: runs the program `signorini` the way a shell would, and keeps what it says.
#pragma once

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "this_build.hpp"

namespace signorini::cli_test {

struct Ending {
  int code = -1;
  std::string out, err;
};

/// A folder of its own, in which the program runs; gone with its owner.
class Shell {
 public:
  Shell() {
    std::string pattern = (std::filesystem::temp_directory_path() / "signorini-cli-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~Shell() { std::filesystem::remove_all(folder_); }
  Shell(const Shell&) = delete;
  Shell& operator=(const Shell&) = delete;

  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  [[nodiscard]] std::string read(const std::string& name) const {
    std::ifstream file(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  /// Names of what is in the folder, but for the captured streams.
  [[nodiscard]] std::vector<std::string> list() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      const std::string name = entry.path().filename().string();
      if (name != ".out" && name != ".err") names.push_back(name);
    }
    return names;
  }

  [[nodiscard]] pid_t start(const std::vector<std::string>& arguments, const std::string& out = ".out",
                            rlim_t file_size = RLIM_INFINITY) const {
    std::vector<char*> argv = {const_cast<char*>("signorini")};
    for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
    argv.push_back(nullptr);
    const pid_t child = fork();
    if (child != 0) return child;
    if (file_size != RLIM_INFINITY) {
      std::signal(SIGXFSZ, SIG_IGN);
      const rlimit limit{file_size, file_size};
      setrlimit(RLIMIT_FSIZE, &limit);
    }
    if (chdir(folder_.c_str()) != 0) _exit(125);
    dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
    dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
    dup2(open(".err", O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
    execv(tests::program, argv.data());
    _exit(125);
  }
  [[nodiscard]] Ending wait(pid_t child) const {
    int status = 0;
    waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read(".out"), read(".err")};
  }
  [[nodiscard]] Ending run(const std::vector<std::string>& arguments) const { return wait(start(arguments)); }

 private:
  std::filesystem::path folder_;
};

[[nodiscard]] inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A shell line in the folder; the program is $SIGNORINI. The exit code.
inline int line(const Shell& shell, const std::string& text) {
  const std::string command =
      "cd '" + (shell / "").string() + "' && SIGNORINI='" + tests::program + "' && " + text;
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

[[nodiscard]] inline bool on_path(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

[[nodiscard]] inline long lines(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n');
}

[[nodiscard]] inline bool exists(const Shell& shell, const std::string& name) {
  return std::filesystem::exists(shell / name);
}

/// Block on a belt: a few events a time unit, for as long as asked.
inline std::string belt(double t_end) {
  return R"(schema = 1
title = "Block on a moving belt"
units = { force = "N", mass = "kg", length = "m", time = "s" }
[run]
t_end = )" +
         std::to_string(t_end) + R"(
initial = { block = { ux = 0.0, vx = 0.0 } }
output_dt = 0.1
[nodes]
block = [0.0, 0.0]
[[masses]]
node = "block"
mass = 1.0
[[supports]]
node = "block"
fix = ["uy"]
[[springs]]
node = "block"
direction = [1.0, 0.0]
stiffness = 1.0
[[contacts]]
name = "belt"
node = "block"
law = "slider"
tangent = [1.0, 0.0]
normal_force = 1.0
friction = { static = 1.5, kinetic = 1.0 }
surface_velocity = 0.2
)";
}

}  // namespace signorini::cli_test
