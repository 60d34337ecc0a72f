#include "model/assembly/parts.hpp"

#include <doctest/doctest.h>

using namespace signorini;

namespace {

/// d0 - d3 by K, d1 - d4 by a contact, d2 and d5 touched by nothing.
std::string scene_text(const std::string& rest = "") {
  return "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n"
         "[run]\nt_end = 1.0\ninitial = { u = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5], v = [1.0, 1.1, 1.2, 1.3, 1.4, "
         "1.5] }\n"
         "[matrices]\nmass = [[1.0, 0, 0, 0, 0, 0], [0, 2.0, 0, 0, 0, 0], [0, 0, 3.0, 0, 0, 0], [0, 0, 0, "
         "4.0, 0, 0],"
         " [0, 0, 0, 0, 5.0, 0], [0, 0, 0, 0, 0, 6.0]]\n"
         "stiffness = [[9.0, 0, 0, -2.0, 0, 0], [0, 8.0, 0, 0, 0, 0], [0, 0, 7.0, 0, 0, 0], [-2.0, 0, 0, "
         "6.0, 0, 0],"
         " [0, 0, 0, 0, 5.0, 0], [0, 0, 0, 0, 0, 4.0]]\n"
         "[[contacts]]\nname = \"b\"\nlaw = \"compliant\"\nnormal = { d1 = 1.0, d4 = -0.5 "
         "}\nnormal_stiffness = 10.0\n"
         "[[contacts]]\nname = \"a\"\nlaw = \"compliant\"\nnormal = { d3 = 1.0 }\nnormal_stiffness = 20.0\n"
         "[[loads]]\ndirection = { d0 = 2.0, d4 = 3.0, d5 = 4.0 }\namplitude = 1.0\nhistory = { type = "
         "\"constant\" }\n"
         "[[loads]]\ndirection = { d2 = 5.0 }\namplitude = 1.0\nhistory = { type = \"constant\" }\n" +
         rest;
}

}  // namespace

TEST_SUITE_BEGIN("unit/model/assembly/part_models");

TEST_CASE("a model as several: each has what acts on it, by its own numbers") {
  const Model model = build_model(parse_scene(scene_text(), "parts.toml"));
  const std::vector<assembly::PartModel> parts = assembly::part_models(model);
  REQUIRE(parts.size() == 3);
  CHECK(parts[0].dofs == std::vector<int>{1, 4});
  CHECK(parts[1].dofs == std::vector<int>{0, 3});
  CHECK(parts[2].dofs == std::vector<int>{2, 5});
  CHECK(parts[0].contacts == std::vector<std::size_t>{0});
  CHECK(parts[1].contacts == std::vector<std::size_t>{1});
  CHECK(parts[2].contacts.empty());
  const Model &b = parts[0].model, &a = parts[1].model, &free = parts[2].model;
  CHECK(Eigen::MatrixXd(a.stiffness) == Eigen::Matrix2d{{9.0, -2.0}, {-2.0, 6.0}});
  CHECK(Eigen::MatrixXd(b.mass) == Eigen::Matrix2d{{2.0, 0.0}, {0.0, 5.0}});
  CHECK(b.u0 == Eigen::Vector2d(0.1, 0.4));
  CHECK(a.v0 == Eigen::Vector2d(1.0, 1.3));
  using Terms = std::vector<std::pair<int, double>>;
  REQUIRE(b.contacts.size() == 1);
  CHECK(b.contacts[0].normal.terms == Terms{{0, 1.0}, {1, -0.5}});
  CHECK(a.contacts[0].normal.terms == Terms{{1, 1.0}});
  REQUIRE(a.loads.size() == 1);
  CHECK(a.loads[0].direction.terms == Terms{{0, 2.0}});
  CHECK(b.loads[0].direction.terms == Terms{{1, 3.0}});
  REQUIRE(free.loads.size() == 2);
  CHECK(free.loads[0].direction.terms == Terms{{1, 4.0}});
  CHECK(free.loads[1].direction.terms == Terms{{0, 5.0}});
  CHECK(a.dofs[1].displacement == model.dofs[3].displacement);
  for (const assembly::PartModel& part : parts) {
    CHECK(part.model.scales.velocity == model.scales.velocity);
    CHECK(part.model.scales.force == model.scales.force);
    CHECK(part.model.omega_max == model.omega_max);
    CHECK(part.model.units.time == model.units.time);
    for (const Column& column : part.model.columns)
      CHECK((column.velocity
                 ? part.model.dofs[static_cast<std::size_t>(column.dof)].velocity
                 : part.model.dofs[static_cast<std::size_t>(column.dof)].displacement) == column.name);
  }
  CHECK(a.columns.size() == 4);
}

TEST_CASE("what is one stays one") {
  // A damper's entry, a contact that reaches both, an output over two.
  for (const char* rest :
       {"[[contacts]]\nname = \"both\"\nlaw = \"compliant\"\nnormal = { d0 = 1.0, d1 = 1.0 "
        "}\nnormal_stiffness = 1.0\n",
        "[[output]]\nname = \"force\"\nkind = \"contact\"\nat = \"a\"\nquantity = \"N\"\n"}) {
    CAPTURE(rest);
    std::optional<Scene> read;
    try {
      read = parse_scene(scene_text(rest), "parts.toml");
    } catch (const std::exception& error) {
      FAIL(error.what());
    }
    CHECK(assembly::part_models(build_model(*read)).empty());
  }
}

TEST_SUITE_END();
