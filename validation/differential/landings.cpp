#include "differential/landings.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "differential/random.hpp"
#include "differential/scene_text.hpp"
#include "signorini/simulate.hpp"

namespace signorini::differential {
namespace {

constexpr double gravity = 9.81;
/// Of the energy's scale: what a swallowed hit takes out is of its order. Balances of `exact` are below 1e-7 here.
constexpr double balanced = 1e-5;

std::string head(const std::string& title, double t_end, const std::string& engine,
                 const std::string& initial) {
  return fmt::format(
      "schema = 1\ntitle = \"{}\"\nunits = {{ force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }}\n"
      "gravity = [0.0, -{}]\n[run]\nt_end = {}\nengine = \"{}\"\n{}\n",
      title, gravity, t_end, engine, initial);
}

/// Lands after 2 speed/g, and again; its other end throws it down at once.
std::string bar(Random& draw) {
  const double speed = std::pow(10.0, draw.real(0.0, 1.5)), stiffness = std::pow(10.0, draw.real(5.0, 9.0));
  const double length = draw.real(0.2, 1.0), t_end = 2.0 * speed / gravity * draw.real(1.05, 1.6);
  const std::string engine = draw.chance(0.2) ? "ida" : "exact";
  Keys section;
  section.set("EA", stiffness).set("mass_per_length", draw.real(0.5, 2.0));
  Keys contact;
  contact.name("name", "floor").name("node", "a").name("law", "rigid").set("normal", "[0.0, 1.0]");
  contact.set("capture_velocity", draw.one_of({1e-3, 1e-6, 1e-9}));
  contact.set("restitution", draw.rounded(0.1, 0.9, 2));
  return head("a stiff bar lands late", t_end, engine,
              fmt::format("initial = {{ a = {{ vy = {0:.17g} }}, b = {{ vy = {0:.17g} }} }}", speed)) +
         table("[sections.s]", section) +
         fmt::format("\n[nodes]\na = [0.0, 0.0]\nb = [0.0, {:.17g}]\n", length) +
         table("[[members]]",
               Keys().set("nodes", "[\"a\", \"b\"]").name("section", "s").name("type", "bar")) +
         table("[[supports]]", Keys().set("nodes", "[\"a\", \"b\"]").set("fix", "[\"ux\"]")) +
         table("[[contacts]]", contact);
}

std::string shaking(Random& draw, const char* direction, double strength) {
  std::string text;
  for (int i = 0; i < 2; ++i) {
    Keys history;
    history.name("type", "harmonic").set("amplitude", draw.real(0.3, 1.0) * strength);
    history.set("omega", draw.real(4.0, 18.0));
    history.set("phase", draw.real(0.0, 6.0));
    text +=
        table("[[base_motion]]", Keys().set("direction", direction).set("acceleration", history.braced()));
  }
  return text;
}

std::string block(Random& draw) {
  const double half = draw.real(0.12, 0.35), stiffness = std::pow(10.0, draw.real(6.0, 8.7));
  const double height = draw.real(0.6, 1.4), inertia = draw.real(100.0, 400.0), t_end = draw.real(0.5, 2.5);
  const std::string engine = draw.chance(0.1) ? "ida" : "exact";
  Keys feet;
  feet.name("name", "foot").set("nodes", "[\"L\", \"R\"]").name("law", "rigid").set("normal", "[0.0, 1.0]");
  feet.set("capture_velocity", draw.one_of({1e-4, 1e-6, 1e-9}));
  feet.set("friction", draw.rounded(0.3, 0.9, 2));
  feet.set("restitution", draw.one_of({0.0, 0.0, 0.3, 0.6}));
  const std::string along = shaking(draw, "[1.0, 0.0]", 4.0);
  const std::string up = shaking(draw, "[0.0, 1.0]", 2.5);
  return head("a block rocks on stiff beams", t_end, engine, "initial = \"static\"") +
         table("[sections.stiff]",
               Keys().set("EA", stiffness).set("EI", 0.1 * stiffness).set("mass_per_length", 1.0)) +
         fmt::format("\n[nodes]\nL = [-{0:.17g}, 0.0]\nR = [{0:.17g}, 0.0]\nG = [0.0, {1:.17g}]\n", half,
                     height) +
         table("[[masses]]", Keys().name("node", "G").set("mass", 800.0).set("inertia", inertia)) +
         table("[[members]]", Keys().set("nodes", "[\"L\", \"G\", \"R\"]").name("section", "stiff")) +
         table("[[contacts]]", feet) + along + up;
}

}  // namespace

std::string draw_landing_scene(std::uint64_t seed) {
  Random draw(seed);
  return seed % 2 == 1 ? bar(draw) : block(draw);
}

void LandingsTally::print() const {
  fmt::print(
      "\n| bodies | bars | hits | closings faster than capture_velocity without a hit | energy lost | "
      "stopped "
      "|\n"
      "|---|---|---|---|---|---|\n| {} | {} | {} | {} | {} | {} |\n",
      runs, bars, hits, swallowed, unbalanced, ended);
}

void look_at_landings(const std::string& name, const std::string& text, LandingsTally& tally) {
  const Scene scene = parse_scene(text, name + ".toml", {{"run.certify", "false"}});
  const Result result = simulate(build_model(scene), scene.run);
  const double capture = *scene.contacts.front().capture_velocity;
  ++tally.runs;
  tally.bars += scene.contacts.size() == 1 ? 1 : 0;
  const auto of = [&](EventType type, double faster) {
    return std::count_if(result.events.begin(), result.events.end(), [&](const Event& event) {
      return event.type == type && event.contact >= 0 && event.vn < -faster;
    });
  };
  tally.hits += of(EventType::impact, 0.0);
  const long swallowed = of(EventType::contact, capture);
  const Audit& audit = result.report.audit;
  // Each step of ida may be off by its tolerance, all the same way.
  const auto steps = static_cast<double>(result.report.counters.steps);
  const double allowed =
      scene.run.engine == Engine::ida ? std::max(balanced, scene.run.rtol * steps) : balanced;
  const bool lost = !(audit.energy.value <= allowed * audit.energy_scale);
  const bool ended = result.report.outcome.kind != Outcome::Kind::done;
  tally.swallowed += swallowed;
  tally.unbalanced += lost ? 1 : 0;
  tally.ended += ended ? 1 : 0;
  if (swallowed == 0 && !lost && !ended) return;
  fmt::print("{}: {} closings without a hit, energy off by {:.2g} of {:.2g}; {}\n", name, swallowed,
             audit.energy.value, audit.energy_scale, result.report.outcome.reason);
  std::fflush(stdout);
}

}  // namespace signorini::differential
