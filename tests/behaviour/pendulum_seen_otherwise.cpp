// Two bearings under a floor as tables of pendulums, as sliders, springs and stops by hand, turned, mirrored, permuted, in
// other units, in halves and reduced: the same motion.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <array>
#include <cmath>
#include <functional>

#include "behaviour/halves.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests::pendulum_otherwise {
namespace {

/// How the scene is written: factors of forces, lengths and times; the tangent's angle and sign; the order of tables.
struct View {
  double force = 1.0, length = 1.0, time = 1.0, angle = 0.0;
  const char* units = "force = \"N\", mass = \"kg\", length = \"m\", time = \"s\"";
  bool mirrored = false, permuted = false, by_hand = false, held = false;
  std::string friction = "{{ slow = 0.04, fast = 0.1, velocity = {:.17g} }}";
  std::string spring = "tangential_stiffness = {:.17g}\n";
  std::string more = {};
};

class Writer {
 public:
  explicit Writer(const View& view) : v_(view) {}

  [[nodiscard]] std::string scene() const {
    std::string text = fmt::format(
        "schema = 1\nunits = {{ {} }}\n[run]\nt_end = {:.17g}\noutput_dt = {:.17g}\nrtol = 1e-10\n", v_.units,
        1.2 * v_.time, 0.1 * v_.time);
    const std::string A = fmt::format("A = [0.0, 0.0]\n"),
                      B = fmt::format("B = [{:.17g}, 0.0]\n", 3.0 * v_.length);
    text += "[nodes]\n" + (v_.permuted ? B + A : A + B);
    const double mass = v_.force * v_.time * v_.time / v_.length;
    text +=
        fmt::format("[[masses]]\nnode = \"A\"\nmass = {:.17g}\n[[masses]]\nnode = \"B\"\nmass = {:.17g}\n",
                    300.0 * mass, 200.0 * mass);
    if (v_.held) text += "[[supports]]\nnodes = [\"A\", \"B\"]\nfix = [\"uy\"]\n";
    const double stiffness = v_.force / v_.length;
    text += fmt::format("[[springs]]\nnode = \"A\"\nagainst = \"B\"\ndirection = {}\nstiffness = {:.17g}\n",
                        along(), 3e4 * stiffness);
    const std::string a = bearing("a", "A", 3000.0, 2.0), b = bearing("b", "B", 2000.0, 1.4);
    text += v_.permuted ? b + a : a + b;
    return text +
           fmt::format(
               "[[loads]]\nnode = \"A\"\ndirection = {}\namplitude = {:.17g}\nhistory = {{ type = "
               "\"harmonic\", "
               "omega = {:.17g} }}\n",
               along(), 1800.0 * v_.force, 5.3 / v_.time) +
           v_.more;
  }
  /// A bearing's own unit vector; what it moves along it is the same in every view but for the mirror's sign.
  [[nodiscard]] std::array<double, 2> tangent() const {
    const double s = v_.mirrored ? -1.0 : 1.0;
    return {s * std::cos(v_.angle), s * std::sin(v_.angle)};
  }

 private:
  [[nodiscard]] std::string along() const {
    return fmt::format("[{:.17g}, {:.17g}]", tangent()[0], tangent()[1]);
  }
  [[nodiscard]] std::string bearing(const std::string& name, const std::string& node, double N,
                                    double R) const {
    const double stiffness = v_.force / v_.length;
    const std::string friction =
        "friction = " + fmt::format(fmt::runtime(v_.friction), 0.05 * v_.length / v_.time) + "\n" +
        fmt::format(fmt::runtime(v_.spring), 4e5 * stiffness);
    const double stop = 0.05 * v_.length, rim = 5e5 * stiffness;
    if (!v_.by_hand)
      return fmt::format(
                 "[[pendulums]]\nname = \"{}\"\nnode = \"{}\"\nnormal = [{:.17g}, {:.17g}]\nradius = "
                 "{:.17g}\nnormal_force = {:.17g}\nstop = {:.17g}\nstop_stiffness = {:.17g}\n",
                 name, node, -tangent()[1], tangent()[0], R * v_.length, N * v_.force, stop, rim) +
             friction;
    return fmt::format(
               "[[contacts]]\nname = \"{}\"\nnode = \"{}\"\nlaw = \"slider\"\ntangent = {}\nnormal_force = "
               "{:.17g}\n",
               name, node, along(), N * v_.force) +
           friction +
           fmt::format("[[springs]]\nnode = \"{}\"\ndirection = {}\nstiffness = {:.17g}\n", node, along(),
                       N / R * stiffness) +
           fmt::format(
               "[[stops]]\nname = \"{}\"\nnode = \"{}\"\nlaw = \"compliant\"\ndirection = {}\ngap = {:.17g}\n"
               "normal_stiffness = {:.17g}\n",
               name, node, along(), stop, rim);
  }

