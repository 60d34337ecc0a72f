#include "study/orbit/orbit_files.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <sstream>

#include "base/files.hpp"
#include "base/json.hpp"
#include "base/run_files.hpp"
#include "base/text.hpp"
#include "result/csv.hpp"
#include "result/states.hpp"
#include "result/summary.hpp"
#include "result/summary_parts.hpp"
#include "result/table.hpp"

namespace signorini::orbit_study {
namespace {

namespace fs = std::filesystem;

base::Json sequence_json(const Model& model, const Orbit& orbit) {
  base::Json list = base::Json::array();
  for (const Event& event : orbit.sequence)
    list.push_back({{"t", event.t},
                    {"contact", model.contacts[static_cast<std::size_t>(event.contact)].name},
                    {"event", to_string(event.type)},
                    {"from", to_string(event.from)},
                    {"to", to_string(event.to)}});
  return list;
}

base::Json cycle_json(const Energy& cycle) {
  base::Json json = base::Json::object();
  for (const EnergyColumn& column : energy_columns) json[column.name] = cycle.*column.value;
  return json;
}

/// The path as a TOML string.
std::string quoted(const fs::path& path) {
  std::string text = "\"";
  for (const char c : path.string()) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  return text + "\"";
}

/// Text of start/summary.json, with the only entries that a continuing run reads (scene/read_initial.cpp).
std::string start_summary(const Model& model) {
  const Scales& s = model.scales;
  const base::Json scales = {{"displacement", s.displacement},
                             {"rotation", s.rotation},
                             {"velocity", s.velocity},
                             {"angular_velocity", s.angular_velocity},
                             {"force", s.force}};
  return base::json_text(
      {{"what", "start of an orbit"}, {"model", {{"alpha", model.alpha}, {"scales", scales}}}});
}

/// Writes the state at t = 0. model: a model whose initial state is the start of the orbit.
void write_start(const fs::path& directory, const Model& model, const Orbit& orbit) {
  const Vector u = model.physical(model.u0, 0.0, 0), v = model.physical(model.v0, 0.0, 1);
  Sample sample{0.0, &u, &v, {}, {}};
  for (const Contact& contact : model.contacts) {
    ContactSample c;
    for (const auto& [name, T] : orbit.start.shears)
      if (name == contact.name) c.T = T;
    for (const auto& [name, sign] : orbit.start.slips)
      if (name == contact.name)
        c.state = sign > 0 ? State::slip_plus : sign < 0 ? State::slip_minus : State::stick;
    for (const auto& [name, value] : orbit.start.motions)
      if (name == contact.name + ".slip") c.slip = value - contact.surface_motion.value(0.0);
    sample.contacts.push_back(c);
  }
  result::StateWriter(directory, model).write(sample);
}

}  // namespace

std::string orbit_json(const Model& model, const Orbit& orbit) {
  base::Json multipliers = base::Json::array();
  for (const auto& mu : orbit.multipliers) multipliers.push_back({mu.real(), mu.imag()});
  base::Json steps = base::Json::array();
  for (const OrbitStep& step : orbit.steps)
    steps.push_back({{"residual", step.residual}, {"damping", step.damping}});
  base::Json json = {{"found", orbit.found},
                     {"reason", orbit.reason},
                     {"units", result::units_json(model.units)},
                     {"period", orbit.period},
                     {"autonomous", orbit.autonomous},
                     {"phase", orbit.phase},
                     {"section", orbit.section},
                     {"residual", orbit.residual},
                     {"amplitude", orbit.amplitude},
                     {"multipliers", multipliers},
                     {"multiplier_error", orbit.multiplier_error},
                     {"max_multiplier", orbit.max_multiplier},
                     {"stable", orbit.stable ? base::Json(*orbit.stable) : base::Json()},
                     {"loss", to_string(orbit.loss)},
                     {"families", orbit.families},
                     {"cycle", cycle_json(orbit.cycle)},
                     {"sequence", sequence_json(model, orbit)},
                     {"steps", steps}};
  return base::json_text(json);
}

Scene scene_starting_from(Scene scene, const fs::path& directory) {
  constexpr std::array replaced{"t_end", "output_dt", "output_times", "frames", "initial", "stages"};
  std::istringstream lines(scene.resolved);
  std::string text;
  bool in_run = false, skipping = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("[")) in_run = line == "[run]";
    const bool key = !line.empty() && line[0] >= 'a' && line[0] <= 'z';
    if (in_run && key) {
      skipping = false;
      for (const char* name : replaced) skipping = skipping || line.starts_with(std::string(name) + " =");
    }
    if (!in_run || line.empty()) skipping = false;
    if (skipping) continue;
    text += line + "\n";
    if (line == "[run]")
      text += fmt::format("t_end = {}\noutput_dt = {}\ninitial = {{ run = {} }}\n",
                          base::format_number(scene.run.t_end), base::format_number(*scene.run.output_dt),
                          quoted(fs::absolute(directory / "start").lexically_normal()));
  }
  scene.resolved = std::move(text);
  return scene;
}

void write_orbit(const fs::path& directory, const Scene& scene, const Model& model, const Orbit& orbit) {
  result::write_file(directory / "orbit.json", orbit_json(model, orbit));
  const fs::path start = directory / "start";
  base::make_directory(start);
  base::remove_manifest(start);
  write_start(start, model, orbit);
  result::write_file(start / "run.toml", scene.resolved);
  result::write_file(start / "summary.json", start_summary(model));
  result::write_file(start / base::manifest_file,
                     base::manifest_of(start, result::to_string(Outcome::Kind::done)).text());
}

