#include "engine/newmark/local_step.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "engine/newmark/newmark_step.hpp"
#include "unit/motion/lively_row.hpp"

using namespace signorini;

namespace {

struct Ends {
  const Model& model;
  linear::SystemMatrices structure{model};
  motion::Forcing forcing{model, 0.0, motion::Side::after};
  motion::Point from;
  explicit Ends(const Model& m) : model(m) {
    const Eigen::Index n = m.size();
    from = {m.u0, m.v0, Vector::Zero(2 * static_cast<Eigen::Index>(m.contacts.size())),
            Vector::LinSpaced(n, -1.0, 1.0)};
  }
};

}  // namespace

TEST_SUITE_BEGIN("unit/engine/newmark/local_step");

TEST_CASE("at every contact, turned as it may be, the end of a step is that of the whole step") {
  const Model m = lively_row(313);
  for (const int number : {0, 11, 500}) {
    const std::vector<Rows> rows = linear::rows_of(m, rubbing_mode(m, number));
    Ends at(m);
    newmark::NewmarkStep step(m, at.structure);
    step.set({number}, rows);
    const double longer = 0.05;
    motion::Point whole, end;
    REQUIRE(step.take(at.forcing, at.from, longer, longer, true, whole));
    for (const double part : {1e-9, 0.02, 0.4, 0.97}) {
      const double h = part * longer;
      REQUIRE(step.take(at.forcing, at.from, h, h, false, end));
      const double force = end.forces.cwiseAbs().maxCoeff();
      for (std::size_t k = 0; k < m.contacts.size(); k += 7) {
        CAPTURE(number);
        CAPTURE(h);
        CAPTURE(k);
        const motion::Point* near = step.local_end(k, at.forcing, at.from, h, h, whole, longer);
        REQUIRE(near != nullptr);
        const ContactMotion a = motion::motion_of(m.contacts[k], k, at.forcing, h, *near),
                            b = motion::motion_of(m.contacts[k], k, at.forcing, h, end);
        CHECK(std::abs(a.gap - b.gap) < 1e-15);
        CHECK(std::abs(a.ut - b.ut) < 1e-15);
        CHECK(std::abs(a.vn - b.vn) < 1e-14);
        CHECK(std::abs(a.vt - b.vt) < 1e-14);
        CHECK(std::abs(a.an - b.an) < 1e-12 * end.a.cwiseAbs().maxCoeff());
        CHECK(std::abs(a.at - b.at) < 1e-12 * end.a.cwiseAbs().maxCoeff());
        CHECK(std::abs(a.N - b.N) < 1e-13 * force);
        CHECK(std::abs(a.T - b.T) < 1e-13 * force);
      }
    }
  }
}

TEST_CASE(
    "where K rules, and A^-1 hardly decays, more is seen the farther one looks; of a small structure "
    "nothing") {
  Model m = lively_row(1501);
  for (int i = 0; i < m.size(); ++i) m.stiffness.coeffRef(i, i) = 18.0001;  // next to a rope without a bed
  m.stiffness *= 1e4;
  for (Contact& contact : m.contacts) contact.normal_stiffness = contact.normal_damping = 1e-3;
  for (Contact& contact : m.contacts) contact.tangential_stiffness = 1e-3;
  const std::vector<Rows> rows = linear::rows_of(m, rubbing_mode(m, 0));
  Ends at(m);
  newmark::NewmarkStep step(m, at.structure);
  step.set({0}, rows);
  const double longer = 1.0, h = 0.5;
  motion::Point whole, end;
  REQUIRE(step.take(at.forcing, at.from, longer, longer, true, whole));
  REQUIRE(step.take(at.forcing, at.from, h, h, false, end));
  const std::size_t k = 750;
  const auto off = [&]() -> double {
    const motion::Point* near = step.local_end(k, at.forcing, at.from, h, h, whole, longer);
    if (near == nullptr) return -1.0;
    const auto dof = m.contacts[k].normal.terms[0].first;
    return std::abs(near->a[dof] - end.a[dof]) / end.a.cwiseAbs().maxCoeff();
  };
  double before = off();
  CHECK(before > 1e-9);
  int times = 0;
  for (; times < 10; ++times) {
    step.double_radius();
    const double now = off();
    if (now < 0.0) break;
    CHECK(now < before);
    before = now;
  }
  CHECK(times >= 2);
  CHECK(times < 10);  // then it would be no small part
}

TEST_SUITE_END();
