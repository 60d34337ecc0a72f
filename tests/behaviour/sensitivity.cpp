// Derivatives of runs against closed forms, and against differences of `exact` where there is none.
#include "signorini/sensitivity.hpp"

#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "behaviour/one_mass.hpp"

using namespace signorini;
using namespace signorini::tests;

namespace {

/// With `exact`, unless the text names an engine.
SceneReader reader_of_text(const std::string& text) {
  return [text](const std::vector<Override>& changes) {
    std::vector<Override> all;
    if (text.find("engine = ") == std::string::npos) all.push_back({"run.engine", "exact"});
    all.insert(all.end(), changes.begin(), changes.end());
    return parse_scene(text, "test.toml", all);
  };
}

Sensitivities rates_of(const std::string& text, const std::vector<std::string>& paths) {
  return sensitivities(reader_of_text(text), paths);
}

Sensitivities rates_of_model(const std::string& name, const std::vector<std::string>& paths,
                             std::vector<Override> changes = {}) {
  changes.insert(changes.begin(), {"run.engine", "exact"});
  return sensitivities(reader_of(std::string(SIGNORINI_MODELS) + "/" + name + ".toml", std::move(changes)),
                       paths);
}

const Response& figure(const Sensitivities& s, const std::string& name, int contact = 0) {
  for (const Response& r : s.responses)
    if (r.name == name && r.contact == contact) return r;
  REQUIRE_MESSAGE(false, name);
  return s.responses.front();
}

/// Within 1e-11 of what it is, or of one.
void check_rate(double found, double expected) {
  CAPTURE(found);
  CAPTURE(expected);
  CHECK(std::abs(found - expected) <= 1e-11 * std::max(1.0, std::abs(expected)));
}

Result run_exact(const SceneReader& read, const Override& change) {
  Scene scene = read({change});
  scene.run.engine = Engine::exact;
  scene.run.flow = Flow::taylor;
  return simulate(build_model(scene), scene.run);
}

/// A ball of 1 kg that falls under 10 N.
std::string ball(const std::string& contact, const std::string& run = "t_end = 3.0") {
  return matrix_scene(run + "\ninitial = { u = [1.0], v = [0.0] }", "mass = [[1.0]]\nstiffness = [[0.0]]",
                      "law = \"rigid\"\nnormal = { d0 = 1.0 }\n" + contact,
                      "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = -10.0\n");
}

/// A block on springs of 4 N/m that a slider of 1 N rubs: turns at k pi/omega, omega = 2.
std::string oscillator(const std::string& contact, const std::string& rest = "") {
  return matrix_scene("t_end = 12.0\noutput_dt = 3.0\ninitial = { u = [1.03], v = [0.0] }",
                      "mass = [[1.0]]\nstiffness = [[4.0]]",
                      "law = \"slider\"\ntangent = { d0 = 1.0 }\n" + contact, rest);
}

/// Every derivative of every event against differences of fourth order; in parts of the greatest of its
/// column.
void check_differences(const SceneReader& read, const std::string& path, double part,
                       double relative = 2e-4) {
  CAPTURE(path);
  const Sensitivities s = sensitivities(read, {path});
  const double p = s.parameters[0].value;
  const double h = relative * (p != 0.0 ? std::abs(p) : 1.0);
  CAPTURE(s.parameters[0].reason);
  std::vector<Result> runs;
  for (const int k : {-2, -1, 1, 2})
    runs.push_back(run_exact(read, {path, fmt::format("{:.17g}", p + k * h)}));
  for (const Result& run : runs) REQUIRE(run.events.size() == s.events.size());
  const auto difference = [&](auto value) {
    return (8.0 * (value(runs[2]) - value(runs[1])) - (value(runs[3]) - value(runs[0]))) / (12.0 * h);
  };
  double greatest = 0.0;
  for (const auto& row : s.event_rates) greatest = std::max(greatest, std::abs(row[0].t));
  for (std::size_t i = 0; i < s.events.size(); ++i) {
    CAPTURE(i);
    const EventRates& rates = s.event_rates[i][0];
    CHECK(std::abs(rates.t - difference([&](const Result& r) { return r.events[i].t; })) <= part * greatest);
    if (s.events[i].contact < 0) continue;
    for (const auto& [mine, theirs] :
         {std::pair{&EventRates::N, &Event::N}, std::pair{&EventRates::T, &Event::T},
          std::pair{&EventRates::N_after, &Event::N_after}, std::pair{&EventRates::T_after, &Event::T_after},
          std::pair{&EventRates::vn, &Event::vn}, std::pair{&EventRates::vt, &Event::vt},
          std::pair{&EventRates::vn_after, &Event::vn_after},
          std::pair{&EventRates::vt_after, &Event::vt_after}}) {
      double size = 0.0;
      for (const auto& row : s.event_rates)
        if (std::isfinite(row[0].*mine)) size = std::max(size, std::abs(row[0].*mine));
      const double expected = difference([&](const Result& r) { return r.events[i].*theirs; });
      CHECK(std::abs(rates.*mine - expected) <= part * std::max(size, 1e-3));
    }
  }
  REQUIRE(s.times.size() == runs[0].rows.size());
  for (std::size_t i = 0; i < s.times.size(); ++i) {
    const double expected = difference([&](const Result& r) { return r.rows[i].contacts[0].ut; });
    const auto column =
        std::find(s.columns.begin(), s.columns.end(), s.contacts[0] + ".ut") - s.columns.begin();
    const double found = s.value_rates[0][i][static_cast<std::size_t>(column)];
    CHECK(std::abs(found - expected) <= 10.0 * part * std::max(std::abs(expected), 1e-3));
  }
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/sensitivity");

TEST_CASE("hits of a ball: times, speeds and impulses by height, weight and restitution") {
  const double h = 1.0, g = 10.0, e = 0.5;
  const Sensitivities s = rates_of(ball("restitution = 0.5", "t_end = 1.2"),
                                   {"contacts.c.restitution", "loads.1.amplitude", "run.initial.u.1"});
  REQUIRE(s.events.size() == 3);
  const double fall = std::sqrt(2.0 * h / g), v = std::sqrt(2.0 * g * h);
  for (std::size_t i = 0; i < 3; ++i) {
    CAPTURE(i);
    // t = fall (1 + 2 e + 2 e^2 + ...),   v = v0 e^i
    double factor = 1.0, factor_e = 0.0;
    for (std::size_t k = 1; k <= i; ++k) {
      factor += 2.0 * std::pow(e, static_cast<double>(k));
      factor_e += 2.0 * static_cast<double>(k) * std::pow(e, static_cast<double>(k) - 1.0);
    }
    const double power = std::pow(e, static_cast<double>(i));
    const double power_e = i == 0 ? 0.0 : static_cast<double>(i) * std::pow(e, static_cast<double>(i) - 1.0);
    const std::vector<EventRates>& rates = s.event_rates[i];
    check_rate(rates[0].t, fall * factor_e);
    check_rate(rates[1].t, 0.5 * fall * factor / g);  // by -g
    check_rate(rates[2].t, 0.5 * fall * factor / h);
    check_rate(rates[0].vn, -v * power_e);
    check_rate(rates[0].vn_after, v * (power_e * e + power));
    check_rate(rates[2].vn_after, 0.5 * v * power * e / h);
    check_rate(rates[0].impulse_n, v * (power_e * (1.0 + e) + power));
    check_rate(rates[1].impulse_n, -0.5 * v * power * (1.0 + e) / g);
  }
}

TEST_CASE("a ball's last rebounds are captured, and what comes after rests at rest") {
  const Sensitivities s = rates_of(ball("restitution = 0.5\ncapture_velocity = 0.3"), {"run.initial.u.1"});
  REQUIRE(s.events.size() > 3);
  CHECK(s.events.back().to == State::closed);
  const EventRates& last = s.event_rates.back()[0];
  check_rate(last.t, 0.5 * s.events.back().t);  // all times go as sqrt(h)
  CHECK(last.vn_after == doctest::Approx(0.0));
  CHECK(std::abs(s.value_rates[0].back()[0]) < 1e-12);
  CHECK(s.parameters[0].reason.empty());
}

TEST_CASE("a block slips under a load that grows, when friction lets it") {
  // T = 2 t reaches 0.4 N = 4 at t = 2; the weight is 10
  const std::string text = matrix_scene(
      "t_end = 3.0\ninitial = { u = [0.0, 0.0], v = [0.0, 0.0] }",
      "mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[0.0, 0.0], [0.0, 0.0]]",
      "law = \"rigid\"\nnormal = { d1 = 1.0 }\ntangent = { d0 = 1.0 }\nfriction = { static = 0.4, kinetic = "
      "0.3 }",
      "[[loads]]\ndirection = { d1 = 1.0 }\namplitude = -10.0\n[[loads]]\ndirection = { d0 = 1.0 "
      "}\namplitude = 2.0\n"
      "history = { type = \"polynomial\", coefficients = [0.0, 1.0], start = 0.5, end = 100.0 }\n");
  const Sensitivities s = rates_of(text, {"contacts.c.friction.static", "contacts.c.friction.kinetic",
                                          "loads.2.amplitude", "loads.1.amplitude", "loads.2.history.start"});
  REQUIRE(s.events.size() == 1);
  CHECK(s.events[0].t == doctest::Approx(2.5));
  const std::vector<EventRates>& rates = s.event_rates[0];
  check_rate(rates[0].t, 10.0 / 2.0);
  check_rate(rates[1].t, 0.0);
  check_rate(rates[2].t, -2.0 / 2.0);
  check_rate(rates[3].t, -0.4 / 2.0);
  check_rate(rates[4].t, 1.0);
  // u = int int 2 s - 3 over s = t - 0.5 from 2 to 2.5: slip at the end
  const double a = 2.0, b = 2.5;  // of s
  const double slid = (b * b * b - a * a * a) / 3.0 - a * a * (b - a) - 1.5 * (b - a) * (b - a);
  CHECK(figure(s, "rest slip").value == doctest::Approx(slid));
  check_rate(figure(s, "rest slip").rates[1], -5.0 * (b - a) * (b - a));
  // by the static coefficient: the beginning moves by 5, du/da = -2 a (b - a) + 10 fk (b - a)
  check_rate(figure(s, "rest slip").rates[0], 5.0 * (-2.0 * a * (b - a) + 3.0 * (b - a)));
  // by the start: what is left of the time
  check_rate(figure(s, "rest slip").rates[4], -(b * b - a * a - 3.0 * (b - a)));
}

TEST_CASE("turns of a rubbed oscillator: times by stiffness, what is left by friction") {
  const Sensitivities s =
      rates_of_model("coulomb-pad", {"contacts.pad.friction", "springs.1.stiffness", "masses.1.mass",
                                     "contacts.pad.normal_force", "run.initial.block.ux"});
  REQUIRE(s.events.size() == 4);
  const double k = 1e4, f = 0.1, N = 10.0;
  for (std::size_t i = 0; i < 4; ++i) {
    CAPTURE(i);
    const double t = s.events[i].t;
    check_rate(s.event_rates[i][0].t, 0.0);
    check_rate(s.event_rates[i][1].t, -0.5 * t / k);
    check_rate(s.event_rates[i][2].t, 0.5 * t);
    check_rate(s.event_rates[i][3].t, 0.0);
    check_rate(s.event_rates[i][4].t * 0.85e-3, 0.0);
  }
  const Response& rest = figure(s, "rest tangential");
  CHECK(rest.value == doctest::Approx(0.05e-3));
  check_rate(rest.rates[0], -8.0 * N / k);
  check_rate(rest.rates[1], 8.0 * f * N / (k * k));
  check_rate(rest.rates[2], 0.0);
  check_rate(rest.rates[3], -8.0 * f / k);
  check_rate(rest.rates[4], 1.0);
}

TEST_CASE("rows at output times between events: a free oscillator") {
  const Sensitivities s = rates_of(oscillator("normal_force = 0.0\nfriction = 0.1"), {"run.initial.u.1"});
  REQUIRE(s.times.size() == 5);
  for (std::size_t i = 0; i < s.times.size(); ++i) {
    check_rate(s.value_rates[0][i][0], std::cos(2.0 * s.times[i]));
    check_rate(s.values[i][0], 1.03 * std::cos(2.0 * s.times[i]));
  }
}

TEST_CASE("the pipeline by friction: event times that differences of `exact` gave") {
  const Sensitivities s = rates_of_model("pipeline", {"contacts.*.friction"});
  REQUIRE(s.events.size() == 251);
  // central differences, plateau of their steps: docs/theory.md (Sensitivities)
  CHECK(std::abs(s.event_rates.front()[0].t - 6.4399031e-4) <= 1e-10);
  CHECK(std::abs(s.event_rates.back()[0].t + 2.12704e-2) <= 1e-6 * 2.12704e-2 + 5e-8);
  double greatest = 0.0;
  for (const auto& rates : s.event_rates) greatest = std::max(greatest, std::abs(rates[0].t));
  CHECK(std::abs(greatest - 0.189) < 1e-3);
}

TEST_CASE("the pipeline in modes, along the series and with `ida`: the same derivatives") {
  const std::vector<std::string> paths{"contacts.*.friction",
                                       "loads.1.amplitude",
                                       "gravity.2",
                                       "sections.pipe.EI",
                                       "sections.pipe.mass_per_length",
                                       "contacts.first.normal_stiffness",
                                       "contacts.second.tangential_stiffness",
                                       "nodes.D.1",
                                       "damping.alpha_over_omega1",
                                       "loads.1.history.end"};
  const auto with = [&](const std::string& engine, const std::string& flow) {
    return rates_of_model("pipeline", paths,
                          {{"run.engine", engine},
                           {"run.flow", flow},
                           {"run.rtol", "1e-10"},
                           {"run.t_end", "0.19"},
                           {"run.output_dt", "0.01"}});
  };
  const Sensitivities modes = with("exact", "modal"), series = with("exact", "taylor"),
                      ida = with("ida", "auto");
  std::size_t peaks = 0;
  const auto agree = [&](const Sensitivities& a, double part) {
    REQUIRE(a.events.size() == series.events.size());
    for (std::size_t p = 0; p < paths.size(); ++p) {
      CAPTURE(paths[p]);
      double greatest = 0.0;
      for (const auto& rates : series.event_rates) greatest = std::max(greatest, std::abs(rates[p].t));
      CHECK(greatest > 0.0);
      for (std::size_t i = 0; i < a.events.size(); ++i)
        CHECK(std::abs(a.event_rates[i][p].t - series.event_rates[i][p].t) <= part * greatest);
      REQUIRE(a.value_rates[p].size() == series.value_rates[p].size());
      for (std::size_t i = 0; i < series.times.size(); ++i)
        for (std::size_t c = 0; c < series.columns.size(); ++c) {
          double size = 0.0;
          for (const auto& row : series.value_rates[p]) size = std::max(size, std::abs(row[c]));
          CHECK(std::abs(a.value_rates[p][i][c] - series.value_rates[p][i][c]) <= part * size);
        }
      REQUIRE(a.responses.size() == series.responses.size());
      for (std::size_t i = 0; i < a.responses.size(); ++i) {
        CAPTURE(a.responses[i].name);
        const Response &found = a.responses[i], &expected = series.responses[i];
        // a modal flow sees turns of what is slow: another crest of a ripple may be its peak
        if (std::abs(found.t - expected.t) > 1e-7) continue;
        ++peaks;
        CHECK(found.rates[p] == doctest::Approx(expected.rates[p]).epsilon(1e2 * part));
      }
    }
  };
  agree(modes, 1e-7);
  CHECK(peaks > 6 * paths.size());
  agree(ida, 1e-5);  // what w inherits from the states of the run; at rtol 1e-8 up to 2.5e-4
}

TEST_CASE("friction that depends on the slip rate, by its constants and by the belt, against differences") {
  const SceneReader belt = reader_of_text(matrix_scene(
      "t_end = 20.0\noutput_dt = 5.0\nengine = \"ida\"\nrtol = 1e-10\ninitial = { u = [0.0], v = [0.0] }",
      "mass = [[1.0]]\nstiffness = [[1.0]]",
      "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 1.0\nsurface_velocity = 0.3\n"
      "friction = { static = 0.6, kinetic = 0.4, stribeck_velocity = 0.5 }"));
  for (const char* path :
       {"contacts.c.friction.static", "contacts.c.friction.kinetic", "contacts.c.friction.stribeck_velocity",
        "contacts.c.surface_velocity", "contacts.c.normal_force"}) {
    CAPTURE(path);
    const Sensitivities s = sensitivities(belt, {path});
    CAPTURE(s.parameters[0].reason);
    const double p = s.parameters[0].value, h = 1e-3 * p;
    std::vector<Result> runs;
    for (const int k : {-2, -1, 1, 2}) {
      const Scene scene = belt({{path, fmt::format("{:.17g}", p + k * h)}});
      runs.push_back(simulate(build_model(scene), scene.run));
      REQUIRE(runs.back().events.size() == s.events.size());
    }
    REQUIRE(s.events.size() > 4);
    for (std::size_t i = 0; i < s.events.size(); ++i) {
      CAPTURE(i);
      const auto t = [&](std::size_t run) { return runs[run].events[i].t; };
      const double expected = (8.0 * (t(2) - t(1)) - (t(3) - t(0))) / (12.0 * h);
      CHECK(std::abs(s.event_rates[i][0].t - expected) <= 1e-6 * std::max(1.0, std::abs(expected)));
    }
  }
}

TEST_CASE("data of the pipeline that move its matrices and its static start, against differences") {
  const std::vector<Override> shorter{
      {"run.engine", "exact"}, {"run.t_end", "0.01"}, {"run.output_dt", "0.01"}};
  const SceneReader read = reader_of(std::string(SIGNORINI_MODELS) + "/pipeline.toml", shorter);
  check_differences(read, "sections.pipe.EI", 1e-7, 1e-5);
  check_differences(read, "contacts.first.normal_stiffness", 1e-7, 1e-5);
  check_differences(read, "nodes.D.1", 1e-5, 1e-5);
  check_differences(read, "nodes.D.2", 1e-5,
                    1e-5);  // forms have entries beside its value that they lack at it
  check_differences(read, "gravity.2", 1e-7, 1e-5);
  check_differences(read, "damping.alpha_over_omega1", 1e-6, 1e-3);
}

TEST_CASE(
    "impacts with friction, elements with dashpots, shear elements and jumps of friction, against "
    "differences") {
  const std::string foot = "law = \"rigid\"\nrestitution = 0.4\nfriction = 0.3\ncapture_velocity = 0.01\n";
  const std::string plane =
      "mass = [[2.0, 0.0, 0.0], [0.0, 0.7, 0.0], [0.0, 0.0, 2.0]]\nstiffness = [[0.0, 0.0, 0.0], "
      "[0.0, 0.0, 0.0], [0.0, 0.0, 3.0]]";
  // a tilted bar falls on its feet while it moves sideways
  const SceneReader bar = reader_of_text(matrix_scene(
      "t_end = 0.4\noutput_dt = 0.2\ninitial = { u = [0.4, 0.11, 0.0], v = [0.0, 0.0, 0.5] }", plane,
      foot +
          "normal = { d0 = 1.0, d1 = 1.0 }\ntangent = { d2 = 1.0, d1 = 0.2 }\n[[contacts]]\nname = \"b\"\n" +
          foot + "normal = { d0 = 1.0, d1 = -1.0 }\ntangent = { d2 = 1.0, d1 = 0.2 }",
      "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = -20.0\n"));
  for (const char* path : {"contacts.*.friction", "contacts.c.restitution", "loads.1.amplitude",
                           "run.initial.v.3", "contacts.b.gap"})
    check_differences(bar, path, 1e-8);
  // a block that is shaken on an element with dashpots
  const auto element = [](const std::string& more) {
    return reader_of_text(matrix_scene(
        "t_end = 1.2\noutput_dt = 0.4\ninitial = { u = [0.0, 0.002], v = [0.0, 0.0] }",
        "mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[40.0, 0.0], [0.0, 0.0]]",
        "law = \"compliant\"\nnormal = { d1 = 1.0 }\ntangent = { d0 = 1.0 }\nnormal_stiffness = 4000.0\n"
        "tangential_stiffness = 3000.0\n" +
            more,
        "[[loads]]\ndirection = { d1 = 1.0 }\namplitude = -10.0\n[[loads]]\ndirection = { d0 = 1.0 "
        "}\namplitude = 6.0\n"
        "history = { type = \"harmonic\", omega = 7.0 }\n"));
  };
  for (const char* path : {"contacts.c.friction.static", "contacts.c.friction.kinetic",
                           "contacts.c.tangential_stiffness", "loads.2.history.omega"})
    check_differences(element("friction = { static = 0.4, kinetic = 0.3 }"), path, 1e-8);
  for (const char* path : {"contacts.c.normal_damping", "contacts.c.friction", "contacts.c.normal_stiffness"})
    check_differences(element("friction = 0.3\nnormal_damping = 12.0"), path, 1e-8);
  for (const char* path : {"contacts.c.tangential_damping", "contacts.c.friction"})
    check_differences(element("friction = 0.3\ntangential_damping = 5.0"), path, 1e-8);
}

TEST_CASE("a mass on a belt: speed of the surface, static friction above kinetic") {
  const SceneReader belt = reader_of_text(
      matrix_scene("t_end = 20.0\noutput_dt = 5.0\ninitial = { u = [0.0], v = [0.0] }",
                   "mass = [[1.0]]\nstiffness = [[1.0]]",
                   "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 1.0\nsurface_velocity = 0.3\n"
                   "friction = { static = 0.6, kinetic = 0.4 }"));
  for (const char* path : {"contacts.c.surface_velocity", "contacts.c.friction.static",
                           "contacts.c.friction.kinetic", "contacts.c.normal_force"})
    check_differences(belt, path, 1e-8);
}

TEST_CASE("where derivatives from both sides differ there is none, and the reason is said") {
  // at the crest of its swing the mass comes as near as the gap is wide
  const auto swing = [](const std::string& gap) {
    return matrix_scene("t_end = 4.0\ninitial = { u = [1.0], v = [0.0] }",
                        "mass = [[1.0]]\nstiffness = [[1.0]]",
                        "law = \"compliant\"\nnormal_stiffness = 2.0\nnormal = { d0 = 1.0 }\ngap = " + gap);
  };
  const Sensitivities clear = rates_of(swing("0.9"), {"contacts.c.gap"});
  REQUIRE(clear.events.size() == 2);
  // cos t = -0.9
  check_rate(clear.event_rates[0][0].t, 1.0 / std::sin(std::acos(-0.9)));
  CHECK(clear.parameters[0].reason.empty());
  const Sensitivities graze = rates_of(swing("0.99999999999999"), {"contacts.c.gap"});
  if (!graze.events.empty()) {
    CHECK(graze.parameters[0].reason.find("grazes") != std::string::npos);
    CHECK(std::isnan(graze.event_rates[0][0].t));
  }
  // it rests on the ground without weight: lifted by one sign of the gap, pressed by the other
  const Sensitivities kink = rates_of(
      matrix_scene("t_end = 1.0\ninitial = { u = [0.0], v = [0.0] }", "mass = [[1.0]]\nstiffness = [[4.0]]",
                   "law = \"rigid\"\nnormal = { d0 = 1.0 }\ngap = 0.0"),
      {"run.initial.v.1"});
  CHECK(kink.parameters[0].until == 0.0);
  CHECK(kink.parameters[0].reason.find("both sides") != std::string::npos);
}

TEST_CASE(
    "two masses that hit at one instant: each time has its own derivative, unless they act on each other") {
  const std::string twice = "law = \"rigid\"\nrestitution = 0.5\n";
  const auto pair = [&](const std::string& mass) {
    return matrix_scene(
        "t_end = 0.8\ninitial = { u = [1.0, 1.0], v = [0.0, 0.0] }",
        "mass = " + mass + "\nstiffness = [[0.0, 0.0], [0.0, 0.0]]",
        twice + "normal = { d0 = 1.0 }\n[[contacts]]\nname = \"b\"\n" + twice + "normal = { d1 = 1.0 }",
        "[[loads]]\ndirection = { d0 = 1.0, d1 = 1.0 }\namplitude = -10.0\n");
  };
  const Sensitivities same =
      rates_of(pair("[[1.0, 0.0], [0.0, 1.0]]"), {"loads.1.amplitude", "run.initial.u.1"});
  REQUIRE(same.events.size() == 2);
  CAPTURE(same.parameters[1].reason);
  check_rate(same.event_rates[0][0].t, 0.5 * same.events[0].t / 10.0);
  check_rate(same.event_rates[1][0].t, 0.5 * same.events[1].t / 10.0);
  CHECK(same.parameters[0].reason.empty());
  CHECK(same.parameters[1].reason.find("which is first") != std::string::npos);
  const Sensitivities coupled =
      rates_of(pair("[[1.0, 0.2], [0.2, 1.0]]"), {"loads.1.amplitude", "run.initial.u.1"});
  REQUIRE(coupled.events.size() == 2);
  CAPTURE(coupled.parameters[1].reason);
  check_rate(coupled.event_rates[1][0].t, 0.5 * coupled.events[1].t / 10.0);
  CHECK(coupled.parameters[1].reason.find("which is first") != std::string::npos);
  CHECK(std::isnan(coupled.event_rates[0][1].t));
}

TEST_CASE("the least changes at which neighbours meet, and keys that are refused") {
  const std::string text = oscillator("normal_force = 1.0\nfriction = 0.4");
  const Sensitivities s = rates_of(text, {"run.initial.u.1", "contacts.c.friction"});
  for (const Swap& swap : least_swaps(s)) {
    const double apart = s.events[swap.second].t - s.events[swap.first].t;
    const double first = s.event_rates[swap.first][swap.parameter].t,
                 second = s.event_rates[swap.second][swap.parameter].t;
    CHECK(apart + swap.change * (second - first) == doctest::Approx(0.0));
  }
  CHECK_THROWS_WITH_AS(rates_of(text, {"run.t_end"}), "--parameter run.t_end: it is no datum of the motion",
                       UsageError);
  CHECK_THROWS_AS(rates_of(text, {"contacts.c.name"}), UsageError);
  CHECK_THROWS_AS(rates_of(text, {"contacts.d.friction"}), UsageError);
  CHECK_THROWS_AS(rates_of(oscillator("normal_force = 1.0\nfriction = { static = 0.4, kinetic = 0.3 }"),
                           {"contacts.c.friction"}),
                  UsageError);
  CHECK_THROWS_AS(rates_of(oscillator("normal_force = 1.0\nfriction = { static = 0.4, kinetic = 0.3, "
                                      "stribeck_velocity = 0.1 }"),
                           {"contacts.c.friction"}),
                  UsageError);
}