  View v_;
};

struct Seen {
  std::vector<std::pair<double, std::string>> events;
  std::vector<double> place;  ///< of A and B along the bearing, by row
};

Seen seen(const View& view, const std::vector<Override>& changes = {}) {
  const Writer writer(view);
  const Scene scene = parse_scene(writer.scene(), "view.toml", changes);
  const Model model = build_model(scene);
  const Result result = simulate(model, scene.run);
  REQUIRE(result.report.outcome.kind == Outcome::Kind::done);
  CHECK(result.report.law_checks.violations.empty());
  Seen s;
  for (const Event& e : result.events)
    if (e.contact >= 0)
      s.events.emplace_back(e.t / view.time, model.contacts[static_cast<std::size_t>(e.contact)].name);
  for (const Result::Row& row : result.rows)
    for (const char* node : {"A", "B"}) {
      double along = 0.0;
      for (const Column& column : model.columns)
        if (!column.velocity && column.name == std::string(node) + ".ux")
          along += row.u[column.dof] * writer.tangent()[0];
        else if (!column.velocity && column.name == std::string(node) + ".uy")
          along += row.u[column.dof] * writer.tangent()[1];
      s.place.push_back(along / view.length);
    }
  return s;
}

void check_same(const Seen& a, const Seen& b, double limit) {
  REQUIRE(a.events.size() == b.events.size());
  for (std::size_t i = 0; i < a.events.size(); ++i) {
    CAPTURE(i);
    CHECK(std::abs(a.events[i].first - b.events[i].first) < limit);
    CHECK(a.events[i].second == b.events[i].second);
  }
  REQUIRE(a.place.size() == b.place.size());
  for (std::size_t i = 0; i < a.place.size(); ++i) CHECK(std::abs(a.place[i] - b.place[i]) < 0.1 * limit);
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/pendulum_seen_otherwise");

TEST_CASE("two pendulums are the same by hand, turned, mirrored, permuted and in other units") {
  View plain;
  const Seen expected = seen(plain);
  CHECK(expected.events.size() > 12);
  View hand, turned, mirrored, permuted, units;
  hand.by_hand = true;
  turned.angle = 0.7351;
  mirrored.mirrored = true;
  permuted.permuted = true;
  units.force = 1e-3;
  units.length = units.time = 1e3;
  units.units = "force = \"kN\", mass = \"kg\", length = \"mm\", time = \"ms\"";
  check_same(expected, seen(hand), 1e-9);
  check_same(expected, seen(turned), 1e-7);
  check_same(expected, seen(mirrored), 1e-7);
  check_same(expected, seen(permuted), 1e-7);
  check_same(expected, seen(units), 1e-7);
}

TEST_CASE("two pendulums with constant friction: every engine, turned and by hand") {
  View plain;
  plain.friction = "0.06";
  const Seen expected = seen(plain, {{"run.engine", "exact"}});
  CHECK(expected.events.size() > 8);
  View turned = plain;
  turned.angle = 0.7351;
  check_same(expected, seen(turned, {{"run.engine", "exact"}}), 1e-11);
  check_same(expected, seen(turned, {{"run.engine", "ida"}}), 1e-7);
  View hand = plain;
  hand.by_hand = true;
  check_same(expected, seen(hand, {{"run.engine", "exact"}}), 1e-12);
}

TEST_CASE("pendulums with rising friction go on from where a run left them") {
  View view;
  const std::string text = Writer(view).scene();
  const halves::Reader read = [&](const std::vector<Override>& changes) {
    return parse_scene(text, "halves.toml", changes);
  };
  for (const double part : {0.31, 0.55, 0.77}) {
    CAPTURE(part);
    const halves::Difference d = halves::split_scene(read, {}, part);
    CAPTURE(d.first);
    CHECK(d.events_agree);
    CHECK(d.events > 2);
    CHECK(d.time < 1e-7);
    CHECK(d.state < 1e-6);
  }
}

TEST_CASE(
    "a reduced model that keeps all modes moves as the whole one, rising friction beside a spring or not") {
  for (const char* spring : {"", "tangential_stiffness = {:.17g}\n"}) {
    CAPTURE(spring);
    View whole;
    whole.spring = spring;
    whole.held = true;
    View reduced = whole;
    reduced.more = "[reduction]\ncutoff_omega = 1e4\n";
    check_same(seen(whole), seen(reduced), 1e-7);
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests::pendulum_otherwise
