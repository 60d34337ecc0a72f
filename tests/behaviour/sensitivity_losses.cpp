// Derivatives of works, losses, energies and landings: closed forms, the balance of energy, differences of `exact`.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "behaviour/one_mass.hpp"
#include "signorini/sensitivity.hpp"

using namespace signorini;
using namespace signorini::tests;

namespace {

SceneReader losses_reader(const std::string& text) {
  return [text](const std::vector<Override>& changes) {
    std::vector<Override> all{{"run.engine", "exact"}};
    all.insert(all.end(), changes.begin(), changes.end());
    return parse_scene(text, "test.toml", all);
  };
}

Sensitivities with_losses(const SceneReader& read, const std::vector<std::string>& paths) {
  return sensitivities(read, paths, nullptr, {true});
}

const Response& loss_of(const Sensitivities& s, const std::string& name, int contact = -1) {
  for (const Response& r : s.responses)
    if (r.name == name && r.contact == contact) return r;
  REQUIRE_MESSAGE(false, name);
  return s.responses.front();
}

/// Four runs about the value of a key, and differences of fourth order of what they show.
class Around {
 public:
  Around(const SceneReader& read, const Parameter& p, double relative)
      : h_(relative * (p.value != 0.0 ? std::abs(p.value) : 1.0)) {
    for (const int k : {-2, -1, 1, 2}) {
      Scene scene = read({{p.path, fmt::format("{:.17g}", p.value + k * h_)}});
      scene.run.flow = Flow::taylor;
      runs_.push_back(simulate(build_model(scene), scene.run));
    }
  }
  template <class Value>
  [[nodiscard]] double rate(const Value& value) const {
    return (8.0 * (value(runs_[2]) - value(runs_[1])) - (value(runs_[3]) - value(runs_[0]))) / (12.0 * h_);
  }
  /// What rounding leaves of it: `exact` keeps all but three digits of a double.
  template <class Value>
  [[nodiscard]] double rounding(const Value& value) const {
    double size = 0.0;
    for (const Result& run : runs_) size = std::max(size, std::abs(value(run)));
    return 1e3 * std::numeric_limits<double>::epsilon() * size / h_;
  }
  [[nodiscard]] const std::vector<Result>& runs() const { return runs_; }

 private:
  double h_;
  std::vector<Result> runs_;
};

/// Within `part` of the greatest derivative of its kind.
class Compared {
 public:
  template <class Value>
  void add(double found, const Around& around, const Value& value) {
    pairs_.push_back({found, around.rate(value), around.rounding(value)});
    greatest_ = std::max(greatest_, std::abs(pairs_.back().expected));
  }
  void check(double part) const {
    for (const auto& [found, expected, rounding] : pairs_) {
      CAPTURE(found);
      CAPTURE(expected);
      CHECK(std::abs(found - expected) <= part * greatest_ + rounding);
    }
  }
  [[nodiscard]] double greatest() const { return greatest_; }

