// How forces move with a parameter on stretches in modes: closed form of one of many masses, turned.
#include <doctest/doctest.h>
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "behaviour/one_mass.hpp"
#include "behaviour/rates.hpp"

namespace signorini::tests::modal_stretches {
namespace {

constexpr std::size_t masses = 17;  // fewer go by series
constexpr double mass = 2.0, own = 2.0, kn = 18.0, gap = -0.3, speed = -0.6, alpha = 0.4;

/// K = Q D Q^T, M = 2 I, C = alpha M, Q = I - 2 w w^T: along its first column a mass of its own, with a contact.
std::string turned() {
  const auto q = [](std::size_t i, std::size_t j) {
    return (i == j ? 1.0 : 0.0) - 2.0 / static_cast<double>(masses);
  };
  std::vector<std::string> k, m, c, normal;
  std::vector<double> v;
  for (std::size_t i = 0; i < masses; ++i) {
    std::vector<double> k_row(masses, 0.0), m_row(masses, 0.0);
    for (std::size_t j = 0; j < masses; ++j)
      for (std::size_t l = 0; l < masses; ++l)
        k_row[j] += (own + static_cast<double>(l)) * (q(i, l) * q(j, l));
    m_row[i] = mass;
    k.push_back(fmt::format("[{:.17g}]", fmt::join(k_row, ", ")));
    m.push_back(fmt::format("[{}]", fmt::join(m_row, ", ")));
    m_row[i] *= alpha;
    c.push_back(fmt::format("[{}]", fmt::join(m_row, ", ")));
    normal.push_back(fmt::format("d{} = {:.17g}", i, q(i, 0)));
    v.push_back(speed * q(i, 0));
  }
  return matrix_scene(
      fmt::format("t_end = 0.9\noutput_dt = 0.1\nflow = \"modal\"\ninitial = {{ u = [{}], v = [{:.17g}] }}",
                  fmt::join(std::vector<double>(masses, 0.0), ", "), fmt::join(v, ", ")),
      fmt::format("mass = [{}]\ndamping = [{}]\nstiffness = [{}]", fmt::join(m, ", "), fmt::join(c, ", "),
                  fmt::join(k, ", ")),
      fmt::format("law = \"compliant\"\nnormal = {{ {} }}\nnormal_stiffness = {}\ngap = {}",
                  fmt::join(normal, ", "), kn, gap));
}

}  // namespace

TEST_SUITE_BEGIN("unit/sensitivity/modal_stretch");

TEST_CASE("the force on a spring whose gap moves: all along, at its greatest, and where it ends") {
  const Sensitivities s = rates_of(turned(), {"contacts.c.gap"});
  CHECK(s.stretches.modes == 2);
  CHECK(s.stretches.series == 0);
  // z'' + 2 b z' + k/m (z - rest) = 0, k = own + kn, rest = -kn gap/k: z = rest + e^-bt (A cos w t + B sin w t)
  const double k = own + kn, b = 0.5 * alpha, w = std::sqrt(k / mass - b * b), rest = -kn * gap / k;
  const double A = -rest, B = (speed + b * A) / w;
  const auto N = [&](double t) {
    return kn * (gap + rest + std::exp(-b * t) * (A * std::cos(w * t) + B * std::sin(w * t)));
  };
  const auto N_rate = [&](double t) {
    return kn * std::exp(-b * t) * (speed * std::cos(w * t) - (A * w + b * B) * std::sin(w * t));
  };
  const auto N_by_gap = [&](double t) {
    return kn * (1.0 - kn / k * (1.0 - std::exp(-b * t) * (std::cos(w * t) + b / w * std::sin(w * t))));
  };
  const double turn = std::atan2(-speed, -(A * w + b * B)) / w;
  double open = 3.0 * turn;
  for (int i = 0; i < 10; ++i) open -= N(open) / N_rate(open);
  REQUIRE(std::abs(N(open)) < 1e-13);
  REQUIRE(s.events.size() == 1);
  CHECK(s.events[0].to == State::open);
  CHECK(s.events[0].t == doctest::Approx(open).epsilon(1e-11));
  CHECK(s.event_rates[0][0].t == doctest::Approx(-N_by_gap(open) / N_rate(open)).epsilon(1e-9));
  const auto column =
      static_cast<std::size_t>(std::find(s.columns.begin(), s.columns.end(), "c.N") - s.columns.begin());
  REQUIRE(column < s.columns.size());
  int closed = 0;
  for (std::size_t i = 0; i < s.times.size(); ++i) {
    const double t = s.times[i];
    if (t >= open) continue;
    CAPTURE(t);
    ++closed;
    CHECK(s.values[i][column] == doctest::Approx(N(t)).epsilon(1e-11));
    CHECK(s.value_rates[0][i][column] == doctest::Approx(N_by_gap(t)).epsilon(1e-9));
  }
  CHECK(closed > 4);
  const auto peak = std::find_if(s.responses.begin(), s.responses.end(),
                                 [](const Response& r) { return r.name == "peak N"; });
  REQUIRE(peak != s.responses.end());
  CHECK(peak->t == doctest::Approx(turn).epsilon(1e-8));
  CHECK(peak->value == doctest::Approx(N(turn)).epsilon(1e-11));
  CHECK(peak->rates[0] == doctest::Approx(N_by_gap(turn)).epsilon(1e-9));
}

TEST_SUITE_END();

}  // namespace signorini::tests::modal_stretches
