#include "differential/families.hpp"
#include "differential/scene_text.hpp"

namespace signorini::differential {
namespace {

std::string point(double x, double y) { return list({x, y}); }

std::string sections(Random& draw) {
  const Keys section = Keys()
                           .set("EA", draw.one_of({1e4, 1e5}))
                           .set("EI", draw.one_of({50.0, 500.0}))
                           .set("mass_per_length", draw.one_of({1.0, 4.0}));
  const Keys damping =
      Keys().set("alpha", draw.one_of({0.0, 2.0, 10.0})).set("beta", draw.one_of({0.0, 1e-5, 1e-4}));
  return table("[sections.beam]", section) + table("[damping]", damping);
}

/// A - B - C - D, feet at A and D.
std::string portal(Random& draw, double height, double span) {
  std::string text = table("[nodes]", Keys()
                                          .set("A", point(0.0, 0.0))
                                          .set("B", point(0.0, height))
                                          .set("C", point(span, height))
                                          .set("D", point(span, 0.0)));
  text +=
      table("[[members]]",
            Keys().set("nodes", "[\"A\", \"B\", \"C\", \"D\"]").name("section", "beam").set("elements", "1"));
  if (draw.chance(0.5)) text += table("[[masses]]", Keys().name("node", "B").set("mass", 2.0));
  return text;
}

/// A - B - D in one line, or bent up at its end.
std::string beam(Random& draw, double span) {
  std::string text = table("[nodes]", Keys()
                                          .set("A", point(0.0, 0.0))
                                          .set("B", point(rounded(0.5 * span, 3), 0.0))
                                          .set("D", point(span, draw.one_of({0.0, 0.3}))));
  Keys member = Keys().set("nodes", "[\"A\", \"B\", \"D\"]").name("section", "beam");
  member.set("elements", fmt::format("{}", draw.integer(1, 2)));
  if (draw.chance(0.2)) member.name("mass", "lumped");
  return text + table("[[members]]", member);
}

std::string foot(Random& draw, const char* node, bool may_stand_open) {
  const std::string law = draw.one_of<const char*>({"compliant", "compliant", "rigid"});
  return table("[[contacts]]",
               Keys()
                   .name("name", fmt::format("foot{}", node))
                   .name("node", node)
                   .name("law", law)
                   .set("normal", "[0.0, 1.0]")
                   .set("gap", may_stand_open && draw.chance(0.5) ? draw.rounded(0.0, 0.01, 4) : 0.0)
                   .add(contact_laws(draw, {law, 20.0, 1e5, false})));
}

}  // namespace

std::string frame_scene(Random& draw) {
  const double t_end = draw.one_of({0.1, 0.2, 0.4});
  const double height = draw.rounded(0.8, 2.0, 2);
  const double span = draw.rounded(1.0, 3.0, 2);
  const bool is_portal = draw.chance(0.5);
  std::string text = sections(draw);
  text += is_portal ? portal(draw, height, span) : beam(draw, span);
  const bool held = draw.chance(0.6);  // the first foot; else both rest on contacts
  if (held)
    text += table(
        "[[supports]]",
        Keys().name("node", "A").set("fix", is_portal ? "[\"ux\", \"uy\"]" : "[\"ux\", \"uy\", \"rz\"]"));
  else
    text += foot(draw, "A", false);
  text += foot(draw, "D", held);
  if (draw.chance(0.3))
    text += table("[[contacts]]", Keys()
                                      .name("name", "stop")
                                      .name("node", "D")
                                      .name("law", "compliant")
                                      .set("normal", "[-1.0, 0.0]")
                                      .set("gap", draw.rounded(0.0005, 0.02, 4))
                                      .set("normal_stiffness", 1e5));
  for (int i = draw.integer(1, 2); i > 0; --i) {
    const double across = draw.rounded(-1.0, 1.0, 2);
    const double up = draw.one_of({1.0, -1.0});
    text += table(
        "[[loads]]",
        Keys().name("node", "B").set("direction", point(across, up)).add(load_course(draw, 300.0, t_end)));
  }
  if (draw.chance(0.2))
    text +=
        table("[base_motion]",
              Keys().set("direction", "[1.0, 0.2]").set("acceleration", motion_history(draw, 20.0, t_end)));
  Keys initial;
  if (draw.chance(0.7)) {
    initial.name("initial", "static");
  } else {
    Keys thrown = Keys().set("vx", draw.rounded(-1.0, 1.0, 2)).set("vy", draw.rounded(-1.0, 1.0, 2));
    initial.set("initial", Keys().set("B", thrown.braced()).braced());
  }
  return "gravity = [0.0, -9.81]\n" + run_table(t_end) + initial.lines() + text;
}

}  // namespace signorini::differential
