// [[output]]: response quantities.
#include <fmt/core.h>

#include <algorithm>

#include "scene/readers.hpp"

namespace signorini {

namespace {

/// The names under `at`: one, or two.
std::vector<std::string> read_places(Table& table, std::size_t count, const char* expected) {
  const toml::node* node = table.raw("at");
  if (!node) table.fail("at", fmt::format("missing, expected {}", expected));
  std::vector<std::string> names;
  if (count == 1) {
    if (!node->is_string()) table.wrong("at", expected);
    names.push_back(node->value_or(std::string()));
    table.record("at", toml_string(names[0]));
    return names;
  }
  const toml::array* array = node->as_array();
  if (!array || array->size() != 2) table.wrong("at", expected);
  for (const toml::node& item : *array) {
    if (!item.is_string()) table.wrong("at", expected);
    names.push_back(item.value_or(std::string()));
  }
  if (names[0] == names[1])
    table.fail("at", fmt::format("found \"{}\" twice, expected {}", names[0], expected));
  table.record("at", toml_strings(names));
  return names;
}

void check_nodes(const Table& table, const std::vector<std::string>& names, const Space& space) {
  for (const std::string& name : names)
    check_known(name, space.names, "node", table.place("at"), table.path("at"));
}

/// A direction, or a rotation.
void read_motion(Table& table, OutputSpec& output, const Space& space) {
  output.rotation = !space.matrices && table.flag("rotation");
  if (!output.rotation) {
    if (!table.has("direction")) table.require("direction", space.matrices ? "" : ", or rotation = true");
    output.direction = read_direction(table, "direction", space);
  } else if (table.has("direction")) {
    table.fail("direction", "stands beside rotation, expected one of the two");
  }
}

void read_quantity(Table& table, OutputSpec& output, const char* known) {
  if (!table.has("quantity")) table.fail("quantity", fmt::format("missing, expected one of {}", known));
  const std::string word = table.text("quantity");
  constexpr std::pair<const char*, OutputQuantity> words[] = {
      {"N", OutputQuantity::N},      {"V", OutputQuantity::V},     {"M", OutputQuantity::M},
      {"T", OutputQuantity::T},      {"gap", OutputQuantity::gap}, {"slip", OutputQuantity::slip},
      {"loss", OutputQuantity::loss}};
  for (const auto& [name, quantity] : words)
    if (word == name) output.quantity = quantity;
  if (std::string_view(known).find(fmt::format("\"{}\"", word)) == std::string_view::npos)
    table.wrong("quantity", fmt::format("one of {}", known));
}

void read_contact_output(Table& table, OutputSpec& output, const Scene& scene) {
  output.at = read_places(table, 1, "the name of a contact");
  Names names;
  for (const ContactSpec& contact : scene.contacts) names.add(contact.name);
  const ContactSpec& contact =
      scene.contacts[check_known(output.at[0], names, "contact", table.place("at"), table.path("at"))];
  read_quantity(table, output, "\"N\", \"T\", \"gap\", \"slip\", \"loss\"");
  if (output.quantity == OutputQuantity::gap && !has_gap(contact.law))
    table.fail("quantity",
               fmt::format("found \"gap\" of contact \"{}\", a slider, which has none", contact.name));
}

void read_terms(Table& table, OutputSpec& output, const Scene& scene) {
  if (!table.has("terms")) table.require("terms", "");
  Names names;
  for (const OutputSpec& before : scene.outputs) names.add(before.name);
  Table terms = table.child("terms");
  for (const Entry& entry : entries_of(terms.node())) {
    const std::size_t i = check_known(entry.name, names, "output", entry.place(), terms.path(entry.name));
    if (scene.outputs[i].quantity == OutputQuantity::loss)
      terms.fail(entry.name, "is a loss, which has no part in a combination: it has no value between rows");
    output.terms.emplace_back(entry.name, terms.number(entry.name));
  }
  if (output.terms.empty()) table.fail("terms", "found none, expected { name = factor }");
  table.record("terms", terms.record().inline_table());
}

void read_spring(Table& table, OutputSpec& output, const Scene& scene) {
  if (!table.has("spring")) table.require("spring", "");
  const int number = table.integer("spring");
  if (static_cast<std::size_t>(number) > scene.springs.size())
    table.fail("spring", fmt::format("found {}, expected a number from 1 to {}, of [[springs]]", number,
                                     scene.springs.size()));
  output.spring = static_cast<std::size_t>(number) - 1;
  output.rotation = table.flag("rotation");
}

void read_by_kind(Table& table, OutputSpec& output, const Scene& scene, const Space& space) {
  switch (output.kind) {
    case OutputKind::displacement:
    case OutputKind::velocity:
    case OutputKind::acceleration:
      if (!space.matrices) {
        output.at = read_places(table, 1, "the name of a node");
        check_nodes(table, output.at, space);
      }
      return read_motion(table, output, space);
    case OutputKind::relative:
    case OutputKind::member_force:
      output.at = read_places(table, 2, "the names of two nodes");
      check_nodes(table, output.at, space);
      if (output.kind == OutputKind::relative) return read_motion(table, output, space);
      read_quantity(table, output, "\"N\", \"V\", \"M\"");
      output.station = table.number("station");
      return;
    case OutputKind::reaction:
      output.at = read_places(table, 1, "the name of a node");
      check_nodes(table, output.at, space);
      return read_motion(table, output, space);
    case OutputKind::spring:
      return read_spring(table, output, scene);
    case OutputKind::contact:
      return read_contact_output(table, output, scene);
    case OutputKind::combination:
      return read_terms(table, output, scene);
  }
}

bool of_nodes_only(OutputKind kind) {
  return kind == OutputKind::relative || kind == OutputKind::member_force || kind == OutputKind::reaction ||
         kind == OutputKind::spring;
}

}  // namespace

void read_outputs(Table& top, Scene& scene, RecordedScene& record) {
  const Space space = space_of(scene);
  Names names{"t"};
  for (Table& table : tables_of(top, "output")) {
    OutputSpec output;
    output.place = table.place();
    output.name = table.text("name");
    if (output.name == "t") table.fail("name", "found \"t\", which is the time in response.csv");
    if (!names.add(output.name))
      table.fail("name",
                 fmt::format("found \"{}\" twice, expected each output to have its own name", output.name));
    const std::string kind = table.choice("kind");
    for (const OutputKindName& row : all_output_kinds)
      if (kind == row.name) output.kind = row.kind;
    if (space.matrices && of_nodes_only(output.kind))
      table.fail("kind", fmt::format("found \"{}\", which has no meaning with [matrices]", kind));
    read_by_kind(table, output, scene, space);
    table.finish(fmt::format("has no meaning for a {}", kind));
    scene.outputs.push_back(std::move(output));
    record.add("output", "[[output]]", table.record());
  }
}

}  // namespace signorini
