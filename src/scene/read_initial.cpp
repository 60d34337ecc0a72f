// run.initial: "static", "frictional", the state of another run, or displacements and velocities at t = 0.
#include <fmt/core.h>

#include <cmath>

#include "base/json.hpp"
#include "base/run_files.hpp"
#include "base/text.hpp"
#include "scene/components.hpp"
#include "scene/data_file.hpp"
#include "scene/readers.hpp"
#include "scene/saved_state.hpp"

namespace signorini::scene {

namespace {

void read_list(Table& table, std::string_view key, const NameScope& space, std::vector<double>& values) {
  if (const toml::node* node = table.raw(key); node && node->is_string()) {
    values = read_vector_file(table, key, space);
    table.record(key, toml_numbers(values));
    return;
  }
  const auto given = table.numbers(key);
  if (!given) return;
  const std::size_t size = space.names.size();
  if (given->size() != size) {
    table.fail(key, fmt::format("found {}, expected {}, one for each degree of freedom",
                                base::count_text(given->size(), "number"), size));
  }
  values = *given;
}

void read_nodes_state(Table& table, InitialSpec& initial, const NameScope& space) {
  for (const Entry& entry : entries_of(table.node())) {
    const auto group = space.groups.find(entry.name);
    if (group == space.groups.end())
      check_node(entry.name, space, entry.place(), table.path(entry.name), true);
    const toml::node* node = table.raw(entry.name);
    if (!node->is_table()) table.wrong(entry.name, "a table { ux = ..., vx = ... }");
    Table state(node->as_table(), "run.initial.*", table.path(entry.name), place_of(*node));
    for (const bool rate : {false, true})
      for (const PlaneComponent& c : plane_components) {
        const char* component = rate ? c.velocity : c.displacement;
        if (const auto value = state.optional_number(component))
          for (const std::string& name :
               group == space.groups.end() ? std::vector<std::string>{entry.name} : group->second)
            initial.components.push_back({name, component, *value, state.place(component)});
      }
    state.finish();
    table.record(entry.name, state.record().inline_table());
  }
}

void read_stages(Table& run, InitialSpec& initial) {
  const toml::node* node = run.raw("stages");
  if (!node) return;
  const toml::array* array = node->as_array();
  if (!array || array->empty()) run.wrong("stages", "tables under [[run.stages]]");
  if (!initial.is_frictional) run.fail("stages", "has no meaning without initial = \"frictional\"");
  std::vector<std::string> texts;
  Names names{"fit", "geometric"};
  for (const toml::node& item : *array) {
    const std::string path = run.path("stages") + "." + std::to_string(texts.size() + 1);
    if (!item.is_table()) refuse(place_of(item), path, "found " + describe(item) + ", expected a table");
    Table table(item.as_table(), "run.stages[]", path, place_of(item));
    StageSpec stage;
    stage.place = table.place();
    stage.name = table.text("name");
    if (!names.add(stage.name))
      table.fail("name",
                 fmt::format("found \"{}\" twice, expected each stage to have its own name", stage.name));
    table.require("loads", "");
    stage.loads = table.texts("loads");
    for (const toml::node& load : *table.raw("loads")->as_array())
      stage.load_places.push_back(place_of(load));
    stage.steps = table.integer("steps");
    constexpr int most_steps = 10'000;
    if (stage.steps > most_steps) table.wrong("steps", fmt::format("an integer from 1 to {}", most_steps));
    table.finish();
    initial.stages.push_back(std::move(stage));
    texts.push_back(table.record().inline_table());
  }
  run.record("stages", toml_array(texts));
}

/// Part `model` of the summary of a run; empty if the run was killed before it wrote a summary. Errors: FileError.
base::Json model_of_run(const std::filesystem::path& directory) {
  const std::filesystem::path path = directory / "summary.json";
  std::ifstream in(path);
  if (!in) return {};
  try {
    return base::parse_json(in).value("model", base::Json{});
  } catch (const base::Json::exception& error) {
    throw FileError(path.string(), std::string("is not the summary of a run: ") + error.what());
  }
}

std::optional<double> alpha_of_run(const base::Json& model) {
  const auto alpha = model.find("alpha");
  if (alpha == model.end() || !alpha->is_number()) return std::nullopt;
  return alpha->get<double>();
}

std::optional<std::array<double, 5>> scales_of_run(const base::Json& model) {
  try {
    const base::Json& scales = model.at("scales");
    std::array<double, 5> found{};
    std::size_t i = 0;
    for (const char* name : {"displacement", "rotation", "velocity", "angular_velocity", "force"})
      found[i++] = scales.at(name).get<double>();
    for (const double scale : found)
      if (!(std::isfinite(scale) && scale > 0.0)) return std::nullopt;
    return found;
  } catch (const base::Json::exception&) {
    return std::nullopt;
  }
}

/// Vertical loads of pendulums in the run to be continued, by name. They are part of its stiffness matrix, and so of its
/// damping and stored energy.
std::vector<std::pair<std::string, double>> carried_in_run(const base::Json& model) {
  std::vector<std::pair<std::string, double>> found;
  const auto pendulums = model.find("pendulums");
  if (pendulums == model.end() || !pendulums->is_object()) return found;
  for (const auto& [name, force] : pendulums->items())
    if (force.is_number()) found.emplace_back(name, force.get<double>());
  return found;
}

void read_from_run(Table& run, InitialSpec& initial, const Scene& scene) {
  Table table = run.child("initial");
  const std::string name = table.text("run");
  const std::filesystem::path directory = directory_of(scene) / name, path = directory / "states.csv";
  if (name.empty() || name.find('\0') != std::string::npos) table.wrong("run", "the directory of a run");
  if (std::error_code ignored; !std::filesystem::is_directory(directory, ignored))
    refuse_file(table, "run", directory,
                std::filesystem::exists(directory, ignored) ? "not a directory; give the directory of a run"
                                                            : "there is no such directory");
  base::Json model;
  try {
    base::check_run_files(directory,
                          {"states.csv", "contacts.csv", prestress_file, "summary.json", "run.toml"});
    model = model_of_run(directory);
  } catch (const FileError& error) {
    refuse_file(table, "run", error);
  }
  std::ifstream in = open_data_file(table, "run", path);
  const std::optional<double> t = table.optional_number("t");
  table.finish("has no meaning together with run");
  SavedStates found = read_saved_states(in, path.string(), table.path("run"), t);
  if (!found.state && !t) table.fail("run", fmt::format("found no state in {}", path.string()));
  if (!found.state)
    table.fail(
        "t", fmt::format("found the number {}, expected one of the times in {}: {}", base::format_number(*t),
                         path.string(), found.times.empty() ? "none" : base::join_texts(found.times)));
  initial.saved = std::move(*found.state);
  initial.saved->run = directory.string();
  initial.saved->final_contacts = read_final_contacts(directory / "contacts.csv", initial.saved->t);
  initial.saved->prestress = read_prestress(directory / prestress_file, table.path("run"));
  initial.saved->scales = scales_of_run(model);
  initial.saved->pendulum_forces = carried_in_run(model);
  if (const auto alpha = alpha_of_run(model)) initial.saved->motions.emplace_back(saved_alpha, *alpha);
  ResolvedTable record;
  record.set("run", toml_string(std::filesystem::absolute(directory).lexically_normal().string()));
  if (t) record.set("t", toml_number(*t));
  run.record("initial", record.inline_table());
}

/// True if `node`, the value of run.initial, refers to another run. A node of the structure may have the name
/// of the key `run` or `t`; its value is then a table.
bool is_of_run(Table& run, const toml::node* node) {
  const toml::table* table = node ? node->as_table() : nullptr;
  if (!table) return false;
  if (const toml::node* directory = table->get("run"); directory && !directory->is_table()) return true;
  if (const toml::node* t = table->get("t"); t && !t->is_table())
    refuse(place_of(*t), run.path("initial") + ".t",
           "needs the key run (the directory of a run) in the same table");
  return false;
}

}  // namespace

void read_initial(Table& run, Scene& scene) {
  InitialSpec& initial = scene.initial;
  initial.place = run.place("initial");
  const toml::node* node = run.raw("initial");
  if (node && !node->is_table()) {
    const std::string kind = node->value<std::string>().value_or("");
    initial.is_static = kind == "static";
    initial.is_frictional = kind == "frictional";
    if (!initial.is_static && !initial.is_frictional)
      run.wrong("initial", describe_type(*find_key("run", "initial")) +
                               base::did_you_mean(kind, {"static", "frictional"}));
    run.record("initial", toml_string(kind));
  }
  read_stages(run, initial);
  if (node && !node->is_table()) return;
  if (is_of_run(run, node)) {
    read_from_run(run, initial, scene);
    return;
  }

  const NameScope space = name_scope(scene);
  if (space.matrices) {
    Table table = run.child("initial");
    for (const Entry& entry : entries_of(table.node())) {
      if (entry.name != "u" && entry.name != "v") {
        refuse(entry.place(), table.path(entry.name), "unknown key; with [matrices] the keys are u and v");
      }
    }
    read_list(table, "u", space, initial.u);
    read_list(table, "v", space, initial.v);
    run.record("initial", table.record().inline_table());
  } else {
    Table table(node ? node->as_table() : nullptr, "run.initial", run.path("initial"), initial.place);
    read_nodes_state(table, initial, space);
    run.record("initial", table.record().inline_table());
  }
}

}  // namespace signorini::scene
