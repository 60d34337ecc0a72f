#include "study/compare/alignment.hpp"

#include <doctest/doctest.h>

#include "unit/result/made_up.hpp"

using namespace signorini;
using namespace signorini::made_up;

TEST_SUITE_BEGIN("unit/study/compare/joined_tables");

TEST_CASE("joined tables: rows that only one table has are passed over, in the middle and at the end") {
  const Folder folder;
  spill(folder / "a.csv", "t,x\n0,1\n1,2\n2,3\n3,4\n");
  spill(folder / "b.csv", "t,y\n0,5\n1.5,6\n2,7\n2.5,8\n");
  compare::TimeJoin join(folder / "a.csv", folder / "b.csv");
  std::vector<std::vector<double>> rows;
  while (join.next()) rows.push_back({join.t(), join.a().number(1), join.b().number(1)});
  CHECK(rows == std::vector<std::vector<double>>{{0.0, 1.0, 5.0}, {2.0, 3.0, 7.0}});
}

TEST_CASE("joined tables: times are the same but for roundoff") {
  CHECK(compare::same_time(0.3, 0.1 + 0.2));
  CHECK_FALSE(compare::same_time(0.3, 0.3 * (1.0 + 1e-12)));
  CHECK(compare::same_time(0.0, 0.0));
}

TEST_SUITE_END();
