#include "differential/families.hpp"
#include "differential/generator.hpp"
#include "differential/scene_text.hpp"

// What the other families do not say: moments, distributed loads, heat, strains as built, hinges, springs of
// rotations, stops, supports that move, base motion along two directions, starts with friction in stages.
namespace signorini::differential {
namespace {

std::string frame(Random& draw) {
  const double height = draw.rounded(0.8, 2.0, 2), span = draw.rounded(1.5, 3.0, 2);
  std::string text = table("[sections.beam]", Keys()
                                                  .set("EA", draw.one_of({1e4, 1e5}))
                                                  .set("EI", draw.one_of({50.0, 500.0}))
                                                  .set("mass_per_length", draw.one_of({1.0, 4.0})));
  text += table("[damping]",
                Keys().set("alpha", draw.one_of({2.0, 10.0})).set("beta", draw.one_of({0.0, 1e-5, 1e-4})));
  text += table("[nodes]", Keys()
                               .set("A", list({0.0, 0.0}))
                               .set("B", list({0.1, height}))
                               .set("C", list({span, height}))
                               .set("D", list({span, 0.0})));
  Keys post = Keys().set("nodes", "[\"A\", \"B\"]").name("section", "beam");
  if (draw.chance(0.3)) post.set("release", "[\"B\"]");
  Keys girder = Keys().set("nodes", "[\"B\", \"C\"]").name("section", "beam").set("elements", "2");
  girder.set("thermal_expansion", 1e-5);
  const double degrees = draw.rounded(20.0, 400.0, 0);
  if (draw.chance(0.5))
    girder.set("temperature", degrees);
  else if (draw.chance(0.5))
    girder.set("temperature",
               Keys().name("type", "step").set("start", 0.01).set("amplitude", degrees).braced());
  if (draw.chance(0.3)) girder.set("initial_strain", draw.rounded(-1.0, 1.0, 2) * 1e-3);
  const Keys leg = Keys().set("nodes", "[\"C\", \"D\"]").name("section", "beam");
  text += table("[[members]]", post) + table("[[members]]", girder) + table("[[members]]", leg);
  text += table("[[masses]]", Keys().name("node", "B").set("mass", 2.0).set("inertia", 0.1));
  if (draw.chance(0.4))
    text += table("[[springs]]", Keys()
                                     .name("node", "C")
                                     .set("rotation_stiffness", draw.one_of({10.0, 300.0}))
                                     .set("rotation_damping", draw.one_of({0.0, 0.5})));
  return text;
}

/// The left foot is held whole, or along x and y in tables of their own, one of which may move.
std::string supports(Random& draw, double t_end) {
  const bool moves = draw.chance(0.5);
  if (!moves) return table("[[supports]]", Keys().name("node", "A").set("fix", "[\"ux\", \"uy\"]"));
  const bool across = draw.chance(0.5);
  const std::string motion = Keys()
                                 .name("type", "harmonic")
                                 .set("omega", rounded(draw.real(3.0, 40.0) / t_end, 2))
                                 .set("amplitude", draw.rounded(0.002, 0.02, 4))
                                 .braced();
  return table("[[supports]]", Keys().name("node", "A").set("fix", across ? "[\"ux\"]" : "[\"uy\"]")) +
         table("[[supports]]",
               Keys().name("node", "A").set("fix", across ? "[\"uy\"]" : "[\"ux\"]").set("motion", motion));
}

std::string contacts(Random& draw) {
  Keys foot = Keys().name("name", "foot").name("node", "D").set("normal", list({0.0, 1.0}));
  foot.set("friction", draw.one_of({0.1, 0.3, 0.6}));
  if (draw.chance(0.3))
    foot.name("law", "rigid");
  else
    foot.name("law", "compliant")
        .set("normal_stiffness", 1e5)
        .set("tangential_stiffness", draw.one_of({1e4, 1e5}));
  std::string text = table("[[contacts]]", foot);
  if (draw.chance(0.5))
    text += table("[[stops]]", Keys()
                                   .name("name", "guide")
                                   .name("node", "C")
                                   .name("law", "compliant")
                                   .set("direction", list({1.0, 0.2}))
                                   .set("gaps", list({draw.rounded(0.001, 0.02, 4), 0.004}))
                                   .set("normal_stiffness", 1e4));
  return text;
}

std::string loads(Random& draw, double t_end) {
  std::string text;
  if (draw.chance(0.6))
    text +=
        table("[[loads]]",
              Keys().name("name", "couple").name("node", "B").set("moment", draw.rounded(-40.0, 40.0, 1)));
  Keys snow = Keys().name("name", "snow").set("nodes", "[\"C\", \"B\"]");
  snow.name("axes", draw.one_of<const char*>({"global", "member"}));
  snow.set("direction", list({draw.rounded(-0.5, 0.5, 2), draw.one_of({1.0, -1.0})}));
  text += table("[[loads]]", snow.set("distributed", draw.rounded(2.0, 20.0, 1)));
  if (draw.chance(0.7)) {
    Keys blow = Keys().name("name", "blow").name("node", "C").set("direction", list({1.0, 0.3}));
    text += table("[[loads]]", blow.add(load_course(draw, 200.0, t_end)));
  }
  for (const char* direction : {"[1.0, 0.2]", "[-0.3, 1.0]"})
    if (draw.chance(0.3))
      text += table("[[base_motion]]",
                    Keys().set("direction", direction).set("acceleration", motion_history(draw, 8.0, t_end)));
  return text;
}

/// Gravity, then all else that is there from the start; static, or from rest.
std::string start(Random& draw, const std::string& rest) {
  const int kind = draw.integer(0, 3);
  if (kind == 0) return "";
  if (kind == 1) return "initial = \"static\"\n";
  std::string names = "\"snow\"";
  if (rest.find("\"couple\"") != std::string::npos) names += ", \"couple\"";
  if (rest.find("initial_strain") != std::string::npos) names += ", \"initial strain\"";
  if (rest.find("\ntemperature = ") != std::string::npos && rest.find("temperature = {") == std::string::npos)
    names += ", \"temperature\"";
  return "initial = \"frictional\"\n" +
         table("[[run.stages]]", Keys().name("name", "weight").set("loads", "[\"gravity\"]")) +
         table("[[run.stages]]",
               Keys().name("name", "rest").set("loads", "[" + names + "]").set("steps", "2"));
}

}  // namespace

std::string draw_loaded_scene(std::uint64_t seed) {
  Random draw(seed);
  const double t_end = draw.one_of({0.1, 0.2, 0.4});
  std::string rest = frame(draw);
  rest += supports(draw, t_end);
  rest += contacts(draw);
  rest += loads(draw, t_end);
  return fmt::format(
             "schema = 1\ntitle = \"loaded, seed {}\"\nunits = {{ force = \"N\", mass = \"kg\", length = "
             "\"m\", time = "
             "\"s\" }}\ngravity = [0.0, -9.81]\n",
             seed) +
         run_table(t_end) + start(draw, rest) + rest;
}

}  // namespace signorini::differential
