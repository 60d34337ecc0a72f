// signorini paraview DIR: writes a run as frames for ParaView.
#include "report/paraview.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/command.hpp"
#include "cli/plot_any.hpp"
#include "cli/terminal.hpp"
#include "report/page.hpp"
#include "report/paraview_bodies.hpp"
#include "report/run_data.hpp"

namespace signorini::cli {

namespace {

namespace fs = std::filesystem;

struct FrameOptions {
  std::string directory;
  int count = 200;
  bool events = false;
};

ExitCode write_frames(const FrameOptions& options) {
  constexpr int most = 5000;
  if (options.count < 1 || options.count > most)
    throw UsageError(fmt::format("--frames: found {}, expected 1 to {}", options.count, most));
  const fs::path directory = options.directory;
  if (kind_of_results(directory) != "run") throw FileError(directory.string(), "holds no run");
  if (!ready_to_draw(directory)) return ExitCode::interrupted;
  const Scene scene = read_scene((directory / "run.toml").string());
  const Json data = run_data(scene, directory);
  const auto count = static_cast<std::size_t>(options.count);
  const std::vector<double> times = frame_times(data, count, options.events);
  std::string written = write_paraview(directory, data, times).string() + "\n";
  if (const auto bodies = write_paraview_bodies(directory, scene)) written += bodies->string() + "\n";
  print(written);
  return ExitCode::done;
}

}  // namespace

void add_paraview(Program& program) {
  auto options = std::make_shared<FrameOptions>();
  CLI::App* command =
      program.app.add_subcommand("paraview", "write a run as frames for ParaView: DIR/paraview/run.pvd");
  command->add_option("DIR", options->directory, "a directory that `signorini run` wrote")->required();
  command->add_option("--frames", options->count, "number of frames at equal time intervals (default: 200)")
      ->option_text("N");
  command->add_flag("--events", options->events, "a frame at the time of each event, too");
  command->callback([&program, options] { program.action = [options] { return write_frames(*options); }; });
}

}  // namespace signorini::cli
