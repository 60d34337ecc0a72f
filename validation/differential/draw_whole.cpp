#include <fmt/core.h>

#include "differential/families.hpp"
#include "differential/generator.hpp"
#include "differential/scene_text.hpp"

// Scenes with all that a scene can say, for relations: a loaded frame, blocks in a yard, or one of the other
// families; with parts without mass, dashpots, segments, reduction, outputs, tolerances, and an engine.
namespace signorini::differential {
namespace {

void insert_after(std::string& text, const std::string& line, const std::string& more) {
  const std::size_t at = text.find(line);
  if (at == std::string::npos) return;
  text.insert(text.find('\n', at) + 1, more);
}

std::string output(const char* name, const char* kind, const std::string& at, const Keys& more) {
  return table("[[output]]", Keys().name("name", name).name("kind", kind).set("at", at).add(more));
}

Keys along(double x, double y) { return Keys().set("direction", list({x, y})); }

/// A node without mass between springs and dampers, which a contact may touch.
std::string massless_node(Random& draw, const std::string& beside, std::string& nodes) {
  nodes += "light = [0.3, 0.45]\n";
  const double angle = draw.one_of({0.0, 0.0, draw.rounded(-0.6, 0.6, 2)});
  std::string text = table("[[springs]]", Keys()
                                              .name("node", "light")
                                              .name("against", beside)
                                              .set("direction", list({1.0, angle}))
                                              .set("stiffness", draw.one_of({200.0, 3000.0}))
                                              .set("damping", draw.one_of({0.0, 0.0, 2.0})));
  text += table("[[springs]]", Keys()
                                   .name("node", "light")
                                   .set("direction", list({-angle, 1.0}))
                                   .set("stiffness", draw.one_of({100.0, 2000.0})));
  if (draw.chance(0.6)) {
    Keys wall = Keys().name("name", "bumper").name("node", "light").name("law", "compliant");
    wall.set("normal", list({-1.0, -angle}));
    wall.set("gap", draw.one_of({0.0, 0.001, 0.01}));
    wall.set("normal_stiffness", draw.one_of({1e3, 1e4}));
    if (draw.chance(0.3)) wall.set("tangential_stiffness", 1e3).set("friction", 0.3);
    text += table("[[contacts]]", wall);
  }
  return text;
}

/// A ball over the girder B-C.
std::string ball(Random& draw, const std::string& scene, std::string& nodes) {
  const std::size_t at = scene.find("\nC = [") + 6;
  const double span = std::stod(scene.substr(at)), height = std::stod(scene.substr(scene.find(' ', at)));
  const double part = draw.rounded(0.2, 0.8, 2);
  nodes += fmt::format("ball = [{}, {}]\n", rounded(0.1 + part * (span - 0.1), 3), height);
  const std::string law = draw.one_of<const char*>({"rigid", "compliant"});
  std::string text = table("[[masses]]", Keys().name("node", "ball").set("mass", draw.rounded(0.2, 3.0, 1)));
  text += table("[[springs]]", Keys()
                                   .name("node", "ball")
                                   .set("direction", "[1.0, 0.0]")
                                   .set("stiffness", draw.one_of({10.0, 500.0}))
                                   .set("damping", draw.one_of({0.0, 1.0})));
  return text + table("[[contacts]]", Keys()
                                          .name("name", "landing")
                                          .name("node", "ball")
                                          .set("against", "[\"B\", \"C\"]")
                                          .name("law", law)
                                          .set("normal", "[0.0, 1.0]")
                                          .set("gap", draw.one_of({0.0, draw.rounded(0.001, 0.02, 4)}))
                                          .add(contact_laws(draw, {law, 10.0, 1e4, false})));
}

std::string frame(Random& draw) {
  std::string text = draw_loaded_scene(static_cast<std::uint64_t>(draw.integer(1, 1000000))), nodes;
  if (draw.chance(0.3))
    text += table("[sections.light]", Keys().set("EA", 5e3).set("EI", 40.0).set("mass_per_length", 0.0)) +
            table("[[members]]", Keys().set("nodes", "[\"A\", \"C\"]").name("section", "light"));
  if (draw.chance(0.3)) text += massless_node(draw, "B", nodes);
  if (draw.chance(0.4)) text += ball(draw, text, nodes);
  insert_after(text, "[nodes]", nodes);
  if (draw.chance(0.15))
    text += table("[reduction]", Keys().set("cutoff_omega", draw.one_of({300.0, 2000.0})));
  text += output("across", "displacement", "\"C\"", along(1.0, 0.4)) +
          output("turn", "velocity", "\"B\"", Keys().set("rotation", "true")) +
          output("shake", "acceleration", "\"B\"", along(0.6, 0.8)) +
          output("moment", "member_force", "[\"B\", \"C\"]",
                 Keys().name("quantity", "M").set("station", draw.rounded(0.0, 1.0, 1))) +
          output("shear", "member_force", "[\"C\", \"D\"]", Keys().name("quantity", "V")) +
          output("thrust", "reaction", "\"A\"", along(1.0, 0.0)) +
          output("rubbed", "contact", "\"foot\"", Keys().name("quantity", "loss"));
  return text;
}

std::string node(int i) { return fmt::format("b{}", i); }

std::string springs_of(Random& draw, int i) {
  std::string text;
  for (const char* direction : {"[1.0, 0.2]", "[-0.1, 1.0]"}) {
    if (!draw.chance(0.6)) continue;
    Keys spring = Keys().name("node", node(i));
    if (i > 0 && draw.chance(0.5)) spring.name("against", node(i - 1));
    text += table("[[springs]]", spring.set("direction", direction)
                                     .set("stiffness", draw.rounded(20.0, 800.0, 0))
                                     .set("damping", draw.one_of({0.0, 0.0, 0.5, 3.0})));
  }
  return text;
}

std::string contacts_of(Random& draw, int i, double slope) {
  const std::string law = draw.one_of<const char*>({"rigid", "compliant", "compliant"});
  std::string text =
      table("[[contacts]]", Keys()
                                .name("name", fmt::format("floor{}", i))
                                .name("node", node(i))
                                .name("law", law)
                                .set("normal", list({slope, 1.0}))
                                .set("gap", draw.one_of({0.0, 0.0, draw.rounded(0.01, 0.2, 3)}))
                                .add(contact_laws(draw, {law, 20.0, 1e4, false})));
  if (draw.chance(0.3)) {
    const std::string side = draw.one_of<const char*>({"rigid", "compliant"});
    Keys stop = Keys().name("name", fmt::format("guide{}", i)).name("node", node(i)).name("law", side);
    stop.set("direction", list({1.0, draw.one_of({0.0, 0.1})}));
    stop.set("gap", draw.rounded(0.005, 0.1, 3));
    if (side == "compliant")
      stop.set("normal_stiffness", draw.one_of({1e3, 1e4})).set("normal_damping", draw.one_of({0.0, 5.0}));
    else
      stop.set("restitution", draw.one_of({0.0, 0.5, 0.9}));
    text += table("[[stops]]", stop);
  }
  if (i > 0 && draw.chance(0.4)) {
    const std::string between = draw.one_of<const char*>({"rigid", "compliant"});
    text += table("[[contacts]]", Keys()
                                      .name("name", fmt::format("between{}", i))
                                      .name("node", node(i))
                                      .name("against", node(i - 1))
                                      .name("law", between)
                                      .set("normal", "[1.0, 0.0]")
                                      .set("gap", draw.rounded(0.01, 0.1, 3))
                                      .add(contact_laws(draw, {between, 20.0, 1e4, false})));
  }
  if (draw.chance(0.25))
    text += table("[[contacts]]", Keys()
                                      .name("name", fmt::format("brake{}", i))
                                      .name("node", node(i))
                                      .name("law", "slider")
                                      .set("tangent", list({1.0, slope}))
                                      .add(contact_laws(draw, {"slider", 6.0, 1e3, false})));
  return text;
}

/// A support that is driven, and the spring that drives a block.
std::string shaker(Random& draw, std::string& nodes) {
  std::string parts;
  nodes += "shaker = [-1.0, 0.3]\n";
  const char* drive = draw.chance(0.5) ? "acceleration" : "motion";
  parts += table("[[supports]]", Keys().name("node", "shaker").set("fix", "[\"uy\"]"));
  parts += table("[[supports]]", Keys()
                                     .name("node", "shaker")
                                     .set("fix", "[\"ux\"]")
                                     .set(drive, Keys()
                                                     .name("type", "harmonic")
                                                     .set("amplitude", draw.rounded(0.01, 0.3, 3))
                                                     .set("omega", draw.rounded(5.0, 30.0, 1))
                                                     .braced()));
  parts += table("[[springs]]", Keys()
                                    .name("node", node(0))
                                    .name("against", "shaker")
                                    .set("direction", "[1.0, 0.0]")
                                    .set("stiffness", draw.rounded(50.0, 500.0, 0)));
  return parts;
}

std::string outputs_of_yard(int count, bool sprung, bool light) {
  std::string outputs = output("place", "displacement", "\"b0\"", along(0.6, -0.8)) +
                        output("speed", "velocity", "\"b0\"", along(1.0, 0.0)) +
                        output("shake", "acceleration", "\"b0\"", along(0.8, 0.6)) +
                        output("pressure", "contact", "\"floor0\"", Keys().name("quantity", "N")) +
                        output("rubbed", "contact", "\"floor0\"", Keys().name("quantity", "loss"));
  if (sprung)
    outputs += table("[[output]]", Keys().name("name", "pull").name("kind", "spring").set("spring", "1"));
  if (light)
    outputs += output("light_place", "displacement", "\"light\"", along(1.0, 0.0)) +
               output("light_speed", "velocity", "\"light\"", along(1.0, 0.0)) +
               output("light_shake", "acceleration", "\"light\"", along(1.0, 0.0));
  if (count > 1)
    outputs += output("drift", "relative", "[\"b1\", \"b0\"]", along(1.0, 0.0)) +
               table("[[output]]", Keys()
                                       .name("name", "both")
                                       .name("kind", "combination")
                                       .set("terms", "{ place = 2.0, drift = -1.0 }"));
  return outputs;
}

std::string yard(Random& draw) {
  const double t_end = draw.one_of({0.3, 0.6, 1.0});
  const double slope = draw.one_of({0.0, 0.0, draw.rounded(-0.4, 0.4, 2)});
  const int count = draw.integer(1, 3), begin = draw.integer(0, 2);
  std::string nodes = "\n[nodes]\n", light, parts, contacts, loads;
  Keys thrown;
  for (int i = 0; i < count; ++i) {
    nodes += fmt::format("{} = [{}.0, 0.0]\n", node(i), i);
    parts += table("[[masses]]", Keys().name("node", node(i)).set("mass", draw.rounded(0.5, 3.0, 2)));
    parts += springs_of(draw, i);
    contacts += contacts_of(draw, i, slope);
    Keys velocity = Keys().set("vx", draw.rounded(-1.0, 1.0, 2));
    thrown.set(node(i).c_str(), velocity.set("vy", draw.one_of({0.0, draw.rounded(-0.5, 1.0, 2)})).braced());
    if (draw.chance(0.7))
      loads += table("[[loads]]", Keys()
                                      .name("name", fmt::format("push{}", i))
                                      .name("node", node(i))
                                      .set("direction", list({1.0, draw.rounded(-1.0, 1.0, 1)}))
                                      .add(load_course(draw, 60.0, t_end)));
  }
  if (draw.chance(0.3)) parts += massless_node(draw, node(0), light);
  if (draw.chance(0.2))
    loads +=
        table("[[base_motion]]",
              Keys().set("direction", "[1.0, 0.5]").set("acceleration", motion_history(draw, 15.0, t_end)));
  if (draw.chance(0.25)) parts += shaker(draw, light);
  std::string start = begin == 0   ? Keys().set("initial", thrown.braced()).lines()
                      : begin == 1 ? "initial = \"static\"\n"
                                   : "initial = \"frictional\"\n";
  if (begin == 2)
    start += table("[[run.stages]]", Keys().name("name", "weight").set("loads", "[\"gravity\"]"));
  insert_after(nodes, "[nodes]", light);
  const bool sprung = parts.find("[[springs]]") != std::string::npos;
  const std::string outputs = outputs_of_yard(count, sprung, light.find("light") != std::string::npos);
  return "schema = 1\ntitle = \"yard\"\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" "
         "}\n"
         "gravity = [0.0, -9.81]\n" +
         run_table(t_end) + start + nodes + parts + contacts + loads + outputs;
}

std::string engine(Random& draw, const std::string& text) {
  const double kind = draw.real(0.0, 1.0);
  if (text.find("stribeck") != std::string::npos || kind < 0.15) return "engine = \"ida\"\nrtol = 1e-9\n";
  if (kind < 0.25) {
    const double t_end = std::stod(text.substr(text.find("t_end = ") + 8));
    return fmt::format("engine = \"newmark\"\ndt = {}\n", t_end / 4000.0);
  }
  return "engine = \"exact\"\n";
}

/// Given tolerances, so that they do not follow from scales of the scene.
void give_tolerances(std::string& text) {
  insert_after(text, "output_dt = ", "atol = { displacement = 1e-10, velocity = 1e-9, force = 1e-7 }\n");
  for (std::size_t at = 0; (at = text.find("law = \"rigid\"\n", at)) != std::string::npos; ++at) {
    const std::size_t end = text.find("\n[", at);
    const std::size_t own = text.find("capture_velocity", at);
    if (own == std::string::npos || (end != std::string::npos && own > end))
      text.insert(text.find('\n', at) + 1, "capture_velocity = 1e-3\n");
  }
}

}  // namespace

std::string draw_whole_scene(std::uint64_t seed) {
  Random draw(seed);
  const double family = draw.real(0.0, 1.0);
  std::string text = family < 0.4   ? frame(draw)
                     : family < 0.8 ? yard(draw)
                                    : draw_scene(static_cast<std::uint64_t>(draw.integer(1, 1000000)));
  if (draw.chance(0.5)) give_tolerances(text);
  insert_after(text, "output_dt = ", engine(draw, text));
  return text;
}

}  // namespace signorini::differential
