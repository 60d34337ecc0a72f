#include "signorini/history.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "base/history/pieces.hpp"
#include "scene/history_from_spec.hpp"

using namespace signorini;

namespace {

constexpr double pi = 3.14159265358979323846;

HistorySpec spec(HistoryType type, double start, double end) {
  HistorySpec s;
  s.type = type;
  s.start = start;
  s.end = end;
  s.start_given = true;
  return s;
}

HistorySpec table_spec(std::vector<double> times, std::vector<double> values, bool steffen = false) {
  HistorySpec s;
  s.type = HistoryType::table;
  s.times = std::move(times);
  s.values = std::move(values);
  s.steffen = steffen;
  return s;
}

std::vector<HistorySpec> every_type() {
  HistorySpec harmonic = spec(HistoryType::harmonic, 0.2, 1.3);
  harmonic.omega = 7.0;
  harmonic.phase = 0.4;
  HistorySpec polynomial = spec(HistoryType::polynomial, 0.1, 1.5);
  polynomial.coefficients = {1.0, -2.0, 0.5, 3.0};
  std::vector<HistorySpec> all{HistorySpec{},
                               spec(HistoryType::constant, 0.3, 0.9),
                               spec(HistoryType::step, 0.3, HUGE_VAL),
                               spec(HistoryType::rectangle, 0.3, 0.9),
                               spec(HistoryType::triangle, 0.3, 0.9),
                               spec(HistoryType::half_sine, 0.3, 0.9),
                               harmonic,
                               polynomial,
                               table_spec({0.0, 0.5, 0.5, 1.0, 1.4}, {1.0, 2.0, -1.0, 0.5, 0.5}),
                               table_spec({0.0, 0.3, 0.5, 1.0, 1.4}, {1.0, 2.0, -1.0, 0.5, 0.5}, true)};
  for (HistorySpec& s : all) {
    s.offset = 0.7;
    s.amplitude = -1.6;
  }
  return all;
}

double at(HistorySpec s, double t) { return scene::make_history(s, "h").value(t); }

}  // namespace

