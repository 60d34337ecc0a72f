// signorini plot DIR: draws the pictures of a run again, from its tables.
#include <filesystem>
#include <memory>

#include "cli/command.hpp"
#include "cli/gnuplot.hpp"
#include "cli/terminal.hpp"
#include "result/plots.hpp"

namespace signorini::cli {

namespace {

namespace fs = std::filesystem;

ExitCode plot(const fs::path& directory, const PlotWindow& window) {
  if (window.from && window.to && *window.from >= *window.to)
    throw UsageError("--from: expected less than --to");
  const std::vector<fs::path> scripts = first_ones(write_plots(directory, window));
  if (scripts.empty())
    throw FileError(directory.string(), "has fewer than two output times: nothing to draw");
  const Drawing drawing = draw(scripts);
  if (drawing.kind == Drawing::Kind::no_gnuplot) {
    throw FileError("gnuplot", "not found on PATH; the scripts are in " + (directory / "plots").string());
  }
  if (drawing.kind == Drawing::Kind::failed) throw FileError("gnuplot", drawing.message);
  std::string text;
  for (fs::path picture : scripts) {
    text += picture.replace_extension(".png").string() + "\n";
    text += picture.replace_extension(".svg").string() + "\n";
  }
  print(text);
  return ExitCode::done;
}

}  // namespace

void add_plot(Program& program) {
  auto directory = std::make_shared<std::string>();
  auto window = std::make_shared<PlotWindow>();
  CLI::App* command = program.app.add_subcommand("plot", "draw the pictures of a run again");
  command->add_option("DIR", *directory, "a directory that `signorini run` wrote")->required();
  command->add_option("--from", window->from, "first time shown (default: the whole run)")->option_text("T");
  command->add_option("--to", window->to, "last time shown")->option_text("T");
  command->callback([&program, directory, window] {
    program.action = [directory, window] { return plot(fs::path(*directory), *window); };
  });
}

}  // namespace signorini::cli
