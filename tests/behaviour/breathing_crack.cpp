// A crack that opens and closes: the frequency of a bilinear oscillator, by one mode and by finite elements.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <map>
#include <numbers>

#include "model/modes/frequencies.hpp"
#include "signorini/simulate.hpp"
#include "unit/result/made_up.hpp"

using namespace signorini;

namespace {

/// A bar 1 x 0.1 of n x m elements, cut at column `cut` from the middle to the top: groups clamp, near, far (the faces).
std::string cracked_mesh(int n, int m, int cut) {
  std::map<std::pair<int, int>, int> number,
      beyond;  // beyond: nodes of the crack that belong to its right side
  std::string nodes, elements;
  int count = 0;
  const auto add_node = [&](int i, int j) {
    nodes += fmt::format("{} {:.17g} {:.17g} 0\n", ++count, static_cast<double>(i) / n, 0.1 * j / m);
    return count;
  };
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= n; ++i) number[{i, j}] = add_node(i, j);
  for (int j = m / 2 + 1; j <= m; ++j) beyond[{cut, j}] = add_node(cut, j);
  const auto at = [&](int i, int j, bool right) {
    const auto found = beyond.find({i, j});
    return right && found != beyond.end() ? found->second : number[{i, j}];
  };
  int lines = 0;
  const auto add = [&](int type, int group, const std::vector<int>& on) {
    elements += fmt::format("{} {} 2 {} {}", ++lines, type, group, group);
    for (const int k : on) elements += fmt::format(" {}", k);
    elements += "\n";
  };
  for (int j = 0; j < m; ++j) add(1, 1, {at(0, j, false), at(0, j + 1, false)});
  for (int j = m / 2; j < m; ++j) {
    add(1, 2, {at(cut, j, false), at(cut, j + 1, false)});
    add(1, 3, {at(cut, j, true), at(cut, j + 1, true)});
  }
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i)
      add(3, 4,
          {at(i, j, i >= cut), at(i + 1, j, i >= cut), at(i + 1, j + 1, i >= cut), at(i, j + 1, i >= cut)});
  return fmt::format(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n1 1 \"clamp\"\n1 2 \"near\"\n1 3 \"far\"\n2 "
      "4 "
      "\"all\"\n$EndPhysicalNames\n$Nodes\n{}\n{}$EndNodes\n$Elements\n{}\n{}$EndElements\n",
      count, nodes, lines, elements);
}

/// Mean time between upward zeros of a column after `from`.
double mean_period(const Result& result, int dof, double from) {
  double first = 0.0, last = 0.0;
  int periods = -1;
  for (std::size_t i = 1; i < result.rows.size(); ++i) {
    const auto &a = result.rows[i - 1], &b = result.rows[i];
    if (a.t < from || !(a.u[dof] < 0.0 && b.u[dof] >= 0.0)) continue;
    last = a.t - a.u[dof] * (b.t - a.t) / (b.u[dof] - a.u[dof]);
    if (++periods == 0) first = last;
  }
  REQUIRE(periods >= 4);
  return (last - first) / periods;
}

}  // namespace

TEST_SUITE_BEGIN("slow/behaviour/breathing_crack");

TEST_CASE("a crack in a cantilever breathes at 2 f1 f2 / (f1 + f2), f1 open and f2 closed, within 1 %") {
  const made_up::Folder folder;
  made_up::spill(folder / "crack.msh", cracked_mesh(40, 8, 10));
  const std::string text = fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
run = {{ t_end = 9.0, engine = "exact", output_dt = 0.002, certify = false }}
damping = {{ alpha = 0.0, beta = 1.6e-3 }}
[[bodies]]
name = "bar"
mesh = "{}"
E = 1.0e7
nu = 0.3
density = 1000.0
plane = "stress"
points = {{ tip = [1.0, 0.1] }}
[[supports]]
nodes = ["bar.clamp"]
fix = ["ux", "uy"]
[[loads]]
node = "tip"
direction = [0.0, 1.0]
amplitude = 1.0
history = {{ type = "half_sine", duration = 0.3 }}
[[seams]]
name = "crack"
slave = "bar.near"
master = "bar.far"
law = "compliant"
normal_stiffness = 1.0e10
contact_mass = "none"
)",
                                       (folder / "crack.msh").string());
  const Scene whole = parse_scene(text, "crack.toml");
  const Model structure = build_model(whole);
  const double f1 = modes::lowest_frequencies(structure.mass, structure.damping, structure.stiffness, {}, 1)
                        .modes[0]
                        .omega /
                    (2.0 * std::numbers::pi);
  const double f2 = modes::lowest_frequencies(structure.mass, structure.damping, structure.stiffness,
                                              modes::constrain_normals(structure.contacts), 1)
                        .modes[0]
                        .omega /
                    (2.0 * std::numbers::pi);
  const Scene scene = parse_scene(text + "[reduction]\ncutoff_omega = 400.0\n", "crack.toml");
  const Model model = build_model(scene);
  Result result = simulate(model, scene.run);
  REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
  int tip = -1;
  for (std::size_t i = 0; i < model.reduction->dofs.size(); ++i)
    if (model.reduction->dofs[i].displacement == "tip.uy") tip = static_cast<int>(i);
  REQUIRE(tip >= 0);
  for (auto& row : result.rows)
    if (row.u.size() != static_cast<Eigen::Index>(model.reduction->dofs.size()))
      row.u = model.physical(row.u);
  const double f = 1.0 / mean_period(result, tip, 2.0), wanted = 2.0 * f1 * f2 / (f1 + f2);
  CHECK(f2 / f1 >= 1.03);
  CHECK(std::abs(f / wanted - 1.0) <= 0.01);
}

TEST_SUITE_END();
