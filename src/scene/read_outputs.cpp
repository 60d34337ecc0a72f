// [[output]]: response quantities.
#include <fmt/core.h>

#include <algorithm>

#include "scene/components.hpp"
#include "scene/quantities.hpp"
#include "scene/readers.hpp"
#include "scene/units.hpp"
#include "signorini/output.hpp"

namespace signorini::scene {

namespace {

/// Reads `count` names, one or two, from the key `at`.
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

void check_nodes(const Table& table, const std::vector<std::string>& names, const NameScope& space) {
  for (const std::string& name : names) check_node(name, space, table.place("at"), table.path("at"));
}

/// Reads the component of a motion: along a direction, or the rotation.
void read_motion(Table& table, OutputSpec& output, const NameScope& space) {
  output.rotation = !space.matrices && table.flag("rotation");
  if (!output.rotation) {
    if (!table.has("direction"))
      table.require("direction", space.matrices ? "" : " (required without rotation = true)");
    output.direction = read_direction(table, "direction", space);
  } else if (table.has("direction")) {
    table.fail("direction", "cannot be combined with rotation; give only one of them");
  }
}

void read_quantity(Table& table, OutputSpec& output, const char* known) {
  if (!table.has("quantity")) table.fail("quantity", fmt::format("missing, expected one of {}", known));
  const std::string word = table.text("quantity");
  constexpr std::pair<const char*, OutputQuantity> words[] = {
      {"N", OutputQuantity::N},       {"V", OutputQuantity::V},           {"M", OutputQuantity::M},
      {"T", OutputQuantity::T},       {"gap", OutputQuantity::gap},       {"slip", OutputQuantity::slip},
      {"loss", OutputQuantity::loss}, {"stress", OutputQuantity::stress}, {"xx", OutputQuantity::xx},
      {"yy", OutputQuantity::yy},     {"xy", OutputQuantity::xy}};
  for (const auto& [name, quantity] : words)
    if (word == name) output.quantity = quantity;
  if (std::string_view(known).find(fmt::format("\"{}\"", word)) == std::string_view::npos)
    table.wrong("quantity", fmt::format("one of {}", known));
}

/// True if the output can be part of a combination.
bool can_be_combined(const OutputSpec& output) {
  return output.kind != OutputKind::envelope &&
         !(output.kind == OutputKind::stress && output.fibre == Fibre::both &&
           output.quantity != OutputQuantity::N && !is_body_stress(output.quantity));
}

void read_contact_output(Table& table, OutputSpec& output, const Scene& scene) {
  output.at = read_places(table, 1, "the name of a contact");
  Names names;
  for (const ContactSpec& contact : scene.contacts) names.add(contact.name);
  const ContactSpec& contact =
      scene.contacts[check_known(output.at[0], names, "contact", table.place("at"), table.path("at"))];
  read_quantity(table, output, "\"N\", \"T\", \"gap\", \"slip\", \"loss\"");
  if (output.quantity == OutputQuantity::gap && contact.capabilities().normal_force_given)
    table.fail("quantity", fmt::format("found \"gap\", but contact \"{}\" is a slider and has no gap; "
                                       "expected \"N\", \"T\", \"slip\" or \"loss\"",
                                       contact.name));
}

/// Reads the factor of an output in a combination: a number, or a table with a unit.
OutputTerm read_term(Table& terms, const Entry& entry, const Scene& scene) {
  OutputTerm term;
  term.name = entry.name;
  if (!entry.node->is_table()) {
    term.factor = terms.number(entry.name);
    return term;
  }
  Table table(entry.node->as_table(), "output[].terms.*", terms.path(entry.name), entry.place());
  term.factor = table.number("factor");
  const std::string text = table.text("unit");
  const std::optional<Unit> unit = unit_of_text(text, scene.units);
  if (!unit)
    table.fail(
        "unit",
        fmt::format("found \"{}\", expected a product of powers of {}, {}, {} and {}, such as \"1/{}^2\"",
                    text, scene.units.force, scene.units.mass, scene.units.length, scene.units.time,
                    scene.units.length));
  term.unit = *unit;
  table.finish();
  terms.record(entry.name, table.record().inline_table());
  return term;
}

/// Name and unit of a term for a message: "'M' [kN m]"; adds "with its factor" if the factor has a unit.
std::string described(const OutputTerm& term, const Scene& scene) {
  return fmt::format("'{}' [{}]{}", term.name, unit_text(unit_of_term(term, scene.outputs), scene.units),
                     same_unit(term.unit, unit::plain) ? "" : " with its factor");
}

void read_terms(Table& table, OutputSpec& output, const Scene& scene) {
  if (!table.has("terms")) table.require("terms", "");
  Names names;
  for (const OutputSpec& before : scene.outputs) names.add(before.name);
  Table terms = table.child("terms");
  for (const Entry& entry : entries_of(terms.node())) {
    const std::size_t i = check_known(entry.name, names, "output", entry.place(), terms.path(entry.name));
    if (scene.outputs[i].quantity == OutputQuantity::loss)
      terms.fail(entry.name,
                 "is a loss; a combination cannot contain it, because a loss has no value between rows");
    if (!can_be_combined(scene.outputs[i]))
      terms.fail(entry.name,
                 "is a greatest value (of an envelope or of both fibres); a combination cannot contain it");
    output.terms.push_back(read_term(terms, entry, scene));
    const OutputTerm &first = output.terms.front(), &term = output.terms.back();
    if (!same_unit(unit_of_term(first, scene.outputs), unit_of_term(term, scene.outputs)))
      terms.fail(entry.name,
                 fmt::format("terms {} and {} have different units; give one of the factors a unit: {{ "
                             "factor = ..., unit = \"...\" }}",
                             described(term, scene), described(first, scene)));
  }
  if (output.terms.empty()) table.fail("terms", "found no output, expected { name = factor }");
  table.record("terms", terms.record().inline_table());
}

void read_fibre(Table& table, OutputSpec& output) {
  const std::string fibre = table.choice("fibre");
  output.fibre = fibre == "left" ? Fibre::left : fibre == "right" ? Fibre::right : Fibre::both;
  output.intensification = table.optional_number("sif");
}

void read_envelope(Table& table, OutputSpec& output, const NameScope& space) {
  table.require("nodes", "");
  output.at = read_node_names(table, "nodes", space);
  if (output.at.size() < 2) table.wrong("nodes", "the names of two or more nodes");
  read_quantity(table, output, "\"N\", \"V\", \"M\", \"stress\"");
  if (output.quantity == OutputQuantity::stress) read_fibre(table, output);
}

void read_spring(Table& table, OutputSpec& output, const Scene& scene) {
  if (!table.has("spring")) table.require("spring", "");
  const int number = table.integer("spring");
  if (static_cast<std::size_t>(number) > scene.springs.size())
    table.fail("spring",
               scene.springs.empty()
                   ? fmt::format("found {}, but the scene has no [[springs]]", number)
                   : fmt::format("found {}, expected the number of a spring in [[springs]], from 1 to {}",
                                 number, scene.springs.size()));
  output.spring = static_cast<std::size_t>(number) - 1;
  output.rotation = table.flag("rotation");
}

/// Reads a stress component at a node of a body; `direction` is the axis x of the component.
void read_body_stress(Table& table, OutputSpec& output, const Scene& scene, const NameScope& space) {
  output.at = read_places(table, 1, "the name of a node");
  const std::size_t node = check_node(output.at[0], space, table.place("at"), table.path("at"));
  if (!body_of_node(scene, node))
    table.fail("at",
               fmt::format("node \"{}\" belongs to no body: expected a node of a body, or two nodes [A, B] "
                           "of a member",
                           output.at[0]));
  read_quantity(table, output, "\"xx\", \"yy\", \"xy\"");
  output.direction.vector = {1.0, 0.0};
  if (table.has("direction")) output.direction = read_direction(table, "direction", space);
}

void read_by_kind(Table& table, OutputSpec& output, const Scene& scene, const NameScope& space) {
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
      output.at = read_places(table, 2, "the names of two nodes");
      check_nodes(table, output.at, space);
      return read_motion(table, output, space);
    case OutputKind::member_force:
    case OutputKind::stress:
      if (const toml::node* at = table.raw("at");
          output.kind == OutputKind::stress && at && at->is_string() && !scene.bodies.empty())
        return read_body_stress(table, output, scene, space);
      output.at = read_places(table, 2, "the names of two nodes");
      check_nodes(table, output.at, space);
      output.station = table.number("station");
      if (output.kind == OutputKind::member_force) return read_quantity(table, output, "\"N\", \"V\", \"M\"");
      if (table.has("quantity")) read_quantity(table, output, "\"N\", \"M\"");
      return read_fibre(table, output);
    case OutputKind::envelope:
      return read_envelope(table, output, space);
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
  return kind == OutputKind::relative || kind == OutputKind::member_force || kind == OutputKind::stress ||
         kind == OutputKind::envelope || kind == OutputKind::reaction || kind == OutputKind::spring;
}

}  // namespace

void read_outputs(Table& top, Scene& scene, ResolvedScene& record) {
  const NameScope space = name_scope(scene);
  Names names{"t"};
  for (Table& table : tables_of(top, "output")) {
    OutputSpec output;
    output.place = table.place();
    output.name = table.text("name");
    if (output.name == "t")
      table.fail("name", "found \"t\", which is the column of times in response.csv; expected another name");
    if (!names.add(output.name))
      table.fail("name",
                 fmt::format("found \"{}\" twice, expected each output to have its own name", output.name));
    const std::string kind = table.choice("kind");
    for (const OutputKindName& row : all_output_kinds)
      if (kind == row.name) output.kind = row.kind;
    if (space.matrices && of_nodes_only(output.kind))
      table.fail("kind", fmt::format("found \"{}\", which has no meaning with [matrices]", kind));
    read_by_kind(table, output, scene, space);
    table.finish(fmt::format("has no meaning with kind = \"{}\"", kind));
    scene.outputs.push_back(std::move(output));
    record.add("output", "[[output]]", table.record());
  }
}

}  // namespace signorini::scene
