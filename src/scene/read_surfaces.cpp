// [[surfaces]]: boundaries of a structure given by [matrices], for seams.
#include <fmt/core.h>

#include <algorithm>

#include "base/listed.hpp"
#include "base/number.hpp"
#include "scene/readers.hpp"

namespace signorini {

namespace {

/// Two surfaces may share a node (the tip of a crack): its degrees of freedom then must be the same.
int index_of(const Table& table, const SurfaceNode& node, Scene& scene) {
  const auto same =
      std::find_if(scene.surface_nodes.begin(), scene.surface_nodes.end(), [&](const SurfaceNode& other) {
        return (!node.ux.empty() && node.ux == other.ux) || (!node.uy.empty() && node.uy == other.uy);
      });
  if (same == scene.surface_nodes.end()) {
    scene.surface_nodes.push_back(node);
    return static_cast<int>(scene.surface_nodes.size()) - 1;
  }
  if (same->ux != node.ux || same->uy != node.uy || same->x != node.x || same->y != node.y)
    table.fail(node.ux == same->ux ? "ux" : "uy",
               fmt::format("found \"{}\" at two places, [{:.9g}, {:.9g}] and [{:.9g}, {:.9g}]",
                           node.ux == same->ux ? node.ux : node.uy, same->x, same->y, node.x, node.y));
  return static_cast<int>(same - scene.surface_nodes.begin());
}

std::vector<SurfaceNode> read_surface_nodes(Table& table, const Names& dofs) {
  const auto x = table.numbers("x"), y = table.numbers("y");
  for (const char* key : {"x", "y"}) table.require(key, "");
  const std::vector<std::string> ux = table.texts("ux"), uy = table.texts("uy");
  const std::pair<const char*, std::size_t> counts[] = {
      {"y", y->size()}, {"ux", ux.size()}, {"uy", uy.size()}};
  for (const auto& [key, count] : counts)
    if (count != x->size())
      table.fail(key, fmt::format("found {}, expected one for each of the {} places of x",
                                  count_of(count, "entry"), x->size()));
  std::vector<SurfaceNode> nodes;
  for (std::size_t i = 0; i < x->size(); ++i) {
    for (const auto& [key, name] : {std::pair{"ux", &ux[i]}, std::pair{"uy", &uy[i]}})
      if (!name->empty())
        static_cast<void>(check_known(*name, dofs, "degree of freedom", table.place(key), table.path(key)));
    nodes.push_back({(*x)[i], (*y)[i], ux[i], uy[i]});
  }
  return nodes;
}

/// Edges between consecutive nodes; with quadratic edges every second node is a middle node.
std::vector<PlaneMesh::Edge> edges_of(Table& table, std::vector<int> nodes) {
  const bool quadratic = table.flag("quadratic"), closed = table.flag("closed");
  if (closed) nodes.push_back(nodes.front());
  const std::size_t step = quadratic ? 2 : 1;
  if (nodes.size() < step + 1 || (nodes.size() - 1) % step != 0)
    table.fail("x", fmt::format("found {}, expected {}", count_of(nodes.size() - (closed ? 1 : 0), "place"),
                                quadratic ? "an end, a middle, an end and so on" : "two or more"));
  std::vector<PlaneMesh::Edge> edges;
  for (std::size_t i = 0; i + step < nodes.size(); i += step) {
    edges.push_back({{nodes[i], nodes[i + step]}});
    if (quadratic) edges.back().nodes.push_back(nodes[i + 1]);
  }
  return edges;
}

}  // namespace

void read_surfaces(Table& top, Scene& scene, RecordedScene& record) {
  Names names, dofs;
  if (scene.matrices)
    for (const std::string& name : scene.matrices->dofs) dofs.add(name);
  for (Table& table : tables_of(top, "surfaces")) {
    if (!scene.matrices)
      table.fail("", "has no meaning without [matrices]: boundaries of [[bodies]] are their groups");
    SurfaceSpec surface;
    surface.place = table.place();
    surface.name = table.text("name");
    if (!names.add(surface.name))
      table.fail("name",
                 fmt::format("found \"{}\" twice, expected each surface to have its own name", surface.name));
    std::vector<int> nodes;
    for (const SurfaceNode& node : read_surface_nodes(table, dofs))
      nodes.push_back(index_of(table, node, scene));
    surface.edges = edges_of(table, std::move(nodes));
    for (const PlaneMesh::Edge& edge : surface.edges) {
      const auto at = [&](int i) -> const SurfaceNode& {
        return scene.surface_nodes[static_cast<std::size_t>(edge.nodes[static_cast<std::size_t>(i)])];
      };
      if (at(0).x == at(1).x && at(0).y == at(1).y)
        table.fail("x",
                   fmt::format("found the place [{:.9g}, {:.9g}] at both ends of an edge", at(0).x, at(0).y));
    }
    surface.thickness = table.number("thickness");
    table.finish();
    scene.surfaces.push_back(std::move(surface));
    record.add("surfaces", "[[surfaces]]", table.record());
  }
}

}  // namespace signorini
