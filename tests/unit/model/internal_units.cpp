#include "model/internal_units.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace signorini;

namespace {

constexpr Factors odd{0x1.0p7, 0x1.0p-3, 0x1.0p5};

bool same(const SparseMatrix& a, const SparseMatrix& b) {
  return a.rows() == b.rows() && Eigen::MatrixXd(a) == Eigen::MatrixXd(b);
}

bool same(const Combination& a, const Combination& b) { return a.terms == b.terms; }

bool same(const History& a, const History& b) {
  if (a.starts() != b.starts() || a.pieces().size() != b.pieces().size()) return false;
  for (std::size_t i = 0; i < a.pieces().size(); ++i) {
    const Piece &p = a.pieces()[i], &q = b.pieces()[i];
    if (p.origin != q.origin || p.coefficients != q.coefficients || p.amplitude != q.amplitude ||
        p.omega != q.omega || p.phase != q.phase)
      return false;
  }
  return true;
}

void check_same(const Contact& a, const Contact& b) {
  CHECK(same(a.normal, b.normal));
  CHECK(same(a.tangent, b.tangent));
  CHECK(a.gap == b.gap);
  CHECK(a.normal_stiffness == b.normal_stiffness);
  CHECK(a.tangential_stiffness == b.tangential_stiffness);
  CHECK(a.shear.has_value() == b.shear.has_value());
  if (a.shear && b.shear) {
    CHECK(same(a.shear->body, b.shear->body));
    CHECK(a.shear->stiffness == b.shear->stiffness);
    CHECK(a.shear->damping == b.shear->damping);
  }
  CHECK(a.normal_damping == b.normal_damping);
  CHECK(a.friction.stribeck_velocity == b.friction.stribeck_velocity);
  CHECK(a.capture_velocity == b.capture_velocity);
  CHECK(same(a.normal_force, b.normal_force));
  CHECK(same(a.surface_motion, b.surface_motion));
  CHECK(a.initial_shear == b.initial_shear);
}

/// Loads as forces on degrees of freedom: weight stands in the direction of gravity, not in its history.
Vector load_at(const Model& model, double t) {
  Vector p = Vector::Zero(model.size());
  for (const Load& load : model.loads) load.direction.add_to(p, load.history.value(t));
  return p;
}

void check_same(const Model& a, const Model& b, double t_end) {
  CHECK(same(a.mass, b.mass));
  CHECK(same(a.damping, b.damping));
  CHECK(same(a.stiffness, b.stiffness));
  for (int i = 0; i <= 10; ++i) CHECK(load_at(a, 0.1 * i * t_end) == load_at(b, 0.1 * i * t_end));
  REQUIRE(a.contacts.size() == b.contacts.size());
  for (std::size_t k = 0; k < a.contacts.size(); ++k) check_same(a.contacts[k], b.contacts[k]);
  CHECK(a.u0 == b.u0);
  CHECK(a.v0 == b.v0);
  CHECK(a.statics.reactions == b.statics.reactions);
  CHECK(a.scales.displacement == b.scales.displacement);
  CHECK(a.scales.rotation == b.scales.rotation);
  CHECK(a.scales.velocity == b.scales.velocity);
  CHECK(a.scales.angular_velocity == b.scales.angular_velocity);
  CHECK(a.scales.force == b.scales.force);
  CHECK(a.alpha == b.alpha);
  CHECK(a.beta == b.beta);
  CHECK(a.omega1 == b.omega1);
  CHECK(a.omega_max == b.omega_max);
  CHECK(a.reduction.has_value() == b.reduction.has_value());
  if (a.reduction && b.reduction) {
    CHECK(a.reduction->shapes == b.reduction->shapes);
    CHECK(a.reduction->cutoff == b.reduction->cutoff);
    CHECK(a.reduction->ringing == b.reduction->ringing);
  }
}

const std::string good = SIGNORINI_TEST_DATA "/scenes/good/";

}  // namespace

