// Sections: stiffness and mass as given, or from a shape.
//
//   EA = E A,  EI = E I,  mass per length = density A + content A_inside + insulation,  W = I / (height/2)
//
//   pipe   D, t, d = D - 2t   A = pi t (D - t)                I = A (D^2 + d^2)/16
//   round  D                  A = pi D^2/4                    I = A D^2/16
//   box    b, h, t            A = b h - (b - 2t)(h - 2t)      I = (b h^3 - (b - 2t)(h - 2t)^3)/12
//   i      b, h, s, t         A = 2 b t + (h - 2t) s          strong: I = (b h^3 - (b - s)(h - 2t)^3)/12
//                                                             weak:   I = (2 t b^3 + (h - 2t) s^3)/12
#include <fmt/core.h>

#include <numbers>

#include "base/number.hpp"
#include "scene/readers.hpp"

namespace signorini {

namespace {

/// Cross-section: area, second moment of area, distance of the outermost fibre.
struct Shape {
  double area = 0.0, moment = 0.0, reach = 0.0;
  double more_mass = 0.0;  ///< per length, in addition to the material's mass
};

constexpr const char* all_shapes[] = {"pipe", "box", "i", "round"};

double ring(double thickness, double inner_diameter) {
  return std::numbers::pi * thickness * (inner_diameter + thickness);
}

/// Reads a wall thickness; refuses a wall that does not fit within `width`.
double wall_within(Table& table, const char* key, double width, const char* of) {
  const double wall = table.number(key);
  if (!(2.0 * wall < width))
    table.fail(
        key, fmt::format("found {}, expected less than half the {} {}", shortest(wall), of, shortest(width)));
  return wall;
}

Shape read_pipe(Table& table, Section& section) {
  const double outer = table.number("diameter"), wall = wall_within(table, "wall", outer, "diameter");
  const double inner = outer - 2.0 * wall;
  Shape shape;
  shape.area = ring(wall, inner);
  shape.moment = shape.area * (outer * outer + inner * inner) / 16.0;
  shape.reach = 0.5 * outer;
  shape.more_mass = table.number("content") * std::numbers::pi * inner * inner / 4.0;
  if (table.has("insulation")) {
    Table insulation = table.child("insulation");
    shape.more_mass += insulation.number("density") * ring(insulation.number("thickness"), outer);
    insulation.finish();
    table.record("insulation", insulation.record().inline_table());
  }
  section.pipe_wall = wall;
  section.pipe_radius = 0.5 * (outer - wall);
  return shape;
}

Shape read_round(Table& table) {
  const double diameter = table.number("diameter"), area = std::numbers::pi * diameter * diameter / 4.0;
  return {area, area * diameter * diameter / 16.0, 0.5 * diameter};
}

Shape read_box(Table& table) {
  const double b = table.number("width"), h = table.number("height");
  if (!table.has("wall")) return {b * h, b * h * h * h / 12.0, 0.5 * h};
  const double t = wall_within(table, "wall", std::min(b, h), b < h ? "width" : "height");
  const double inside = b - 2.0 * t, between = h - 2.0 * t;
  return {b * h - inside * between, (b * h * h * h - inside * between * between * between) / 12.0, 0.5 * h};
}

Shape read_i(Table& table) {
  const double b = table.number("width"), h = table.number("height");
  const double t = wall_within(table, "flange", h, "height"), s = table.number("web"), between = h - 2.0 * t;
  if (!(s <= b))
    table.fail("web", fmt::format("found {}, expected at most the width {}", shortest(s), shortest(b)));
  const double area = 2.0 * b * t + between * s;
  if (table.choice("axis") == "weak")
    return {area, (2.0 * t * b * b * b + between * s * s * s) / 12.0, 0.5 * b};
  return {area, (b * h * h * h - (b - s) * between * between * between) / 12.0, 0.5 * h};
}

void read_shape(Table& table, const std::string& name, Section& section) {
  for (const char* key : {"EA", "EI", "mass_per_length", "area", "modulus"})
    if (table.has(key)) table.fail(key, fmt::format("follows from {0}; remove {1} or {0}", name, key));
  Table dimensions = table.child(name);
  const Shape shape = name == "pipe"  ? read_pipe(dimensions, section)
                      : name == "box" ? read_box(dimensions)
                      : name == "i"   ? read_i(dimensions)
                                      : read_round(dimensions);
  const double E = dimensions.number("E");
  section.EA = E * shape.area;
  section.EI = E * shape.moment;
  section.mass_per_length = dimensions.number("density") * shape.area + shape.more_mass;
  section.area = shape.area;
  section.modulus = shape.moment / shape.reach;
  dimensions.finish();
  table.record(name, dimensions.record().inline_table());
}

}  // namespace

void read_sections(Table& top, Scene& scene, RecordedScene& record) {
  Table sections = top.child("sections");
  for (const Entry& entry : entries_of(sections.node())) {
    check_name(entry.name, entry.place(), sections.path(entry.name));
    if (!entry.node->is_table()) sections.wrong(entry.name, "a table [sections." + entry.name + "]");
    Table table(entry.node->as_table(), "sections.*", sections.path(entry.name), place_of(*entry.node));
    Section section;
    section.name = entry.name;
    std::string shape;
    for (const char* name : all_shapes) {
      if (!table.has(name)) continue;
      if (!shape.empty())
        table.fail(name, fmt::format("cannot be combined with {}; give only one shape", shape));
      shape = name;
    }
    if (!shape.empty()) {
      read_shape(table, shape, section);
    } else {
      for (const char* key : {"EA", "mass_per_length"}) table.require(key, "");
      section.EA = table.number("EA");
      section.EI = table.optional_number("EI").value_or(0.0);
      section.mass_per_length = table.number("mass_per_length");
      section.area = table.optional_number("area").value_or(0.0);
      section.modulus = table.optional_number("modulus").value_or(0.0);
    }
    scene.sections.push_back(section);
    record.add("sections", "[sections." + toml_key(entry.name) + "]", table.record());
  }
}

}  // namespace signorini
