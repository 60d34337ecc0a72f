#include "scenes.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace signorini::benchmarks {
namespace {

constexpr int elements_a_bay = 10;
constexpr double element = 1.5;  // m, as in models/pipeline.toml

std::string head(const char* title, double t_end) {
  return fmt::format(
      "schema = 1\ntitle = \"{}\"\nunits = {{ force = \"kN\", mass = \"t\", length = \"m\", time = \"s\" }}\n"
      "[run]\nt_end = {}\nrtol = 1e-6\noutput_times = [{}]\n",
      title, t_end, t_end);
}

}  // namespace

std::string bedded_pipe(int unknowns, int contacts, double t_end) {
  const int bays = std::max(unknowns / (3 * elements_a_bay), std::max(contacts - 1, 1));
  std::string text = head("Pipe on springs and contacts", t_end);
  text +=
      "initial = \"static\"\n[damping]\nalpha = 1.0\n"
      "[sections.pipe]\nEA = 9.0e6\nEI = 2.0e6\nmass_per_length = 0.4\n[nodes]\n";
  std::string nodes;
  for (int i = 0; i <= bays; ++i) {
    text += fmt::format("n{} = [{}, 0.0]\n", i, i * elements_a_bay * element);
    nodes += fmt::format("{}\"n{}\"", i == 0 ? "" : ", ", i);
  }
  text +=
      fmt::format("[[members]]\nnodes = [{}]\nsection = \"pipe\"\nelements = {}\n", nodes, elements_a_bay);
  for (int i = 0; i <= bays; ++i)
    for (const char* direction : {"[1.0, 0.0]", "[0.0, 1.0]"})
      text += fmt::format("[[springs]]\nnode = \"n{}\"\ndirection = {}\nstiffness = 1e4\n", i, direction);
  for (int c = 0; c < contacts; ++c)
    text += fmt::format(
        "[[contacts]]\nname = \"c{}\"\nnode = \"n{}\"\nnormal = [0.0, 1.0]\nlaw = \"compliant\"\n"
        "normal_stiffness = 1e6\ntangential_stiffness = 1e6\nfriction = 0.3\n",
        c, c * bays / (contacts - 1));
  for (int c = 0; c < contacts; ++c)
    text += fmt::format(
        "[[loads]]\nnode = \"n{}\"\ndirection = [0.7, 0.7]\namplitude = 40.0\n"
        "history = {{ type = \"harmonic\", omega = {} }}\n",
        c * bays / (contacts - 1), 20.0 + 0.1 * c);
  return text;
}

std::string chain(int unknowns, int contacts, double t_end) {
  std::string text = head("Chain of masses on a belt", t_end);
  text += "initial = { m0 = { ux = 0.0 } }\n[nodes]\n";
  for (int i = 0; i < unknowns; ++i) text += fmt::format("m{} = [{}, 0.0]\n", i, i);
  for (int i = 0; i < unknowns; ++i) {
    text += fmt::format(
        "[[masses]]\nnode = \"m{0}\"\nmass = 1.0\n[[supports]]\nnode = \"m{0}\"\nfix = [\"uy\"]\n", i);
    text += fmt::format("[[springs]]\nnode = \"m{}\"\ndirection = [1.0, 0.0]\nstiffness = 1.0\n", i);
    if (i > 0)
      text += fmt::format(
          "[[springs]]\nnode = \"m{}\"\nagainst = \"m{}\"\ndirection = [1.0, 0.0]\nstiffness = 25.0\n", i,
          i - 1);
  }
  for (int c = 0; c < contacts; ++c)
    text += fmt::format(
        "[[contacts]]\nname = \"c{}\"\nnode = \"m{}\"\nlaw = \"slider\"\ntangent = [1.0, 0.0]\n"
        "normal_force = 1.0\nfriction = {{ static = {}, kinetic = 0.7 }}\nsurface_velocity = 0.2\n",
        c, c * unknowns / contacts, 1.0 + 0.01 * (c % 17));
  return text;
}

}  // namespace signorini::benchmarks
