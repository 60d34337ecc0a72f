// run.initial: "static", or the state at t = 0.
#include <fmt/core.h>

#include "base/number.hpp"
#include "scene/data_file.hpp"
#include "scene/readers.hpp"
#include "scene/saved_state.hpp"

namespace signorini {

namespace {

void read_list(Table& table, std::string_view key, const Space& space, std::vector<double>& values) {
  if (const toml::node* node = table.raw(key); node && node->is_string()) {
    values = read_vector_file(table, key, space);
    table.record(key, toml_numbers(values));
    return;
  }
  const auto given = table.numbers(key);
  if (!given) return;
  const std::size_t size = space.names.size();
  if (given->size() != size) {
    table.fail(key, fmt::format("found {}, expected one for each of the {} degrees of freedom",
                                count_of(given->size(), "number"), size));
  }
  values = *given;
}

void read_nodes_state(Table& table, InitialSpec& initial, const Space& space) {
  for (const Entry& entry : entries_of(table.node())) {
    check_known(entry.name, space.names, "node", entry.place, table.path(entry.name));
    const toml::node* node = table.raw(entry.name);
    if (!node->is_table()) table.wrong(entry.name, "a table { ux = ..., vx = ... }");
    Table state(node->as_table(), "run.initial.*", table.path(entry.name), place_of(*node));
    for (const char* component : {"ux", "uy", "rz", "vx", "vy", "wz"}) {
      if (const auto value = state.optional_number(component)) {
        initial.components.push_back({entry.name, component, *value, state.place(component)});
      }
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
  Names names{"fit"};
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
    stage.steps = table.integer("steps");
    constexpr int most_steps = 10'000;
    if (stage.steps > most_steps) table.wrong("steps", fmt::format("an integer from 1 to {}", most_steps));
    table.finish();
    initial.stages.push_back(std::move(stage));
    texts.push_back(table.record().inline_table());
  }
  run.record("stages", toml_array(texts));
}

void read_from_run(Table& run, InitialSpec& initial, const Scene& scene) {
  Table table = run.child("initial");
  const std::filesystem::path path = directory_of(scene) / table.text("run") / "states.csv";
  std::ifstream in = open_data_file(table, "run", path);
  const std::optional<double> t = table.optional_number("t");
  table.finish("has no meaning beside run");
  initial.saved = read_saved_state(in, path.string(), table.path("t"), t);
  Record record;
  record.set("run", toml_string(std::filesystem::absolute(path.parent_path()).lexically_normal().string()));
  if (t) record.set("t", toml_number(*t));
  run.record("initial", record.inline_table());
}

bool is_of_run(const toml::node* node) {
  const toml::table* table = node ? node->as_table() : nullptr;
  return table && table->get("run") && table->get("run")->is_string();
}

}  // namespace

void read_initial(Table& run, Scene& scene) {
  InitialSpec& initial = scene.initial;
  initial.place = run.place("initial");
  const toml::node* node = run.raw("initial");
  if (node && node->value<std::string>() == "static") {
    initial.is_static = true;
    run.record("initial", "\"static\"");
    return;
  }
  if (node && node->value<std::string>() == "frictional") {
    initial.is_frictional = true;
    run.record("initial", "\"frictional\"");
    read_stages(run, initial);
    return;
  }
  read_stages(run, initial);
  if (node && !node->is_table()) run.wrong("initial", describe_type(*find_key("run", "initial")));
  if (is_of_run(node)) {
    read_from_run(run, initial, scene);
    return;
  }

  const Space space = space_of(scene);
  if (space.matrices) {
    Table table = run.child("initial");
    for (const Entry& entry : entries_of(table.node())) {
      if (entry.name != "u" && entry.name != "v") {
        refuse(entry.place, table.path(entry.name), "unknown key; with [matrices] known: u, v");
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

}  // namespace signorini
