// A first event after some thousand swings: rounding of all steps of the way is in its time, and the bound knows of it.
// Two masses on springs of their own swing along one line, and a rigid contact closes late between them:
//   g(t) = gap + a2 cos w2 t - a1 cos w1 t,   its first zero by Newton's method in long double
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <string>

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

}  // namespace

TEST_SUITE_BEGIN("behaviour/rounding/long_motion");

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
