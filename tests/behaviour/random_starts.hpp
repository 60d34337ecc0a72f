// random_starts.hpp: a bar on springs and contacts, loaded in stages, and a check of its slow way that shares no code
// with the program.
//
//   K u + sum (n N + t T) = P(l)      u from N and T, by elimination
//   N = kn min(g, 0),  |T| <= f |N|;  where nothing happens in between: stick p' = 0, slip s: T = s f |N|, s p' >= 0
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "signorini/model.hpp"

namespace signorini::tests::random_starts {

using Pair = std::array<double, 2>;
using Four = std::array<double, 4>;  // of A, then of B

struct Spring {
  int node;
  Pair direction;
  double stiffness;
};
struct Touch {
  std::string name;
  int node;
  Pair normal;
  double gap, kn, kt, friction;
};
struct Push {
  std::string name;
  int node, stage;
  Pair direction;
  double amplitude;
};
struct Start {
  double EA = 0.0;
  Pair B{1.0, 0.1};
  std::vector<Spring> springs;
  std::vector<Touch> contacts;
  std::vector<Push> loads;
};
inline constexpr int steps = 40, stages = 3;

inline Pair at_angle(double a) { return {std::cos(a), std::sin(a)}; }

inline Start random_start(unsigned seed) {
  std::mt19937 bits(seed);
  const auto between = [&](double a, double b) {
    return a + (b - a) * (static_cast<double>(bits()) / 4294967296.0);
  };
  Start s;
  s.EA = between(100.0, 1000.0);
  for (const int node : {0, 1}) {
    const double a = between(0.0, 6.28);
    s.springs.push_back({node, at_angle(a), between(200.0, 900.0)});
    s.springs.push_back({node, at_angle(a + between(0.6, 2.5)), between(200.0, 900.0)});
  }
  const int count = 1 + static_cast<int>(between(0.0, 3.0));
  for (int k = 0; k < count; ++k) {
    const double gap = between(0.0, 1.0) < 0.5 ? 0.0 : between(0.0, 0.01), kn = between(5e3, 1.5e4);
    s.contacts.push_back({fmt::format("c{}", k), static_cast<int>(between(0.0, 2.0)),
                          at_angle(between(0.0, 6.28)), gap, kn, kn * between(0.2, 0.9), between(0.1, 0.8)});
  }
  for (int stage = 0; stage < 2; ++stage)
    for (int i = 0; i < 2; ++i)
      s.loads.push_back({fmt::format("l{}", s.loads.size()), static_cast<int>(between(0.0, 2.0)), stage,
                         at_angle(between(0.0, 6.28)), between(1.0, 30.0)});
  Push back = s.loads[static_cast<std::size_t>(between(0.0, 2.0))];
  back.name = "back";
  back.stage = 2;
  back.amplitude *= -between(0.5, 1.3);
  s.loads.push_back(back);
  return s;
}

inline Pair turned(const Pair& x, double by) {
  return {std::cos(by) * x[0] - std::sin(by) * x[1], std::sin(by) * x[0] + std::cos(by) * x[1]};
}

/// The same, turned, contacts and springs in another order.
inline Start turned_and_permuted(Start s, double by) {
  s.B = turned(s.B, by);
  for (Spring& spring : s.springs) spring.direction = turned(spring.direction, by);
  for (Touch& contact : s.contacts) contact.normal = turned(contact.normal, by);
  for (Push& load : s.loads) load.direction = turned(load.direction, by);
  std::reverse(s.springs.begin(), s.springs.end());
  std::reverse(s.contacts.begin(), s.contacts.end());
  return s;
}

inline std::string scene_of(const Start& s) {
  const auto node = [](int i) { return i == 0 ? "A" : "B"; };
  const auto pair = [](const Pair& x) { return fmt::format("[{}, {}]", x[0], x[1]); };
  std::string text =
      "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n[run]\nt_end = "
      "1e-4\n"
      "initial = \"frictional\"\n";
  for (int stage = 0; stage < stages; ++stage) {
    std::string names;
    for (const Push& load : s.loads)
      if (load.stage == stage) names += (names.empty() ? "\"" : ", \"") + load.name + "\"";
    text += fmt::format("[[run.stages]]\nname = \"s{}\"\nloads = [{}]\nsteps = {}\n", stage, names, steps);
  }
  text += fmt::format(
      "[sections.bar]\nEA = {}\nmass_per_length = 0.1\n[nodes]\nA = [0.0, 0.0]\nB = {}\n[[members]]\n"
      "nodes = [\"A\", \"B\"]\nsection = \"bar\"\ntype = \"bar\"\n",
      s.EA, pair(s.B));
  for (const Spring& x : s.springs)
    text += fmt::format("[[springs]]\nnode = \"{}\"\ndirection = {}\nstiffness = {}\n", node(x.node),
                        pair(x.direction), x.stiffness);
  for (const Touch& c : s.contacts)
    text += fmt::format(
        "[[contacts]]\nname = \"{}\"\nnode = \"{}\"\nlaw = \"compliant\"\nnormal = {}\ngap = {}\n"
        "normal_stiffness = {}\ntangential_stiffness = {}\nfriction = {}\n",
        c.name, node(c.node), pair(c.normal), c.gap, c.kn, c.kt, c.friction);
  for (const Push& l : s.loads)
    text += fmt::format("[[loads]]\nname = \"{}\"\nnode = \"{}\"\ndirection = {}\namplitude = {}\n", l.name,
                        node(l.node), pair(l.direction), l.amplitude);
  return text;
}

inline Four on(int node, const Pair& d) {
  return node == 0 ? Four{d[0], d[1], 0.0, 0.0} : Four{0.0, 0.0, d[0], d[1]};
}
inline double dot(const Four& a, const Four& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

/// K^-1 P, by Gauss.
inline Four displaced(const Start& s, Four p) {
  std::array<Four, 4> k{};
  const auto spring = [&](const Four& d, double stiffness) {
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) k[i][j] += stiffness * d[i] * d[j];
  };
  for (const Spring& x : s.springs) spring(on(x.node, x.direction), x.stiffness);
  const double length = std::hypot(s.B[0], s.B[1]);
  spring({-s.B[0] / length, -s.B[1] / length, s.B[0] / length, s.B[1] / length}, s.EA / length);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t row = i + 1; row < 4; ++row) {
      const double factor = k[row][i] / k[i][i];
      for (std::size_t j = i; j < 4; ++j) k[row][j] -= factor * k[i][j];
      p[row] -= factor * p[i];
    }
  Four u{};
  for (std::size_t i = 4; i-- > 0;) {
    double sum = p[i];
    for (std::size_t j = i + 1; j < 4; ++j) sum -= k[i][j] * u[j];
    u[i] = sum / k[i][i];
  }
  return u;
}

