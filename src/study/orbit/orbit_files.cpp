#include "study/orbit/orbit_files.hpp"

#include <fmt/core.h>

#include <array>
#include <sstream>

#include "base/json.hpp"
#include "base/number.hpp"
#include "base/output_directory.hpp"
#include "base/run_files.hpp"
#include "result/csv.hpp"
#include "result/states.hpp"
#include "result/summary.hpp"
#include "result/units_json.hpp"

namespace signorini {
namespace {

namespace fs = std::filesystem;

Json sequence_json(const Model& model, const Orbit& orbit) {
  Json list = Json::array();
  for (const Event& event : orbit.sequence)
    list.push_back({{"t", event.t},
                    {"contact", model.contacts[static_cast<std::size_t>(event.contact)].name},
                    {"event", to_string(event.type)},
                    {"from", to_string(event.from)},
                    {"to", to_string(event.to)}});
  return list;
}

Json cycle_json(const Energy& cycle) {
  Json json = Json::object();
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

/// Contains only the data from which a run continues (scene/read_initial.cpp).
std::string start_summary(const Model& model) {
  const Scales& s = model.scales;
  const Json scales = {{"displacement", s.displacement},
                       {"rotation", s.rotation},
                       {"velocity", s.velocity},
                       {"angular_velocity", s.angular_velocity},
                       {"force", s.force}};
  return json_text({{"what", "start of an orbit"}, {"model", {{"alpha", model.alpha}, {"scales", scales}}}});
}

/// The state at t = 0, from the model that begins with it.
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
  StateWriter(directory, model).write(sample);
}

}  // namespace

std::string orbit_json(const Model& model, const Orbit& orbit) {
  Json multipliers = Json::array();
  for (const auto& mu : orbit.multipliers) multipliers.push_back({mu.real(), mu.imag()});
  Json steps = Json::array();
  for (const OrbitStep& step : orbit.steps)
    steps.push_back({{"residual", step.residual}, {"damping", step.damping}});
  Json json = {{"found", orbit.found},
               {"reason", orbit.reason},
               {"units", units_json(model.units)},
               {"period", orbit.period},
               {"autonomous", orbit.autonomous},
               {"phase", orbit.phase},
               {"section", orbit.section},
               {"residual", orbit.residual},
               {"amplitude", orbit.amplitude},
               {"multipliers", multipliers},
               {"multiplier_error", orbit.multiplier_error},
               {"max_multiplier", orbit.max_multiplier},
               {"stable", orbit.stable ? Json(*orbit.stable) : Json()},
               {"loss", to_string(orbit.loss)},
               {"families", orbit.families},
               {"cycle", cycle_json(orbit.cycle)},
               {"sequence", sequence_json(model, orbit)},
               {"steps", steps}};
  return json_text(json);
}

Scene scene_beginning_in(Scene scene, const fs::path& directory) {
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
      text += fmt::format("t_end = {}\noutput_dt = {}\ninitial = {{ run = {} }}\n", shortest(scene.run.t_end),
                          shortest(*scene.run.output_dt),
                          quoted(fs::absolute(directory / "start").lexically_normal()));
  }
  scene.resolved = std::move(text);
  return scene;
}

void write_orbit(const fs::path& directory, const Scene& scene, const Model& model, const Orbit& orbit) {
  write_file(directory / "orbit.json", orbit_json(model, orbit));
  const fs::path start = directory / "start";
  make_directory(start);
  remove_manifest(start);
  write_start(start, model, orbit);
  write_file(start / "run.toml", scene.resolved);
  write_file(start / "summary.json", start_summary(model));
  write_file(start / manifest_file, manifest_of(start, to_string(Outcome::Kind::done)).text());
}

}  // namespace signorini
