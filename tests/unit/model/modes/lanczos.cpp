#include "model/modes/lanczos.hpp"

#include <doctest/doctest.h>

using namespace signorini;

namespace {

SparseMatrix diagonal(const Eigen::VectorXd& d) {
  return SparseMatrix(Eigen::MatrixXd(d.asDiagonal()).sparseView());
}

}  // namespace

TEST_SUITE("unit/model/modes/lanczos") {
  TEST_CASE("the lowest squares of a diagonal problem, a repeated one included") {
    Eigen::VectorXd squares = Eigen::VectorXd::LinSpaced(40, 1.0, 40.0);
    squares[1] = squares[0];
    const base::EigenPairs found = modes::lowest_modes(3, 3.5, diagonal(Eigen::VectorXd::Ones(40)),
                                                       diagonal(squares), Eigen::MatrixXd(40, 0), 0.1);
    REQUIRE(found.values.size() == 4);
    CHECK(found.values[0] == doctest::Approx(1.0));
    CHECK(found.values[1] == doctest::Approx(1.0));
    CHECK(found.values[2] == doctest::Approx(3.0));
    CHECK(found.values[3] == doctest::Approx(4.0));
  }

  TEST_CASE("nothing is found where the shifted stiffness is not positive definite") {
    Eigen::VectorXd squares = Eigen::VectorXd::LinSpaced(40, 1.0, 40.0);
    squares[7] = -5.0;
    const base::EigenPairs found = modes::lowest_modes(1, 1.5, diagonal(Eigen::VectorXd::Ones(40)),
                                                       diagonal(squares), Eigen::MatrixXd(40, 0), 1.0);
    CHECK(found.values.size() == 0);
  }
}
