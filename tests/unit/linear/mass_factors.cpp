#include "linear/mass_factors.hpp"
#include "base/eigen_dense.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>

#include "linear/system_matrix.hpp"
#include "motion/state_systems.hpp"
#include "unit/linear/rubbing_row.hpp"

using namespace signorini;

TEST_SUITE_BEGIN("unit/linear/mass_factors");

TEST_CASE("one factorisation of M solves the system of every state, as the dense matrix does") {
  for (const int masses : {1, 13, 40}) {
    const Model model = rubbing_row(masses);
    const linear::SystemMatrices structure(model);
    const auto mass = linear::mass_factors(structure);
    REQUIRE(mass);
    const Eigen::Index n = model.size(), size = n + 2 * static_cast<Eigen::Index>(model.contacts.size());
    for (const int number : {0, 1, 2, 3, 27, 1000}) {
      CAPTURE(masses);
      CAPTURE(number);
      const std::vector<Rows> rows = linear::rows_of(model, rubbing_mode(model, number));
      Eigen::MatrixXd a = Eigen::MatrixXd::Zero(size, size);
      a.topLeftCorner(n, n) = model.mass;
      for (std::size_t k = 0; k < rows.size(); ++k) {
        const Eigen::Index N = n + 2 * static_cast<Eigen::Index>(k), T = N + 1;
        for (const auto& [dof, factor] : model.contacts[k].normal.terms) a(dof, N) += factor;
        for (const auto& [dof, factor] : model.contacts[k].tangent.terms) a(dof, T) += factor;
        a(N, N) = rows[k].normal.N;
        a(N, T) = rows[k].normal.T;
        a(T, N) = rows[k].tangent.N;
        a(T, T) = rows[k].tangent.T;
      }
      const std::vector<linear::ContactForceBlock> forces = linear::contact_force_blocks(rows);
      REQUIRE(forces.size() == rows.size());
      const Vector b = Vector::LinSpaced(size, -1.0, 2.3);
      Vector x = b, work(size);
      linear::MassSolver(model, mass, forces).solve(x.data(), work.data());
      const Vector expected = base::solve_dense(a, b);
      CHECK((x - expected).cwiseAbs().maxCoeff() < 1e-12 * expected.cwiseAbs().maxCoeff());
    }
  }
}

TEST_CASE("rows that hold an acceleration do not tell their forces") {
  Model model = rubbing_row(3);
  contact::ContactStates states = rubbing_mode(model, 0);
  CHECK(linear::contact_force_blocks(linear::rows_of(model, states)).size() == 3);
  model.contacts[1].law = Law::rigid;
  model.contacts[1].tangential_stiffness.reset();
  states[1].state = State::stick;
  CHECK(linear::contact_force_blocks(linear::rows_of(model, states)).empty());
  states[1].state = State::open;
  CHECK(linear::contact_force_blocks(linear::rows_of(model, states)).size() == 3);
}

TEST_CASE("a mass that is singular has no factors") {
  Model model = rubbing_row(2);
  model.mass.setZero();
  model.mass.insert(0, 0) = 1.0;
  CHECK_FALSE(linear::mass_factors(linear::SystemMatrices(model)));
}

TEST_SUITE_END();
