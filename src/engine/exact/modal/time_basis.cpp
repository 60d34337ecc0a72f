#include "engine/exact/modal/time_basis.hpp"

#include <algorithm>
#include <cmath>

#include "engine/exact/series_works.hpp"

namespace signorini::modal {
namespace {

// Largest phase angle of the fastest wave on a panel of the quadrature, rad. The error is then only rounding.
constexpr double turn_of_panel = 2.0;

std::size_t degree_of(const Piece& piece) {
  std::size_t degree = piece.coefficients.size();
  while (degree > 1 && piece.coefficients[degree - 1] == 0.0) --degree;
  return degree > 0 ? degree - 1 : 0;
}

}  // namespace

TimeBasis::TimeBasis(const Model& model, double t) : t0_(t) {
  std::size_t degree = 0;
  const auto take = [&](const History& history) {
    const Piece& piece = history.piece(t);
    degree = std::max(degree, degree_of(piece));
    if (piece.amplitude != 0.0 && piece.omega != 0.0 &&
        std::find(omega_.begin(), omega_.end(), std::abs(piece.omega)) == omega_.end())
      omega_.push_back(std::abs(piece.omega));
  };
  for (const Load& load : model.loads) take(load.history);
  for (const Contact& contact : model.contacts) {
    take(contact.normal_force);
    take(contact.surface_motion);
  }
  degree_ = driven_ = degree + 1;
}

void TimeBasis::reserve_slow_roots(const Eigen::VectorXcd& roots, double length) {
  degree_ = driven_;
  length_ = std::numeric_limits<double>::infinity();
  if (is_constant()) return;
  length_ = length;
  double greatest = 0.0;
  for (const std::complex<double>& l : roots)
    if (is_slow(l)) greatest = std::max(greatest, std::abs(l) * length);
  double term = greatest;
  for (int m = 1; term > 0.25 * std::numeric_limits<double>::epsilon(); term *= greatest / ++m) ++degree_;
}

Eigen::VectorXd TimeBasis::at(double x) const {
  Eigen::VectorXd b(size());
  double power = 1.0;
  Eigen::Index i = 0;
  for (; i <= static_cast<Eigen::Index>(degree_); ++i, power *= x) b[i] = power;
  for (const double w : omega_) {
    b[i++] = std::cos(w * x);
    b[i++] = std::sin(w * x);
  }
  return b;
}

TimeCoefficients TimeBasis::of(const Piece& piece) const {
  TimeCoefficients c = TimeCoefficients::Zero(size());
  Piece polynomial = piece;
  polynomial.amplitude = 0.0;
  polynomial.taylor(t0_, 1.0, degree_ + 1, c.data());
  if (piece.amplitude == 0.0) return c;
  const double phase = piece.omega * (t0_ - piece.origin) + piece.phase;
  if (piece.omega == 0.0) {
    c[0] += piece.amplitude * std::sin(phase);
    return c;
  }
  const auto wave = std::find(omega_.begin(), omega_.end(), std::abs(piece.omega)) - omega_.begin();
  const Eigen::Index i = static_cast<Eigen::Index>(degree_) + 1 + 2 * wave;
  c[i] = piece.amplitude * std::sin(phase);
  c[i + 1] = piece.amplitude * std::cos(phase) * (piece.omega < 0.0 ? -1.0 : 1.0);
  return c;
}

TimeCoefficients TimeBasis::constant(double value) const {
  TimeCoefficients c = TimeCoefficients::Zero(size());
  c[0] = value;
  return c;
}

TimeCoefficients TimeBasis::derivative(const TimeCoefficients& c) const {
  TimeCoefficients d = TimeCoefficients::Zero(size());
  const auto degree = static_cast<Eigen::Index>(degree_);
  for (Eigen::Index j = 1; j <= degree; ++j) d[j - 1] = static_cast<double>(j) * c[j];
  Eigen::Index i = degree + 1;
  for (const double w : omega_) {
    d[i] = w * c[i + 1];
    d[i + 1] = -w * c[i];
    i += 2;
  }
  return d;
}

Eigen::MatrixXd TimeBasis::derivative(const Eigen::MatrixXd& c) const {
  Eigen::MatrixXd d(c.rows(), c.cols());
  for (Eigen::Index row = 0; row < c.rows(); ++row)
    d.row(row) = derivative(TimeCoefficients(c.row(row).transpose())).transpose();
  return d;
}

ComplexTimeCoefficients TimeBasis::response(std::complex<double> l, const ComplexTimeCoefficients& p) const {
  ComplexTimeCoefficients c = ComplexTimeCoefficients::Zero(size());
  const auto degree = static_cast<Eigen::Index>(degree_);
  if (is_slow(l)) {
    for (Eigen::Index j = 0; j < degree; ++j) c[j + 1] = (l * c[j] + p[j]) / static_cast<double>(j + 1);
  } else {
    const std::complex<double> part = 1.0 / l;
    for (Eigen::Index j = degree; j-- > 0;) c[j] = (static_cast<double>(j + 1) * c[j + 1] - p[j]) * part;
  }
  Eigen::Index i = degree - 1;
  for (const double w : omega_) {
    i += 2;
    if (p[i] == 0.0 && p[i + 1] == 0.0) continue;
    const std::complex<double> part = 1.0 / (l * l + w * w);
    c[i] = -(l * p[i] + w * p[i + 1]) * part;
    c[i + 1] = (w * p[i] - l * p[i + 1]) * part;
  }
  return c;
}

double TimeBasis::cancellation(std::complex<double> l, double time) const {
  const double size = std::abs(l);
  double most = 0.0;
  if (size > 0.0) {  // terms j! / (l time)^(j + 1), relative to p time
    double term = 1.0 / (size * time);
    if (l.imag() != 0.0 || l.real() > 0.0)
      term = std::max(term, term * term);  // p / l^2 relative to p time^2 / 2
    for (std::size_t j = 0; j < driven_; ++j) {
      most = std::max(most, term);
      term *= static_cast<double>(j + 1) / (size * time);
    }
  }
  for (const double w : omega_) most = std::max(most, (size + w) / (std::abs(l * l + w * w) * time));
  return most;
}

TimeBasis::FastWaveBound TimeBasis::taylor(const TimeCoefficients& c, double x0, double h, double turn,
                                           std::vector<double>& p) const {
  const std::size_t count = p.size();
  std::fill(p.begin(), p.end(), 0.0);
  double power = 1.0;
  for (std::size_t k = 0; k < std::min(count, degree_ + 1); ++k, power *= h) {
    double sum = 0.0;
    for (std::size_t j = degree_ + 1; j-- > k;) {
      double binomial = 1.0;
      for (std::size_t i = 1; i <= k; ++i)
        binomial *= static_cast<double>(j + 1 - i) / static_cast<double>(i);
      sum = sum * x0 + binomial * c[static_cast<Eigen::Index>(j)];
    }
    p[k] = sum * power;
  }
  FastWaveBound bound;
  auto i = static_cast<Eigen::Index>(degree_) + 1;
  for (const double w : omega_) {
    const double a = c[i], b = c[i + 1];
    i += 2;
    if (a == 0.0 && b == 0.0) continue;
    if (w * h > turn) {
      const double size = std::hypot(a, b);
      bound.value += size;
      bound.rate += size * w;
      continue;
    }
    double even = a * std::cos(w * x0) + b * std::sin(w * x0),
           odd = b * std::cos(w * x0) - a * std::sin(w * x0);
    double factor = 1.0;
    for (std::size_t k = 0; k < count; ++k) {
      p[k] += factor * even;
      factor *= w * h / static_cast<double>(k + 1);
      const double next = -even;
      even = odd;
      odd = next;
    }
    bound.rest += 2.0 * factor * std::hypot(a, b);
  }
  return bound;
}

Eigen::MatrixXd TimeBasis::products(double x0, double x1) const {
  const double fastest = omega_.empty() ? 0.0 : *std::max_element(omega_.begin(), omega_.end());
  const double h = x1 - x0;
  const auto panels = static_cast<int>(std::ceil(std::max(1.0, fastest * h / turn_of_panel)));
  const exact::GaussRule& rule = exact::gauss_rule();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(size(), size());
  for (int panel = 0; panel < panels; ++panel)
    for (std::size_t i = 0; i < rule.x.size(); ++i) {
      const Eigen::VectorXd b = at(x0 + h * (panel + rule.x[i]) / panels);
      for (Eigen::Index j = 0; j < b.size(); ++j) sum.col(j) += rule.w[i] * b[j] * b;
    }
  return sum * (h / panels);
}

}  // namespace signorini::modal
