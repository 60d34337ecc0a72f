// A first event after some thousand swings: rounding of all steps of the way is in its time, and the bound knows of it.
// Two masses on springs of their own swing along one line, and a rigid contact closes late between them:
//   g(t) = gap + a2 cos w2 t - a1 cos w1 t,   its first zero by Newton's method in long double
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "base/rounding.hpp"
#include "signorini/certify.hpp"
#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

struct SwungMass {
  double ux, uy, mass, k;
};
/// dx, dy: the line; t_end: half a second after the event.
struct LongSwing {
  double t_end, dx, dy, gap;
  SwungMass a, b;
};

// Random scenes of up to 7000 s; the gap is some 1e-7 less than both amplitudes, so that it closes slowly and late.
constexpr LongSwing long_swings[] = {
    {279.306357015764,
     1.0,
     0.0,
     1.444111523585427,
     {-0.6621234337591477, 0.0, 0.6601155462242183, 932.1932034183925},
     {0.7819886735842458, 0.0, 1.6234473820766073, 44.95381482304831}},
    {1147.4560008132328,
     0.6967067093471654,
     0.7173560908995228,
     1.1143787222620916,
     {-0.3592839033895045, -0.3699325598573918, 1.9977634180636648, 68.31975791660177},
     {0.41711303157218604, 0.4294756599548886, 0.9645050802145085, 612.0727661744969}},
    {6959.918562472728,
     1.0,
     0.0,
     1.0742074886278106,
     {-0.502450639283462, 0.0, 1.6006027644692733, 74.35904673034226},
     {0.5717591801135624, 0.0, 1.3457659318890942, 824.1708710221368}},
    {195.3309144541711,
     0.6967067093471654,
     0.7173560908995228,
     1.4354879845067503,
     {-0.49903751699665266, -0.51382826891443, 0.6881381036083012, 876.2381617221748},
     {0.5010781691939101, 0.5159294030982559, 0.9782203784492987, 33.14637267352336}},
};

std::string swing_scene(const LongSwing& s) {
  std::string text = fmt::format(
      "schema = 1\nunits = {{ force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }}\n"
      "[run]\nt_end = {0:.17g}\noutput_dt = {0:.17g}\nengine = \"exact\"\n"
      "initial = {{ a = {{ ux = {1:.17g}, uy = {2:.17g} }}, b = {{ ux = {3:.17g}, uy = {4:.17g} }} }}\n"
      "[nodes]\na = [0.0, 0.0]\nb = [{5:.17g}, {6:.17g}]\n",
      s.t_end, s.a.ux, s.a.uy, s.b.ux, s.b.uy, s.dx, s.dy);
  for (const auto& [name, own] : {std::pair("a", s.a), std::pair("b", s.b)}) {
    text += fmt::format("[[masses]]\nnode = \"{}\"\nmass = {:.17g}\n", name, own.mass);
    for (const auto& [x, y] : {std::pair(s.dx, s.dy), std::pair(-s.dy, s.dx)})
      text += fmt::format("[[springs]]\nnode = \"{}\"\ndirection = [{:.17g}, {:.17g}]\nstiffness = {:.17g}\n",
                          name, x, y, own.k);
  }
  return text + fmt::format(
                    "[[contacts]]\nname = \"c\"\nnode = \"b\"\nagainst = \"a\"\nlaw = \"rigid\"\n"
                    "normal = [{:.17g}, {:.17g}]\ngap = {:.17g}\nrestitution = 0.7\n",
                    s.dx, s.dy, s.gap);
}

/// The zero of g near t.
long double closing_time(const LongSwing& s, double t) {
  const long double length = std::hypot(static_cast<long double>(s.dx), static_cast<long double>(s.dy));
  const auto along = [&](const SwungMass& m) { return (1.0L * m.ux * s.dx + 1.0L * m.uy * s.dy) / length; };
  const long double a1 = along(s.a), a2 = along(s.b);
  const long double w1 = std::sqrt(1.0L * s.a.k / s.a.mass), w2 = std::sqrt(1.0L * s.b.k / s.b.mass);
  long double x = t;
  for (int i = 0; i < 6; ++i)
    x -= (s.gap + a2 * std::cos(w2 * x) - a1 * std::cos(w1 * x)) /
         (a1 * w1 * std::sin(w1 * x) - a2 * w2 * std::sin(w2 * x));
  return x;
}

/// A mass on a spring, carried by a belt: it sticks until the spring holds it, slips back and sticks again.
struct Belt {
  double mass, k, compression, fs, fk, v;

