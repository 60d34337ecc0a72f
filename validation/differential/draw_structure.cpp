#include "differential/families.hpp"
#include "differential/generator.hpp"
#include "differential/scene_text.hpp"

// Structures of rigid bodies, sections with shapes, bends, hangers and pendulums, by P-delta or without; stresses, envelopes
// and forces in springs are their outputs.
//
//   column A - B, bend B - C, run C - D, and where D ends one of:   a shoe, a block on two feet, a slab on pendulums
namespace signorini::differential {
namespace {

struct Drawn {
  std::string nodes, parts, contacts, loads, outputs;
  std::string staged;  ///< names of loads that are there from the start, gravity apart
  bool needs_ida = false;
};

std::string section(Random& draw) {
  const double E = draw.one_of({1e8, 3e8});
  Keys shape;
  switch (draw.integer(0, 3)) {
    case 0: {
      shape.set("diameter", draw.rounded(0.15, 0.25, 3)).set("wall", draw.one_of({0.005, 0.012}));
      shape.set("E", E).set("density", 900.0).set("content", draw.one_of({0.0, 700.0}));
      if (draw.chance(0.5)) shape.set("insulation", "{ thickness = 0.05, density = 150.0 }");
      return table("[sections.line]", Keys().set("pipe", shape.braced()));
    }
    case 1:
      shape.set("width", 0.1).set("height", draw.rounded(0.1, 0.3, 2)).set("E", E).set("density", 800.0);
      if (draw.chance(0.7)) shape.set("wall", 0.01);
      return table("[sections.line]", Keys().set("box", shape.braced()));
    case 2:
      shape.set("width", 0.2).set("height", 0.2).set("web", 0.01).set("flange", 0.015).set("E", E);
      shape.set("density", 900.0).name("axis", draw.one_of<const char*>({"strong", "weak"}));
      return table("[sections.line]", Keys().set("i", shape.braced()));
    default:
      shape.set("diameter", draw.rounded(0.08, 0.15, 3)).set("E", E).set("density", 600.0);
      return table("[sections.line]", Keys().set("round", shape.braced()));
  }
}

/// Column, bend and run; D is the end of the run, whose height is returned.
double line(Random& draw, Drawn& scene) {
  const double height = draw.rounded(0.8, 1.6, 2), radius = draw.rounded(0.3, 0.6, 2);
  const double top = rounded(height + radius, 3);
  scene.nodes += table("[nodes]", Keys()
                                      .set("A", list({0.0, 0.0}))
                                      .set("B", list({0.0, height}))
                                      .set("C", list({radius, top}))
                                      .set("D", list({2.0, top})));
  scene.parts += section(draw);
  scene.parts +=
      table("[damping]", Keys().set("alpha", draw.one_of({1.0, 5.0})).set("beta", draw.one_of({0.0, 1e-5})));
  scene.parts += table("[[members]]", Keys().set("nodes", "[\"A\", \"B\"]").name("section", "line"));
  Keys bend = Keys().set("radius", -radius);
  if (draw.chance(0.3)) bend.set("flexibility", draw.rounded(1.0, 6.0, 1)).set("sif", 1.7);
  scene.parts += table("[[members]]", Keys()
                                          .set("nodes", "[\"B\", \"C\"]")
                                          .name("section", "line")
                                          .set("bend", bend.braced())
                                          .set("elements", fmt::format("{}", draw.integer(2, 3))));
  Keys run = Keys().set("nodes", "[\"C\", \"D\"]").name("section", "line").set("elements", "2");
  if (draw.chance(0.4)) {
    run.set("thermal_expansion", 1e-4).set("temperature", draw.rounded(20.0, 60.0, 0));
    scene.staged += ", \"temperature\"";
  }
  scene.parts += table("[[members]]", run);
  scene.parts += table("[[supports]]", Keys().name("node", "A").set("fix", "[\"ux\", \"uy\", \"rz\"]"));
  for (const char* quantity : {"M", "stress"})
    scene.outputs += table("[[output]]", Keys()
                                             .name("name", fmt::format("all_{}", quantity))
                                             .name("kind", "envelope")
                                             .set("nodes", "[\"A\", \"B\", \"C\", \"D\"]")
                                             .name("quantity", quantity));
  for (const char* fibre : {"left", "both"})
    scene.outputs += table("[[output]]", Keys()
                                             .name("name", fmt::format("foot_{}", fibre))
                                             .name("kind", "stress")
                                             .set("at", "[\"A\", \"B\"]")
                                             .set("station", draw.rounded(0.0, 1.0, 1))
                                             .name("fibre", fibre));
  return top;
}

void contact_at(Random& draw, Drawn& scene, const char* name, const char* node, double force) {
  const std::string law = draw.one_of<const char*>({"compliant", "compliant", "rigid"});
  scene.contacts += table("[[contacts]]", Keys()
                                              .name("name", name)
                                              .name("node", node)
                                              .name("law", law)
                                              .set("normal", "[0.0, 1.0]")
                                              .add(contact_laws(draw, {law, force, 1e5, false})));
}

/// A connection without mass below the end of the run, which rests.
void shoe(Random& draw, Drawn& scene, double x, double y) {
  scene.nodes += fmt::format("shoe = [{}, {}]\n", x, rounded(y - draw.rounded(0.1, 0.4, 2), 3));
  scene.parts += table("[[rigid]]", Keys()
                                        .name("name", "offset")
                                        .name("centre", "D")
                                        .set("nodes", "[\"shoe\"]")
                                        .set("mass", 0.0)
                                        .set("inertia", draw.one_of({0.0, 2.0})));
  contact_at(draw, scene, "foot", "shoe", 300.0);
}

/// A block on two feet, with the end of the run at its top.
void block(Random& draw, Drawn& scene, double x, double y) {
  const double half = draw.rounded(0.2, 0.5, 2), low = rounded(y - draw.rounded(0.8, 1.4, 2), 3);
  scene.nodes += fmt::format("L = [{}, {}]\nR = [{}, {}]\nT = [{}, {}]\n", rounded(x - half, 3), low,
                             rounded(x + half, 3), low, x, y);
  scene.nodes += fmt::format("beside = [{}, {}]\n", rounded(x + half + 1.0, 3), y);
  Keys body = Keys().name("name", "block").set("centre", list({x, rounded(0.5 * (low + y), 4)}));
  body.set("nodes", draw.one_of<const char*>({"[\"L\", \"R\", \"D\", \"T\"]", "[\"T\", \"R\", \"L\"]"}));
  const bool joined = body.lines().find("\"D\"") != std::string::npos;
  scene.parts += table("[[rigid]]", body.set("box", Keys()
                                                        .set("width", 2.0 * half)
                                                        .set("height", rounded(y - low, 3))
                                                        .set("density", draw.one_of({100.0, 400.0}))
                                                        .set("thickness", 0.5)
                                                        .braced()));
  if (!joined)
    for (const char* direction : {"[1.0, 0.0]", "[0.0, 1.0]"})
      scene.parts += table("[[springs]]", Keys()
                                              .name("node", "D")
                                              .name("against", "T")
                                              .set("direction", direction)
                                              .set("stiffness", draw.one_of({1e3, 2e4}))
                                              .set("damping", draw.one_of({0.0, 20.0})));
  contact_at(draw, scene, "left", "L", 500.0);
  contact_at(draw, scene, "foot", "R", 500.0);
  if (!draw.chance(0.4)) return;
  scene.parts += table("[[masses]]", Keys().name("node", "beside").set("mass", 20.0));
  scene.parts += table("[[springs]]", Keys()
                                          .name("node", "beside")
                                          .set("direction", "[1.0, 0.0]")
                                          .set("stiffness", 4e3)
                                          .set("damping", 10.0));
  scene.parts += table("[[springs]]", Keys()
                                          .name("node", "beside")
                                          .set("direction", "[0.0, 1.0]")
                                          .set("stiffness", 4e4)
                                          .set("damping", 40.0));
  scene.contacts += table("[[contacts]]", Keys()
                                              .name("name", "beside")
                                              .name("node", "beside")
                                              .name("against", "T")
                                              .name("law", "compliant")
                                              .set("normal", "[1.0, 0.0]")
                                              .set("gap", draw.rounded(0.001, 0.01, 3))
                                              .set("normal_stiffness", 1e5));
}

/// A slab on two pendulums, which may lift off; the end of the run stands on it by springs.
void slab(Random& draw, Drawn& scene, double x, double y) {
  const double low = rounded(y - 0.5, 3);
  scene.nodes +=
      fmt::format("W = [{}, {}]\nE = [{}, {}]\n", rounded(x - 0.8, 3), low, rounded(x + 0.7, 3), low);
  scene.parts += table("[[rigid]]", Keys()
                                        .name("name", "slab")
                                        .set("centre", list({x, rounded(low + 0.1, 3)}))
                                        .set("nodes", "[\"W\", \"E\"]")
                                        .set("mass", draw.one_of({50.0, 200.0}))
                                        .set("inertia", 30.0));
  const bool presses = draw.chance(0.4), rises = draw.chance(0.4);
  scene.needs_ida = presses || rises;
  if (!presses)
    scene.parts += table("[[supports]]", Keys().name("node", "slab").set("fix", "[\"uy\", \"rz\"]"));
  for (const char* node : {"W", "E"}) {
    Keys bearing = Keys().name("name", fmt::format("bearing{}", node)).name("node", node).set("radius", 1.5);
    if (presses)
      bearing.set("normal_stiffness", 4e5).set("normal_damping", draw.one_of({0.0, 400.0}));
    else
      bearing.set("normal_force", draw.rounded(200.0, 1000.0, 0));
    if (rises)
      bearing.set("friction", "{ slow = 0.03, fast = 0.09, velocity = 0.05 }");
    else
      bearing.set("friction", 0.06);
    if (presses || draw.chance(0.7)) bearing.set("tangential_stiffness", draw.one_of({2e4, 2e5}));
    if (draw.chance(0.5)) bearing.set("stop", draw.rounded(0.004, 0.02, 3)).set("stop_stiffness", 3e4);
    scene.contacts += table("[[pendulums]]", bearing);
  }
  for (const char* direction : {"[1.0, 0.0]", "[0.0, 1.0]"})
    scene.parts += table("[[springs]]", Keys()
                                            .name("node", "D")
                                            .name("against", "slab")
                                            .set("direction", direction)
                                            .set("stiffness", draw.one_of({1e3, 2e4})));
}

void hangers(Random& draw, Drawn& scene) {
  Keys hanger = Keys().name("node", "C").set("direction", "[0.0, -1.0]");
  switch (draw.integer(0, 2)) {
    case 0:
      hanger.set("hanger", Keys().set("hot", 150.0).set("cold", 170.0).set("travel", 0.01).braced());
      break;
    case 1:
      hanger.set("preload", draw.rounded(50.0, 200.0, 0));
      break;
    default:
      hanger.set("stiffness", 500.0).set("preload", draw.rounded(50.0, 200.0, 0)).set("damping", 5.0);
  }
  scene.parts += table("[[springs]]", hanger);
  scene.staged += ", \"preload\"";
}

void loads(Random& draw, Drawn& scene, double t_end, double force) {
  scene.loads += table("[[loads]]", Keys()
                                        .name("name", "blow")
                                        .name("node", draw.one_of<const char*>({"B", "D"}))
                                        .set("direction", list({1.0, draw.rounded(-0.5, 0.5, 1)}))
                                        .add(load_course(draw, force, t_end)));
  for (const char* direction : {"[1.0, 0.0]", "[-0.3, 1.0]"})
    if (draw.chance(0.5))
      scene.loads +=
          table("[[base_motion]]",
                Keys().set("direction", direction).set("acceleration", motion_history(draw, 6.0, t_end)));
}

std::string start(Random& draw, const Drawn& scene) {
  const int kind = draw.integer(0, 2);
  if (kind == 0) return "initial = { B = { vx = 0.3 }, C = { vy = -0.2, wz = 0.1 } }\n";
  if (kind == 1) return "initial = \"static\"\n";
  std::string text = "initial = \"frictional\"\n" +
                     table("[[run.stages]]", Keys().name("name", "weight").set("loads", "[\"gravity\"]"));
  if (!scene.staged.empty())
    text +=
        table("[[run.stages]]", Keys().name("name", "rest").set("loads", "[" + scene.staged.substr(2) + "]"));
  return text;
}

}  // namespace

std::string draw_structure_scene(std::uint64_t seed) {
  Random draw(seed);
  const double t_end = draw.one_of({0.1, 0.2, 0.4});
  Drawn scene;
  const double height = line(draw, scene);
  const int end = draw.integer(0, 2);
  (end == 0 ? shoe : end == 1 ? block : slab)(draw, scene, 2.0, height);
  if (draw.chance(0.6)) hangers(draw, scene);
  loads(draw, scene, t_end, 400.0);
  if (scene.parts.find("[[springs]]") != std::string::npos)
    scene.outputs +=
        table("[[output]]", Keys().name("name", "pull").name("kind", "spring").set("spring", "1"));
  scene.outputs +=
      table("[[output]]", Keys()
                              .name("name", "sum")
                              .name("kind", "combination")
                              .set("terms", "{ foot_left = { factor = 0.01, unit = \"m^2\" } }"));
  if (draw.chance(0.15))
    scene.parts += table("[reduction]", Keys().set("cutoff_omega", draw.one_of({500.0, 3000.0})));
  std::string head = run_table(t_end);
  if (draw.chance(0.5)) head += "atol = { displacement = 1e-10, velocity = 1e-9, force = 1e-7 }\n";
  if (draw.chance(0.5)) head += "geometric = true\n";
  const double kind = draw.real(0.0, 1.0);
  if (scene.needs_ida || kind < 0.2)
    head += "engine = \"ida\"\nrtol = 1e-9\n";
  else if (kind < 0.3)
    head += fmt::format("engine = \"newmark\"\ndt = {}\n", t_end / 4000.0);
  else
    head += "engine = \"exact\"\n";
  head += start(draw, scene);
  return fmt::format(
             "schema = 1\ntitle = \"structure, seed {}\"\nunits = {{ force = \"N\", mass = \"kg\", length = "
             "\"m\", "
             "time = \"s\" }}\ngravity = [0.0, -9.81]\n",
             seed) +
         head + scene.nodes + scene.parts + scene.contacts + scene.loads + scene.outputs;
}

}  // namespace signorini::differential
