#include "contact/motion.hpp"

#include <doctest/doctest.h>

using namespace signorini;

TEST_SUITE_BEGIN("unit/contact/motion");

TEST_CASE("forms stand side by side on the degrees of freedom that they touch, weighted") {
  const Combination first{{{7, 2.0}, {3, -1.0}}}, second{{{3, 4.0}}}, none{}, twice{{{9, 1.0}, {9, 0.5}}};
  const Eigen::MatrixXd h = contact::form_columns({&first, &second, &none, &twice});
  REQUIRE(h.rows() == 3);
  REQUIRE(h.cols() == 4);
  Eigen::MatrixXd expected(3, 4);
  expected << 2.0, 0.0, 0.0, 0.0, -1.0, 4.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.5;
  CHECK(h == expected);
  CHECK(contact::form_columns({&first, &second}, [](int dof) { return dof == 3 ? 10.0 : 0.5; })(1, 1) ==
        40.0);
  CHECK(contact::form_columns({&first, &second}, [](int dof) { return dof == 3 ? 10.0 : 0.5; })(0, 0) == 1.0);
  CHECK(contact::form_columns({}).size() == 0);
}

TEST_SUITE_END();