  [[nodiscard]] long double period() const {
    const long double w = std::sqrt(1.0L * k / mass), a = (1.0L * fs - fk) * compression / k;
    return 2.0L * (std::numbers::pi_v<long double> - std::atan(a * w / v)) / w + 2.0L * a / v;
  }
  [[nodiscard]] std::string text(double t_end) const {
    return fmt::format(
        "schema = 1\nunits = {{ force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }}\n"
        "[run]\nt_end = {0:.17g}\noutput_dt = {0:.17g}\nengine = \"exact\"\n"
        "[nodes]\na = [0.0, 0.0]\n[[masses]]\nnode = \"a\"\nmass = {1:.17g}\n"
        "[[supports]]\nnode = \"a\"\nfix = [\"uy\"]\n"
        "[[springs]]\nnode = \"a\"\ndirection = [1.0, 0.0]\nstiffness = {2:.17g}\n"
        "[[contacts]]\nname = \"b\"\nnode = \"a\"\nlaw = \"slider\"\ntangent = [1.0, 0.0]\nnormal_force = "
        "{3:.17g}\n"
        "friction = {{ static = {4:.17g}, kinetic = {5:.17g} }}\nsurface_velocity = {6:.17g}\n",
        t_end, mass, k, compression, fs, fk, v);
  }
};

constexpr Belt belts[] = {{1.0, 4.0, 10.0, 0.5, 0.3, 0.2},
                          {0.37, 11.0, 7.0, 0.62, 0.41, 0.13},
                          {2.9, 1.7, 3.3, 0.81, 0.44, 0.07},
                          {0.053, 23.0, 1.9, 0.33, 0.2, 0.31},
                          {1.3, 0.9, 12.0, 0.27, 0.19, 1.1}};

}  // namespace

TEST_SUITE_BEGIN("behaviour/rounding/long_motion");

TEST_CASE("slips of belts keep their period over a thousand periods, and lie within their certified errors") {
  for (const Belt& belt : belts)
    for (const char* flow : {"taylor", "modal"}) {
      CAPTURE(belt.v);
      CAPTURE(std::string(flow));
      const auto t_end = static_cast<double>(1000.0L * belt.period());
      const Scene scene =
          parse_scene(belt.text(t_end), "test.toml", {{"run.flow", flow}, {"run.certify", "true"}});
      Result rows;
      const CertifiedReport run = simulate_certified(build_model(scene), scene.run, rows);
      REQUIRE(run.certificate);
      std::optional<double> first;
      long slips = 0, outside = 0, certain = 0;
      long double drift = 0.0L;
      for (std::size_t i = 0; i < rows.events.size(); ++i) {
        const Event& e = rows.events[i];
        if (e.type != EventType::slip || e.from != State::stick) continue;
        if (!first) first = e.t;
        const long double off = std::abs(e.t - (*first + static_cast<long double>(slips++) * belt.period()));
        drift = std::max(drift, off);
        if (!run.certificate->certain(i)) continue;
        ++certain;
        if (off > run.certificate->t_errors[i] + run.certificate->t_errors[0]) ++outside;
      }
      CHECK(slips >= 998);
      CHECK(certain == slips);
      CHECK(outside == 0);
      // In periods of one length each rounding of the time has the same sign: if it were not carried on, the first belt would be
      // 9e-11 s off at the end. The others also have roundings of one sign within their periods.
      if (&belt == belts) CHECK(drift <= rounding::few_operations * t_end);
    }
}

TEST_CASE("the rounding of a long way is within the certified error of the event at its end") {
  for (const LongSwing& swing : long_swings)
    for (const char* flow : {"taylor", "modal"}) {
      CAPTURE(swing.t_end);
      CAPTURE(flow);
      const Scene scene =
          parse_scene(swing_scene(swing), "test.toml", {{"run.flow", flow}, {"run.certify", "true"}});
      const Model model = build_model(scene);
      Result rows;
      const CertifiedReport run = simulate_certified(model, scene.run, rows);
      REQUIRE(!rows.events.empty());
      REQUIRE(run.certificate);
      if (!run.certificate->certain(0)) continue;  // then nothing is said that could be wrong
      const double t = rows.events[0].t;
      const double off = static_cast<double>(std::abs(closing_time(swing, t) - t));
      CHECK(off <= run.certificate->t_errors[0]);
      CHECK(run.certificate->t_errors[0] < 1e-7);
    }
}

TEST_SUITE_END();
