// Orbits of random forced scenes: closed to rounding, or a reason; multipliers against differences of runs.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <Eigen/Dense>
#include <complex>
#include <random>

#include "behaviour/orbit_runs.hpp"
#include "behaviour/rates.hpp"
#include "signorini/orbit.hpp"

using namespace signorini;
using namespace signorini::tests;

namespace {

class RandomForced {
 public:
  explicit RandomForced(unsigned seed) : random_(seed), damping_of_mass_(seed % 2 == 1) {}

  /// One to five masses in a chain, one or two contacts of any kind, a harmonic load.
  [[nodiscard]] std::string scene() {
    n_ = whole(1, 5);
    std::string text = matrices();
    const int contacts = whole(1, 2);
    for (int c = 0; c < contacts; ++c)
      text += fmt::format("[[contacts]]\nname = \"c{}\"\n", c) + contact(whole(0, n_ - 1));
    return text + fmt::format(
                      "[[loads]]\ndirection = {{ d{} = 1.0 }}\namplitude = {}\nhistory = {{ type = "
                      "\"harmonic\", omega = {}, phase = {} }}\n",
                      whole(0, n_ - 1), real(0.3, 2.0), real(0.4, 3.0), real(0.0, 6.0));
  }
  [[nodiscard]] int size() const { return n_; }

 private:
  [[nodiscard]] double real(double a, double b) {
    return a + (b - a) * static_cast<double>(random_()) / 4294967296.0;
  }
  [[nodiscard]] int whole(int a, int b) { return a + static_cast<int>(real(0.0, b - a + 1.0)); }
  [[nodiscard]] std::string matrices() {
    Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n_, n_), K = M;
    double before = real(0.5, 4.0);
    for (int i = 0; i < n_; ++i) {
      const double next = real(0.5, 4.0);
      M(i, i) = real(0.5, 2.0);
      K(i, i) = before + next;
      if (i + 1 < n_) K(i, i + 1) = K(i + 1, i) = -next;
      before = next;
    }
    const Eigen::MatrixXd C = real(0.01, 0.15) * M + (damping_of_mass_ ? 0.0 : 0.02) * K;
    const auto text = [](const Eigen::MatrixXd& a) {
      std::vector<std::string> rows;
      for (Eigen::Index i = 0; i < a.rows(); ++i) {
        std::vector<double> row(static_cast<std::size_t>(a.cols()));
        for (Eigen::Index j = 0; j < a.cols(); ++j) row[static_cast<std::size_t>(j)] = a(i, j);
        rows.push_back(fmt::format("[{}]", fmt::join(row, ", ")));
      }
      return fmt::format("[{}]", fmt::join(rows, ", "));
    };
    return fmt::format(
        "schema = 1\nunits = {{ force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }}\n[run]\nt_end "
        "= "
        "50.0\nengine = \"exact\"\ncertify = false\n[matrices]\nmass = {}\nstiffness = {}\ndamping = {}\n",
        text(M), text(K), text(C));
  }
  [[nodiscard]] std::string contact(int d) {
    const int side = whole(0, 1) == 0 ? -1 : 1;
    switch (whole(0, 4)) {
      case 0:
        return fmt::format("law = \"compliant\"\nnormal = {{ d{} = {} }}\ngap = {}\nnormal_stiffness = {}\n",
                           d, side, real(0.0, 0.5), real(5.0, 200.0));
      case 1:
        return fmt::format(
            "law = \"compliant\"\nnormal = {{ d{} = {} }}\ngap = {}\nnormal_stiffness = {}\n{}", d, side,
            real(0.0, 0.3), real(5.0, 100.0),
            n_ > 1 ? fmt::format("tangent = {{ d{} = 1.0 }}\ntangential_stiffness = {}\nfriction = {}\n",
                                 (d + 1) % n_, real(5.0, 100.0), real(0.1, 0.6))
                   : "");
      case 2:
        return fmt::format(
            "law = \"slider\"\ntangent = {{ d{} = 1.0 }}\nnormal_force = 1.0\nfriction = "
            "{}\ntangential_stiffness = {}\n",
            d, real(0.05, 0.4), real(5.0, 50.0));
      case 3:
        return fmt::format("law = \"slider\"\ntangent = {{ d{} = 1.0 }}\nnormal_force = 1.0\nfriction = {}\n",
                           d, real(0.05, 0.4));
      default:
        return fmt::format("law = \"rigid\"\nnormal = {{ d{} = {} }}\ngap = {}\nrestitution = {}\n", d, side,
                           real(0.05, 0.5), real(0.3, 0.9));
    }
  }

