// Forces of narrow bands, four rows at once: to the last bit what columns leave one by one.
#include "linear/system_matrices.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace signorini;

namespace {

struct Banded {
  std::vector<std::int64_t> column_start{0};
  std::vector<int> row;
  std::vector<double> c, k;
};

/// Irregular numbers; every `gap`-th entry of the band is missing. Not symmetric.
Banded band_of(int size, int width, int gap) {
  Banded band;
  int count = 0;
  for (int j = 0; j < size; ++j) {
    for (int i = std::max(0, j - width); i <= std::min(size - 1, j + width); ++i) {
      ++count;
      if (gap > 0 && i != j && count % gap == 0 && i - j != width && j - i != width) continue;
      band.row.push_back(i);
      band.c.push_back(std::sin(1.7 * count) * std::pow(10.0, count % 5));
      band.k.push_back(std::cos(0.3 * count) * std::pow(10.0, count % 7));
    }
    band.column_start.push_back(static_cast<std::int64_t>(band.row.size()));
  }
  return band;
}

std::vector<double> irregular(int size, double phase) {
  std::vector<double> x;
  for (int i = 0; i < size; ++i) x.push_back(std::sin(phase + 2.1 * i) / (1.0 + i % 3));
  return x;
}

std::vector<double> by_columns(const Banded& band, const std::vector<double>& v, const std::vector<double>& u,
                               std::vector<double> r) {
  for (std::size_t j = 0; j < v.size(); ++j)
    for (auto p = static_cast<std::size_t>(band.column_start[j]);
         p < static_cast<std::size_t>(band.column_start[j + 1]); ++p)
      r[static_cast<std::size_t>(band.row[p])] -= band.c[p] * v[j] + band.k[p] * u[j];
  return r;
}

}  // namespace

TEST_SUITE_BEGIN("unit/linear/system_matrices");

TEST_CASE("forces of bands are those of columns, bit by bit, at every size and width") {
  for (const int gap : {0, 3})
    for (const int width : {0, 1, 2, 5, 8})
      for (int size = 1; size <= 41; ++size) {
        CAPTURE(width);
        CAPTURE(size);
        const Banded band = band_of(size, width, gap);
        const linear::BandedForces forces(band.column_start, band.row, band.c, band.k);
        if (forces.empty()) {
          CHECK(size <= width);  // no band: some diagonals are short
          continue;
        }
        const std::vector<double> v = irregular(size, 0.2), u = irregular(size, 1.4);
        std::vector<double> r = irregular(size, 3.0);
        const std::vector<double> expected = by_columns(band, v, u, r);
        forces.subtract(v.data(), u.data(), r.data());
        for (std::size_t i = 0; i < r.size(); ++i) CHECK(r[i] == expected[i]);
      }
}

TEST_CASE("a matrix with far entries is no band") {
  Banded band = band_of(30, 1, 0);
  band.row.back() = 3;  // of the last column
  CHECK(linear::BandedForces(band.column_start, band.row, band.c, band.k).empty());
  CHECK(linear::BandedForces({0}, {}, {}, {}).empty());
}

TEST_SUITE_END();
