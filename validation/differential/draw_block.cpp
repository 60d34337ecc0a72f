#include "differential/families.hpp"
#include "differential/scene_text.hpp"

namespace signorini::differential {
namespace {

std::string node(int i) { return fmt::format("b{}", i); }

std::string floor_of(Random& draw, int i, double slope) {
  const std::string law = draw.one_of<const char*>({"rigid", "rigid", "compliant"});
  return table("[[contacts]]", Keys()
                                   .name("name", fmt::format("floor{}", i))
                                   .name("node", node(i))
                                   .name("law", law)
                                   .set("normal", list({slope, 1.0}))
                                   .set("gap", draw.one_of({0.0, 0.0, draw.rounded(0.01, 0.3, 3)}))
                                   .add(contact_laws(draw, {law, 20.0, 1e4, true})));
}

std::string wall_of(Random& draw, int i) {
  const std::string law = draw.one_of<const char*>({"rigid", "compliant"});
  return table("[[contacts]]", Keys()
                                   .name("name", fmt::format("wall{}", i))
                                   .name("node", node(i))
                                   .name("law", law)
                                   .set("normal", "[-1.0, 0.0]")
                                   .set("gap", draw.rounded(0.02, 0.2, 3))
                                   .add(contact_laws(draw, {law, 20.0, 1e4, false})));
}

std::string spring_of(Random& draw, int i) {
  Keys spring = Keys().name("node", node(i));
  if (i > 0) spring.name("against", node(0));
  spring.set("direction", list({1.0, draw.one_of({0.0, 0.3})}));
  return table("[[springs]]",
               spring.set("stiffness", draw.rounded(10.0, 500.0, 0)).set("damping", draw.one_of({0.0, 0.5})));
}

}  // namespace

std::string block_scene(Random& draw) {
  const double t_end = draw.one_of({0.5, 1.0, 2.0});
  const double slope = draw.one_of({0.0, 0.0, draw.rounded(-0.5, 0.5, 2)});
  const int count = draw.integer(1, 2);
  std::string nodes = "\n[nodes]\n", parts, contacts, loads;
  Keys start;
  for (int i = 0; i < count; ++i) {
    nodes += fmt::format("{} = [{}.0, 0.0]\n", node(i), i);
    parts += table("[[masses]]", Keys().name("node", node(i)).set("mass", draw.rounded(0.5, 3.0, 2)));
    if (draw.chance(0.6)) parts += spring_of(draw, i);
    contacts += floor_of(draw, i, slope);
    if (draw.chance(0.4)) contacts += wall_of(draw, i);
    Keys thrown = Keys().set("vx", draw.rounded(-2.0, 2.0, 2));
    thrown.set("vy", draw.one_of({0.0, 0.0, draw.rounded(-0.5, 2.0, 2)}));
    start.set(node(i).c_str(), thrown.braced());
    if (draw.chance(0.7))
      loads += table("[[loads]]", Keys()
                                      .name("node", node(i))
                                      .set("direction", list({1.0, draw.rounded(-1.0, 1.0, 1)}))
                                      .add(load_course(draw, 60.0, t_end)));
  }
  if (draw.chance(0.25))
    loads +=
        table("[base_motion]",
              Keys().set("direction", "[1.0, 0.5]").set("acceleration", motion_history(draw, 15.0, t_end)));
  return "gravity = [0.0, -9.81]\n" + run_table(t_end) + Keys().set("initial", start.braced()).lines() +
         nodes + parts + contacts + loads;
}

}  // namespace signorini::differential
