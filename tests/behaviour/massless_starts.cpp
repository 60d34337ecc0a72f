// Parts without mass that loads press onto their contacts at t = 0: the limit of a fast ramp, elastic first.
//
//   q without mass, on a floor kn, kt with friction f, joined to a mass at rest; N = kn q / (kn + kv), P along the floor
//   |P| < f N:   q stays but for P/(kt + k), T = P kt/(kt + k)      whatever drives the mass later
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>

#include "behaviour/engines.hpp"
#include "behaviour/scene_parts.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::massless_starts {
namespace {

constexpr double k = 50.0, kv = 7.0, kc = 1e6, press = 10.0;

/// along: a pull on q; drive: amplitude of the mass's load, sin 3t.
std::string scene_text(double turn, double along, double drive, double gap, const std::string& engine) {
  const auto vector = [&](double x, double y) {
    return fmt::format("[{:.17g}, {:.17g}]", std::cos(turn) * x - std::sin(turn) * y,
                       std::sin(turn) * x + std::cos(turn) * y);
  };
  const auto spring = [&](const std::string& at, double x, double y, double stiffness) {
    return fmt::format("[[springs]]\n{}\ndirection = {}\nstiffness = {}\n", at, vector(x, y), stiffness);
  };
  const auto load = [&](const char* node, double x, double y, double size, const std::string& history) {
    return fmt::format("[[loads]]\nnode = \"{}\"\ndirection = {}\namplitude = {:.17g}\n{}", node,
                       vector(x, y), size, history);
  };
  return parts::head +
         fmt::format("[run]\nt_end = 0.5\noutput_dt = 0.1\nrtol = 1e-10\ndt = 1e-3\nengine = \"{}\"\n",
                     engine) +
         "[nodes]\nm = " + vector(0.0, 0.0) + "\nq = " + vector(1.0, 0.0) +
         "\n[[masses]]\nnode = \"m\"\nmass = 1.0\n" + spring("node = \"m\"", 1.0, 0.0, 20.0) +
         spring("node = \"m\"", 0.0, 1.0, 1e3) + spring("node = \"m\"\nagainst = \"q\"", 1.0, 0.0, k) +
         spring("node = \"q\"", 0.0, 1.0, kv) +
         fmt::format(
             "[[contacts]]\nname = \"c\"\nnode = \"q\"\nlaw = \"compliant\"\nnormal = {}\nfriction = 0.3\n"
             "normal_stiffness = {}\ntangential_stiffness = {}\ngap = {}\n",
             vector(0.0, 1.0), kc, kc, gap) +
         load("q", 0.0, -1.0, press, "") + (along != 0.0 ? load("q", 1.0, 0.0, along, "") : "") +
         (drive != 0.0 ? load("m", 1.0, 0.0, drive, "history = { type = \"harmonic\", omega = 3.0 }\n") : "");
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/massless_starts");

TEST_CASE(
    "a pull within friction leaves a part without mass where it is, and so does what moves others later") {
  for (const std::string& engine : locating_engines)
    for (const double turn : {0.0, 0.9})
      for (const double along : {0.0, 2.0, -2.9})
        for (const double drive : {0.0, 1e-6, -6.0}) {
          CAPTURE(engine);
          CAPTURE(turn);
          CAPTURE(along);
          CAPTURE(drive);
          const Scene read = parse_scene(scene_text(turn, along, drive, 0.0, engine), "test.toml");
          const Result result = simulate(build_model(read), read.run);
          REQUIRE(result.report.outcome.reason == "");
          const ContactSample& c = result.rows.front().contacts[0];
          CHECK(c.N == doctest::Approx(-press * kc / (kc + kv)).epsilon(1e-9));
          CHECK(std::abs(c.T - along * kc / (kc + k)) <= 1e-9 * press);
          CHECK(std::abs(c.ut - along / (kc + k)) <= 1e-9 * press / kc);
        }
}

TEST_CASE("what closes on the way keeps the slip of the way from there") {
  // Open, q would move by along/k sideways and press/kv down: it touches at the part gap kv / press of that.
  const double gap = 0.4, along = 5.0, part = gap * kv / press;
  const double drag =
      along * (1.0 - part);  // the rest of the pull comes on contact: elastic, within its limit
  const Scene read = parse_scene(scene_text(0.3, along, 0.0, gap, "exact"), "test.toml");
  const Result result = simulate(build_model(read), read.run);
  const ContactSample& c = result.rows.front().contacts[0];
  const double N = (press - kv * gap) * kc / (kc + kv);
  CHECK(-c.N == doctest::Approx(N).epsilon(1e-9));
  const double T = std::min(drag * kc / (kc + k), 0.3 * N);
  CHECK(c.T == doctest::Approx(T).epsilon(1e-9));
}

TEST_CASE("two halves of a contact that a part without mass reaches at once are the whole") {
  // The pull exceeds friction or does not; the halves have the parts 1 and 3 of the stiffnesses.
  for (const std::string& engine : locating_engines)
    for (const double along : {1.0, 5.0, -5.0}) {
      CAPTURE(engine);
      CAPTURE(along);
      const Scene whole = parse_scene(scene_text(0.3, along, 0.0, 0.4, engine), "whole.toml");
      Scene split = whole;
      split.contacts.push_back(whole.contacts[0]);
      split.contacts[1].name = "other";
      for (std::size_t i = 0; i < 2; ++i) {
        const double part = i == 0 ? 0.25 : 0.75;
        split.contacts[i].normal_stiffness *= part;
        *split.contacts[i].tangential_stiffness *= part;
      }
      const ContactSample one = simulate(build_model(whole), whole.run).rows.front().contacts[0];
      const Result halves = simulate(build_model(split), split.run);
      REQUIRE(halves.report.outcome.reason == "");
      const std::vector<ContactSample>& two = halves.rows.front().contacts;
      for (std::size_t i = 0; i < 2; ++i) {
        const double part = i == 0 ? 0.25 : 0.75;
        CHECK(two[i].N == doctest::Approx(part * one.N).epsilon(1e-9));
        CHECK(two[i].T == doctest::Approx(part * one.T).epsilon(1e-9));
      }
    }
}

TEST_CASE("halves of a contact that lands by a load's jump slip when the whole does") {
  const std::string folder = std::string(SIGNORINI_TEST_DATA) + "/scenes/massless/lands-at-load-jump";
  const std::vector<Override> plain{{"run.certify", "false"}};
  const Scene whole = read_scene(folder + ".toml", plain), split = read_scene(folder + "-split.toml", plain);
  const Result one = simulate(build_model(whole), whole.run), two = simulate(build_model(split), split.run);
  // Contacts of the whole: c0, c1; of the halves: c0, c0zz, c1, c1zz.
  const auto times = [](const Result& result, int contact) {
    std::vector<double> list;
    for (const Event& event : result.events)
      if (event.contact == contact) list.push_back(event.t);
    return list;
  };
  const std::vector<double> expected = times(one, 1);
  REQUIRE(expected.size() > 5);
  for (const int half : {2, 3}) {
    const std::vector<double> found = times(two, half);
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
      CHECK(found[i] == doctest::Approx(expected[i]).epsilon(1e-10));
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests::massless_starts
