#include "sensitivity/model_derivative.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "model/internal_units.hpp"
#include "sensitivity/parameter.hpp"
#include "signorini/error.hpp"

using namespace signorini;

namespace {

/// A beam from the ground, a mass at its tip over a contact.
SceneReader beam_reader(const std::string& more = "") {
  const std::string text =
      "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\ngravity = [0.0, "
      "-10.0]\n"
      "[run]\nt_end = 1.0\ninitial = \"static\"\n" +
      more +
      "[sections.pipe]\nEA = 3e5\nEI = 2e3\nmass_per_length = 2.0\n[nodes]\nA = [0.0, 0.0]\nB = [2.0, 0.0]\n"
      "[[members]]\nnodes = [\"A\", \"B\"]\nsection = \"pipe\"\nelements = [2]\n"
      "[[supports]]\nnode = \"A\"\nfix = [\"ux\", \"uy\", \"rz\"]\n"
      "[[contacts]]\nname = \"c\"\nnode = \"B\"\nnormal = [0.0, 1.0]\nlaw = \"compliant\"\nnormal_stiffness "
      "= 1e4\n"
      "tangential_stiffness = 1e4\nfriction = 0.3\n";
  return [text](const std::vector<Override>& changes) { return parse_scene(text, "beam.toml", changes); };
}

/// In the units of the machine, those of the scene without changes.
Model computed(const SceneReader& read, const std::vector<Override>& changes = {}) {
  return model::rescaled(build_model(read(changes)), scene::inverse(build_model(read({})).internal_units));
}

sensitivity::ModelDerivative of(const SceneReader& read, const std::string& path) {
  const Scene scene = read({});
  const double value = sensitivity::value_of(scene, path);
  return sensitivity::derivative(read, computed(read), path, value, value != 0.0 ? std::abs(value) : 1.0);
}

}  // namespace

TEST_SUITE_BEGIN("unit/sensitivity/model_derivative");

TEST_CASE("K by EI is K of a beam of EI one; M does not move") {
  const SceneReader read = beam_reader();
  const sensitivity::ModelDerivative d = of(read, "sections.pipe.EI");
  const SparseMatrix more = computed(read, {{"sections.pipe.EI", "3e3"}}).stiffness;
  const SparseMatrix less = computed(read, {{"sections.pipe.EI", "1e3"}}).stiffness;
  const SparseMatrix expected = (more - less) / 2e3;  // linear in EI
  CHECK(SparseMatrix(d.stiffness - expected).norm() <= 1e-12 * expected.norm());
  CHECK(d.mass.nonZeros() == 0);
  CHECK_FALSE(d.one_sided);
}

TEST_CASE("what goes as 1/p^3, and an equilibrium, against differences of a hundredth of the step") {
  const SceneReader read = beam_reader();
  const sensitivity::ModelDerivative d = of(read, "nodes.B.1");
  const auto model = [&](double x) { return computed(read, {sensitivity::set_to("nodes.B.1", x)}); };
  const double h = 1e-4;
  const Model a = model(2.0 - h), b = model(2.0 + h);
  const SparseMatrix expected = (b.stiffness - a.stiffness) / (2.0 * h);
  CHECK(SparseMatrix(d.stiffness - expected).norm() <= 1e-7 * expected.norm());
  const Vector start = (b.u0 - a.u0) / (2.0 * h);
  CHECK((d.u0 - start).norm() <= 1e-6 * start.norm());
  CHECK(start.norm() > 0.0);
}

