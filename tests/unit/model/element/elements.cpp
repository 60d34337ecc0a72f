// What every element answers, on lines at odd angles: sizes, rigid motions, weight, heat, spread loads, own unknowns.
#include <doctest/doctest.h>

#include <cmath>

#include "model/assembly/dofs.hpp"
#include "model/element/element_kinds.hpp"
#include "model/element/line_elements.hpp"
#include "model/outputs/structure_rows.hpp"
#include "unit/model/scenes.hpp"

using namespace signorini;
using namespace signorini::test;

namespace {

constexpr double span_x = 1.2, span_y = -0.7, line_EA = 9e3, line_EI = 400.0, line_rho = 0.4;

element::LineData line_data(bool hinged_a = false, bool hinged_b = false) {
  return {{3, 5},
          2,
          element::axis_between(span_x, span_y),
          line_EA,
          line_EI,
          line_rho,
          MassKind::consistent,
          hinged_a,
          hinged_b};
}

/// ux, uy, rz of both ends as the element has them.
element::ElementVector motion_of(const element::FiniteElement& e, const std::array<double, 6>& ends) {
  const auto unknowns = e.unknowns();
  element::ElementVector u(static_cast<Eigen::Index>(unknowns.size()));
  for (std::size_t j = 0; j < unknowns.size(); ++j)
    u[static_cast<Eigen::Index>(j)] = ends[3 * unknowns[j].local_node + unknowns[j].component];
  return u;
}

void check_contract(const element::LineElement& e) {
  const auto n = static_cast<Eigen::Index>(e.unknowns().size());
  const double length = std::hypot(span_x, span_y);
  const element::ElementMatrix k = e.stiffness(), m = e.mass(), g = e.geometric_stiffness({2.0, 3.0});
  for (const element::ElementMatrix* a : {&k, &m, &g}) {
    REQUIRE(a->rows() == n);
    REQUIRE(a->cols() == n);
    CHECK((*a - a->transpose()).norm() <= 1e-15 * a->norm());
  }
  CHECK(e.nodes() == std::vector<int>{3, 5});
  CHECK(e.member() == 2);
  CHECK(e.extent() == doctest::Approx(length).epsilon(1e-15));
  CHECK(e.density() == line_rho);
  CHECK(e.has_geometric_stiffness());

  // As one body it resists nothing, and heat does no work; its weight is rho L g, however it comes about.
  const element::ElementVector turned = motion_of(e, {0.0, 0.0, 1.0, -span_y, span_x, 1.0});
  for (const element::ElementVector& rigid : {e.translation({1.0, 0.0}), e.translation({0.0, 1.0}), turned}) {
    CHECK((k * rigid).norm() <= 1e-11 * k.norm());
    CHECK(std::abs(e.strain_work(rigid)) <= 1e-12 * line_EA);
  }
  const element::ElementVector gravity = e.translation({3.0, -5.0});
  CHECK(e.translation({1.0, 0.0}).dot(m * gravity) == doctest::Approx(3.0 * line_rho * length));
  CHECK(e.translation({0.0, 1.0}).dot(m * gravity) == doctest::Approx(-5.0 * line_rho * length));
  const element::ElementVector spread = e.load_vector({3.0 * line_rho, -5.0 * line_rho});
  CHECK((spread - m * gravity).norm() <= 1e-13 * spread.norm());
  // The turning of a spread load about a: half its length times what is across.
  CHECK(spread.dot(turned) == doctest::Approx(0.5 * length * line_rho * (3.0 * -span_y - 5.0 * span_x)));

  // Free to expand, it feels no force: k u = what the strain holds.
  const double strain = 2e-3;
  const element::ElementVector expanded =
      motion_of(e, {0.0, 0.0, 0.0, strain * span_x, strain * span_y, 0.0});
  CHECK((k * expanded - strain * e.strain_forces()).norm() <= 1e-12 * (k * expanded).norm());
  CHECK(e.strain_forces().dot(expanded) == doctest::Approx(e.strain_work(expanded)).epsilon(1e-14));
  const element::AxialForces none = e.axial_forces(expanded, strain, {0.0, 0.0}, {0.0, 0.0});
  CHECK(std::abs(none.a) <= 1e-10);
  CHECK(std::abs(none.b) <= 1e-10);
  // Held it is pressed by EA strain; along it lie a load and its weight, half of which each end bears.
  const element::AxialForces held =
      e.axial_forces(element::ElementVector::Zero(n), strain, {7.0, 0.0}, {0.0, -5.0});
  const double along = (7.0 * span_x - 5.0 * line_rho * span_y) / length;
  CHECK(held.a == doctest::Approx(-line_EA * strain + 0.5 * length * along));
  CHECK(held.b == doctest::Approx(-line_EA * strain - 0.5 * length * along));

  // Under a constant force a string of length L and slope v / L has the work N v^2 / (2 L); its cut V is N v / L.
  const element::ElementVector raised =
      motion_of(e, {0.0, 0.0, 1.0 / length, -span_y / length, span_x / length,
                    1.0 / length});  // b up by 1, turned with it
  CHECK(raised.dot(e.geometric_stiffness({6.0, 6.0}) * raised) == doctest::Approx(6.0 / length));
  CHECK(e.section_force(OutputQuantity::V, {0.3, 0.0}, {6.0, 6.0}).deflection.dot(raised) ==
        doctest::Approx(6.0 / length));
  CHECK(e.section_force(OutputQuantity::M, {0.5, 0.0}, {6.0, 6.0}).deflection.dot(raised) ==
        doctest::Approx(3.0));
  CHECK(e.section_force(OutputQuantity::V, {0.3, 0.0}, {}).deflection.isZero(0.0));
  CHECK(e.section_force(OutputQuantity::N, {0.3, 0.0}, {6.0, 6.0}).deflection.isZero(0.0));

  // N where it is stretched by e: EA e, at every place of it.
  for (const double x : {0.0, 0.3, 1.0}) {
    const element::SectionForce cut = e.section_force(OutputQuantity::N, {x, 0.0}, {});
    CHECK(cut.forces.dot(k * expanded) == doctest::Approx(line_EA * strain));
    CHECK(cut.load[0] == doctest::Approx(-x * span_x));
    CHECK(cut.load[1] == doctest::Approx(-x * span_y));
  }
}

}  // namespace

