// law_check/law_checker.hpp: laws of a stretch by its ends, and of the structure just after an instant. Numbers by hand.
#include <doctest/doctest.h>

#include "contact/contact_states.hpp"
#include "law_check/law_checker.hpp"

using namespace signorini;

TEST_SUITE_BEGIN("unit/law_check/stretch");

namespace {

/// A block of 2 kg on a spring of 50 N/m and a dashpot of 3 N s/m, which a slider rubs.
Model rubbed_block(std::optional<double> tangential_stiffness) {
  Model model;
  model.dofs.resize(1);
  const auto one = [](SparseMatrix& matrix, double value) {
    matrix.resize(1, 1);
    matrix.insert(0, 0) = value;
  };
  one(model.mass, 2.0);
  one(model.damping, 3.0);
  one(model.stiffness, 50.0);
  model.scales.displacement = 1.0;
  Contact c;
  c.name = "slider";
  c.law = Law::slider;
  c.tangent.terms = {{0, 1.0}};
  c.friction.static_ = c.friction.kinetic = 0.5;
  c.tangential_stiffness = tangential_stiffness;
  model.contacts.push_back(c);
  model.layout = contact::layout_of(model.contacts);
  return model;
}

struct End {
  Vector u = Vector::Zero(1), v = Vector::Zero(1), a = Vector::Zero(1), forces = Vector::Zero(2);
  std::vector<ContactState> mode;

  End(double ut, double T, ContactState state) : mode{state} {
    u[0] = ut;
    forces << -8.0, T;
  }
  [[nodiscard]] law_check::CheckedSide side() const {
    return {&u, &v, &a, &mode, &forces, ForceLayout(1), {law_check::Driven{}}};
  }
};

std::string law_of(const Model& model, const End& from, const End& to,
                   const law_check::LawLimits& limits = {}) {
  const std::vector<Violation> found =
      law_check::LawChecker(model, limits).check_stretch(1.0, from.side(), to.side());
  return found.empty() ? "" : found[0].law;
}

}  // namespace

TEST_CASE("stretch: states and sliding points at its ends are one") {
  const Model model = rubbed_block(100.0);
  const ContactState stick{State::stick, 0.25};
  CHECK(law_of(model, {0.26, 1.0, stick}, {0.27, 2.0, stick}) == "");
  CHECK(law_of(model, {0.26, 1.0, stick}, {0.27, 4.0, {State::slip_plus, 0.25}}) == "unbroken state");
  CHECK(law_of(model, {0.26, 1.0, stick}, {0.27, 2.0, {State::stick, 0.25 + 1e-15}}) == "unbroken state");
}

TEST_CASE("stretch: what slides goes its way, its spring apart") {
  const ContactState plus{State::slip_plus, 0.0}, minus{State::slip_minus, 0.0};
  for (const auto& kt : {std::optional<double>(), std::optional<double>(100.0)}) {
    const Model model = rubbed_block(kt);
    CHECK(law_of(model, {0.1, 4.0, plus}, {0.2, 4.0, plus}) == "");
    CHECK(law_of(model, {0.1, 4.0, plus}, {0.1 - 1e-9, 4.0, plus}) == "way of slip");
    CHECK(law_of(model, {0.2, -4.0, minus}, {0.1, -4.0, minus}) == "");
    CHECK(law_of(model, {0.2, -4.0, minus}, {0.2 + 1e-9, -4.0, minus}) == "way of slip");
  }
  // The spring of 100 N/m is let out by 0.02 m: the block goes back by 0.01, the sliding point on by 0.01.
  CHECK(law_of(rubbed_block(100.0), {0.1, 4.0, plus}, {0.09, 2.0, plus}) == "");
  CHECK(law_of(rubbed_block(100.0), {0.1, 4.0, plus}, {0.079, 2.0, plus}) == "way of slip");
}

TEST_CASE("stretch: what sticks rigidly stays where nothing lets it drift") {
  const Model model = rubbed_block({});
  const ContactState stick{State::stick, 0.1};
  CHECK(law_of(model, {0.1, 4.0, stick}, {0.1, 3.0, stick}) == "");
  CHECK(law_of(model, {0.1, 4.0, stick}, {0.1 + 1e-9, 3.0, stick}) == "unbroken rest");
  law_check::LawLimits tolerance;
  tolerance.rtol = 1e-6;
  CHECK(law_of(model, {0.1, 4.0, stick}, {0.1 + 1e-9, 3.0, stick}, tolerance) == "");
}

TEST_CASE("equilibrium: M a + C v + K u + T = P") {
  const Model model = rubbed_block({});
  End end(0.2, 4.0, {State::slip_plus, 0.0});
  end.v[0] = 2.0;
  end.a[0] = -5.0;
  const Vector load = Vector::Constant(1, 2.0 * -5.0 + 3.0 * 2.0 + 50.0 * 0.2 + 4.0);
  const law_check::LawChecker witness(model, {});
  CHECK(witness.check_equilibrium(1.0, end.side(), load).empty());
  for (double* part : {&end.a[0], &end.v[0], &end.u[0], &end.forces[1]}) {
    const double kept = *part;
    *part *= 1.0 + 1e-9;
    const std::vector<Violation> found = witness.check_equilibrium(1.0, end.side(), load);
    REQUIRE(found.size() == 1);
    CHECK(found[0].law == std::string("equilibrium"));
    *part = kept;
  }
  CHECK(witness.check_equilibrium(1.0, end.side(), 1.000001 * load).size() == 1);
}

TEST_SUITE_END();
