// run.initial: "static", or the state at t = 0.
#include <fmt/core.h>

#include "base/number.hpp"
#include "scene/readers.hpp"

namespace signorini {

namespace {

void read_list(Table& table, std::string_view key, std::size_t size, std::vector<double>& values) {
  const auto given = table.numbers(key);
  if (!given) return;
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
  if (node && !node->is_table()) run.wrong("initial", "\"static\" or a table");

  const Space space = space_of(scene);
  if (space.matrices) {
    Table table = run.child("initial");
    for (const Entry& entry : entries_of(table.node())) {
      if (entry.name != "u" && entry.name != "v") {
        refuse(entry.place, table.path(entry.name), "unknown key; with [matrices] known: u, v");
      }
    }
    read_list(table, "u", space.names.size(), initial.u);
    read_list(table, "v", space.names.size(), initial.v);
    run.record("initial", table.record().inline_table());
  } else {
    Table table(node ? node->as_table() : nullptr, "run.initial", run.path("initial"), initial.place);
    read_nodes_state(table, initial, space);
    run.record("initial", table.record().inline_table());
  }
}

}  // namespace signorini