  std::mt19937 random_;
  bool damping_of_mass_;
  int n_ = 1;
};

/// Extrapolated: h^4 beside eps z/h.
Eigen::MatrixXd phi_of(const std::string& text, const Orbit& orbit, int n) {
  const double h = 5e-7;
  return (4.0 * monodromy_by_runs(text, orbit, n, h) - monodromy_by_runs(text, orbit, n, 2.0 * h)) / 3.0;
}

/// How far a run that starts beside the orbit by `size` along the eigenvector of the greatest multiplier is from
/// Re(mu^k v) after k = 1, 2, 3 periods, over the greatest |mu^j v| up to there.
double off_rate(const std::string& text, const Orbit& orbit, int n, const Eigen::MatrixXd& phi, double size) {
  const Eigen::EigenSolver<Eigen::MatrixXd> eigen(phi);
  Eigen::Index leading = 0;
  const auto away = [&](Eigen::Index i) {
    return std::abs(std::abs(eigen.eigenvalues()[i]) - orbit.max_multiplier);
  };
  for (Eigen::Index i = 1; i < phi.rows(); ++i)
    if (away(i) < away(leading)) leading = i;
  const std::complex<double> mu = eigen.eigenvalues()[leading];
  Eigen::VectorXcd v = eigen.eigenvectors().col(leading);
  Eigen::Index at = 0;
  v.cwiseAbs().maxCoeff(&at);
  v *= size / v[at];
  const int periods = 3;
  const Eigen::MatrixXd moved = states_beside(text, orbit, n, v.real(), periods) -
                                states_beside(text, orbit, n, Eigen::VectorXd::Zero(phi.rows()), periods);
  double worst = 0.0, greatest = size;
  std::complex<double> power = 1.0;
  for (int k = 0; k < periods && (k == 0 || std::abs(power * mu) <= 10.0); ++k) {
    power *= mu;
    greatest = std::max(greatest, size * std::abs(power));
    worst = std::max(worst, (moved.col(k) - (power * v).real()).cwiseAbs().maxCoeff() / greatest);
  }
  return worst;
}

/// Seeds 0 to seeds - 1: closed to rounding, with the multipliers of runs, or a reason is given.
void check_random_orbits(unsigned seeds) {
  int found = 0, none = 0, compared = 0, edges = 0;
  for (unsigned seed = 0; seed < seeds; ++seed) {
    CAPTURE(seed);
    RandomForced random(seed);
    const std::string text = random.scene();
    const Orbit orbit = find_orbit(reader_of_text(text));
    if (!orbit.found) {
      ++none;
      CHECK(!orbit.reason.empty());
      continue;
    }
    ++found;
    CHECK(orbit.residual <= 1e-12);
    if (!orbit.reason.empty()) {
      ++edges;  // a contact comes to its limit: Phi differs from side to side
      CHECK(!orbit.families.empty());
      continue;
    }
    const Eigen::MatrixXd phi = phi_of(text, orbit, random.size());
    if (static_cast<std::size_t>(phi.rows()) != orbit.multipliers.size())
      continue;  // rigid contacts that hold
    ++compared;
    std::complex<double> sum = 0.0, squares = 0.0;
    double size = 1.0;
    for (const auto& mu : orbit.multipliers) {
      sum += mu;
      squares += mu * mu;
      size = std::max(size, std::abs(mu));
    }
    CHECK(std::abs(phi.trace() - sum.real()) <= 1e-7 * size);
    CHECK(std::abs((phi * phi).trace() - squares.real()) <= 1e-7 * size * size);
    const double off = off_rate(text, orbit, random.size(), phi, 1e-6 * orbit.amplitude);
    CHECK(off <= 1e-3);
  }
  MESSAGE(found << " orbits, " << none << " reasons, " << edges << " at edges, " << compared << " compared");
  CHECK(found >= 0.95 * seeds);
  CHECK(compared >= 0.8 * seeds);
}

}  // namespace

TEST_SUITE_BEGIN("slow/orbit random");

TEST_CASE(
    "three hundred random forced scenes: an orbit closed to rounding, with the multipliers of runs, or a "
    "reason") {
  check_random_orbits(300);
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("deep/orbit random");

TEST_CASE(
    "a thousand random forced scenes: an orbit closed to rounding, with the multipliers of runs, or a "
    "reason") {
  check_random_orbits(1000);
}

TEST_SUITE_END();
