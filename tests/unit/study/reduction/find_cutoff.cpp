// What the modes left out would have added: a mode under a force, in closed form.
#include "study/reduction/find_cutoff.hpp"
#include "contact/contact_states.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace signorini;

namespace {

/// Two masses of 1, apart from each other: springs 1 and 10^4, the second with a damper of 8.
Model two_masses() {
  Model model;
  model.dofs = {{"a.u", "a.v", false, false}, {"b.u", "b.v", false, false}};
  const auto diagonal = [](double a, double b) {
    Eigen::MatrixXd m = Eigen::MatrixXd::Zero(2, 2);
    m.diagonal() << a, b;
    return SparseMatrix(m.sparseView());
  };
  model.mass = diagonal(1.0, 1.0);
  model.stiffness = diagonal(1.0, 1e4);
  model.damping = diagonal(0.0, 8.0);
  model.u0 = model.v0 = Vector::Zero(2);
  model.columns = {{"a.u", 0, false}, {"b.u", 1, false}, {"b.v", 1, true}};
  Contact contact;
  contact.name = "stop";
  contact.normal.terms = {{1, 1.0}};
  model.contacts.push_back(contact);
  model.layout = contact::layout_of(model.contacts);
  return model;
}

const Eigen::VectorXd squares = (Eigen::VectorXd(2) << 1.0, 1e4).finished();

}  // namespace

TEST_SUITE_BEGIN("unit/study/reduction/find_cutoff");

TEST_CASE("places: contacts along their normals, named displacements") {
  const std::vector<reduction::RequestedPlace> places = reduction::requested_places(two_masses());
  REQUIRE(places.size() == 3);
  CHECK(places[0].name == "normal of contact 'stop'");
  CHECK(places[2].name == "b.u");
  CHECK(places[2].form == Eigen::Vector2d(0.0, 1.0));
}

TEST_CASE("a contact force N = -3 (1 - cos 20 t): z'' + 8 z' + 10^4 z = -N, less what is static") {
  const Model model = two_masses();
  const double step = 2e-3, w = 20.0;
  reduction::TruncationError left_out(model, squares, Eigen::MatrixXd::Identity(2, 2), 1, step);
  for (int i = 0; i <= 1000; ++i) left_out.sample(i * step, {-3.0 * (1.0 - std::cos(w * i * step)), 0.0});
  left_out.finish();
  // What is missed starts with -F''(0)/omega^4 and dies out, e^(-4 t), to |F/(k - w^2 + 8 i w) - F/k|, F = 3.
  const std::complex<double> answer = 3.0 / std::complex<double>(1e4 - w * w, 8.0 * w);
  const double settled = std::abs(answer - 3.0 / 1e4);
  CHECK(left_out.missed()[1] == 0.0);  // the mode that is kept
  CHECK(left_out.missed()[0] > 1.5 * settled);
  CHECK(left_out.missed()[0] < 2.1 * settled);
  CHECK(left_out.missed()[2] == left_out.missed()[0]);
}

TEST_CASE("a load that jumps rings with its whole static answer") {
  Model model = two_masses();
  Load load;
  load.direction.terms = {{1, 2.0}};
  load.history = History({1e-3}, {Piece{}, Piece{0.0, {50.0}}});
  model.loads.push_back(load);
  reduction::TruncationError left_out(model, squares, Eigen::MatrixXd::Identity(2, 2), 1, 1e-4);
  for (int i = 0; i <= 2000; ++i) left_out.sample(i * 1e-4, {0.0, 0.0});
  left_out.finish();
  // 2 * 50 / 10^4 before the damper takes a part of the first swing
  CHECK(left_out.missed()[2] == doctest::Approx(0.01).epsilon(1e-2));
}

TEST_CASE("all modes kept: nothing is missed") {
  const Model model = two_masses();
  reduction::TruncationError left_out(model, squares, Eigen::MatrixXd::Identity(2, 2), 2, 1e-3);
  for (int i = 0; i < 10; ++i) left_out.sample(i * 1e-3, {-1.0 * i, 0.0});
  left_out.finish();
  for (const double missed : left_out.missed()) CHECK(missed == 0.0);
}

TEST_SUITE_END();
