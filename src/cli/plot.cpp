// signorini plot DIR: redraws the pictures of a run from its tables.
#include <filesystem>
#include <memory>

#include "cli/command.hpp"
#include "cli/gnuplot.hpp"
#include "cli/plot_any.hpp"
#include "cli/terminal.hpp"
#include "result/plots.hpp"

namespace signorini::cli {

namespace {

namespace fs = std::filesystem;

ExitCode plot(const fs::path& directory, const PlotWindow& window, const PictureLook& look) {
  if (window.from && window.to && *window.from >= *window.to)
    throw UsageError("--from: expected less than --to");
  if (!ready_to_draw(directory)) return ExitCode::interrupted;
  const std::vector<fs::path> scripts = first_ones(write_any_plots(directory, window, look));
  if (scripts.empty())
    throw FileError(directory.string(), "has nothing to draw: fewer than two output times, or rows");
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
  PlotWindow window;
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
  command->add_flag("--no-title", options->no_title, "neither title nor subtitle");
  command->callback([&program, options] {
    program.action = [options] {
      PictureLook look;
      look.title = !options->no_title;
      if (options->size) read_size(*options->size, look);
      if (options->formats) read_formats(*options->formats, look);
      if (options->language) read_language(*options->language, look);
      return plot(fs::path(options->directory), options->window, look);
    };
  });
}

}  // namespace signorini::cli