 private:
  struct Pair {
    double found = 0.0, expected = 0.0, rounding = 0.0;
  };
  std::vector<Pair> pairs_;
  double greatest_ = 0.0;
};

/// What is in the structure and what left it, at all times as at the start.
void check_balance(const Sensitivities& s, std::size_t parameter, double greatest) {
  const std::size_t first = s.columns.size() - energy_columns.size();
  const auto balance_of = [&](const std::vector<double>& row) {
    return row[first] + row[first + 1] + row[first + 2] + row[first + 3] + row[first + 4] + row[first + 5] -
           row[first + 6] - row[first + 7];
  };
  const double at_start = balance_of(s.value_rates[parameter].front());
  for (const auto& row : s.value_rates[parameter])
    CHECK(std::abs(balance_of(row) - at_start) <= 1e-9 * greatest);
}

void check_energies(const Sensitivities& s, const Around& around, double part) {
  const std::size_t first = s.columns.size() - energy_columns.size();
  Compared energies;
  for (std::size_t i = 0; i < s.times.size(); ++i)
    for (std::size_t e = 0; e < energy_columns.size(); ++e)
      energies.add(s.value_rates[0][i][first + e], around,
                   [&](const Result& r) { return r.rows[i].energy.*energy_columns[e].value; });
  energies.check(part);
  check_balance(s, 0, energies.greatest());
}

void check_landings(const Sensitivities& s, const Around& around, double part) {
  std::array<Compared, 4> all;
  std::size_t at = 0;
  for (std::size_t c = 0; c < s.contacts.size(); ++c) {
    const std::size_t count = around.runs()[0].report.landings[c].size();
    for (std::size_t i = 0; i < count; ++i, ++at) {
      REQUIRE(at < s.landings.size());
      REQUIRE(s.landings[at].contact == static_cast<int>(c));
      const LandingRates& rates = s.landings[at].rates[0];
      const auto add = [&](std::size_t which, double found, double Landing::*value) {
        all[which].add(found, around, [&](const Result& r) { return r.report.landings[c][i].*value; });
      };
      add(0, rates.start, &Landing::start);
      add(1, rates.end, &Landing::end);
      add(2, rates.impulse, &Landing::impulse);
      add(3, rates.peak_force, &Landing::peak_force);
    }
  }
  CHECK(at == s.landings.size());
  for (std::size_t i = 0; i < 3; ++i) all[i].check(part);
  all[3].check(100.0 * part);  // the run's own are of steps and turning points
}

void check_losses(const SceneReader& read, const std::string& path, double part, double relative = 2e-4) {
  CAPTURE(path);
  const Sensitivities s = with_losses(read, {path});
  CAPTURE(s.parameters[0].reason);
  const Around around(read, s.parameters[0], relative);
  for (const Result& run : around.runs()) REQUIRE(run.events.size() == s.events.size());
  check_energies(s, around, part);
  check_landings(s, around, part);
  Compared works;
  for (std::size_t c = 0; c < s.contacts.size(); ++c)
    for (const Response& r : s.responses)
      if (r.name == "lost by friction" && r.contact == static_cast<int>(c))
        works.add(r.rates[0], around, [&](const Result& x) { return x.report.audit.friction_work[c]; });
  const auto total = [&](const char* name, double Energy::*value) {
    works.add(loss_of(s, name).rates[0], around,
              [&](const Result& x) { return x.report.audit.final.*value; });
  };
  total("lost by friction", &Energy::friction);
  total("lost by damping", &Energy::damping);
  total("lost by impacts", &Energy::impact);
  total("work of loads", &Energy::loads);
  total("work of surfaces", &Energy::surface);
  works.check(part);
}

std::string shaken(const std::string& contact, const std::string& load = "harmonic\", omega = 7.0 }",
                   const std::string& damping = "") {
  return matrix_scene("t_end = 1.2\noutput_dt = 0.17\ninitial = { u = [0.0, 0.002], v = [0.0, 0.0] }",
                      "mass = [[1.0, 0.0], [0.0, 1.0]]\nstiffness = [[40.0, 0.0], [0.0, 0.0]]" + damping,
                      "law = \"compliant\"\nnormal = { d1 = 1.0 }\ntangent = { d0 = 1.0 }\n"
                      "normal_stiffness = 4000.0\ntangential_stiffness = 3000.0\n" +
                          contact,
                      "[[loads]]\ndirection = { d1 = 1.0 }\namplitude = -10.0\n[[loads]]\ndirection = { d0 = "
                      "1.0 }\namplitude = 6.0\nhistory = { type = \"" +
                          load + "\n");
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/sensitivity_losses");

TEST_CASE("losses of a ball's hits, its landings and the work of its weight") {
  const double h = 1.0, g = 10.0, e = 0.5;
  const SceneReader ball = losses_reader(matrix_scene(
      "t_end = 1.2\noutput_dt = 0.6\ninitial = { u = [1.0], v = [0.0] }",
      "mass = [[1.0]]\nstiffness = [[0.0]]", "law = \"rigid\"\nnormal = { d0 = 1.0 }\nrestitution = 0.5",
      "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = -10.0\n"));
  const Sensitivities s = with_losses(ball, {"contacts.c.restitution", "run.initial.u.1"});
  REQUIRE(s.events.size() == 3);
  const Response& lost = loss_of(s, "lost by impacts");
  CHECK(lost.value == doctest::Approx(g * h * (1.0 - std::pow(e, 6.0))));
  CHECK(lost.rates[0] == doctest::Approx(-6.0 * g * h * std::pow(e, 5.0)).epsilon(1e-11));
  CHECK(lost.rates[1] == doctest::Approx(g * (1.0 - std::pow(e, 6.0))).epsilon(1e-11));
  REQUIRE(s.landings.size() == 3);
  const double v = std::sqrt(2.0 * g * h);
  for (std::size_t i = 0; i < 3; ++i) {
    CAPTURE(i);
    const auto n = static_cast<double>(i);
    const double power = std::pow(e, n);
    CHECK(s.landings[i].value.impulse == doctest::Approx(v * power * (1.0 + e)));
    CHECK(s.landings[i].rates[0].impulse ==
          doctest::Approx(v * (n * power / e * (1.0 + e) + power)).epsilon(1e-11));
    CHECK(s.landings[i].rates[1].impulse == doctest::Approx(0.5 * v * power * (1.0 + e) / h).epsilon(1e-11));
    CHECK(s.landings[i].rates[1].start == doctest::Approx(0.5 * s.events[i].t / h).epsilon(1e-11));
    CHECK(s.landings[i].rates[1].end == doctest::Approx(0.5 * s.events[i].t / h).epsilon(1e-11));
  }
  check_losses(ball, "loads.1.amplitude", 1e-9);
  CHECK(loss_of(with_losses(ball, {"loads.1.amplitude"}), "lost by damping").rates[0] == 0.0);
}

TEST_CASE("works and losses of elements with friction that drops, dashpots and shear elements") {
  for (const char* path : {"contacts.c.friction.static", "contacts.c.friction.kinetic",
                           "contacts.c.tangential_stiffness", "loads.2.history.omega", "matrices.mass.1.1"})
    check_losses(losses_reader(shaken("friction = { static = 0.4, kinetic = 0.3 }")), path, 1e-8);
  for (const char* path : {"contacts.c.normal_damping", "contacts.c.friction", "contacts.c.normal_stiffness"})
    check_losses(losses_reader(shaken("friction = 0.3\nnormal_damping = 12.0")), path, 1e-8);
  for (const char* path : {"contacts.c.tangential_damping", "contacts.c.tangential_stiffness"})
    check_losses(losses_reader(shaken("friction = 0.3\ntangential_damping = 5.0")), path, 1e-8);
  const std::string damped = "\ndamping = [[1.5, 0.2], [0.2, 0.8]]";
  const std::string pulse = "rectangle\", start = 0.1, end = 0.5 }";
  for (const char* path : {"matrices.damping.1.1", "loads.2.history.end", "loads.2.amplitude"})
    check_losses(losses_reader(shaken("friction = 0.3", pulse, damped)), path, 1e-8);
}

TEST_CASE("the balance where a dashpot takes what its spring still holds, N having come to zero") {
  std::string often = shaken("friction = 0.3\nnormal_damping = 30.0");
  often.replace(often.find("0.17"), 4, "0.002");
  often.replace(often.find("0.002], v"), 5, "0.21");  // it falls, and leaves again
  const Sensitivities s =
      with_losses(losses_reader(often),
                  {"contacts.c.normal_stiffness", "contacts.c.normal_damping", "loads.1.amplitude"});
  for (std::size_t i = 0; i < 3; ++i) {
    CAPTURE(s.parameters[i].path);
    double greatest = 0.0;
    for (const auto& row : s.value_rates[i])
      for (std::size_t e = row.size() - energy_columns.size(); e < row.size(); ++e)
        greatest = std::max(greatest, std::abs(row[e]));
    CHECK(greatest > 0.0);
    check_balance(s, i, greatest);
  }
}

TEST_CASE("works where parts without mass follow a load that jumps, and where their friction drops") {
  const auto scene = [](const std::string& friction, const std::string& loaded) {
    return losses_reader(matrix_scene(
        "t_end = 1.2\noutput_dt = 0.17\ninitial = { u = [0.1, 0.1], v = [0.0, 0.0] }",
        "mass = [[1.0, 0.0], [0.0, 0.0]]\nstiffness = [[90.0, -40.0], [-40.0, 40.0]]",
        "law = \"slider\"\ntangent = { d1 = 1.0 }\nnormal_force = 1.0\ntangential_stiffness = 300.0\n"
        "friction = " +
            friction,
        "[[loads]]\ndirection = { " + loaded +
            " = 1.0 }\namplitude = 0.8\nhistory = { type = \"rectangle\", start = 0.1, end = 0.5 }\n"));
  };
  for (const char* path :
       {"loads.1.amplitude", "loads.1.history.end", "contacts.c.tangential_stiffness", "matrices.mass.1.1"})
    check_losses(scene("20.0", "d1"), path, 1e-8);
  for (const char* path : {"contacts.c.friction.kinetic", "contacts.c.friction.static",
                           "contacts.c.tangential_stiffness", "loads.1.history.start"})
    check_losses(scene("{ static = 0.4, kinetic = 0.3 }", "d0"), path, 1e-8);
}

TEST_CASE("two parts without mass whose friction drops at one instant: what is lost is lost once") {
  const std::string slider =
      "law = \"slider\"\nnormal_force = 1.0\ntangential_stiffness = 300.0\n"
      "friction = { static = 0.4, kinetic = 0.3 }\n";
  const SceneReader twice = losses_reader(matrix_scene(
      "t_end = 1.2\noutput_dt = 0.17\ninitial = { u = [0.1, 0.1, 0.1], v = [0.0, 0.0, 0.0] }",
      "mass = [[1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]\n"
      "stiffness = [[90.0, -40.0, -40.0], [-40.0, 40.0, 0.0], [-40.0, 0.0, 40.0]]",
      slider + "tangent = { d1 = 1.0 }\n[[contacts]]\nname = \"b\"\n" + slider + "tangent = { d2 = 1.0 }",
      "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = 0.8\nhistory = { type = \"rectangle\", start = 0.1, "
      "end = "
      "0.5 }\n"));
  for (const char* path :
       {"contacts.*.friction.static", "contacts.*.tangential_stiffness", "loads.1.amplitude"})
    check_losses(twice, path, 1e-8);
}

TEST_CASE("works of a belt, and of impacts with friction") {
  const SceneReader belt = losses_reader(
      matrix_scene("t_end = 20.0\noutput_dt = 3.0\ninitial = { u = [0.0], v = [0.0] }",
                   "mass = [[1.0]]\nstiffness = [[1.0]]",
                   "law = \"slider\"\ntangent = { d0 = 1.0 }\nnormal_force = 1.0\nsurface_velocity = 0.3\n"
                   "friction = { static = 0.6, kinetic = 0.4 }"));
  for (const char* path :
       {"contacts.c.surface_velocity", "contacts.c.friction.static", "contacts.c.normal_force"})
    check_losses(belt, path, 1e-8);
  const std::string foot =
      "law = \"rigid\"\nrestitution = 0.4\nfriction = 0.3\ncapture_velocity = 0.01\n"
      "surface_velocity = 0.1\n";
  const SceneReader bar = losses_reader(matrix_scene(
      "t_end = 0.4\noutput_dt = 0.1\ninitial = { u = [0.4, 0.11, 0.0], v = [0.0, 0.0, 0.5] }",
      "mass = [[2.0, 0.0, 0.0], [0.0, 0.7, 0.0], [0.0, 0.0, 2.0]]\nstiffness = [[0.0, 0.0, 0.0], "
      "[0.0, 0.0, 0.0], [0.0, 0.0, 3.0]]",
      foot +
          "normal = { d0 = 1.0, d1 = 1.0 }\ntangent = { d2 = 1.0, d1 = 0.2 }\n[[contacts]]\nname = \"b\"\n" +
          foot + "normal = { d0 = 1.0, d1 = -1.0 }\ntangent = { d2 = 1.0, d1 = 0.2 }",
      "[[loads]]\ndirection = { d0 = 1.0 }\namplitude = -20.0\n"));
  for (const char* path : {"contacts.*.friction", "contacts.c.restitution", "run.initial.v.3",
                           "matrices.mass.1.1", "contacts.*.surface_velocity"})
    check_losses(bar, path, 1e-8);
}

TEST_CASE("losses of the pipeline, whose run goes in modes: what is lost follows the series") {
  const SceneReader read =
      reader_of(std::string(SIGNORINI_MODELS) + "/pipeline.toml",
                {{"run.engine", "exact"}, {"run.t_end", "0.005"}, {"run.output_dt", "0.001"}});
  const Sensitivities s = with_losses(read, {"contacts.*.friction"});
  CHECK(s.stretches.modes == 0);
  check_losses(read, "contacts.*.friction", 1e-6, 1e-5);
  check_losses(read, "sections.pipe.EI", 1e-6, 1e-5);
}

TEST_SUITE_END();
