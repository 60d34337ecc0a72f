#include "differential/families.hpp"
#include "differential/scene_text.hpp"

namespace signorini::differential {
namespace {

std::string node(int i) { return fmt::format("m{}", i); }

/// Mass i, held on the line, and its spring to the one before or to the ground.
std::string link(Random& draw, int i) {
  std::string text = table("[[masses]]", Keys().name("node", node(i)).set("mass", draw.rounded(0.3, 3.0, 2)));
  text += table("[[supports]]", Keys().name("node", node(i)).set("fix", "[\"uy\"]"));
  if (i > 0 && draw.chance(0.2)) return text;
  Keys spring = Keys().name("node", node(i)).set("direction", "[1.0, 0.0]");
  if (i > 0) spring.name("against", node(i - 1));
  spring.set("stiffness", draw.rounded(5.0, 400.0, 1)).set("damping", draw.one_of({0.0, 0.0, 0.3}));
  return text + table("[[springs]]", spring);
}

std::string stop(Random& draw, const Keys& place) {
  const std::string law = draw.one_of<const char*>({"rigid", "compliant"});
  Keys keys = Keys(place).name("law", law).set("gap", draw.rounded(0.01, 0.2, 3));
  if (law == "rigid")
    keys.set("restitution", draw.one_of({0.0, 0.6, 1.0}));
  else
    keys.set("normal_stiffness", draw.one_of({1e3, 1e4}));
  return table("[[contacts]]", keys);
}

}  // namespace

std::string chain_scene(Random& draw) {
  const int n = draw.integer(1, 5);
  const double t_end = draw.one_of({1.0, 2.0, 3.0});
  std::string nodes = "\n[nodes]\n", parts, contacts, loads;
  Keys start;
  for (int i = 0; i < n; ++i) {
    nodes += fmt::format("{} = [{}.0, 0.0]\n", node(i), i);
    parts += link(draw, i);
    start.set(node(i).c_str(), Keys().set("vx", draw.rounded(-2.0, 2.0, 2)).braced());
    if (draw.chance(0.7))
      contacts += table("[[contacts]]", Keys()
                                            .name("name", fmt::format("under{}", i))
                                            .name("node", node(i))
                                            .name("law", "slider")
                                            .set("tangent", "[1.0, 0.0]")
                                            .add(contact_laws(draw, {"slider", 6.0, 1e3, true})));
    if (i > 0 && draw.chance(0.4))
      contacts += stop(draw, Keys()
                                 .name("name", fmt::format("between{}", i))
                                 .name("node", node(i))
                                 .name("against", node(i - 1))
                                 .set("normal", "[1.0, 0.0]"));
    if (draw.chance(0.6))
      loads += table(
          "[[loads]]",
          Keys().name("node", node(i)).set("direction", "[1.0, 0.0]").add(load_course(draw, 20.0, t_end)));
  }
  if (contacts.empty() || draw.chance(0.4))
    contacts += stop(draw, Keys().name("name", "end").name("node", node(n - 1)).set("normal", "[-1.0, 0.0]"));
  if (draw.chance(0.2))
    loads +=
        table("[base_motion]",
              Keys().set("direction", "[1.0, 0.0]").set("acceleration", motion_history(draw, 10.0, t_end)));
  return run_table(t_end) + Keys().set("initial", start.braced()).lines() + nodes + parts + contacts + loads;
}

}  // namespace signorini::differential