/// By how much the way fails the laws, as a part of its greatest force; what fails most.
struct Fault {
  double most = 0.0;
  std::string what;
  void take(double by, const std::string& text) {
    if (!(by <= most)) {
      most = by;
      what = text;
    }
  }
};

inline Fault fault_of(const Start& s, const Model& model) {
  constexpr double size = 30.0;  // N, of loads
  Fault fault;
  std::vector<double> slipped(s.contacts.size(), 0.0);
  std::vector<int> before(s.contacts.size(), -1);  // states; -1: not known
  double from = 0.0;
  std::string last = "s0";
  for (const StageEnd& end : model.statics.stages) {
    if (end.stage == "fit") continue;
    if (end.stage != last) from = 0.0;
    last = end.stage;
    const int stage = end.stage[1] - '0';
    Four p{};
    for (const Push& l : s.loads) {
      const double part = l.stage < stage ? 1.0 : l.stage == stage ? end.fraction : 0.0;
      const Four d = on(l.node, l.direction);
      for (std::size_t i = 0; i < 4; ++i) p[i] += part * l.amplitude * d[i];
    }
    for (std::size_t k = 0; k < s.contacts.size(); ++k) {
      const Touch& c = s.contacts[k];
      const Four n = on(c.node, c.normal), t = on(c.node, {c.normal[1], -c.normal[0]});
      for (std::size_t i = 0; i < 4; ++i) p[i] -= n[i] * end.N[k] + t[i] * end.T[k];
    }
    const Four u = displaced(s, p);
    for (std::size_t k = 0; k < s.contacts.size(); ++k) {
      const Touch& c = s.contacts[k];
      const double g = c.gap + dot(on(c.node, c.normal), u), N = end.N[k], T = end.T[k];
      const double slip = dot(on(c.node, {c.normal[1], -c.normal[0]}), u) - T / c.kt;
      const std::string where = fmt::format("{} at {} of {}: ", c.name, end.fraction, end.stage);
      fault.take(std::abs(N - c.kn * std::min(g, 0.0)) / size, where + "N = kn min(g, 0)");
      fault.take((std::abs(T) - c.friction * std::abs(N)) / size, where + "|T| <= f |N|");
      const bool quiet =
          std::none_of(model.statics.events.begin(), model.statics.events.end(), [&](const StageEvent& e) {
            return e.contact == static_cast<int>(k) && e.stage == end.stage && e.fraction >= from &&
                   e.fraction <= end.fraction;
          });
      const int sign = end.states[k] == State::slip_plus ? 1 : end.states[k] == State::slip_minus ? -1 : 0;
      const double rate = c.kt * (slip - slipped[k]) / size;
      if (sign != 0) fault.take(std::abs(T - sign * c.friction * std::abs(N)) / size, where + "T = s f |N|");
      if (quiet && static_cast<int>(end.states[k]) == before[k] && end.states[k] == State::stick)
        fault.take(std::abs(rate), where + "p' = 0");
      if (quiet && static_cast<int>(end.states[k]) == before[k] && sign != 0)
        fault.take(-sign * rate, where + "s p' >= 0");
      slipped[k] = slip;
      before[k] = static_cast<int>(end.states[k]);
    }
    from = end.fraction;
  }
  return fault;
}

}  // namespace signorini::tests::random_starts
