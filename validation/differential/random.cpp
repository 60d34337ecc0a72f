#include "differential/random.hpp"

#include <cmath>

namespace signorini::differential {

double rounded(double x, int decimals) {
  double power = 1.0;
  for (int i = 0; i < decimals; ++i) power *= 10.0;
  return std::round(x * power) / power;
}

double Random::rounded(double low, double high, int decimals) {
  return differential::rounded(real(low, high), decimals);
}

double Random::normal() {
  double sum = -6.0;
  for (int i = 0; i < 12; ++i) sum += real(0.0, 1.0);
  return sum;
}

}  // namespace signorini::differential