TEST_SUITE("unit/model/internal_units") {
  TEST_CASE("a rescaled scene is a rescaled model: no quantity is forgotten") {
    for (const char* name : {"frame", "histories", "order", "reduced", "rest", "touching"}) {
      CAPTURE(name);
      const Scene scene = read_scene(good + name + ".toml");
      const Model there = build_model(scene::rescaled(scene, odd));
      check_same(model::rescaled(build_model(scene), odd), there, scene.run.t_end * odd.time);
    }
    const Scene scene = read_scene(good + "matrices.toml");
    const Factors factors{odd.force, 1.0, odd.time};
    check_same(model::rescaled(build_model(scene), factors), build_model(scene::rescaled(scene, factors)),
               scene.run.t_end * odd.time);
  }

  TEST_CASE("what a pendulum's surface adds to an output has the unit of the output") {
    Model model = build_model(read_scene(good + "frame.toml"));
    Output output;
    output.restoring.push_back({0, {{{0, 2.0}}}, 3.0, 5.0});  // 3 (|N| - 5) 2 u_0
    for (const Unit& of : {Unit{1, 0, 0}, Unit{1, 1, 0}, Unit{2, 1, 3}}) {
      output.unit = of;
      model.outputs = {output};
      const Output there = model::rescaled(model, odd).outputs.front();
      REQUIRE(there.restoring.size() == 1);
      const Output::Restoring& r = there.restoring.front();
      CHECK(r.scene_force == 5.0 * odd.force);
      // of N = 7 and u_0 = 11
      const double value =
          r.factor * (7.0 * odd.force - r.scene_force) * r.slip.terms.front().second * 11.0 * odd.length;
      CHECK(value == 3.0 * (7.0 - 5.0) * 2.0 * 11.0 * std::pow(odd.force, of.force) *
                         std::pow(odd.length, of.length) * std::pow(odd.time, of.time));
    }
  }

  TEST_CASE("there and back") {
    const Scene scene = read_scene(good + "frame.toml");
    const Model model = build_model(scene);
    const Model back = model::rescaled(model::rescaled(model, odd), scene::inverse(odd));
    check_same(model, back, scene.run.t_end);
    CHECK(back.unit.force == 1.0);
    CHECK(back.unit.length == 1.0);
    CHECK(back.unit.time == 1.0);
    CHECK(model::rescaled(model, odd).unit.time == 1.0 / odd.time);
  }

  TEST_CASE("machine units follow the scene's by powers of two") {
    for (const char* name : {"frame", "histories", "rest"}) {
      CAPTURE(name);
      const Scene scene = read_scene(good + name + ".toml");
      const Factors here = model::find_internal_units(scene),
                    there = model::find_internal_units(scene::rescaled(scene, odd));
      CHECK(there.force == here.force * odd.force);
      CHECK(there.length == here.length * odd.length);
      CHECK(there.time == here.time * odd.time);
      int exponent = 0;
      for (const double x : {here.force, here.length, here.time}) CHECK(std::frexp(x, &exponent) == 0.5);
    }
    const Scene matrices = read_scene(good + "matrices.toml");
    CHECK(model::find_internal_units(matrices).length == 1.0);
  }

  TEST_CASE("units beyond the range of squares are the scene's") {
    Scene scene = read_scene(good + "minimal.toml");
    for (PointMass& m : scene.masses) m.mass = 1e-300;
    const Factors units = model::find_internal_units(scene);
    for (const double x : {units.force, units.length, units.time}) CHECK(x == 1.0);
  }

  TEST_CASE(
      "loads keep their magnitudes where they had them: gravity in the direction, others in the history") {
    const Scene scene = read_scene(good + "frame.toml");
    const Model model = build_model(scene);
    for (const Load& load : model.loads)
      if (load.name == "gravity") CHECK(load.history.value(0.0) == 1.0);
  }
}
