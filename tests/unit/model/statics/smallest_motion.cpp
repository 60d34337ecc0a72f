// The least of many possible slips: by hand.
#include <doctest/doctest.h>

#include <vector>

#include "model/statics/smallest_motion.hpp"

namespace signorini::tests::least {

using Matrix = Eigen::MatrixXd;
using Column = Eigen::VectorXd;

namespace {

Column about_rest(const Matrix& b) { return Column::Zero(b.cols()); }

}  // namespace

TEST_SUITE_BEGIN("unit/model/statics/smallest_motion");

TEST_CASE("two feet that spread: half each, whichever was moved") {
  const Matrix b = Matrix::Ones(2, 1);  // both to the right
  const std::vector<statics::AdmissibleDirection> ways{statics::AdmissibleDirection::negative,
                                                       statics::AdmissibleDirection::positive};
  for (const double left : {0.0, -3.0, -7.0}) {
    const Column g = Column{{left, left + 10.0}};
    const Column r = statics::smallest_motion(b, g, ways, about_rest(b));
    CHECK(r[0] == doctest::Approx(-5.0).epsilon(1e-14));
    CHECK(r[1] == doctest::Approx(5.0).epsilon(1e-14));
    CHECK(statics::has_other_motions(b, r, ways));
  }
}

TEST_CASE("a foot that may not go back stays; one that may go both ways does") {
  const Matrix b = Matrix::Ones(3, 1);
  const Column g{{0.0, 1.0, 5.0}};
  // free: mean 2, so (-2, -1, 3); the first may go forth only
  const std::vector<statics::AdmissibleDirection> first{statics::AdmissibleDirection::positive,
                                                        statics::AdmissibleDirection::both,
                                                        statics::AdmissibleDirection::both};
  CHECK((statics::smallest_motion(b, g, first, about_rest(b)) - g).norm() < 1e-14);
  const std::vector<statics::AdmissibleDirection> all{statics::AdmissibleDirection::both,
                                                      statics::AdmissibleDirection::both,
                                                      statics::AdmissibleDirection::both};
  CHECK((statics::smallest_motion(b, g, all, about_rest(b)) - Column{{-2.0, -1.0, 3.0}}).norm() < 1e-14);
  // the nearest to (4, 4, 4) moved along: (0, 1, 5) + 2
  CHECK((statics::smallest_motion(b, g, all, Column::Constant(1, 4.0)) - Column{{2.0, 3.0, 7.0}}).norm() <
        1e-13);
}

TEST_CASE("where every way but one is closed, that one is the only one") {
  const Matrix b = Matrix::Ones(2, 1);
  const std::vector<statics::AdmissibleDirection> ways{statics::AdmissibleDirection::positive,
                                                       statics::AdmissibleDirection::negative};
  const Column g = Column::Zero(2);
  CHECK(statics::smallest_motion(b, g, ways, about_rest(b)).norm() == 0.0);
  CHECK_FALSE(statics::has_other_motions(b, Column{{0.0, 0.0}}, ways));
  CHECK(statics::has_other_motions(b, Column{{2.0, -1.0}}, ways));
}

TEST_CASE("two motions at once: a plane of slips") {
  Matrix b(3, 2);
  b << 1, 0, 0, 1, 1, 1;
  const Column g{{1.0, 1.0, 5.0}};  // r3 = r1 + r2 + 3
  const std::vector<statics::AdmissibleDirection> ways(3, statics::AdmissibleDirection::both);
  CHECK((statics::smallest_motion(b, g, ways, about_rest(b)) - Column{{-1.0, -1.0, 1.0}}).norm() < 1e-14);
  const std::vector<statics::AdmissibleDirection> bound{statics::AdmissibleDirection::positive,
                                                        statics::AdmissibleDirection::both,
                                                        statics::AdmissibleDirection::both};
  // r1 = 0: least r2^2 + (r2 + 3)^2
  CHECK((statics::smallest_motion(b, g, bound, about_rest(b)) - Column{{0.0, -1.5, 1.5}}).norm() < 1e-13);
}

TEST_SUITE_END();

}  // namespace signorini::tests::least