TEST_SUITE("unit/base/history/history") {
  TEST_CASE("a piece's derivatives are the limits of differences") {
    Piece p;
    p.origin = 0.3;
    p.coefficients = {1.0, -2.0, 0.5, 3.0, -0.7};
    p.amplitude = 1.7;
    p.omega = 2.3;
    p.phase = 0.4;
    for (int order = 0; order < 6; ++order)
      for (double t : {-1.0, 0.3, 0.8, 2.0}) {
        const double h = 1e-5;
        const double difference = (p.value(t + h, order) - p.value(t - h, order)) / (2.0 * h);
        CHECK(p.value(t, order + 1) == doctest::Approx(difference).epsilon(1e-7).scale(100.0));
      }
  }

  TEST_CASE("the integral's derivative is the history, for every type") {
    for (const HistorySpec& s : every_type()) {
      CAPTURE(static_cast<int>(s.type));
      const History f = scene::make_history(s, "h"), integral = f.integrated();
      CHECK(integral.value(0.0) == doctest::Approx(0.0));
      for (double t : {-0.45, 0.05, 0.15, 0.3, 0.45, 0.55, 0.7, 0.95, 1.05, 1.35, 2.0})
        CHECK(integral.piece(t).value(t, 1) == doctest::Approx(f.value(t)).epsilon(1e-13));
      for (const Breakpoint& b : integral.breakpoints()) CHECK_FALSE(b.jump);
    }
  }

  TEST_CASE("values of each type, right-continuous, offset everywhere") {
    CHECK(at(HistorySpec{}, -1e9) == 1.0);
    CHECK(at(spec(HistoryType::constant, 0.3, HUGE_VAL), 0.29) == 0.0);
    CHECK(at(spec(HistoryType::step, 0.3, HUGE_VAL), 0.3) == 1.0);
    CHECK(at(spec(HistoryType::rectangle, 0.3, 0.9), 0.3) == 1.0);
    CHECK(at(spec(HistoryType::rectangle, 0.3, 0.9), 0.9) == 0.0);
    CHECK(at(spec(HistoryType::triangle, 0.3, 0.9), 0.6) == doctest::Approx(1.0));
    CHECK(at(spec(HistoryType::triangle, 0.3, 0.9), 0.75) == doctest::Approx(0.5));
    CHECK(at(spec(HistoryType::half_sine, 0.3, 0.9), 0.6) == doctest::Approx(1.0));
    HistorySpec harmonic = spec(HistoryType::harmonic, 1.0, HUGE_VAL);
    harmonic.omega = 2.0;
    harmonic.phase = 0.5;
    CHECK(at(harmonic, 2.0) == doctest::Approx(std::sin(2.5)));
    CHECK(at(harmonic, 0.999) == 0.0);
    HistorySpec polynomial = spec(HistoryType::polynomial, 1.0, HUGE_VAL);
    polynomial.coefficients = {1.0, 2.0, 3.0};
    CHECK(at(polynomial, 3.0) == doctest::Approx(1.0 + 4.0 + 12.0));
    HistorySpec shifted = spec(HistoryType::rectangle, 0.3, 0.9);
    shifted.offset = 5.0;
    shifted.amplitude = -2.0;
    CHECK(at(shifted, 0.0) == 5.0);
    CHECK(at(shifted, 0.5) == 3.0);
  }

  TEST_CASE("tables: linear, zero outside, a repeated time is a jump") {
    const History f = scene::make_history(table_spec({1.0, 2.0, 2.0, 4.0}, {0.0, 3.0, -1.0, 1.0}), "h");
    CHECK(f.value(0.99) == 0.0);
    CHECK(f.value(1.5) == doctest::Approx(1.5));
    CHECK(f.value(2.0) == -1.0);
    CHECK(f.piece_before(2.0).value(2.0) == doctest::Approx(3.0));
    CHECK(f.value(3.0) == doctest::Approx(0.0));
    CHECK(f.value(4.0) == 0.0);
    CHECK(f.piece_before(4.0).value(4.0) == doctest::Approx(1.0));
    const auto b = f.breakpoints();
    REQUIRE(b.size() == 3);
    CHECK_FALSE(b[0].jump);
    CHECK(b[1].jump);
    CHECK(b[2].jump);
  }

  TEST_CASE("Steffen tables meet the points, have a continuous slope and never overshoot") {
    const std::vector<double> t{0.0, 1.0, 1.5, 3.0, 4.0, 4.2}, y{0.0, 1.0, 1.0, -2.0, 0.0, 5.0};
    const History f = scene::make_history(table_spec(t, y, true), "h");
    for (std::size_t i = 0; i + 1 < t.size(); ++i) {
      CHECK(f.value(t[i]) == doctest::Approx(y[i]));
      CHECK(f.piece_before(t[i + 1]).value(t[i + 1]) == doctest::Approx(y[i + 1]));
      if (i > 0) CHECK(f.piece(t[i]).value(t[i], 1) == doctest::Approx(f.piece_before(t[i]).value(t[i], 1)));
      for (double s = 0.0; s < 1.0; s += 0.01) {
        const double value = f.value(t[i] + s * (t[i + 1] - t[i]));
        CHECK(value >= std::min(y[i], y[i + 1]) - 1e-14);
        CHECK(value <= std::max(y[i], y[i + 1]) + 1e-14);
      }
    }
  }

  TEST_CASE("a sine that ends on its zero is a kink, one that ends elsewhere a jump") {
    HistorySpec s = spec(HistoryType::harmonic, 0.0, 0.1);
    s.omega = 31.41592653589793;
    for (double amplitude : {1e-8, 1.0, 1e9}) {
      s.amplitude = amplitude;
      const auto b = scene::make_history(s, "h").breakpoints();
      REQUIRE(b.size() == 2);
      CHECK_FALSE(b[0].jump);
      CHECK_FALSE(b[1].jump);
    }
    s.end = 0.1 * (1.0 + 1e-10);
    CHECK(scene::make_history(s, "h").breakpoints()[1].jump);
    for (const Breakpoint& b :
         scene::make_history(spec(HistoryType::half_sine, 1e3, 1e3 + 0.1), "h").breakpoints())
      CHECK_FALSE(b.jump);
    CHECK(scene::make_history(spec(HistoryType::step, 0.5, HUGE_VAL), "h").breakpoints()[0].jump);
  }

  TEST_CASE("a load of amplitude zero has no breakpoints and is constant") {
    const History f = scene::make_history(spec(HistoryType::step, 0.5, HUGE_VAL), "h").scaled(0.0);
    CHECK(f.breakpoints().empty());
    CHECK(f.is_constant());
    CHECK(scene::make_history(HistorySpec{}, "h").is_constant());
    CHECK_FALSE(scene::make_history(spec(HistoryType::rectangle, 0.0, 1.0), "h").is_constant());
  }

  TEST_CASE("histories refuse what has no meaning") {
    CHECK_THROWS_AS((void)History({1.0, 1.0}, {Piece{}, Piece{}, Piece{}}), std::invalid_argument);
    CHECK_THROWS_AS((void)History({1.0}, {Piece{}}), std::invalid_argument);
    CHECK_THROWS_AS((void)scene::make_history(spec(HistoryType::rectangle, 1.0, 0.5), "h"), SceneError);
    CHECK_THROWS_AS((void)scene::make_history(table_spec({0.0, 2.0, 1.0}, {0.0, 0.0, 0.0}), "h"), SceneError);
    CHECK_THROWS_AS((void)scene::make_history(table_spec({0.0, 1.0}, {0.0}), "h"), SceneError);
  }

  TEST_CASE("size and sign of a history within the run") {
    HistorySpec s = spec(HistoryType::harmonic, 0.0, HUGE_VAL);
    s.omega = 3.0;
    s.offset = 1.0;
    s.amplitude = 0.5;
    CHECK(history::magnitude(scene::make_history(s, "h"), 100.0) == doctest::Approx(1.5));
    CHECK(history::find_negative_time(scene::make_history(s, "h"), 100.0) < 0.0);
    s.amplitude = 1.5;
    CHECK(history::find_negative_time(scene::make_history(s, "h"), 100.0) == doctest::Approx(pi / 2.0));
    s.amplitude = -1.5;
    CHECK(history::find_negative_time(scene::make_history(s, "h"), 100.0) == doctest::Approx(pi / 6.0));
    CHECK(history::find_negative_time(scene::make_history(spec(HistoryType::half_sine, 0.0, 0.3), "h"), 1.0) <
          0.0);
    CHECK(history::magnitude(scene::make_history(spec(HistoryType::triangle, 0.5, 0.6), "h"), 1.0) ==
          doctest::Approx(1.0));
  }

  TEST_CASE("the greatest impulse within a time") {
    const auto impulse = [](const History& f, double width) { return history::max_impulse(f, 10.0, width); };
    const History pulse = scene::make_history(spec(HistoryType::rectangle, 0.5, 0.75), "h").scaled(-8.0);
    CHECK(impulse(pulse, 0.1) == doctest::Approx(0.8));
    CHECK(impulse(pulse, 3.0) == doctest::Approx(2.0));
    // 2 for 1, then 1 for 4: the best time of 3 has all of the first; the best time within one piece has no end of it
    const History table = scene::make_history(table_spec({0.0, 1.0, 1.0, 5.0}, {2.0, 2.0, 1.0, 1.0}), "h");
    CHECK(impulse(table, 3.0) == doctest::Approx(4.0));
    HistorySpec s = spec(HistoryType::harmonic, 1.0, HUGE_VAL);
    s.omega = 1e-3;
    CHECK(impulse(scene::make_history(s, "h"), 1.0) == doctest::Approx(std::sin(1e-3 * 10.0)).epsilon(1e-3));
    s.omega = 3.0;
    CHECK(impulse(scene::make_history(s, "h"), 1.0) == doctest::Approx(1.0));
    // A load that has just begun when the run ends is no pulse.
    CHECK(history::max_impulse(scene::make_history(spec(HistoryType::step, 9.999, HUGE_VAL), "h"), 10.0,
                               2.0) == doctest::Approx(2.0));
    // Pulses that follow each other count together, as many as are in that time.
    HistorySpec again = spec(HistoryType::rectangle, 0.0, 0.01);
    again.period = 1.0;
    again.rounds = 10;
    CHECK(impulse(scene::make_history(again, "h"), 2.5) == doctest::Approx(0.03));
  }

  TEST_CASE("what the clock of a run cannot tell apart is one") {
    const double t_end = 0.5;  // 1.1e-14
    CHECK(history::resolved(scene::make_history(spec(HistoryType::rectangle, 1e-200, 1e-20), "h"), t_end)
              .breakpoints()
              .empty());
    const History late =
        history::resolved(scene::make_history(spec(HistoryType::rectangle, 1e-20, 0.25), "h"), t_end);
    CHECK(late.value(0.0) == 1.0);
    CHECK(late.piece_before(0.0).value(0.0) == 0.0);
    CHECK(late.starts() == std::vector<double>{0.0, 0.25});
    const History early = history::resolved(
        scene::make_history(table_spec({-1.0, 0.0, 1e-16, 2.0}, {1.0, 1.0, 3.0, 3.0}), "h"), t_end);
    CHECK(early.starts() == std::vector<double>{-1.0, 0.0, 2.0});
    CHECK(early.value(0.0) == doctest::Approx(3.0));
    CHECK(early.piece_before(0.0).value(0.0) == 1.0);
    const History risen = history::resolved(
        scene::make_history(table_spec({0.25, 0.3, 0.3 + 1e-14, 0.4}, {1.0, 1.0, 3.0, 3.0}), "h"), t_end);
    CHECK(risen.starts() == std::vector<double>{0.25, 0.3 + 1e-14, 0.4});
    CHECK(risen.value(0.3 + 1e-14) == 3.0);
    CHECK(history::resolved(scene::make_history(spec(HistoryType::half_sine, 0.25, 0.25 + 1e-14), "h"), t_end)
              .value(0.3) == 0.0);
    for (const HistorySpec& s : every_type()) {
      const History f = scene::make_history(s, "h");
      CHECK(history::resolved(f, t_end).starts() == f.starts());
    }
  }
}
