// random.hpp: numbers drawn from a seed, the same on every machine.
//
//   Random draw(7);   draw.real(0.0, 1.0);   draw.integer(1, 6);   draw.one_of({0.0, 0.5, 1.0});
//
// std::mt19937_64 is fixed by the standard, its distributions are not; these are sums and products only.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <random>
#include <vector>

namespace signorini::differential {

class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}

  /// In [low, high).
  double real(double low, double high) {
    return low + (high - low) * static_cast<double>(bits_() >> 11U) * 0x1.0p-53;
  }
  /// The same, rounded to so many decimals.
  double rounded(double low, double high, int decimals);
  /// In [low, high]; high - low is far below 2^64.
  int integer(int low, int high) {
    return low + static_cast<int>(bits_() % static_cast<std::uint64_t>(high - low + 1));
  }
  bool chance(double probability) { return real(0.0, 1.0) < probability; }
  /// About normal, mean 0, deviation 1: the sum of twelve.
  double normal();
  template <class T>
  T one_of(std::initializer_list<T> values) {
    return values.begin()[integer(0, static_cast<int>(values.size()) - 1)];
  }

 private:
  std::mt19937_64 bits_;
};

/// Rounded to so many decimals; shortest digits print it as it is read.
[[nodiscard]] double rounded(double x, int decimals);

}  // namespace signorini::differential
