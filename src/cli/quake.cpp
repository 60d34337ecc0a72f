// signorini quake NAME: writes a synthetic accelerogram, as files for a scene.
#include "cli/quake.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "base/text.hpp"
#include "cli/command.hpp"
#include "cli/terminal.hpp"
#include "result/csv.hpp"
#include "scene/record_header.hpp"
#include "study/quake/quake.hpp"
#include "study/quake/spectra.hpp"

namespace signorini::cli {

namespace {

namespace fs = std::filesystem;

quake::QuakeSpec quake_spec(const QuakeOptions& options) {
  const auto within = [](const char* option, double value, double least, double most) {
    if (!(value >= least && value <= most))
      throw UsageError(fmt::format("--{}: found {}, expected a number from {} to {}", option,
                                   base::format_number(value), least, most));
  };
  within("pga", options.pga, 1e-6, 100.0);
  within("duration", options.duration, 1.0, 600.0);
  within("dt", options.dt, 1e-4, 0.1);
  within("ground-frequency", options.ground_frequency, 0.1, 50.0);
  within("ground-damping", options.ground_damping, 0.01, 2.0);
  constexpr long greatest_seed = 4294967295;  // limit of the random generator
  if (options.seed < 0 || options.seed > greatest_seed)
    throw UsageError(
        fmt::format("--seed: found {}, expected an integer from 0 to {}", options.seed, greatest_seed));
  const double steps = options.duration / options.dt;
  if (std::abs(steps - std::round(steps)) > 1e-6 * steps || steps < 100.0 || steps > 100000.0)
    throw UsageError(fmt::format("--duration {}: expected a multiple of --dt {}, from 100 to 100000 steps",
                                 base::format_number(options.duration), base::format_number(options.dt)));
  quake::QuakeSpec spec;
  spec.pga = options.pga;
  spec.duration = options.duration;
  spec.dt = options.dt;
  spec.seed = static_cast<unsigned long>(options.seed);
  spec.ground_frequency = options.ground_frequency;
  spec.ground_damping = options.ground_damping;
  if (options.spectrum) {
    if (options.dt > quake::min_matched_period / 4.0)
      throw UsageError(fmt::format("--dt: found {}, expected at most {} with --spectrum",
                                   base::format_number(options.dt), quake::min_matched_period / 4.0));
    spec.target = quake::TargetSpectrum::read(*options.spectrum, options.pga);
  }
  return spec;
}

/// Command line that reproduces the files, for their comments.
std::string quake_command(const QuakeOptions& options) {
  std::string text = fmt::format("signorini quake NAME --pga {} --duration {} --dt {} --seed {}",
                                 base::format_number(options.pga), base::format_number(options.duration),
                                 base::format_number(options.dt), options.seed);
  if (options.spectrum) text += " --spectrum " + fs::path(*options.spectrum).filename().string();
  return text + fmt::format(" --ground-frequency {} --ground-damping {}",
                            base::format_number(options.ground_frequency),
                            base::format_number(options.ground_damping));
}

std::string at2_text(const QuakeOptions& options, const std::vector<double>& a) {
  std::string text = fmt::format(
      "SYNTHETIC ACCELEROGRAM, NOT A RECORD\n{}\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= {}, DT= {} "
      "SEC\n",
      quake_command(options), a.size(), base::format_number(options.dt));
  for (std::size_t i = 0; i < a.size(); ++i)
    text += fmt::format("{:>16.8E}{}", a[i], i % 5 == 4 || i + 1 == a.size() ? "\n" : "");
  return text;
}

std::string csv_text(const QuakeOptions& options, const std::vector<double>& a) {
  std::string text = "# " + quake_command(options) + "\n# t in s, a in m/s^2\nt,a\n";
  for (std::size_t i = 0; i < a.size(); ++i)
    text += fmt::format("{},{}\n",
                        base::format_number(std::round(static_cast<double>(i) * options.dt * 1e9) / 1e9),
                        base::format_number(a[i] * scene::standard_gravity));
  return text;
}

std::string ground_text(const quake::QuakeSpec& spec, const std::vector<double>& a) {
  const quake::GroundMotion ground = quake::ground_motion(a, spec.dt);
  double pga = 0.0;
  for (const double value : a) pga = std::max(pga, std::abs(value));
  std::string text = fmt::format(
      "peak acceleration {:.4g} g, velocity {:.4g} m/s, displacement {:.4g} m; final velocity and "
      "displacement are 0\n",
      pga, ground.velocity * scene::standard_gravity, ground.displacement * scene::standard_gravity);
  if (!spec.target) return text;
  double least = 1e300, greatest = 0.0;
  // Periods in steps of 1 %, both ends included; peaks of a spectrum at 5 % damping are wider.
  const int last = static_cast<int>(
      std::ceil(std::log(quake::max_matched_period / quake::min_matched_period) / std::log(1.01)));
  for (int i = 0; i <= last; ++i) {
    const double T =
        quake::min_matched_period *
        std::pow(quake::max_matched_period / quake::min_matched_period, static_cast<double>(i) / last);
    const double quotient =
        quake::pseudo_acceleration(a, spec.dt, T, quake::spectrum_damping) / spec.target(T);
    least = std::min(least, quotient);
    greatest = std::max(greatest, quotient);
  }
  return text +
         fmt::format("response spectrum, 5 % damping, {} s to {} s: {:.0f} % to {:.0f} % of the target\n",
                     quake::min_matched_period, quake::max_matched_period, 100.0 * least, 100.0 * greatest);
}

}  // namespace

void add_quake_options(CLI::App& command, QuakeOptions& options) {
  command.add_option("NAME", options.name, "the files to write: NAME.AT2 and NAME.csv")->required();
  command
      .add_option("--pga", options.pga,
                  "peak ground acceleration in g; for ec8 spectra the design acceleration ag (default: 0.3)")
      ->option_text("A");
  command
      .add_option(
          "--spectrum", options.spectrum,
          "match a response spectrum at 5 % damping: ec8-A to ec8-E, or a file of rows T,PSA in s and g")
      ->option_text("NAME|FILE");
  command.add_option("--seed", options.seed, "seed of the random phases (default: 1)")->option_text("S");
  command.add_option("--duration", options.duration, "in s (default: 20)")->option_text("D");
  command.add_option("--dt", options.dt, "time step in s (default: 0.01)")->option_text("DT");
  command
      .add_option("--ground-frequency", options.ground_frequency,
                  "ground frequency of the Kanai-Tajimi filter, in Hz (default: 2.5)")
      ->option_text("F");
  command
      .add_option("--ground-damping", options.ground_damping,
                  "damping ratio of the Kanai-Tajimi filter (default: 0.6)")
      ->option_text("Z");
  command.add_flag("--force", options.force, "replace existing files");
  command.add_flag("--quiet", options.quiet, "print errors only");
}

std::vector<std::string> quake_files(const QuakeOptions& options) {
  return {options.name + ".AT2", options.name + ".csv"};
}

std::string write_quake(const QuakeOptions& options) {
  if (fs::path(options.name).filename().empty())
    throw UsageError(fmt::format("NAME: found \"{}\", expected a file's name", options.name));
  const quake::QuakeSpec spec = quake_spec(options);
  for (const std::string& file : quake_files(options))
    if (!options.force && fs::exists(fs::symlink_status(file)))
      throw FileError(file, "file exists; use --force to replace it");
  const std::vector<double> a = quake::quake(spec);
  result::write_file(quake_files(options)[0], at2_text(options, a));
  result::write_file(quake_files(options)[1], csv_text(options, a));
  return options.quiet ? "" : ground_text(spec, a);
}

void add_quake(Program& program) {
  auto options = std::make_shared<QuakeOptions>();
  CLI::App* command =
      program.app.add_subcommand("quake", "make a synthetic accelerogram: NAME.AT2, NAME.csv");
  add_quake_options(*command, *options);
  command->callback([&program, options] {
    program.action = [options] {
      const std::string text = write_quake(*options);
      if (!options->quiet)
        print(fmt::format("{}, {}\n", quake_files(*options)[0], quake_files(*options)[1]) + text);
      return ExitCode::done;
    };
  });
}

}  // namespace signorini::cli
