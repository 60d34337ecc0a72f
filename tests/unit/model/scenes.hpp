// Scenes in code, for the tests of the model.
#pragma once

#include <cmath>

#include "signorini/model.hpp"

namespace signorini::test {

inline ContactSpec support_contact(const std::string& name, const std::string& node, double kn,
                                   double friction = 0.3) {
  ContactSpec c;
  c.name = name;
  c.normal = Direction{node, {0.0, 1.0}, {}, {}};
  c.normal_stiffness = kn;
  c.tangential_stiffness = kn;
  c.friction = {friction, friction};
  c.surface_velocity.amplitude = 0.0;
  return c;
}

inline ContactSpec slider(const std::string& name, const Direction& tangent, double force, double friction) {
  ContactSpec c;
  c.name = name;
  c.law = Law::slider;
  c.tangent = tangent;
  c.normal_force.amplitude = force;
  c.friction = {friction, friction};
  c.surface_velocity.amplitude = 0.0;
  return c;
}

inline Scene empty_scene() {
  Scene s;
  s.file = "test.toml";
  s.units = {"kN", "t", "m", "s"};
  s.run.t_end = 1.0;
  return s;
}

inline Member member(std::vector<std::string> nodes, const std::string& section, std::vector<int> elements) {
  Member m;
  m.nodes = std::move(nodes);
  m.section = section;
  m.elements = std::move(elements);
  return m;
}

inline LoadSpec node_load(const std::string& node, std::array<double, 2> direction, double amplitude) {
  LoadSpec load;
  load.direction = Direction{node, direction, {}, {}};
  load.amplitude = amplitude;
  return load;
}

/// The main scene.
inline Scene pipeline() {
  Scene s = empty_scene();
  s.run.t_end = 1.2;
  s.gravity = {0.0, -9.81};
  s.initial.is_static = true;
  s.damping.alpha_over_omega1 = 0.2;
  s.sections = {{"pipe", 9.0e6, 2.0e6, 0.4}};
  s.nodes = {{"A", 0.0, 0.0, {}}, {"B", 0.0, 6.0, {}}, {"D", 18.0, 6.0, {}}};
  s.members = {member({"A", "B", "D"}, "pipe", {4, 12})};
  s.contacts = {support_contact("first", "A", 1e6), support_contact("second", "D", 1e6)};
  LoadSpec load = node_load("B", {std::sqrt(0.5), std::sqrt(0.5)}, 100.0);
  load.history.type = HistoryType::rectangle;
  load.history.end = 0.1;
  s.loads = {load};
  return s;
}

/// A straight horizontal beam from L to R, `elements` elements; supports and contacts are up to the test.
inline Scene beam(double length, int elements, double ea, double ei, double mass) {
  Scene s = empty_scene();
  s.sections = {{"s", ea, ei, mass}};
  s.nodes = {{"L", 0.0, 0.0, {}}, {"R", length, 0.0, {}}};
  s.members = {member({"L", "R"}, "s", {elements})};
  return s;
}

inline Support support(const std::string& node, bool ux, bool uy, bool rz) {
  Support s;
  s.node = node;
  s.ux = ux;
  s.uy = uy;
  s.rz = rz;
  return s;
}

/// Matrices by rows.
inline MatrixSpec rows(const std::vector<std::vector<double>>& a) {
  MatrixSpec m;
  m.size = static_cast<int>(a.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < a.size(); ++j)
      if (a[i][j] != 0.0) m.entries.push_back({static_cast<int>(i), static_cast<int>(j), a[i][j]});
  return m;
}

inline Scene matrices(const std::vector<std::vector<double>>& m, const std::vector<std::vector<double>>& c,
                      const std::vector<std::vector<double>>& k) {
  Scene s = empty_scene();
  MatricesSpec spec;
  for (std::size_t i = 0; i < m.size(); ++i) spec.dofs.push_back("d" + std::to_string(i));
  spec.mass = rows(m);
  spec.damping = rows(c);
  spec.stiffness = rows(k);
  s.matrices = spec;
  return s;
}

inline int dof(const Model& model, const std::string& name) {
  for (int i = 0; i < model.size(); ++i)
    if (model.dofs[static_cast<std::size_t>(i)].displacement == name) return i;
  return -1;
}

/// The message of the SceneError that building gives; empty when it builds.
inline std::string refusal(const Scene& scene) {
  try {
    (void)build_model(scene);
  } catch (const SceneError& e) {
    return e.what();
  }
  return {};
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace signorini::test
