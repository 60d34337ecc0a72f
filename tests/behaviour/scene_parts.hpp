// scene_parts.hpp: tables of scene files that many tests write.
//
//   using namespace signorini::tests::parts;
//   head + run_table(1.0, 0.1) + nodes({{"A", 0.0, 0.0}, {"B", 3.0, 4.0}}) + fixed("A", "ux, uy")
//
// Units: kN, t, m, s.
#pragma once

#include <fmt/core.h>

#include <initializer_list>
#include <string>
#include <tuple>

namespace signorini::tests::parts {

inline const std::string head =
    "schema = 1\nunits = { force = \"kN\", mass = \"t\", length = \"m\", time = \"s\" }\n";

/// "A, B" -> "[\"A\", \"B\"]"
inline std::string quoted(const std::string& names) {
  std::string list = "[\"";
  for (const char c : names) list += c == ',' ? "\"," : c == ' ' ? " \"" : std::string(1, c);
  return list + "\"]";
}

/// With `initial` where one is given.
inline std::string run_table(double t_end, double output_dt, const std::string& initial = "") {
  return fmt::format("[run]\nt_end = {}\noutput_dt = {}\n", t_end, output_dt) +
         (initial.empty() ? "" : "initial = \"" + initial + "\"\n");
}

/// The section "s".
inline std::string section(double EA, double EI, double mass_per_length) {
  return fmt::format("[sections.s]\nEA = {}\nEI = {}\nmass_per_length = {}\n", EA, EI, mass_per_length);
}

struct Point {
  const char* name;
  double x, y;
};
inline std::string nodes(std::initializer_list<Point> points) {
  std::string text = "[nodes]\n";
  for (const Point& p : points) text += fmt::format("{} = [{}, {}]\n", p.name, p.x, p.y);
  return text;
}

/// Of the section "s".
inline std::string member(const std::string& names, const std::string& more = "") {
  return "[[members]]\nnodes = " + quoted(names) + "\nsection = \"s\"\n" + more;
}

inline std::string point_mass(const std::string& node, double mass, double inertia = 0.0) {
  return fmt::format("[[masses]]\nnode = \"{}\"\nmass = {}\ninertia = {}\n", node, mass, inertia);
}

inline std::string spring(const std::string& node, const std::string& direction, double stiffness) {
  return fmt::format("[[springs]]\nnode = \"{}\"\ndirection = {}\nstiffness = {}\n", node, direction,
                     stiffness);
}

/// Held, or moved as `more` says.
inline std::string fixed(const std::string& names, const std::string& what, const std::string& more = "") {
  return "[[supports]]\nnodes = " + quoted(names) + "\nfix = " + quoted(what) + "\n" + more;
}

/// Two blocks in a row on sliders, a spring between. run: its table, and what belongs to it.
inline std::string two_sliders(const std::string& run, const std::string& loads) {
  std::string text = head + run + nodes({{"A", 0.0, 0.0}, {"B", 1.0, 0.0}}) + point_mass("A", 1.0) +
                     point_mass("B", 1.0) + fixed("A, B", "uy") +
                     "[[springs]]\nnode = \"A\"\nagainst = \"B\"\ndirection = [1.0, 0.0]\nstiffness = 10.0\n";
  for (const auto& [name, node, force] : {std::tuple("ca", "A", 1.0), std::tuple("cb", "B", 2.0)})
    text += fmt::format(R"([[contacts]]
name = "{}"
node = "{}"
law = "slider"
tangent = [1.0, 0.0]
normal_force = {}
tangential_stiffness = 100.0
friction = 0.5
)",
                        name, node, force);
  return text + loads;
}

}  // namespace signorini::tests::parts
