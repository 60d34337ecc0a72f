#include "linear/condensed_matrix.hpp"
#include "base/eigen_dense.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <algorithm>
#include <set>
#include <utility>

#include "unit/linear/rubbing_row.hpp"

using namespace signorini;

namespace {

/// S, H, R and B as linear/condensed_matrix.hpp names them.
Eigen::MatrixXd dense(const Model& model, const std::vector<Rows>& rows, const linear::Weights& w) {
  const Eigen::Index n = model.size(), size = n + 2 * static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(size, size);
  a.topLeftCorner(n, n) =
      w.acceleration * model.mass + w.velocity * model.damping + w.displacement * model.stiffness;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Eigen::Index N = n + 2 * static_cast<Eigen::Index>(k), T = N + 1;
    const Contact& contact = model.contacts[k];
    const auto couple = [&](Eigen::Index row, const Form& form) {
      for (const auto& [dof, factor] : contact.normal.terms)
        a(row, dof) += linear::entry_of(form, factor, 0.0, w);
      for (const auto& [dof, factor] : contact.tangent.terms)
        a(row, dof) += linear::entry_of(form, 0.0, factor, w);
      a(row, N) += form.N;
      a(row, T) += form.T;
    };
    couple(N, rows[k].normal);
    couple(T, rows[k].tangent);
    for (const auto& [dof, factor] : contact.normal.terms) a(dof, N) += factor;
    for (const auto& [dof, factor] : contact.tangent.terms) a(dof, T) += factor;
  }
  return a;
}

/// The same with degrees of freedom in another order: number i becomes 7 i + 3 modulo n.
Model shuffled(const Model& model) {
  Model other = model;
  const int n = model.size();
  const auto place = [n](auto i) { return static_cast<int>((7 * i + 3) % n); };
  for (auto [from, to] : {std::pair(&model.mass, &other.mass), std::pair(&model.damping, &other.damping),
                          std::pair(&model.stiffness, &other.stiffness)}) {
    to->setZero();
    for (int j = 0; j < n; ++j)
      for (SparseMatrix::InnerIterator it(*from, j); it; ++it)
        to->coeffRef(place(it.row()), place(j)) = it.value();
  }
  for (Contact& contact : other.contacts)
    for (Combination* form : {&contact.normal, &contact.tangent})
      for (auto& term : form->terms) term.first = place(term.first);
  return other;
}

}  // namespace

TEST_SUITE_BEGIN("unit/linear/condensed_matrix");

TEST_CASE("solutions are those of the whole matrix, in every state, at every length, in every order") {
  for (const bool turned : {false, true}) {
    const Model row = rubbing_row(33), model = turned ? shuffled(row) : row;
    const linear::SystemMatrices structure(model);
    std::optional<linear::CondensedRows> in_force =
        linear::CondensedRows::create(model, structure, linear::CondensedMatrix::max_width);
    REQUIRE(in_force);
    linear::CondensedMatrix condensed(*in_force);
    for (const int number : {0, 1, 2, 3, 27, 1000})
      for (const double h : {1e-12, 1e-3, 0.1, 30.0}) {
        CAPTURE(turned);
        CAPTURE(number);
        CAPTURE(h);
        const std::vector<Rows> rows = linear::rows_of(model, rubbing_mode(model, number));
        const linear::Weights weights{1.0, 0.5 * h, 0.25 * h * h};
        const Eigen::MatrixXd a = dense(model, rows, weights);
        const Vector b = Vector::LinSpaced(a.rows(), -1.0, 2.3), expected = base::solve_dense(a, b);
        in_force->set_rows(rows);
        REQUIRE(condensed.set(weights));
        Vector x = b;
        condensed.solve(x.data());
        const Eigen::Index n = model.size();
        CHECK((x - expected).head(n).cwiseAbs().maxCoeff() < 1e-12 * expected.head(n).cwiseAbs().maxCoeff());
        CHECK((x - expected).cwiseAbs().maxCoeff() < 1e-12 * expected.cwiseAbs().maxCoeff());
      }
  }
}

TEST_CASE("rows that hold an acceleration, and wide bands, are left to others") {
  Model model = rubbing_row(9);
  const linear::SystemMatrices structure(model);
  CHECK_FALSE(linear::CondensedRows::create(model, structure, 1));
  model.contacts[4].law = Law::rigid;
  model.contacts[4].tangential_stiffness.reset();
  std::optional<linear::CondensedRows> rows =
      linear::CondensedRows::create(model, structure, linear::CondensedMatrix::max_width);
  REQUIRE(rows);
  linear::CondensedMatrix condensed(*rows);
  CHECK_FALSE(condensed.set({1.0, 0.1, 0.01}));  // nothing is in force
  contact::ContactStates contact_states = rubbing_mode(model, 0);
  contact_states[4].state = State::open;
  rows->set_rows(linear::rows_of(model, contact_states));
  CHECK(condensed.set({1.0, 0.1, 0.01}));
  contact_states[4].state = State::stick;
  rows->set_rows(linear::rows_of(model, contact_states));
  CHECK_FALSE(condensed.set({1.0, 0.1, 0.01}));
  contact_states[4].state = State::open;
  rows->set_rows(4, linear::rows_of(model, contact_states)[4]);
  CHECK(condensed.set({1.0, 0.1, 0.01}));
}