namespace {

constexpr std::size_t max_phase_plots = 3;
constexpr const char* phase_plot_colours[] = {"#1f77b4", "#d95f02", "#1b9e77"};

/// Columns of history.csv for one degree of freedom.
struct PhasePlot {
  std::string u_name;
  std::size_t u, v;  // columns
  double least = 0.0, greatest = 0.0;
  [[nodiscard]] double range() const { return greatest - least; }
};

/// Pairs of columns such as "A.ux" and "A.vx", "d0.u" and "d0.v": a name, a dot, u or v, a direction.
std::vector<PhasePlot> phase_plots_of(const std::vector<std::string>& header) {
  std::vector<PhasePlot> list;
  for (std::size_t i = 0; i < header.size(); ++i) {
    const std::size_t point = header[i].rfind('.');
    if (point == std::string::npos || point + 1 >= header[i].size() || header[i][point + 1] != 'u') continue;
    std::string rate = header[i];
    rate[point + 1] = 'v';
    const auto found = std::find(header.begin(), header.end(), rate);
    if (found != header.end())
      list.push_back({header[i], i, static_cast<std::size_t>(found - header.begin())});
  }
  return list;
}

/// The phase portraits with the largest ranges of displacement.
std::vector<PhasePlot> greatest_phase_plots(const std::filesystem::path& directory) {
  result::CsvReader reader(directory / "history.csv");
  std::vector<PhasePlot> list = phase_plots_of(reader.header());
  for (bool first = true; reader.next(); first = false)
    for (PhasePlot& p : list) {
      const double u = reader.number(p.u);
      p.least = first ? u : std::min(p.least, u);
      p.greatest = first ? u : std::max(p.greatest, u);
    }
  std::stable_sort(list.begin(), list.end(),
                   [](const PhasePlot& a, const PhasePlot& b) { return a.range() > b.range(); });
  if (list.size() > max_phase_plots) list.resize(max_phase_plots);
  return list;
}

result::Picture phase_picture(const std::vector<PhasePlot>& portraits, const Units& units,
                              const result::PictureStyle& look) {
  result::Picture picture{
      "phase", "Velocity over displacement, one period",
      result::canvas_of(look, 120.0 + 420.0 * static_cast<double>(portraits.size()), false), false};
  picture.space = 70.0;
  for (const PhasePlot& p : portraits) {
    const std::size_t i = static_cast<std::size_t>(&p - portraits.data());
    std::string rate = p.u_name;
    rate[rate.rfind('.') + 1] = 'v';
    result::Panel panel{rate + " [" + units.length + "/" + units.time + "]",
                        {{"'../history.csv' skip 1", fmt::format("{}:{}", p.u + 1, p.v + 1),
                          fmt::format("with lines linewidth 1.6 linecolor '{}'", phase_plot_colours[i]),
                          p.u_name.substr(0, p.u_name.rfind('.'))}},
                        "set xrange [*:*]\nset xlabel " +
                            signorini::result::quoted(p.u_name + " [" + units.length + "]") + "\n"};
    panel.own_axis = true;
    picture.panels.push_back(panel);
  }
  return picture;
}

std::vector<std::complex<double>> unit_circle() {
  constexpr int pieces = 180;
  std::vector<std::complex<double>> list;
  for (int i = 0; i <= pieces; ++i)
    list.push_back(std::polar(1.0, 2.0 * std::numbers::pi * static_cast<double>(i) / pieces));
  return list;
}

result::Picture multiplier_picture(const Orbit& orbit, const result::PictureStyle& look) {
  const double greatest =
      std::max(1.0, orbit.multipliers.empty() ? 0.0 : std::abs(orbit.multipliers.front()));
  result::Picture picture{"multipliers", "Floquet multipliers and the unit circle",
                          result::canvas_of(look, 760.0, false), false};
  result::Panel panel{
      "imaginary part",
      {{"'circle.csv' skip 1", "1:2", "with lines linewidth 1.0 linecolor '#888888'", "unit circle"},
       {"'multipliers.csv' skip 1", "1:2", "with points pointtype 7 pointsize 1.0 linecolor '#c0182b'",
        "multipliers"}},
      "set size ratio -1\n" + result::range_of('x', -1.1 * greatest, 1.1 * greatest) +
          result::range_of('y', -1.1 * greatest, 1.1 * greatest) + "set xlabel 'real part'\n"};
  panel.after = "set size noratio\n";
  picture.panels.push_back(panel);
  return picture;
}

}  // namespace

bool is_picture_of_orbit(const std::filesystem::path& file) {
  return file.stem() == "multipliers" || file.stem() == "circle" || file.stem() == "phase";
}

result::PictureFiles orbit_pictures(const std::filesystem::path& directory, const std::string& title,
                                    const Units& units, const Orbit& orbit,
                                    const result::PictureStyle& look) {
  result::PictureFiles files(is_picture_of_orbit);
  const result::PlottedRun run = result::empty_plotted_run(title, units, look);
  if (!orbit.multipliers.empty()) {
    using Row = std::complex<double>;
    const result::CsvTable<Row> table = {{"real", [](const Row& mu) { return mu.real(); }},
                                         {"imaginary", [](const Row& mu) { return mu.imag(); }}};
    files.add_table("multipliers", table.text(orbit.multipliers));
    files.add_table("circle", table.text(unit_circle()));
    files.add(run, multiplier_picture(orbit, look));
  }
  const std::vector<PhasePlot> portraits = greatest_phase_plots(directory);
  if (!portraits.empty()) files.add(run, phase_picture(portraits, units, look));
  return files;
}

}  // namespace signorini::orbit_study
