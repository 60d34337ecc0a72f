// Point masses, springs, supports and damping.
#include <algorithm>

#include "scene/readers.hpp"

namespace signorini {

void read_masses(Table& top, Scene& scene, RecordedScene& record) {
  const Space space = space_of(scene);
  for (Table& table : tables_of(top, "masses")) {
    PointMass mass;
    mass.place = table.place();
    mass.node = read_node(table, "node", space);
    mass.mass = table.number("mass");
    mass.inertia = table.number("inertia");
    table.finish();
    scene.masses.push_back(mass);
    record.add("masses", "[[masses]]", table.record());
  }
}

void read_springs(Table& top, Scene& scene, RecordedScene& record) {
  const Space space = space_of(scene);
  for (Table& table : tables_of(top, "springs")) {
    Spring spring;
    spring.place = table.place();
    spring.node = read_node(table, "node", space);
    if (table.has("against")) {
      spring.against = read_node(table, "against", space);
      if (spring.against == spring.node) table.wrong("against", "another node than the spring's own");
    }
    spring.direction = read_unit_vector(table, "direction");
    spring.stiffness = table.number("stiffness");
    spring.damping = table.number("damping");
    table.finish();
    scene.springs.push_back(spring);
    record.add("springs", "[[springs]]", table.record());
  }
}

void read_supports(Table& top, Scene& scene, RecordedScene& record) {
  const Space space = space_of(scene);
  for (Table& table : tables_of(top, "supports")) {
    Support support;
    support.place = table.place();
    support.node = read_node(table, "node", space);
    table.require("fix", "");
    const std::vector<std::string> held = table.texts("fix");
    if (held.empty()) table.wrong("fix", "any of \"ux\", \"uy\", \"rz\"");
    for (const std::string& name : held) {
      check_known(name, {"ux", "uy", "rz"}, "degree of freedom", table.place("fix"), table.path("fix"));
      bool& fixed = name == "ux" ? support.ux : name == "uy" ? support.uy : support.rz;
      if (fixed) table.fail("fix", "found \"" + name + "\" twice");
      fixed = true;
    }
    table.finish();
    scene.supports.push_back(support);
    record.add("supports", "[[supports]]", table.record());
  }
}

void read_damping(Table& top, Scene& scene, RecordedScene& record) {
  Table table = top.child("damping");
  DampingSpec& damping = scene.damping;
  damping.place = table.place();
  if (table.has("alpha") && table.has("alpha_over_omega1")) {
    table.fail("alpha_over_omega1", "stands beside alpha, expected one of the two");
  }
  damping.alpha_over_omega1 = table.optional_number("alpha_over_omega1");
  if (!damping.alpha_over_omega1) damping.alpha = table.number("alpha");
  damping.beta = table.number("beta");
  table.finish();
  record.add("damping", "[damping]", table.record());
}

}  // namespace signorini
