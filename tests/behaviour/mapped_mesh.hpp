// mapped_mesh.hpp: a file of Gmsh (2.2) of a square grid, mapped; groups bottom, right, top, left.
#pragma once

#include <fmt/core.h>

#include <array>
#include <functional>
#include <map>
#include <string>

#include "mesh/shape_functions.hpp"

namespace signorini::test {

/// n x m elements q4 or q8 over 0 <= a, b <= 1 at map(a, b), which keeps orientation.
[[nodiscard]] inline std::string mapped_mesh(
    PlaneShape shape, int n, int m, const std::function<std::array<double, 2>(double a, double b)>& map) {
  const bool middles = mesh::has_midside_nodes(shape);
  const int step = middles ? 2 : 1;
  std::map<std::pair<int, int>, int> number;
  std::string nodes;
  for (int j = 0; j <= step * m; ++j)
    for (int i = 0; i <= step * n; ++i) {
      if (middles && i % 2 == 1 && j % 2 == 1) continue;
      const int own = static_cast<int>(number.size()) + 1;
      number[{i, j}] = own;
      const auto [x, y] = map(static_cast<double>(i) / (step * n), static_cast<double>(j) / (step * m));
      nodes += fmt::format("{} {:.17g} {:.17g} 0\n", own, x, y);
    }
  std::string elements;
  int count = 0;
  const auto add = [&](int type, int group, const std::vector<int>& at) {
    elements += fmt::format("{} {} 2 {} {}", ++count, type, group, group);
    for (const int k : at) elements += fmt::format(" {}", k);
    elements += "\n";
  };
  const auto line = [&](int group, int i, int j, int di, int dj) {
    std::vector<int> at{number[{i, j}], number[{i + step * di, j + step * dj}]};
    if (middles) at.push_back(number[{i + di, j + dj}]);
    add(middles ? 8 : 1, group, at);
  };
  for (int i = 0; i < n; ++i) {
    line(1, step * i, 0, 1, 0);
    line(3, step * i, step * m, 1, 0);
  }
  for (int j = 0; j < m; ++j) {
    line(2, step * n, step * j, 0, 1);
    line(4, 0, step * j, 0, 1);
  }
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      const int x = step * i, y = step * j;
      std::vector<int> at{number[{x, y}], number[{x + step, y}], number[{x + step, y + step}],
                          number[{x, y + step}]};
      if (middles)
        for (const int k :
             {number[{x + 1, y}], number[{x + 2, y + 1}], number[{x + 1, y + 2}], number[{x, y + 1}]})
          at.push_back(k);
      add(middles ? 16 : 3, 5, at);
    }
  return fmt::format(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n5\n1 1 \"bottom\"\n1 2 \"right\"\n1 3 "
      "\"top\"\n1 4 "
      "\"left\"\n2 5 \"all\"\n$EndPhysicalNames\n$Nodes\n{}\n{}$EndNodes\n$Elements\n{}\n{}$EndElements\n",
      number.size(), nodes, count, elements);
}

}  // namespace signorini::test
