#include "engine/ida/fast_vector.hpp"

#include <doctest/doctest.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

using namespace signorini;

namespace {

constexpr std::size_t most_vectors = 8;

/// Vectors of one length with random numbers.
struct Vectors {
  explicit Vectors(sunindextype n) {
    SUNContext_Create(nullptr, &context);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (N_Vector& vector : v) {
      vector = all.empty() ? ida::make_vector(n, context) : N_VClone(v[0]);
      all.emplace_back();
      for (sunindextype j = 0; j < n; ++j)
        all.back().push_back(NV_DATA_S(vector)[static_cast<std::size_t>(j)] = uniform(random));
    }
  }
  ~Vectors() {
    for (N_Vector vector : v) N_VDestroy(vector);
    SUNContext_Free(&context);
  }
  Vectors(const Vectors&) = delete;
  Vectors& operator=(const Vectors&) = delete;
  [[nodiscard]] std::vector<double> now(std::size_t i) const {
    return {NV_DATA_S(v[i]), NV_DATA_S(v[i]) + NV_LENGTH_S(v[i])};
  }

  SUNContext context = nullptr;
  std::array<N_Vector, most_vectors> v{};
  std::vector<std::vector<double>> all;  // as they were
};

}  // namespace

TEST_SUITE_BEGIN("unit/engine/ida/fast_vector");

TEST_CASE("operations of vectors are those of plain loops, bit by bit, whatever the length") {
  for (sunindextype n = 1; n < 40; ++n) {
    CAPTURE(n);
    const auto size = static_cast<std::size_t>(n);
    for (int count = 1; count <= 7; ++count)
      for (const int zeros : {0, 2}) {  // at the end; into the first of them
        Vectors x(n);
        std::array<double, 7> c{0.3, -1.7, 2.9, 0.11, -0.7, 5.3, 1.9};
        for (int i = std::max(1, count - zeros); i < count; ++i) c[static_cast<std::size_t>(i)] = 0.0;
        N_VLinearCombination(count, c.data(), x.v.data(), x.v[0]);
        for (std::size_t j = 0; j < size; ++j) {
          double sum = c[0] * x.all[0][j];
          for (std::size_t i = 1; i < static_cast<std::size_t>(count); ++i) sum += c[i] * x.all[i][j];
          CHECK(x.now(0)[j] == sum);
        }
      }
    for (const double a : {1.0, -0.3}) {
      Vectors x(n);
      N_VLinearSum(a, x.v[0], 1.3, x.v[1], x.v[2]);
      N_VScale(a, x.v[3], x.v[4]);
      for (std::size_t j = 0; j < size; ++j) {
        CHECK(x.now(2)[j] == a * x.all[0][j] + 1.3 * x.all[1][j]);
        CHECK(x.now(4)[j] == a * x.all[3][j]);
      }
    }
  }
}

TEST_CASE("differences of a step are updated one from the other, in one pass or several") {
  for (const sunindextype n : {3, 8, 21})
    for (std::size_t count = 1; count <= 6; ++count) {
      CAPTURE(n);
      CAPTURE(count);
      for (const double b : {1.0, 0.5}) {  // the second is no cascade
        Vectors x(n);
        // x_1 += b e, x_2 += b x_1 ...: e is vector 0
        N_VLinearSumVectorArray(static_cast<int>(count), 1.0, x.v.data() + 1, b, x.v.data(), x.v.data() + 1);
        for (std::size_t j = 0; j < static_cast<std::size_t>(n); ++j) {
          double sum = x.all[0][j];
          for (std::size_t i = 1; i <= count; ++i) {
            sum = x.all[i][j] + b * sum;
            CHECK(x.now(i)[j] == sum);
          }
          CHECK(x.now(count + 1)[j] == x.all[count + 1][j]);
        }
      }
    }
}

TEST_CASE("the norm is the root of the mean of weighted squares") {
  for (sunindextype n = 1; n < 70; ++n) {
    CAPTURE(n);
    const Vectors x(n);
    long double sum = 0.0L;
    for (std::size_t j = 0; j < static_cast<std::size_t>(n); ++j)
      sum += std::pow(static_cast<long double>(x.all[0][j]) * x.all[1][j], 2.0L);
    const auto exact = static_cast<double>(std::sqrt(sum / static_cast<long double>(n)));
    CHECK(std::abs(N_VWrmsNorm(x.v[0], x.v[1]) - exact) <= 1e-14 * exact);
  }
}
