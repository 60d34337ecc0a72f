#include "model/assembly/parts.hpp"

#include <doctest/doctest.h>

using namespace signorini;

namespace {

SparseMatrix sparse(int n, const std::vector<Eigen::Triplet<double>>& entries) {
  SparseMatrix a(n, n);
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

}  // namespace

TEST_SUITE_BEGIN("unit/model/assembly/parts");

TEST_CASE("parts: what entries and forms couple, and nothing else") {
  // 0 - 3 by K, 1 - 4 by a form, 2 alone; an entry of zero couples nothing.
  const SparseMatrix k = sparse(5, {{0, 0, 2.0}, {0, 3, -1.0}, {3, 0, -1.0}, {3, 3, 3.0}, {0, 2, 0.0}});
  const std::vector<Combination> forms{{{{1, 1.0}, {4, -1.0}}}, {}, {{{3, 0.5}}}};
  const assembly::Parts parts({&k}, forms);
  REQUIRE(parts.count() == 3);
  std::vector<std::vector<int>> dofs;
  for (const assembly::Part& part : parts) dofs.push_back(part.dofs());
  CHECK(dofs == std::vector<std::vector<int>>{{0, 3}, {1, 4}, {2}});
  const Eigen::MatrixXd own(parts.begin()->matrix(k));
  CHECK(own == Eigen::Matrix2d{{2.0, -1.0}, {-1.0, 3.0}});
  const std::vector<Combination> first = parts.begin()->forms(forms);
  REQUIRE(first.size() == 1);
  CHECK(first[0].terms == std::vector<std::pair<int, double>>{{1, 0.5}});
  CHECK(parts.part_of(4) == 1);
}

TEST_CASE("forms that share a degree of freedom, also through others") {
  const std::vector<Combination> forms{{{{0, 1.0}}}, {{{5, 1.0}}}, {{{0, 1.0}, {7, 1.0}}}, {{{7, 2.0}}}, {}};
  CHECK(assembly::coupled_forms(forms) == std::vector<std::vector<std::size_t>>{{0, 2, 3}, {1}, {4}});
}

TEST_SUITE_END();
