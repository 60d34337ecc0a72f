// An element that the program does not have: all that takes elements takes it, and answers by closed forms.
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>

#include "base/eigen_dense.hpp"
#include "model/assembly/assembly.hpp"
#include "model/assembly/loads.hpp"
#include "model/assembly/member_pieces.hpp"
#include "model/assembly/prestress.hpp"
#include "model/outputs/structure_rows.hpp"
#include "unit/model/element/triangle.hpp"
#include "unit/model/scenes.hpp"

using namespace signorini;
using namespace signorini::test;

namespace {

constexpr Plate plate{7e4, 0.3, 0.12};
constexpr double plate_angle = 0.37;

/// A sheet of four triangles around a node that is not in its middle, turned by an odd angle. A holds both ways, B across AB.
struct Sheet {
  Scene scene = empty_scene();
  element::Mesh mesh;
  double area = 0.0, moment_x = 0.0, moment_y = 0.0;  // of the area, about the origin

  Sheet() {
    const double c = std::cos(plate_angle), s = std::sin(plate_angle);
    const auto node = [&](const char* name, double x, double y) {
      scene.nodes.push_back({name, c * x - s * y, s * x + c * y, {}});
      mesh.by_name.emplace(name, static_cast<int>(mesh.nodes.size()));
      mesh.nodes.push_back({name, scene.nodes.back().x, scene.nodes.back().y});
    };
    node("A", 0.0, 0.0), node("B", 4.0, 0.0), node("C", 4.4, 2.1), node("D", -0.3, 1.7), node("M", 1.1, 0.9);
    mesh.named = 5;
    scene.members = {member({"A", "B", "C", "D"}, "", {})};
    for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {2, 3}, {3, 0}}) add(a, b, 4);
    scene.supports = {{"A", true, true, false, {}, {}, false, "supports.1"}};
  }

  void add(int a, int b, int m) {
    Triangle::Corners at;
    double x = 0.0, y = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const element::MeshNode& n = mesh.node(std::array{a, b, m}[i]);
      at[i] = {n.x, n.y};
      x += n.x / 3.0, y += n.y / 3.0;
    }
    mesh.elements.push_back(std::make_shared<Triangle>(std::vector{a, b, m}, 0, at, plate));
    const double own = mesh.elements.back()->extent();
    area += own, moment_x += own * x, moment_y += own * y;
  }
};

Vector answer(const assembly::Assembly& assembly, const Vector& load) {
  return base::solve_dense(Eigen::MatrixXd(assembly.stiffness), load);
}

}  // namespace

TEST_SUITE("unit/model/element/third_element") {
  TEST_CASE("a third element: nodes of triangles do not turn, and its lines are drawn straight") {
    const Sheet sheet;
    const assembly::DofMap map = assembly::number_nodes(sheet.scene, sheet.mesh);
    CHECK(map.size() == 8);
    for (const Dof& dof : map.dofs) CHECK_FALSE(dof.rotation);
    CHECK(map.element_numbers(0) ==
          std::vector<int>{assembly::DofMap::fixed, assembly::DofMap::fixed, 0, 1, 6, 7});
    Model model;
    assembly::add_drawing(sheet.scene, map, model);
    REQUIRE(model.drawing.size() == 12);
    for (const DrawnElement& line : model.drawing) CHECK(line.kind == DrawnElement::Kind::bar);
    CHECK(model.drawing[2].nodes[0] == 4);
    CHECK(model.drawing[2].nodes[1] == 0);
  }

  TEST_CASE("a third element: heat expands it freely, its weight rests on the supports") {
    Sheet sheet;
    Scene& scene = sheet.scene;
    scene.gravity = {1.7, -9.81};
    scene.supports.push_back({"B", false, true, false, {}, {}, false, "supports.2"});
    scene.members[0].thermal_expansion = 1.2e-5;
    scene.members[0].temperature.amplitude = 40.0;
    const assembly::DofMap map = assembly::number_nodes(scene, sheet.mesh);
    const assembly::Assembly assembly = assembly::assemble_nodes(scene, map);
    const std::vector<Load> loads = assembly::make_loads(scene, map, assembly);
    REQUIRE(loads.size() == 2);
    Vector weight = Vector::Zero(map.size()), heat = weight;
    loads[0].direction.add_to(weight, loads[0].history.value(0.0));
    loads[1].direction.add_to(heat, loads[1].history.value(0.0));
    CHECK(loads[1].kind == LoadKind::temperature);

    // As one it grows by e about A, and turns so that B stays at its height.
    const Vector grown = answer(assembly, heat);
    const double e = 1.2e-5 * 40.0, turn = -e * sheet.mesh.node(1).y / sheet.mesh.node(1).x;
    for (int i = 0; i < map.size(); ++i) {
      const auto [node, c] = map.locations[static_cast<std::size_t>(i)];
      const element::MeshNode& at = sheet.mesh.node(node);
      CHECK(grown[i] ==
            doctest::Approx(c == 0 ? e * at.x - turn * at.y : e * at.y + turn * at.x).epsilon(1e-9));
    }

    // What the supports bear of weight and heat: sums of forces, and of moments about A.
    const outputs::StructureRows rows(scene, map, 0.0, 0.0);
    const Vector u = answer(assembly, weight + heat);
    const auto reaction = [&](int node, std::size_t c) {
      outputs::PhysicalRow row(map.size());
      rows.add_reaction(row, node, c, 1.0);
      REQUIRE(row.given.empty());  // all of it is constant
      return row.constant + row.u.dot(u);
    };
    const double rho = plate.mass_per_area, gx = scene.gravity[0], gy = scene.gravity[1];
    const double at_b = -rho * (gy * sheet.moment_x - gx * sheet.moment_y) / sheet.mesh.node(1).x;
    CHECK(reaction(1, 1) == doctest::Approx(at_b).epsilon(1e-9));
    CHECK(reaction(0, 0) == doctest::Approx(-rho * sheet.area * gx).epsilon(1e-9));
    CHECK(reaction(0, 1) == doctest::Approx(-rho * sheet.area * gy - at_b).epsilon(1e-9));
  }

  TEST_CASE("a third element: without a stiffness of static forces run.geometric is refused") {
    Sheet sheet;
    const assembly::DofMap map = assembly::number_nodes(sheet.scene, sheet.mesh);
    const Vector u = Vector::Zero(map.size());
    CHECK_THROWS_WITH(static_cast<void>(assembly::prestress(sheet.scene, map, Model(), {u, {}, {}, {}})),
                      doctest::Contains("the elements of members.1 have no geometric stiffness"));
  }
}
