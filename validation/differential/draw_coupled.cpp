#include <algorithm>
#include <cmath>

#include "differential/coupled.hpp"
#include "differential/families.hpp"
#include "differential/matrix_forms.hpp"
#include "differential/scene_text.hpp"

namespace signorini::differential {
namespace {

constexpr double pi = 3.14159265358979323846;

Keys rigid(Random& draw, std::size_t k) {
  Keys contact = Keys().name("name", fmt::format("c{}", k)).name("law", "rigid");
  contact.set("friction", draw.one_of({0.0, 0.1, 0.3, 0.5, 1.0, draw.rounded(0.05, 1.5, 2)}));
  contact.set("restitution", draw.one_of({0.0, 0.0, 0.0, 0.5, 0.8}));
  return contact.set("gap", draw.one_of({0.0, 0.0, 0.0, draw.rounded(0.001, 0.1, 3)}));
}

std::string steady_and_harmonic(const std::string& place, Random& draw, double size) {
  const double amplitude = rounded(size * draw.real(0.3, 1.0), 3);
  Keys load = Keys().set("amplitude", amplitude);
  if (draw.chance(0.7)) {
    Keys history = Keys().name("type", "harmonic").set("omega", draw.rounded(3.0, 40.0, 2));
    load.set("history", history.set("phase", draw.one_of({0.0, 1.0})).braced());
  }
  return "\n[[loads]]\n" + place + load.lines();
}

/// M full, forms of contacts at random, two to a degree of freedom at most.
std::string matrices(Random& draw, std::size_t count) {
  const auto n =
      static_cast<std::size_t>(std::clamp(2 * static_cast<int>(count) + draw.integer(-1, 3), 2, 12));
  const Matrix mass = mass_matrix(draw, n);
  const auto rank = static_cast<std::size_t>(draw.integer(0, static_cast<int>(n)));
  const Matrix stiffness = gram(draw, n, rank, draw.one_of({1.0, 10.0, 100.0}));
  const Matrix damping = damping_matrix(draw, mass, stiffness);
  std::string contacts;
  Form press(n, 0.0);
  for (std::size_t k = 0; k < count; ++k) {
    const Form normal = normal_form(draw, n, k);
    const Form tangent = tangent_form(draw, mass, normal, k);
    const double force = draw.one_of({1.0, 5.0, 10.0});
    for (std::size_t i = 0; i < n; ++i) press[i] = rounded(press[i] - force * normal[i], 3);
    contacts +=
        table("[[contacts]]", rigid(draw, k).set("normal", form(normal)).set("tangent", form(tangent)));
  }
  Form v(n, 0.0);
  if (draw.chance(0.5))
    for (double& x : v) x = draw.rounded(-1.0, 1.0, 2);
  const std::string initial = Keys().set("u", list(Form(n, 0.0))).set("v", list(v)).braced();
  std::string text =
      Keys().set("initial", initial).lines() +
      table("[matrices]",
            Keys().set("mass", rows(mass)).set("stiffness", rows(stiffness)).set("damping", rows(damping))) +
      contacts;
  if (greatest(press) > 0.0)
    text += table("[[loads]]", Keys().set("direction", form(press)).set("amplitude", 1.0));
  for (int i = draw.integer(1, 2); i > 0; --i) {
    Form d = sparse_form(draw, n);
    if (greatest(d) == 0.0) d[0] = 1.0;
    text += steady_and_harmonic("direction = " + form(d) + "\n", draw, 20.0);
  }
  return text;
}

/// A chain of beams with consistent masses, so that all move all, each node on a contact in any direction.
std::string beams(Random& draw, std::size_t count) {
  std::string nodes, names, contacts, loads;
  double x = 0.0, y = 0.0;
  const std::size_t free = draw.chance(0.3) ? 1 : 0;  // nodes without a contact
  for (std::size_t k = 0; k < count + 1 + free; ++k) {
    const std::string name = fmt::format("p{}", k);
    nodes += fmt::format("{} = [{}, {}]\n", name, rounded(x, 3), rounded(y, 3));
    names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", name);
    const double length = draw.real(0.5, 2.0), angle = draw.real(-1.2, 1.2);
    x += length * std::cos(angle);
    y += length * std::sin(angle);
    if (k >= count) continue;
    const double across = draw.real(0.0, 2.0 * pi);
    const double nx = rounded(std::cos(across), 6), ny = rounded(std::sin(across), 6);
    contacts += table("[[contacts]]", rigid(draw, k).name("node", name).set("normal", list({nx, ny})));
    const std::string place = fmt::format("node = \"{}\"\ndirection = [{}, {}]\n", name, -nx, -ny);
    loads += "\n[[loads]]\n" + place + Keys().set("amplitude", draw.one_of({1.0, 5.0, 20.0})).lines();
    const std::string aside = fmt::format("node = \"{}\"\ndirection = [{}, {}]\n", name, ny, -nx);
    if (draw.chance(0.6)) loads += steady_and_harmonic(aside, draw, 20.0);
  }
  Keys section = Keys().set("EA", draw.one_of({1e3, 1e5})).set("EI", draw.one_of({10.0, 500.0}));
  section.set("mass_per_length", draw.one_of({1.0, 4.0}));
  std::string text = "\n[nodes]\n" + nodes + table("[sections.beam]", section);
  text += table("[damping]", Keys().set("alpha", draw.one_of({0.0, 0.5, 5.0})));
  text += table("[[members]]",
                Keys().set("nodes", "[" + names + "]").name("section", "beam").set("elements", "1"));
  if (draw.chance(0.3))
    text += table("[[supports]]",
                  Keys().name("node", fmt::format("p{}", count + free)).set("fix", "[\"ux\", \"uy\"]"));
  return text + contacts + loads;
}

}  // namespace

std::string draw_coupled_scene(std::uint64_t seed) {
  Random draw(seed);
  const auto count = static_cast<std::size_t>(draw.integer(1, 5));
  const bool plane = draw.chance(0.4);
  const std::string head = fmt::format(
      "schema = 1\ntitle = \"coupled {}, seed {}\"\nunits = {{ force = \"N\", mass = \"kg\", length = \"m\", "
      "time = \"s\" }}\n",
      plane ? "beams" : "matrices", seed);
  return head + run_table(draw.one_of({0.2, 0.5, 1.0})) +
         (plane ? beams(draw, count) : matrices(draw, count));
}

}  // namespace signorini::differential
