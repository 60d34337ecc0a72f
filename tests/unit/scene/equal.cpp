#include "unit/scene/equal.hpp"

#include <fmt/core.h>

#include <optional>

#include "scene/quantities.hpp"

namespace signorini::testing {

namespace {

// Hexadecimal floating point shows every bit.
class Dump {
 public:
  std::string text;

  template <class... Values>
  void line(const char* what, const Values&... values) {
    text += what;
    (add(values), ...);
    text += '\n';
  }

 private:
  void add(double value) { text += fmt::format(" {:a}", value); }
  void add(int value) { text += fmt::format(" {}", value); }
  void add(bool value) { text += value ? " true" : " false"; }
  void add(const std::string& value) { text += " '" + value + "'"; }
  void add(const std::array<double, 2>& v) { text += fmt::format(" ({:a}, {:a})", v[0], v[1]); }
  void add(const std::pair<std::string, double>& v) { text += fmt::format(" {} = {:a}", v.first, v.second); }
  void add(const MatrixSpec::Entry& e) { text += fmt::format(" {},{} = {:a}", e.row, e.column, e.value); }
  void add(const InitialSpec::Component& c) {
    text += fmt::format(" {}.{} = {:a}", c.node, c.component, c.value);
  }
  void add(const HistorySpec& h) {
    text += fmt::format(" history {}", static_cast<int>(h.type));
    add(h.offset), add(h.amplitude), add(h.start), add(h.end), add(h.omega), add(h.phase);
    add(h.coefficients), add(h.times), add(h.values), add(h.steffen), add(h.start_given);
    add(h.hold), add(h.shift), add(h.period), add(h.rounds);
  }
  void add(const Direction& d) { add(d.node), add(d.vector), add(d.dofs), add(d.against); }
  template <class T>
  void add(const std::optional<T>& value) {
    if (value) {
      add(*value);
    } else {
      text += " none";
    }
  }
  template <class T>
  void add(const std::vector<T>& values) {
    text += fmt::format(" {}:", values.size());
    for (const T& value : values) add(value);
  }
};

/// Of a law of one's own; empty: there is none.
std::vector<double> stored_numbers(const std::optional<ContactLawPtr>& own) {
  std::vector<double> numbers;
  if (!own) return numbers;
  static_cast<void>((*own)->with_constants([&](double& x, const Unit&) { numbers.push_back(x); }));
  return numbers;
}

void dump_structure(Dump& dump, const Scene& s) {
  for (const auto& x : s.sections)
    dump.line("section", x.name, x.EA, x.EI, x.mass_per_length, x.area, x.modulus, x.pipe_radius,
              x.pipe_wall);
  for (const auto& x : s.nodes) dump.line("node", x.name, x.x, x.y);
  for (const auto& x : s.members)
    dump.line("member", x.nodes, x.section, x.elements, x.type == MemberType::bar, x.mass == MassKind::lumped,
              x.release, x.thermal_expansion, x.temperature, x.initial_strain, x.bend ? x.bend->radius : 0.0,
              x.bend ? x.bend->flexibility : 0.0, x.bend ? x.bend->intensification : 0.0);
  for (const auto& x : s.masses) dump.line("mass", x.node, x.mass, x.inertia);
  for (const auto& x : s.rigid) dump.line("rigid", x.name, x.centre, x.nodes);
  for (const auto& x : s.springs)
    dump.line("spring", x.node, x.against, x.direction, x.stiffness, x.damping, x.rotation_stiffness,
              x.rotation_damping, x.preload, x.hot_load);
  for (const auto& x : s.supports)
    dump.line("support", x.node, x.ux, x.uy, x.rz, x.motion, x.motion_is_acceleration);
  if (!s.matrices) return;
  dump.line("dofs", s.matrices->dofs);
  for (const MatrixSpec* m : {&s.matrices->mass, &s.matrices->damping, &s.matrices->stiffness}) {
    dump.line("matrix", m->size, m->entries);
  }
}

}  // namespace

std::string dump(const Scene& s) {
  Dump dump;
  dump.line("title", s.title, s.units.force, s.units.mass, s.units.length, s.units.time, s.gravity);
  dump.line("run", s.run.t_end, static_cast<int>(s.run.engine), s.run.rtol, s.run.atol.displacement,
            s.run.atol.velocity, s.run.atol.force, s.run.output_dt, s.run.output_times, s.run.frames,
            s.run.max_order, s.run.max_events_at_once, s.run.dt);
  dump.line("initial", s.initial.is_static, s.initial.u, s.initial.v, s.initial.components);
  dump.line("damping", s.damping.alpha, s.damping.beta, s.damping.alpha_over_omega1);
  if (s.reduction) dump.line("reduction", s.reduction->cutoff_omega);
  dump_structure(dump, s);
  for (const auto& c : s.contacts) {
    dump.line("contact", c.name, static_cast<int>(c.law), c.normal, c.tangent, c.gap, c.normal_stiffness,
              c.tangential_stiffness, c.normal_damping, c.friction.static_, c.friction.kinetic,
              c.friction.stribeck_velocity, c.friction.velocity,
              c.pendulum_surface ? c.pendulum_surface->radius : 0.0,
              c.pendulum_surface ? c.pendulum_surface->nominal_force : 0.0, c.normal_force,
              c.surface_velocity, c.initial_shear, c.tangential_damping, c.restitution, c.capture_velocity,
              stored_numbers(c.user_law));
  }
  for (const auto& l : s.loads)
    dump.line("load", l.name, static_cast<int>(l.type), l.direction, l.amplitude, l.history, l.pieces,
              l.member_axes);
  for (const auto& m : s.base_motion) dump.line("base", m.direction, m.acceleration);
  return dump.text;
}

}  // namespace signorini::testing
