#include "orbit/multipliers.hpp"

#include <algorithm>
#include <cmath>

#include "base/eigen_dense.hpp"
#include "base/rounding.hpp"

namespace signorini::orbit {
namespace {

// A multiplier at this distance or less from 1 is regarded as 1, because of the rounding of Phi and of a
// double eigenvalue. Chosen value: a disturbance that needs 1e7 periods to decay is regarded as permanent.
constexpr double one = 1e-7;

/// Largest distance from a multiplier in `a` to the nearest multiplier in `b`, or to 0 if 0 is nearer.
double apart(const Multipliers& a, const Multipliers& b) {
  double greatest = 0.0;
  for (const auto& x : a) {
    double nearest = std::abs(x);
    for (const auto& y : b) nearest = std::min(nearest, std::abs(x - y));
    greatest = std::max(greatest, nearest);
  }
  return greatest;
}

OrbitLoss loss_of(std::complex<double> mu, double error) {
  if (std::abs(mu.imag()) > error) return OrbitLoss::neimark_sacker;
  return mu.real() > 0.0 ? OrbitLoss::fold : OrbitLoss::flip;
}

}  // namespace

}  // namespace signorini::orbit

namespace signorini {

const char* to_string(OrbitLoss loss) {
  switch (loss) {
    case OrbitLoss::none:
      return "none";
    case OrbitLoss::fold:
      return "fold";
    case OrbitLoss::flip:
      return "flip";
    case OrbitLoss::neimark_sacker:
      return "neimark-sacker";
  }
  return "";
}

}  // namespace signorini

namespace signorini::orbit {

Multipliers multipliers_of(const Eigen::MatrixXd& phi) {
  if (phi.size() == 0) return {};
  const Eigen::VectorXcd values = base::general_eigenvalues(phi);
  Multipliers all(values.data(), values.data() + values.size());
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    if (std::abs(a) != std::abs(b)) return std::abs(a) > std::abs(b);
    return a.imag() > b.imag();
  });
  return all;
}

Multipliers without_ones(Multipliers all, std::size_t count) {
  for (; count > 0 && !all.empty(); --count)
    all.erase(std::min_element(all.begin(), all.end(), [](const auto& a, const auto& b) {
      return std::abs(a - 1.0) < std::abs(b - 1.0);
    }));
  return all;
}

std::size_t count_ones(const Multipliers& all) {
  return static_cast<std::size_t>(
      std::count_if(all.begin(), all.end(), [](const auto& mu) { return std::abs(mu - 1.0) <= one; }));
}

double error_of(const Eigen::MatrixXd& phi, double derivatives_error, double states) {
  const double size = phi.size() == 0 ? 0.0 : phi.cwiseAbs().maxCoeff();
  return (static_cast<double>(phi.rows()) * rounding::eps + derivatives_error + states) * size;
}

void set_multipliers(const Multipliers& all, const Eigen::MatrixXd& again, std::size_t ones, double error,
                     bool keeps, Orbit& orbit) {
  orbit.multipliers = all;
  orbit.multiplier_error = error;
  if (again.size() > 0) orbit.multiplier_error += apart(orbit.multipliers, multipliers_of(again));
  const Multipliers rest = without_ones(orbit.multipliers, ones);
  orbit.max_multiplier = rest.empty() ? 0.0 : std::abs(rest.front());
  orbit.loss = OrbitLoss::none;
  orbit.stable.reset();
  const double near = error_at_circle(orbit.multiplier_error, keeps);
  if (orbit.max_multiplier > 1.0 + near) {
    orbit.stable = false;
    orbit.loss = loss_of(rest.front(), near);
  } else if (!keeps && orbit.max_multiplier < 1.0 - near) {
    orbit.stable = true;
  }
}

}  // namespace signorini::orbit