TEST_SUITE("unit/model/element/elements") {
  TEST_CASE("bars and beams answer what an element must") {
    check_contract(element::BarElement(line_data()));
    check_contract(element::BeamElement(line_data()));
    check_contract(element::BeamElement(line_data(true, true)));
  }

  TEST_CASE("a bar has translations alone, a beam has a rotation of its own where it is hinged") {
    const element::BarElement bar(line_data());
    CHECK(bar.unknowns().size() == 4);
    CHECK_FALSE(bar.has_internal_unknowns());
    for (const bool a : {false, true})
      for (const bool b : {false, true}) {
        const element::BeamElement beam(line_data(a, b));
        const auto unknowns = beam.unknowns();
        REQUIRE(unknowns.size() == 6);
        for (std::size_t j = 0; j < 6; ++j) {
          CHECK(unknowns[j].local_node == j / 3);
          CHECK(unknowns[j].component == j % 3);
          CHECK(unknowns[j].internal == ((j == 2 && a) || (j == 5 && b)));
        }
        CHECK(beam.has_internal_unknowns() == (a || b));
      }
  }

  TEST_CASE("beams are drawn bent, bars straight, and elements as their members") {
    CHECK(element::BeamElement(line_data()).lines().at(0).bends);
    CHECK_FALSE(element::BarElement(line_data()).lines().at(0).bends);
    Member m = member({"A", "B", "D"}, "s", {1, 1});
    for (const MemberType type : {MemberType::beam, MemberType::bar}) {
      m.type = type;
      CHECK(element::kind_of(type).type == type);
      const auto lines = element::lines_of(m);
      REQUIRE(lines.size() == 2);
      CHECK(lines[0].from == "A");
      CHECK(lines[0].to == "B");
      CHECK(lines[1].from == "B");
      CHECK(lines[1].to == "D");
      CHECK(lines[1].bends == (type == MemberType::beam));
      for (const auto& line : lines) CHECK_FALSE((line.hinged_from || line.hinged_to));
    }
  }

  TEST_CASE("a member is hinged at its own ends alone") {
    Member m = member({"A", "B", "D"}, "s", {1, 1});
    m.release = {"D", "B"};
    const auto lines = element::lines_of(m);
    CHECK_FALSE((lines[0].hinged_from || lines[0].hinged_to || lines[1].hinged_from));
    CHECK(lines[1].hinged_to);
    m.release = {"A"};
    CHECK(element::lines_of(m)[0].hinged_from);
    CHECK_FALSE(element::lines_of(m)[1].hinged_to);
  }

  TEST_CASE("the curve that is drawn is the element's own: its slope pulls, its integral weighs") {
    const element::BeamElement beam(line_data());
    const double length = std::hypot(span_x, span_y);
    // Of v_a, rz_a, v_b, rz_b in the scene's axes.
    const auto row = [&](const element::LineShapes& h) {
      const double s = span_y / length, c = span_x / length;
      return motion_of(beam,
                       {-s * h.a, c * h.a, length * h.rotation_a, -s * h.b, c * h.b, length * h.rotation_b});
    };
    for (const double x : {0.15, 0.5, 0.83}) {
      const double step = 1e-5;
      const element::LineShapes before = element::hermite_shapes(x - step),
                                after = element::hermite_shapes(x + step);
      const element::ElementVector slope = (row(after) - row(before)) / (2.0 * step * length);
      CHECK((beam.section_force(OutputQuantity::V, {x, 0.0}, {6.0, 6.0}).deflection - 6.0 * slope).norm() <=
            1e-8);
      // Of a cubic Simpson's rule is exact: what lies between a and x.
      const element::ElementVector inside =
          x * length / 6.0 *
          (row(element::hermite_shapes(0.0)) + 4.0 * row(element::hermite_shapes(0.5 * x)) +
           row(element::hermite_shapes(x)));
      CHECK((beam.section_force(OutputQuantity::V, {x, 0.0}, {}).acceleration + line_rho * inside).norm() <=
            1e-14);
    }
  }

  TEST_CASE("no moment bends a hinged end of the curve that is drawn, and it keeps its ends") {
    for (const bool a : {false, true})
      for (const bool b : {false, true}) {
        const auto v = [&](double s) {  // v_a, rz_a, v_b, rz_b
          const element::LineShapes h = element::hermite_shapes(s, a, b);
          return h.a * 0.3 + h.rotation_a * -0.8 + h.b * 1.1 + h.rotation_b * 0.6;
        };
        const auto curvature = [&](double s) { return (v(s - 1e-3) - 2.0 * v(s) + v(s + 1e-3)) / 1e-6; };
        CHECK(v(0.0) == doctest::Approx(0.3).epsilon(1e-14));
        CHECK(v(1.0) == doctest::Approx(1.1).epsilon(1e-14));
        CHECK((std::abs(curvature(0.0)) < 1e-8) == a);
        CHECK((std::abs(curvature(1.0)) < 1e-8) == b);
        // An end that is not hinged turns as it is told.
        if (!a) CHECK((v(1e-6) - v(-1e-6)) / 2e-6 == doctest::Approx(-0.8).epsilon(1e-8));
        if (!b) CHECK((v(1.0 + 1e-6) - v(1.0 - 1e-6)) / 2e-6 == doctest::Approx(0.6).epsilon(1e-8));
        if (a && b) CHECK(v(0.25) == doctest::Approx(0.5).epsilon(1e-14));
      }
  }

  TEST_CASE("own unknowns have numbers of their own, behind those of the nodes") {
    Scene s = empty_scene();
    s.sections = {{"s", line_EA, line_EI, line_rho}};
    s.nodes = {{"A", 0.0, 0.0, {}}, {"B", span_x, span_y, {}}, {"D", 3.0, 1.0, {}}};
    Member first = member({"A", "B"}, "s", {2}), second = member({"B", "D"}, "s", {1});
    second.release = {"B", "D"};
    s.members = {first, second};
    const assembly::DofMap map = assembly::number_nodes(s);
    // A, B, the inner node with rotations; D, which nothing turns, without; two ends of their own.
    REQUIRE(map.size() == 3 + 3 + 2 + 3 + 2);
    CHECK(map.dofs[11].displacement == "B-D.B.rz");
    CHECK(map.dofs[12].displacement == "B-D.D.rz");
    CHECK(map.dofs[12].rotation);
    CHECK(map.element_numbers(2) == std::vector<int>{3, 4, 11, 6, 7, 12});
    CHECK(map.element_numbers(0) == std::vector<int>{0, 1, 2, 8, 9, 10});
    CHECK(map.element_numbers(1) == std::vector<int>{8, 9, 10, 3, 4, 5});
    CHECK_FALSE(map.within_body(map.mesh.element(2)));
    // Nothing of its moment reaches the node: what would hold B from turning has A-B alone to hold, 4 EI/L of half of it.
    outputs::PhysicalRow row(map.size());
    outputs::StructureRows(s, map, 0.0, 0.0).add_reaction(row, 1, 2, 1.0);
    CHECK(row.u[5] == doctest::Approx(4.0 * line_EI / (0.5 * std::hypot(span_x, span_y))));
    for (const int i : {6, 7, 11, 12}) CHECK(row.u[i] == 0.0);
  }
}
