// Modes below a frequency, counted by the signs of pivots.
#include <doctest/doctest.h>

#include "model/modes/frequencies.hpp"

using namespace signorini;

namespace {

/// n separate pairs of a mass m at the end of spring a, with a massless point on spring b between: omega^2 of
/// each is 1/(1/a + 1/b)/m.
void series(int n, double a, double b, double m, SparseMatrix& mass, SparseMatrix& stiffness) {
  mass.resize(2 * n, 2 * n);
  stiffness.resize(2 * n, 2 * n);
  for (int i = 0; i < 2 * n; i += 2) {
    mass.insert(i, i) = m;
    stiffness.insert(i, i) = a;
    stiffness.insert(i, i + 1) = -a;
    stiffness.insert(i + 1, i) = -a;
    stiffness.insert(i + 1, i + 1) = a + b;
  }
}

}  // namespace

TEST_SUITE_BEGIN("unit/model/modes/frequencies");

TEST_CASE("repeated modes count as often as they are there, massless points not at all") {
  SparseMatrix mass, stiffness;
  series(60, 30.0, 60.0, 2.0, mass, stiffness);  // omega^2 = 10
  CHECK(modes::count_modes_below(mass, stiffness, 1e-3) == 0);
  CHECK(modes::count_modes_below(mass, stiffness, 9.999) == 0);
  CHECK(modes::count_modes_below(mass, stiffness, 10.001) == 60);
  CHECK(modes::count_modes_below(mass, stiffness, 1e9) == 60);
}

TEST_CASE("free motions count") {
  SparseMatrix mass, stiffness;
  series(5, 30.0, 0.0, 2.0, mass, stiffness);
  CHECK(modes::count_modes_below(mass, stiffness, 1e-3) == 5);
}

TEST_CASE("a shift on which a pivot vanishes counts just above it") {
  SparseMatrix mass, stiffness;
  series(3, 30.0, 60.0, 2.0, mass, stiffness);
  CHECK(modes::count_modes_below(mass, stiffness, 15.0) == 3);  // K_00 - s M_00 = 0
  CHECK(modes::count_modes_below(mass, stiffness, 10.0) == 3);  // a mode: taken as below
}

TEST_SUITE_END();