TEST_CASE("a start whose feet share a free motion, against differences") {
  // Two bars from the ridge C to feet that the weight spreads against a spring, and a slider that is pressed, too.
  const std::string text =
      "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\ngravity = [0.0, "
      "-10.0]\n[run]\nt_end = 1.0\ninitial = \"static\"\n[sections.bar]\nEA = 1e4\nmass_per_length = 0.3\n"
      "[nodes]\nA = [0.0, 0.0]\nB = [2.0, 0.1]\nC = [0.5, 1.0]\n[[masses]]\nnode = \"C\"\nmass = 8.0\n"
      "[[masses]]\nnode = \"A\"\nmass = 4.0\n[[members]]\nnodes = [\"A\", \"C\"]\nsection = \"bar\"\ntype "
      "= \"bar\"\n[[members]]\nnodes = [\"B\", \"C\"]\nsection = \"bar\"\ntype = \"bar\"\n[[springs]]\nnode "
      "= "
      "\"B\"\nagainst = \"A\"\ndirection = [1.0, 0.0]\nstiffness = 5e3\n[[contacts]]\nname = \"A\"\nnode = "
      "\"A\"\nlaw = \"compliant\"\nnormal = [0.0, 1.0]\nnormal_stiffness = 4e4\nfriction = "
      "0.5\ntangential_stiffness = 1e4\n[[contacts]]\nname = \"B\"\nnode = \"B\"\nlaw = \"rigid\"\nnormal = "
      "[0.0, 1.0]\nfriction = 0.2\n[[contacts]]\nname = \"pad\"\nnode = \"C\"\nlaw = \"slider\"\ntangent = "
      "[0.8, 0.6]\nnormal_force = 30.0\nfriction = 0.2\ntangential_stiffness = 1e3\n";
  const SceneReader read = [text](const std::vector<Override>& changes) {
    return parse_scene(text, "spread.toml", changes);
  };
  for (const char* path :
       {"springs.1.stiffness", "masses.2.mass", "sections.bar.EA", "contacts.A.normal_stiffness",
        "contacts.pad.normal_force", "nodes.C.1", "nodes.C.2", "nodes.B.1"}) {
    CAPTURE(path);
    const sensitivity::ModelDerivative d = of(read, path);
    const double value = sensitivity::value_of(read({}), path), h = 1e-4 * value;
    const Model a = computed(read, {sensitivity::set_to(path, value - h)}),
                b = computed(read, {sensitivity::set_to(path, value + h)});
    const Vector start = (b.u0 - a.u0) / (2.0 * h);
    CHECK((d.u0 - start).norm() <= 1e-6 * start.norm());
    CHECK(start.norm() > 0.0);
  }
}

TEST_CASE("rows and guards of a contact by its friction") {
  const sensitivity::ModelDerivative d = of(beam_reader(), "contacts.c.friction");
  const sensitivity::ContactRates& c = d.contacts[0];
  CHECK(c.rows[sensitivity::index_of(State::slip_plus)].tangent.N == doctest::Approx(1.0));
  CHECK(c.rows[sensitivity::index_of(State::slip_minus)].tangent.N == doctest::Approx(-1.0));
  CHECK(c.guards[sensitivity::index_of(State::stick)][1].N == doctest::Approx(-1.0));
  CHECK(c.guards[sensitivity::index_of(State::slip_plus)][1].vn == doctest::Approx(1.0));  // s kn/kt
  CHECK(c.rows[sensitivity::index_of(State::stick)].tangent.ut == 0.0);
  CHECK(d.stiffness.nonZeros() + d.mass.nonZeros() + d.damping.nonZeros() == 0);
  CHECK(d.u0.norm() == 0.0);
}

TEST_CASE("at the edge of what a key may be the differences go to one side") {
  const std::string text =
      "schema = 1\nunits = { force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }\n[run]\nt_end = "
      "1.0\n"
      "initial = { u = [1.0], v = [0.0] }\n[matrices]\nmass = [[1.0]]\nstiffness = "
      "[[0.0]]\n[[contacts]]\nname = \"c\"\n"
      "law = \"rigid\"\nnormal = { d0 = 1.0 }\nrestitution = 1.0\n[[loads]]\ndirection = { d0 = 1.0 "
      "}\namplitude = -1.0\n";
  const SceneReader ball = [text](const std::vector<Override>& changes) {
    return parse_scene(text, "ball.toml", changes);
  };
  const sensitivity::ModelDerivative d = of(ball, "contacts.c.restitution");
  CHECK(d.one_sided);
  CHECK(d.contacts[0].restitution == doctest::Approx(1.0));
  CHECK_THROWS_AS(of(ball, "contacts.c.friction"), UsageError);  // without friction there is another law
}

TEST_CASE("shapes of a reduced model that move with the key are refused, friction is not") {
  const SceneReader reduced = beam_reader("[reduction]\ncutoff_frequency = 20.0\n");
  CHECK_THROWS_AS(of(reduced, "sections.pipe.EI"), UsageError);
  CHECK(of(reduced, "contacts.c.friction")
            .contacts[0]
            .rows[sensitivity::index_of(State::slip_plus)]
            .tangent.N == doctest::Approx(1.0));
}
