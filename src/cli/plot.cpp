// signorini plot DIR: redraws the pictures of a run from its tables.

#include "cli/plot.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string_view>
#include <thread>

#include "base/json.hpp"
#include "base/run_files.hpp"
#include "cli/command.hpp"
#include "cli/progress_display.hpp"
#include "cli/terminal.hpp"
#include "report/page.hpp"
#include "result/plots.hpp"
#include "signorini/error.hpp"
#include "study/compare/comparison_plots.hpp"
#include "study/prepared_run.hpp"
#include "study/sensitivity/sensitivity_files.hpp"
#include "study/sensitivity/sensitivity_plots.hpp"
#include "study/sweep/sweep_directory.hpp"
#include "study/sweep/sweep_plots.hpp"

namespace signorini::cli {
namespace {

using Clock = std::chrono::steady_clock;

// Exit codes as in a shell: program not found; program could not be started.
constexpr int no_program = 127, exit_not_started = 126;
constexpr int exit_stopped = 124;  // exit code as of timeout(1): gnuplot was stopped
// Time limit for one picture; gnuplot usually takes one or two seconds.
constexpr std::chrono::seconds patience{60};
constexpr std::size_t max_output = 1 << 16;
// Limit of the number of pictures of contacts, each of which takes about 0.17 s.
constexpr std::size_t max_contact_pictures = 24;

struct ExitStatus {
  int code = 0;
  std::string output;
};

// Only async-signal-safe calls are allowed between fork and exec.
[[noreturn]] void exec_gnuplot(const char* folder, const char* script, int output) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // gnuplot ends with its parent
  const int nothing = open("/dev/null", O_RDWR);
  dup2(nothing, STDIN_FILENO);
  dup2(nothing, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  if (chdir(folder) == 0) execlp("gnuplot", "gnuplot", "-d", script, static_cast<char*>(nullptr));
  _exit(errno == ENOENT ? no_program : exit_not_started);
}

/// Reads gnuplot's output until gnuplot closes it. Returns false if this takes until `last`, or if the output exceeds
/// `max_output` bytes.
bool listen(int end, Clock::time_point last, std::string& output) {
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
    output.append(buffer.data(), static_cast<std::size_t>(n));
    if (output.size() > max_output) return false;
  }
}

/// Exit code of the child process; nullopt if the process has not ended at the time `last`.
std::optional<int> wait_for(pid_t child, Clock::time_point last) {
  for (;;) {
    int status = 0;
    if (waitpid(child, &status, WNOHANG) == child)
      return WIFEXITED(status) ? WEXITSTATUS(status) : exit_not_started;
    if (Clock::now() > last) return std::nullopt;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

ExitStatus run_gnuplot(const std::filesystem::path& script) {
  const std::string folder = script.parent_path().string(), name = script.filename().string();
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return {exit_not_started, "cannot create a pipe"};
  const pid_t child = fork();
  if (child == 0) {
    setpgid(0, 0);  // a new process group, so that gnuplot's own children can also be ended
    close(ends[0]);
    exec_gnuplot(folder.c_str(), name.c_str(), ends[1]);
  }
  close(ends[1]);
  if (child < 0) {
    close(ends[0]);
    return {exit_not_started, "cannot start a process"};
  }
  const auto last = Clock::now() + patience;
  std::string output;
  const bool silent = listen(ends[0], last, output);
  close(ends[0]);
  if (silent)
    if (const auto code = wait_for(child, last)) return {*code, output};
  setpgid(child, child);  // also in the parent, because parent and child run in either order
  kill(-child, SIGKILL);
  while (waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
  }
  return {exit_stopped, output.size() > max_output
                            ? "gnuplot printed more than 64 kB and was stopped"
                            : fmt::format("gnuplot ran longer than {} s and was stopped", patience.count())};
}

}  // namespace

std::vector<std::filesystem::path> scripts_to_draw(const std::vector<std::filesystem::path>& scripts) {
  std::vector<std::filesystem::path> first;
  std::size_t contacts = 0;
  for (const auto& script : scripts)
    if (!script.filename().string().starts_with("contact-") || contacts++ < max_contact_pictures)
      first.push_back(script);
  return first;
}

Drawing draw(const std::vector<std::filesystem::path>& scripts) {
  Drawing drawing;
  std::size_t failed = 0;
  for (const auto& script : scripts) {
    const ExitStatus status = run_gnuplot(script);
    if (status.code == no_program) return {Drawing::Kind::no_gnuplot, ""};
    if (status.code == 0) continue;
    if (failed++ == 0) drawing = {Drawing::Kind::failed, script.string() + ": " + status.output};
    if (status.code == exit_stopped)
      return drawing;  // gnuplot itself hangs, so the other pictures would hang as well
  }
  if (failed > 1)
    drawing.message +=
        fmt::format("\n{} of {} pictures failed; the other pictures are drawn", failed, scripts.size());
  else if (failed == 1 && scripts.size() > 1)
    drawing.message += "\nthe other pictures are drawn";
  return drawing;
}

std::string draw_pictures(const std::filesystem::path& directory,
                          const std::vector<std::filesystem::path>& scripts, const std::string& later) {
  if (scripts.empty()) return "";
  const std::string folder = (directory / "plots").string();
  const std::vector<std::filesystem::path> first = scripts_to_draw(scripts);
  const Drawing drawing = draw(first);
  const std::string more = first.size() == scripts.size()
                               ? ""
                               : fmt::format(
                                     ", of the first {} contacts; in this folder, `gnuplot contact-NAME.gp` "
                                     "draws the other pictures",
                                     max_contact_pictures);
  if (drawing.kind == Drawing::Kind::drawn) return "pictures: " + folder + "/*.png and *.svg" + more + "\n";
  if (drawing.kind == Drawing::Kind::no_gnuplot)
    return "pictures: no gnuplot on PATH; the gnuplot scripts are in " + folder + later + "\n";
  print_note("gnuplot failed: " + drawing.message);
  return first.size() > 1 ? "pictures: " + folder + "/*.png and *.svg, as far as they could be drawn\n" : "";
}

namespace fs = std::filesystem;

namespace {

result::PictureFiles pictures_of_sweep(const fs::path& directory, const result::PictureStyle& look) {
  const sweep::SweepDirectory swept(directory, sweep::read_sweep_spec(directory), false);
  return sweep::sweep_pictures(swept.spec(), swept.rows(), look);
}

result::PictureFiles pictures_of_sensitivities(const fs::path& directory, const result::PictureStyle& look) {
  sensitivity_study::Sigmas sigmas;
  const Sensitivities s = sensitivity_study::read_sensitivities(directory, sigmas);
  return sensitivity_study::sensitivity_pictures(s, sigmas, look);
}

/// Scripts for a comparison. Runs by engine are in folders with the name of the engine; other runs are in the directories
/// that compare.json names.
std::vector<fs::path> comparison_scripts(const fs::path& directory, const result::PictureStyle& look) {
  const fs::path file = directory / "compare.json";
  std::ifstream stream(file, std::ios::binary);
  compare::ComparisonReport report;
  try {
    const base::Json json = base::parse_json(stream);
    for (const base::Json& run : json.at("runs")) {
      const std::string name = run.at("name");
      if (run.at("outcome") == "refused") continue;
      std::error_code error;
      const bool here = fs::is_directory(directory / name, error);
      const fs::path place = here ? directory / name : fs::path(run.at("directory"));
      report.runs.push_back(compare::read_compared_run(place, name));
      print_unchecked(place);
    }
  } catch (const base::Json::exception& error) {
    throw FileError(file.string(), std::string("is not a comparison: ") + error.what());
  }
  if (report.runs.empty()) throw FileError(file.string(), "has no runs");
  compare::begin_comparison_plots(directory);
  for (std::size_t i = 1; i < report.runs.size(); ++i) {
    compare::ComparisonSettings settings;
    settings.folder = directory / "plots";
    settings.slug = compare::run_slug(report.runs[i].figures.name, i);
    report.comparisons.push_back(compare::compare_runs(report.runs.front(), report.runs[i], settings));
  }
  return compare::write_comparison_plots(directory, report, look);
}

}  // namespace

bool ready_to_draw(const fs::path& directory) {
  if (report::kind_of_results(directory) != "run") return true;
  print_unchecked(directory);
  if (!study::lacks_picture_rows(directory)) {
    base::check_run_files(directory);
    return true;
  }
  std::vector<std::string_view> others(base::result_files.begin(), base::result_files.end());
  std::erase_if(others, [](std::string_view file) {
    return std::find(base::picture_rows.begin(), base::picture_rows.end(), file) != base::picture_rows.end();
  });
  base::check_run_files(directory, others);
  print_note(directory.string() + ": pictures need a new computation, because the run used --no-plots");
  return study::add_picture_rows(directory, [] { return !Interrupt::requested(); });
}

std::vector<fs::path> write_plot_scripts(const fs::path& directory, const result::PlotWindow& window,
                                         const result::PictureStyle& look) {
  const std::string kind = report::kind_of_results(directory);
  if (kind == "run") return result::run_pictures(directory, window, look).write(directory);
  if (window.from || window.to)
    throw UsageError(fmt::format("{}: {} is a {}, and its pictures do not show time; omit this option",
                                 window.from ? "--from" : "--to", directory.string(), kind));
  if (kind == "sweep") return pictures_of_sweep(directory, look).write(directory);
  if (kind == "sensitivity") return pictures_of_sensitivities(directory, look).write(directory);
  if (kind == "comparison") return comparison_scripts(directory, look);
  throw FileError(
      directory.string(),
      fmt::format("is a {}; runs, comparisons, sweeps and sensitivities can be drawn again", kind));
}

namespace {

namespace fs = std::filesystem;

ExitCode plot(const fs::path& directory, const result::PlotWindow& window, const result::PictureStyle& look) {
  if (window.from && window.to && *window.from >= *window.to)
    throw UsageError("--from: expected less than --to");
  if (!ready_to_draw(directory)) return ExitCode::interrupted;
  const std::vector<fs::path> scripts = scripts_to_draw(write_plot_scripts(directory, window, look));
  if (scripts.empty())
    throw FileError(directory.string(),
                    "has nothing to draw: the results have fewer than two output times or rows");
  const Drawing drawing = draw(scripts);
  if (drawing.kind == Drawing::Kind::no_gnuplot) {
    throw FileError("gnuplot", "not found on PATH; the scripts are in " + (directory / "plots").string());
  }
  if (drawing.kind == Drawing::Kind::failed) throw FileError("gnuplot", drawing.message);
  std::string text;
  for (fs::path picture : scripts) {
    for (const std::string& format : look.formats) text += picture.replace_extension(format).string() + "\n";
  }
  print(text);
  return ExitCode::done;
}

struct PlotOptions {
  std::string directory;
  result::PlotWindow window;
  std::optional<std::string> size, formats, language;
  bool no_title = false;
};

}  // namespace

void add_plot(Program& program) {
  auto options = std::make_shared<PlotOptions>();
  CLI::App* command = program.app.add_subcommand(
      "plot", "draw the pictures of a run, comparison, sweep or sensitivities again");
  command->add_option("DIR", options->directory, "a directory of results")->required();
  command->add_option("--from", options->window.from, "first time shown (default: the whole run)")
      ->option_text("T");
  command->add_option("--to", options->window.to, "last time shown")->option_text("T");
  command
      ->add_option("--size", options->size,
                   "width in mm, or width and height: 160x90 (default: for a screen)")
      ->option_text("WxH");
  command->add_option("--format", options->formats, "svg, png, pdf, several with commas (default: svg,png)")
      ->option_text("NAME,...");
  command
      ->add_option("--language", options->language,
                   "language of labels and legends: en, de or ru (default: en)")
      ->option_text("NAME");
  command->add_flag("--no-title", options->no_title, "draw neither title nor subtitle");
  command->callback([&program, options] {
    program.action = [options] {
      result::PictureStyle look;
      look.title = !options->no_title;
      if (options->size) result::read_size(*options->size, look);
      if (options->formats) result::read_formats(*options->formats, look);
      if (options->language) result::read_language(*options->language, look);
      return plot(fs::path(options->directory), options->window, look);
    };
  });
}

}  // namespace signorini::cli
