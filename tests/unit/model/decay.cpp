#include "contact/contact_states.hpp"
#include "model/slip_growth.hpp"

#include <doctest/doctest.h>

#include <Eigen/SparseCore>

using namespace signorini;

namespace {

Vector vector(std::initializer_list<double> values) {
  Vector v(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), v.begin());
  return v;
}

SparseMatrix diagonal(std::initializer_list<double> values) {
  return SparseMatrix(vector(values).asDiagonal().toDenseMatrix().sparseView());
}

}  // namespace

TEST_SUITE_BEGIN("unit/model/decay");

TEST_CASE("what has no mass decays by its spring, what has none of both not at all") {
  CHECK(model::diagonal_decay(vector({2.0}), vector({6.0}), vector({1e9})) == 3.0);
  CHECK(model::diagonal_decay(vector({0.0}), vector({2.0}), vector({8.0})) == 4.0);
  CHECK(model::diagonal_decay(vector({0.0}), vector({0.0}), vector({8.0})) == 0.0);
  CHECK(model::diagonal_decay(vector({2.0, 0.0, 1.0}), vector({6.0, 2.0, 3.5}), vector({1.0, 8.0, 1.0})) ==
        4.0);
}

TEST_CASE("dashpots of contacts damp, springs of contacts hurry what has no mass") {
  Model model;
  model.mass = diagonal({2.0, 0.0});
  model.damping = diagonal({1.0, 0.5});
  model.stiffness = diagonal({10.0, 1.0});
  CHECK(model::fastest_decay(model) == 2.0);
  Contact c;
  c.normal.terms = {{0, 2.0}};
  c.tangent.terms = {{1, 0.5}};
  c.normal_damping = 3.0;
  c.normal_stiffness = 100.0;
  c.tangential_stiffness = 16.0;
  model.contacts = {c};
  model.layout = contact::layout_of(model.contacts);
  CHECK(model::fastest_decay(model) == 10.0);  // (1 + 4) / 0.5
  model.contacts[0].tangential_stiffness.reset();
  CHECK(model::fastest_decay(model) == 6.5);  // (1 + 12) / 2
  model.alpha = 1.0;
  model.beta = 0.1;
  model.omega_max = 10.0;
  CHECK(model::fastest_decay(model) == 11.0);
}

TEST_CASE("the least damping ratio is that of the highest frequency where both parts fall towards it") {
  Model model;
  model.omega_max = 10.0;
  model.alpha = 4.0;
  model.beta = 0.01;
  CHECK(model::min_damping_ratio(model) == doctest::Approx(0.25));  // (0.4 + 0.1) / 2
}

TEST_SUITE_END();
