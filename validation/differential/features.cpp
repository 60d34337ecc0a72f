#include "differential/features.hpp"

#include <cmath>

#include "differential/scene_text.hpp"

namespace signorini::differential {
namespace {

const std::string added;
constexpr const char* no_place = "no contact is left that can have it";
constexpr const char* no_nodes = "[matrices] has no nodes";

/// A key of a contact of one of the laws.
std::string give(Draft& d, std::initializer_list<const char*> laws, const char* key, const std::string& value,
                 std::initializer_list<const char*> without = {}) {
  DraftContact* c = d.contact(laws, without.size() > 0 ? without : std::initializer_list<const char*>{key});
  if (c == nullptr) return no_place;
  c->keys.set(key, value);
  return added;
}

std::string number(double x) { return fmt::format("{}", x); }

std::string law(Draft& d, const char* name) { return d.contact({name}, {}) != nullptr ? added : no_place; }

std::string history(Draft& d, const std::string& value) {
  if (!d.history.empty()) {
    DraftTable& second = d.table("[[loads]]");
    if (d.has_nodes())
      second.name("node", d.main).set("direction", "[0.6, -1.0]");
    else
      second.set("direction", "{ d1 = -1.0, d2 = 0.6 }");
    second.set("amplitude", d.draw.rounded(8.0, 25.0, 1)).set("history", value);
    return added;
  }
  d.history = value;
  return added;
}

/// Times in parts of the run.
std::string at(Draft& d, double low, double high) {
  return number(rounded(d.draw.real(low, high) * d.t_end, 4));
}

DraftTable& spring(Draft& d) {
  return d.table("[[springs]]").name("node", d.main).set("direction", "[0.8, 0.6]");
}

std::string engine(Draft& d, const char* name, const char* more = nullptr, const char* value = nullptr) {
  d.run.name("engine", name);
  if (more != nullptr) d.run.set(more, value);
  return added;
}

std::string stepped(Draft& d, const char* name) {
  d.run.set("dt", rounded(d.t_end / 4000.0, 9));
  return engine(d, name);
}

/// A plane body whose upper edge another one follows.
std::string tied(Draft& d) {
  d.body();
  const double left = d.kit == Kit::mesh ? 0.0 : 5.0;
  d.table("[[bodies]]")
      .name("name", "cap")
      .set("rectangle", fmt::format("{{ from = {}, size = [0.4, 0.1] }}", list({left, 0.2})))
      .set("elements", "[3, 1]")
      .set("E", d.draw.rounded(5e4, 2e5, 0))
      .set("nu", 0.2)
      .set("density", 30.0)
      .set("thickness", 0.1)
      .name("plane", "stress");
  d.table("[[seams]]")
      .name("name", "tie")
      .name("slave", "cap.bottom")
      .name("master", "pad.top")
      .name("law", "tied");
  return added;
}

DraftTable& seam(Draft& d) {
  for (DraftTable& t : d.tables)
    if (t.header() == "[[seams]]" && t.text().find("\"sole\"") != std::string::npos) return t;
  d.body();
  DraftTable& sole =
      d.table("[[seams]]").name("name", "sole").name("slave", "pad.bottom").name("master", "ground");
  sole.name("law", "compliant")
      .set("normal_stiffness", d.draw.rounded(3e4, 2e5, 0))
      .set("tangential_stiffness", 5e4)
      .set("friction", d.draw.rounded(0.2, 0.5, 2));
  return sole;
}

std::string rubs(Draft& d, const char* parameter, const std::string& value,
                 std::initializer_list<const char*> laws, const char* stiffness) {
  DraftContact* c = d.contact(laws, {"friction", "tangential_damping"});
  if (c == nullptr) return no_place;
  c->keys.set("friction", value);
  d.parameter = "contacts." + c->name + "." + parameter;
  if (stiffness != nullptr && c->law == "slider")
    c->keys.set("tangential_stiffness", d.draw.rounded(800.0, 3e3, 0));
  return added;
}

DraftTable& output(Draft& d, const char* name, const char* kind, const char* key, const std::string& value) {
  return d.table("[[output]]").name("name", name).name("kind", kind).set(key, value);
}

std::string pendulum(Draft& d) {
  DraftTable& p = d.table("[[pendulums]]").name("name", "bowl").name("node", d.has_nodes() ? d.main : "d0");
  p.set("radius", 0.6)
      .set("normal_force", d.draw.rounded(6.0, 15.0, 1))
      .set("friction", d.draw.rounded(0.05, 0.2, 2));
  if (d.draw.chance(0.5)) p.set("tangential_stiffness", 2e3);
  if (d.draw.chance(0.5)) p.set("stop", 0.03).set("stop_stiffness", 2e3);
  return added;
}

std::string stop(Draft& d, const char* law) {
  DraftTable& s = d.table("[[stops]]").name("name", fmt::format("guide_{}", law)).name("law", law);
  if (d.has_nodes())
    s.name("node", d.main).set("direction", "[1.0, 0.0]");
  else
    s.set("direction", "{ d0 = 1.0 }");
  s.set("gap", d.draw.rounded(0.002, 0.03, 3));
  if (std::string(law) == "rigid")
    s.set("restitution", d.draw.one_of({0.0, 0.4, 0.8})).set("capture_velocity", 1e-2);
  else
    s.set("normal_stiffness", d.draw.rounded(800.0, 5e3, 0));
  return added;
}

std::string rigid_body(Draft& d) {
  if (d.kit == Kit::block) return added;
  const std::string centre = list({rounded(d.x + 1.0, 3), rounded(d.y + 0.3, 3)});
  d.nodes.set("q1", list({rounded(d.x + 0.8, 3), d.y})).set("q2", list({rounded(d.x + 1.2, 3), d.y}));
  d.table("[[rigid]]")
      .name("name", "lump")
      .set("centre", centre)
      .set("nodes", "[\"q1\", \"q2\"]")
      .set("mass", d.draw.rounded(0.5, 1.5, 2))
      .set("inertia", d.draw.rounded(0.03, 0.1, 3));
  if (!d.has_nodes()) return added;
  d.join("q1", 150.0);
  d.join("q2", 80.0);
  d.put_first({"q2", "[0.0, 1.0]", "[1.0, 0.0]"});
  return added;
}

std::string massless(Draft& d) {
  if (!d.has_nodes()) return no_nodes;
  d.nodes.set("light", list({rounded(d.x - 0.3, 3), rounded(d.y - 0.2, 3)}));
  d.join("light", 400.0);
  d.table("[[springs]]")
      .name("node", "light")
      .set("direction", "[0.0, 1.0]")
      .set("stiffness", d.draw.rounded(50.0, 200.0, 1));
  d.put_first({"light", "[0.0, 1.0]", "[1.0, 0.0]", true});
  return added;
}

/// A node that is driven, and the spring that it drives with.
std::string moving_support(Draft& d) {
  if (!d.has_nodes()) {
    d.table("[[supports]]").name("node", "d0").set("fix", "[\"ux\"]");
    return added;
  }
  d.nodes.set("shaker", list({rounded(d.x - 1.7, 3), rounded(d.y + 0.9, 3)}));
  d.table("[[supports]]").name("node", "shaker").set("fix", "[\"uy\"]");
  d.table("[[supports]]")
      .name("node", "shaker")
      .set("fix", "[\"ux\"]")
      .set("motion", fmt::format("{{ type = \"harmonic\", amplitude = {}, omega = {} }}",
                                 d.draw.rounded(0.01, 0.05, 3), d.omega(2, 6)));
  d.table("[[springs]]")
      .name("node", d.main)
      .name("against", "shaker")
      .set("direction", "[1.0, 0.0]")
      .set("stiffness", d.draw.rounded(80.0, 250.0, 1));
  return added;
}

std::string initial(Draft& d, const char* how) {
  if (!d.has_nodes())
    d.table("[[loads]]")
        .name("name", "weight")
        .set("direction", "{ d1 = -1.0 }")
        .set("amplitude", d.draw.rounded(5.0, 15.0, 1));
  d.run.name("initial", how);
  return added;
}

std::string pipe_section(Draft& d) {
  d.beam().name("section", "tube");
  if (d.find("[sections.tube]") != nullptr) return added;
  d.table("[sections.tube]")
      .set("pipe", fmt::format("{{ diameter = {}, wall = 0.002, E = 1e6, density = 300.0, content = 50.0 }}",
                               d.draw.rounded(0.08, 0.12, 3)));
  return added;
}

/// What is not for [matrices].
std::vector<Feature> marked(std::vector<Feature> features) {
  for (const char* name : {"pendulum",
                           "support that moves",
                           "gravity",
                           "heat",
                           "load, distributed",
                           "preload",
                           "damping, alpha",
                           "damping, beta",
                           "damper",
                           "rigid body",
                           "node without mass",
                           "beam",
                           "lumped mass",
                           "bar",
                           "hinge",
                           "bend",
                           "pipe section",
                           "plane body",
                           "seam, tied",
                           "seam, contact",
                           "contact_mass none",
                           "output of forces",
                           "output of stress, envelope",
                           "geometric"})
    for (Feature& f : features)
      if (std::string(name) == f.name) f.needs_nodes = true;
  return features;
}

}  // namespace

const std::vector<Feature>& all_features() {
  using D = Draft;
  static const std::vector<Feature> features = marked({
      // laws
      {"law compliant", "", 2, {}, Check::related, [](D& d) { return law(d, "compliant"); }},
      {"law rigid", "", 2, {}, Check::related, [](D& d) { return law(d, "rigid"); }},
      {"law slider", "", 2, {}, Check::related, [](D& d) { return law(d, "slider"); }},
      {"law yielding", "", 2, {}, Check::related,
       [](D& d) {
         d.needs_ida = true;
         return law(d, "yielding");
       }},
      {"pendulum", "", 2, {}, Check::related, pendulum},
      {"stop, rigid", "", 2, {}, Check::related, [](D& d) { return stop(d, "rigid"); }},
      {"stop, compliant", "", 2, {}, Check::related, [](D& d) { return stop(d, "compliant"); }},
      // keys of contacts
      {"friction, constant", "", 4, {}, Check::related,
       [](D& d) { return rubs(d, "friction", number(d.draw.rounded(0.1, 0.6, 2)), {"compliant", "rigid", "slider"}, nullptr); }},
      {"friction, static above kinetic", "", 4, {}, Check::related,
       [](D& d) {
         return rubs(d, "friction.kinetic", fmt::format("{{ static = {}, kinetic = {} }}", d.draw.rounded(0.35, 0.6, 2), d.draw.rounded(0.1, 0.3, 2)),
                     {"compliant", "rigid", "slider"}, nullptr);
       }},
      {"friction, falling with the slip rate", "", 3, {}, Check::related,
       [](D& d) {
         d.needs_ida = true;
         DraftContact* c = d.contact({"slider", "rigid"}, {"friction", "tangential_stiffness", "tangential_damping"});
         if (c == nullptr) return std::string(no_place);
         c->keys.set("friction", fmt::format("{{ static = 0.5, kinetic = {}, stribeck_velocity = {} }}", d.draw.rounded(0.15, 0.35, 2), d.draw.rounded(0.05, 0.4, 2)));
         d.parameter = "contacts." + c->name + ".friction.stribeck_velocity";
         return added;
       }},
      {"friction, rising with the slip rate", "", 3, {}, Check::related,
       [](D& d) {
         d.needs_ida = true;
         return rubs(d, "friction.velocity", fmt::format("{{ slow = {}, fast = 0.3, velocity = {} }}", d.draw.rounded(0.08, 0.2, 2), d.draw.rounded(0.05, 0.3, 2)), {"compliant", "slider"},
                     d.draw.chance(0.3) ? "with" : nullptr);
       }},
      {"friction, by normal force", "", 3, {}, Check::related,
       [](D& d) {
         d.needs_ida = true;
         DraftContact* c = d.contact({"compliant", "slider"}, {"friction", "normal_damping", "tangential_damping"});
         if (c == nullptr) return std::string(no_place);
         c->keys.set("friction", fmt::format("{{ light = {}, heavy = 0.1, force = {} }}", d.draw.rounded(0.2, 0.4, 2), d.draw.rounded(8.0, 30.0, 1)));
         c->keys.set("tangential_stiffness", d.draw.rounded(800.0, 3e3, 0));
         d.parameter = "contacts." + c->name + ".friction.light";
         return added;
       }},
      {"tangential_stiffness", "", 4, {}, Check::related,
       [](D& d) { return give(d, {"slider"}, "tangential_stiffness", number(d.draw.rounded(600.0, 4e3, 0))); }},
      {"tangential_damping", "", 4, {}, Check::related,
       [](D& d) {
         DraftContact* c = d.contact({"compliant", "slider"}, {"tangential_damping"});
         if (c == nullptr) return std::string(no_place);
         if (!c->keys.has("friction")) c->keys.set("friction", 0.3);
         c->keys.set("tangential_stiffness", d.draw.rounded(600.0, 4e3, 0)).set("tangential_damping", d.draw.rounded(0.5, 8.0, 2));
         return added;
       }},
      {"normal_damping", "", 4, {}, Check::related, [](D& d) { return give(d, {"compliant"}, "normal_damping", number(d.draw.rounded(1.0, 12.0, 1))); }},
      {"restitution", "", 4, {}, Check::related,
       [](D& d) { return give(d, {"rigid"}, "restitution", number(d.draw.rounded(0.2, 0.9, 2))); }},
      {"gap", "", 5, {}, Check::related, [](D& d) { return give(d, {"rigid", "compliant"}, "gap", number(d.draw.rounded(0.0005, 0.01, 4))); }},
      {"surface_velocity", "", 5, {}, Check::related,
       [](D& d) {
         DraftContact* c = d.contact({"slider", "compliant", "rigid"}, {"surface_velocity"});
         if (c == nullptr) return std::string(no_place);
         if (!c->keys.has("friction")) c->keys.set("friction", 0.35);
         c->keys.set("surface_velocity", d.draw.chance(0.6) ? number(d.draw.one_of({0.2, -0.5})) : motion_history(d.draw, 0.5, d.t_end));
         return added;
       }},
      {"normal_force, history", "", 5, {}, Check::related,
       [](D& d) { return give(d, {"slider"}, "normal_force", fmt::format("{{ type = \"harmonic\", offset = 9.0, amplitude = {}, omega = {} }}", d.draw.rounded(1.0, 8.0, 1), d.omega(2, 6))); }},
      {"initial_shear", "", 5, {}, Check::related,
       [](D& d) {
         DraftContact* c = d.contact({"slider"}, {"initial_shear"});
         if (c == nullptr) return std::string(no_place);
         c->keys.set("tangential_stiffness", d.draw.rounded(600.0, 4e3, 0)).set("initial_shear", d.draw.rounded(-0.3, 0.3, 2));
         return added;
       }},
      {"seam of one contact", "", 4, {}, Check::related,
       [](D& d) { return give(d, {"compliant"}, "seam", "{ E = 2e4, G = 8e3, thickness = 0.01, area = 2e-3 }", {"seam", "normal_stiffness", "tangential_stiffness"}); }},
      // loads
      {"load, harmonic", "", 6, {}, Check::related, [](D& d) { return history(d, fmt::format("{{ type = \"harmonic\", omega = {} }}", d.omega(2, 9))); }},
      {"load, pulse", "", 6, {}, Check::related, [](D& d) { return history(d, "{ type = \"half_sine\", start = " + at(d, 0.05, 0.3) + ", duration = " + at(d, 0.1, 0.5) + " }"); }},
      {"load, ramp", "", 6, {}, Check::related,
       [](D& d) { return history(d, "{ type = \"polynomial\", start = " + at(d, 0.05, 0.3) + ", coefficients = [0.0, " + number(rounded(1.0 / d.t_end, 2)) + "] }"); }},
      {"load, table", "", 6, {}, Check::related,
       [](D& d) { return history(d, "{ type = \"table\", times = [0.0, " + at(d, 0.1, 0.3) + ", " + at(d, 0.4, 0.6) + ", " + at(d, 0.7, 0.95) + "], values = [0.0, 1.0, -0.6, 0.3] }"); }},
      {"load, jump", "", 6, {}, Check::related,
       [](D& d) {
         if (d.draw.chance(0.5)) return history(d, "{ type = \"step\", start = " + at(d, 0.1, 0.6) + " }");
         const std::string start = at(d, 0.05, 0.4);
         return history(d, "{ type = \"rectangle\", start = " + start + ", end = " + at(d, 0.5, 0.9) + " }");
       }},
      {"base_motion", "", 6, {}, Check::related,
       [](D& d) {
         d.table("[[base_motion]]").set("direction", d.has_nodes() ? "[1.0, 0.3]" : "{ d0 = 1.0, d1 = 0.3, d2 = 1.0 }").set("acceleration", motion_history(d.draw, 15.0, d.t_end));
         return added;
       }},
      {"support that moves", "", 1, {}, Check::related, moving_support},
      {"gravity", "", 6, {}, Check::related,
       [](D& d) {
         d.top.set("gravity", "[0.0, -9.81]");
         return added;
       }},
      {"heat", "", 1, {}, Check::related,
       [](D& d) {
         d.beam().set("thermal_expansion", 1e-3).set("temperature", fmt::format("{{ type = \"table\", times = [0.0, {}], values = [0.0, {}], hold = true, interpolation = \"steffen\" }}", rounded(0.7 * d.t_end, 3), d.draw.rounded(5.0, 20.0, 1)));
         return added;
       }},
      {"load, distributed", "", 1, {}, Check::related,
       [](D& d) {
         d.beam();
         d.table("[[loads]]").set("nodes", fmt::format("[\"far\", \"{}\"]", d.main)).set("direction", "[0.2, -1.0]").set("distributed", d.draw.rounded(2.0, 10.0, 1));
         return added;
       }},
      {"preload", "", 6, {}, Check::related,
       [](D& d) {
         if (!d.has_nodes()) d.main = "d0";
         spring(d).set("stiffness", d.draw.rounded(20.0, 80.0, 1)).set("preload", d.draw.rounded(-6.0, 6.0, 1));
         return added;
       }},
      // structure
      {"damping, alpha", "", 6, {}, Check::related,
       [](D& d) {
         d.damping.set("alpha", d.draw.rounded(0.5, 4.0, 2));
         return added;
       }},
      {"damping, beta", "", 6, {}, Check::related,
       [](D& d) {
         d.damping.set("beta", d.draw.one_of({1e-4, 4e-4}));
         return added;
       }},
      {"damper", "", 6, {}, Check::related,
       [](D& d) {
         if (!d.has_nodes()) d.main = "d0";
         spring(d).set("damping", d.draw.rounded(0.5, 6.0, 1));
         return added;
       }},
      {"rigid body", "", 1, {}, Check::related, rigid_body},
      {"node without mass", "", 1, {}, Check::related, massless},
      {"beam", "", 1, {}, Check::related,
       [](D& d) {
         d.beam().set("elements", "2");
         return added;
       }},
      {"lumped mass", "", 1, {}, Check::related,
       [](D& d) {
         d.beam().name("mass", "lumped").set("elements", "2");
         return added;
       }},
      {"bar", "", 1, {}, Check::related,
       [](D& d) {
         d.beam();
         d.nodes.set("beyond", list({rounded(d.x + 0.6, 3), rounded(d.y + 0.9, 3)}));
         d.table("[[supports]]").name("node", "beyond").set("fix", "[\"ux\", \"uy\"]");
         d.table("[[members]]")
             .set("nodes", fmt::format("[\"beyond\", \"{}\"]", d.main))
             .name("section", "light")
             .name("type", "bar");
         return added;
       }},
      {"hinge", "", 1, {}, Check::related,
       [](D& d) {
         d.beam().set("release", "[\"far\"]");
         return added;
       }},
      {"bend", "", 1, {}, Check::related,
       [](D& d) {
         d.beam().set("bend", "{ radius = 0.8 }").set("elements", "3");
         return added;
       }},
      {"pipe section", "", 1, {}, Check::related, pipe_section},
      {"plane body", "", 1, {}, Check::related,
       [](D& d) {
         d.body();
         return added;
       }},
      {"seam, tied", "", 1, {}, Check::related, tied},
      {"seam, contact", "", 1, {}, Check::related,
       [](D& d) {
         seam(d);
         return added;
       }},
      {"contact_mass none", "", 1, {}, Check::related,
       [](D& d) {
         seam(d).name("contact_mass", "none");
         d.find("[[bodies]]")->set("elements", "[4, 2]");
         for (const char* corner : {"p0", "p1"}) d.take_mass_from(corner);
         return added;
       }},
      {"matrices", "", 0, Kit::matrices, Check::related, [](D&) { return added; }},
      {"reduction, cutoff", "reduction", 6, {}, Check::related,
       [](D& d) {
         d.reduction.set("cutoff_omega", rounded(d.draw.real(15.0, 60.0) / (d.t_end * std::sqrt(d.t_end)), 1));
         return added;
       }},
      {"reduction, tolerance", "reduction", 6, {}, Check::related,
       [](D& d) {
         d.reduction.set("tolerance", d.draw.one_of({1e-3, 1e-2}));
         return added;
       }},
      {"geometric", "", 6, {}, Check::related,
       [](D& d) {
         if (d.kit == Kit::mesh) return std::string("plane bodies have no stiffness of static forces");
         d.run.set("geometric", "true");
         return added;
       }},
      // start
      {"start, static", "start", 6, {}, Check::related, [](D& d) { return initial(d, "static"); }},
      {"start, frictional", "start", 6, {}, Check::related,
       [](D& d) {
         if (d.has_nodes() && d.draw.chance(0.6)) {
           d.top.set("gravity", "[0.0, -9.81]");
           d.stages = {"gravity"};
         }
         return initial(d, "frictional");
       }},
      {"start, given", "start", 6, {}, Check::related, [](D&) { return added; }},
      {"continued", "", 7, {}, Check::going_on, [](D&) { return added; }},
      // computation
      {"exact, series", "engine", 7, {}, Check::related, [](D& d) { return engine(d, "exact", "flow", "\"taylor\""); }},
      {"exact, modes", "engine", 7, {}, Check::related, [](D& d) { return engine(d, "exact", "flow", "\"modal\""); }},
      {"ida", "engine", 7, {}, Check::related, [](D& d) { return engine(d, "ida"); }},
      {"newmark", "engine", 7, {}, Check::related, [](D& d) { return stepped(d, "newmark"); }},
      {"friction-iteration", "engine", 7, {}, Check::related, [](D& d) { return stepped(d, "friction-iteration"); }},
      {"companion, finer", "", 7, {}, Check::related,
       [](D& d) {
         d.run.set("certify", "true").name("companion", "finer");
         return added;
       }},
      {"output of forces", "", 7, {}, Check::related,
       [](D& d) {
         d.beam();
         output(d, "m_far", "member_force", "at", fmt::format("[\"far\", \"{}\"]", d.main)).name("quantity", "M");
         output(d, "held", "reaction", "at", "\"far\"").set("direction", "[1.0, 0.5]");
         return added;
       }},
      {"output of stress, envelope", "", 2, {}, Check::related,
       [](D& d) {
         pipe_section(d);
         output(d, "sigma", "stress", "at", fmt::format("[\"far\", \"{}\"]", d.main));
         output(d, "all_m", "envelope", "nodes", fmt::format("[\"far\", \"{}\"]", d.main)).name("quantity", "M");
         return added;
       }},
      {"output of motion", "", 7, {}, Check::related,
       [](D& d) {
         for (const char* kind : {"acceleration", "displacement"}) {
           DraftTable& o = output(d, kind, kind, "direction", d.has_nodes() ? "[0.6, 0.8]" : "{ d0 = 0.6, d2 = 0.8 }");
           if (d.has_nodes()) o.name("at", d.main);
         }
         return added;
       }},
      {"units", "", 7, {}, Check::in_units, [](D&) { return added; }},
      {"sensitivity", "command", 8, {}, Check::derivatives, [](D&) { return added; }},
      {"orbit", "command", 8, {}, Check::orbit,
       [](D& d) {
         // What happens once is made to repeat itself, and damping lets a transient end.
         const bool once = !d.history.empty() && d.history.find("harmonic") == std::string::npos;
         if (once) {
           const bool ramp = d.history.find("polynomial") != std::string::npos;
           d.history.resize(d.history.rfind(" }"));
           d.history += ramp ? fmt::format(", end = {}, period = {} }}", rounded(0.8 * d.t_end, 4), rounded(1.25 * d.t_end, 4))
                             : fmt::format(", period = {} }}", rounded(1.25 * d.t_end, 4));
         }
         if (!d.has_nodes())
           d.find("[matrices]")->set("damping", "[[3.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 2.0]]");
         else
           d.damping.set("alpha", 4.0);
         return added;
       }},
      {"sweep", "command", 8, {}, Check::sweep, [](D&) { return added; }},
      {"verify", "command", 8, {}, Check::verify, [](D&) { return added; }},
  });
  return features;
}

}  // namespace signorini::differential
