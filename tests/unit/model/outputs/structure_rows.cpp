// Reactions against the assembled matrices: the force that would hold a free node is its row of M a + K u.
#include "model/outputs/structure_rows.hpp"

#include <doctest/doctest.h>
#include <fmt/core.h>

#include "model/assembly/dofs.hpp"
#include "signorini/model.hpp"

using namespace signorini;

TEST_SUITE_BEGIN("unit/model/outputs/structure_rows");

TEST_CASE(
    "reactions: of every node of a body, with its mass at the contacts and with that mass moved inside") {
  for (const char* shape : {"t3", "q4", "q8"})
    for (const char* mass : {"consistent", "none"}) {
      CAPTURE(shape);
      CAPTURE(mass);
      const Scene scene = parse_scene(fmt::format(R"(schema = 1
units = {{ force = "N", mass = "kg", length = "m", time = "s" }}
run = {{ t_end = 1.0 }}
[[bodies]]
name = "b"
rectangle = {{ from = [0.3, 0.2], size = [2.0, 0.9], degrees = 21.0 }}
elements = [4, 3]
shape = "{}"
E = 2.0e3
nu = 0.25
density = 3.0
thickness = 0.1
plane = "strain"
[[seams]]
name = "s"
slave = "b.bottom"
master = "ground"
law = "compliant"
normal_stiffness = 1.0e6
contact_mass = "{}"
)",
                                                  shape, mass),
                                      "reactions.toml");
      const Model model = build_model(scene);
      const assembly::DofMap map = assembly::number_nodes(scene);
      REQUIRE(map.size() == model.size());
      const outputs::StructureRows rows(scene, map, 0.0, 0.0);
      const Eigen::MatrixXd m = model.mass, k = model.stiffness;
      Vector total[2] = {Vector::Zero(map.size()), Vector::Zero(map.size())};
      for (std::size_t node = 0; node < map.mesh.nodes.size(); ++node)
        for (const std::size_t c : {std::size_t(0), std::size_t(1)}) {
          const int number = map.numbers_at(static_cast<int>(node))[c];
          REQUIRE(number >= 0);
          outputs::PhysicalRow row(map.size());
          rows.add_reaction(row, static_cast<int>(node), c, 2.0);
          CHECK((row.a - 2.0 * m.row(number).transpose()).norm() <= 1e-14 * m.norm());
          CHECK((row.u - 2.0 * k.row(number).transpose()).norm() <= 1e-13 * k.norm());
          total[c] += 0.5 * row.a;
        }
      for (const std::size_t c : {std::size_t(0), std::size_t(1)}) {
        outputs::PhysicalRow row(map.size());
        rows.add_total(row, c);  // what supports bear: less than nothing where all of it falls
        CHECK((row.a + total[c]).norm() <= 1e-14 * m.norm());
      }
    }
}

TEST_SUITE_END();