TEST_CASE("where states change, factors follow in some rows, and are those of all rows to the last bit") {
  for (const bool turned : {false, true}) {
    Model row = rubbing_row(211);
    // Next to a rope on a soft bed: where K counts, what a contact does is felt far away.
    for (int i = 0; i < row.size(); ++i) row.stiffness.coeffRef(i, i) = 18.3;
    for (Contact& contact : row.contacts) contact.normal_stiffness = *(contact.tangential_stiffness = 2.0);
    const Model model = turned ? shuffled(row) : row;
    const linear::SystemMatrices structure(model);
    std::optional<linear::CondensedRows> rows =
        linear::CondensedRows::create(model, structure, linear::CondensedMatrix::max_width);
    REQUIRE(rows);
    linear::CondensedMatrix condensed(*rows);
    contact::ContactStates contact_states = rubbing_mode(model, 5);
    rows->set_rows(linear::rows_of(model, contact_states));
    // K counts for little, as much as M, and alone: over more and more rows.
    for (const double h : {0.01, 0.4, 1e3}) {
      const linear::Weights weights{1.0, 0.5 * h, 0.25 * h * h};
      REQUIRE(condensed.set(weights));
      const long made = condensed.factorisations, before = condensed.refactored_rows;
      constexpr int changes = 30;
      for (int i = 0; i < changes; ++i) {
        CAPTURE(turned);
        CAPTURE(h);
        CAPTURE(i);
        for (const int other : {0, 1}) {  // one, or two of them, close to each other or not
          const auto k = static_cast<std::size_t>(17 * i + other * (i % 3) * 50) % contact_states.size();
          contact_states[k].state = contact_states[k].state == State::open ? State::stick : State::open;
          rows->set_rows(k, signorini::contact::rows(model.contacts[k], contact_states[k]));
        }
        REQUIRE(condensed.set(weights));
        linear::CondensedMatrix whole(*rows);
        REQUIRE(whole.set(weights));
        Vector x = Vector::LinSpaced(model.size() + 2 * static_cast<Eigen::Index>(contact_states.size()),
                                     -1.0, 2.3),
               y = x;
        condensed.solve(x.data());
        whole.solve(y.data());
        CHECK(x == y);
      }
      CHECK(condensed.factorisations == made);
      if (h < 0.1) CHECK(condensed.refactored_rows - before < changes * 2 * 100);
    }
  }
}

TEST_CASE("changes of states that are too many to be remembered cost factors of all rows") {
  const Model model = rubbing_row(40);
  const linear::SystemMatrices structure(model);
  std::optional<linear::CondensedRows> rows =
      linear::CondensedRows::create(model, structure, linear::CondensedMatrix::max_width);
  REQUIRE(rows);
  linear::CondensedMatrix condensed(*rows);
  for (const int number : {3, 9}) {
    for (int again = 0; again < 2; ++again)
      rows->set_rows(linear::rows_of(model, rubbing_mode(model, number)));
    REQUIRE(condensed.set({1.0, 0.1, 0.01}));
    REQUIRE(condensed.set({1.0, 0.1, 0.01}));
  }
  CHECK(condensed.factorisations == 2);
  CHECK(condensed.refactored_rows == 0);
}

TEST_CASE(
    "a row has the band of its neighbours whatever its numbers, a ring twice that; each place is taken "
    "once") {
  const Model row = rubbing_row(50);
  CHECK(linear::band_order(row, linear::SystemMatrices(row)).width <=
        3);  // two of a mass, and one mass further
  const Model model = shuffled(row);
  const linear::BandOrder order = linear::band_order(model, linear::SystemMatrices(model));
  CHECK(order.width <= 3);
  CHECK(std::set<int>(order.place.begin(), order.place.end()).size() == 100);
  CHECK(*std::max_element(order.place.begin(), order.place.end()) == 99);
  Model ring = row;
  for (const int i : {0, 1}) ring.stiffness.coeffRef(i, 98 + i) = ring.stiffness.coeffRef(98 + i, i) = -9.0;
  CHECK(linear::band_order(ring, linear::SystemMatrices(ring)).width <= 7);
  Model apart = row;
  for (const int i : {49, 50, 48, 51})
    for (const int j : {i - 2, i + 2})
      if ((i < 50) != (j < 50))
        for (SparseMatrix* a : {&apart.mass, &apart.damping, &apart.stiffness}) a->coeffRef(i, j) = 0.0;
  for (SparseMatrix* a : {&apart.mass, &apart.damping, &apart.stiffness}) a->prune(0.0);
  const linear::BandOrder parts = linear::band_order(apart, linear::SystemMatrices(apart));
  CHECK(parts.width <= 3);
  CHECK(std::set<int>(parts.place.begin(), parts.place.end()).size() == 100);
}

TEST_SUITE_END();
