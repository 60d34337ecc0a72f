// Stresses, envelopes along members and bends against sums by hand, closed forms, and the same cut by cut.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>

#include "behaviour/engines.hpp"
#include "behaviour/outputs.hpp"

namespace signorini::tests::stresses {

using namespace outputs;

namespace {

std::string stress(const std::string& name, double station, const std::string& more,
                   const std::string& at = "[\"A\", \"B\"]") {
  return output(name, "stress", fmt::format("at = {}\nstation = {:.17g}\n{}", at, station, more));
}

std::string envelope(const std::string& name, const std::string& quantity, const std::string& nodes,
                     const std::string& more = "") {
  return output(name, "envelope", fmt::format("nodes = {}\nquantity = \"{}\"\n{}", nodes, quantity, more));
}

/// A beam of a pipe from A to B, turned, under gravity across it and a force at B along it.
struct PipeBeam {
  double turn = 0.0, length = 6.0, pull = 11.0;
  int elements = 1;
  std::string supports = clamped_at_A, more = {},
              run = "initial = \"static\"\nt_end = 0.1\noutput_dt = 0.02\n";
  bool backwards = false, mirrored = false;
  // of the unit of force and length
  double F = 1.0, L = 1.0;
  std::string units = "{ force = \"kN\", mass = \"t\", length = \"m\", time = \"s\" }";

  [[nodiscard]] std::string text() const {
    const double c = std::cos(turn), s = std::sin(turn), flip = mirrored ? -1.0 : 1.0;
    return fmt::format(R"(schema = 1
units = {}
gravity = [{:.17g}, {:.17g}]
[run]
{}
[sections.s]
pipe = {{ diameter = {:.17g}, wall = {:.17g}, E = {:.17g}, density = {:.17g} }}
[nodes]
A = [{:.17g}, {:.17g}]
B = [{:.17g}, {:.17g}]
[[members]]
nodes = {}
section = "s"
elements = {}
[[loads]]
node = "B"
direction = [{:.17g}, {:.17g}]
amplitude = {:.17g}
{}{})",
                       units, 10.0 * L * s, -10.0 * L * c * flip, run, 0.3 * L, 0.01 * L, 2e7 * F / (L * L),
                       40.0 * F / (L * L * L * L), 0.2 * L, -0.1 * L, 0.2 * L + length * L * c,
                       -0.1 * L + length * L * s * flip, backwards ? "[\"B\", \"A\"]" : "[\"A\", \"B\"]",
                       elements, c, s * flip, pull * F, supports, more);
  }
};

constexpr double area = M_PI / 4.0 * (0.09 - 0.28 * 0.28);
const double modulus = M_PI / 32.0 * (std::pow(0.3, 4) - std::pow(0.28, 4)) / 0.3;
constexpr double weight = 400.0 * area;  // per length

/// Both ends pinned, along and across the beam or only across it at B.
std::string on_two_supports() {
  return "[[supports]]\nnode = \"A\"\nfix = [\"ux\", \"uy\"]\n[[supports]]\nnode = \"B\"\nfix = [\"uy\"]\n";
}

const Output::Segment& stretch_of(const Computed& c, const std::string& name, const OutputPlace& place) {
  REQUIRE(place.segment >= 0);
  return c.model.outputs[c.index(name)].segments[static_cast<std::size_t>(place.segment)];
}

/// What envelopes tell, against the cuts at the places that they tell, and at others.
void check_places(const std::string& engine) {
  const std::string way = "[\"A\", \"B\", \"C\", \"D\"]";
  const std::string places = envelope("N", "N", way) + envelope("V", "V", way) + envelope("M", "M", way);
  CAPTURE(engine);
  const std::vector<Override> changes{{"run.dt", "1e-3"}, {"run.t_end", "0.15"}};
  const Computed first = compute(frame(places), engine, changes);
  std::string again = places;
  for (const char* q : {"N", "V", "M"}) {
    const OutputExtremes& e = first.extremes(q);
    for (const auto& [name, place] :
         {std::pair("greatest", e.at_maximum), std::pair("least", e.at_minimum)}) {
      const Output::Segment& s = stretch_of(first, q, place);
      again +=
          cut(fmt::format("{}_{}", name, q), q, place.station, fmt::format("[\"{}\", \"{}\"]", s.from, s.to));
    }
    for (int i = 0; i <= 10; ++i)
      for (const char* piece : {"AB", "BC", "CD"})
        again += cut(fmt::format("{}{}{}", q, piece, i), q, i / 10.0,
                     fmt::format("[\"{}\", \"{}\"]", piece[0], piece[1]));
  }
  const Computed c = compute(frame(again), engine, changes);
  for (const std::string q : {"N", "V", "M"}) {
    CAPTURE(q);
    const OutputExtremes &e = c.extremes(q), &greatest = c.extremes("greatest_" + q),
                         &least = c.extremes("least_" + q);
    const double size = std::max(e.maximum, -e.minimum);
    CHECK(std::abs(e.maximum - greatest.maximum) < 1e-10 * size);
    CHECK(std::abs(e.minimum - least.minimum) < 1e-10 * size);
    CHECK(std::abs(e.t_maximum - greatest.t_maximum) < 1e-6);
    CHECK(std::abs(e.t_minimum - least.t_minimum) < 1e-6);
    double most = e.minimum, fewest = e.maximum;
    for (int i = 0; i <= 10; ++i)
      for (const char* piece : {"AB", "BC", "CD"}) {
        const OutputExtremes& at = c.extremes(fmt::format("{}{}{}", q, piece, i));
        most = std::max(most, at.maximum);
        fewest = std::min(fewest, at.minimum);
      }
    CHECK(most <= e.maximum + 1e-12 * size);
    CHECK(fewest >= e.minimum - 1e-12 * size);
    CHECK(most > e.maximum - 0.05 * size);
    CHECK(fewest < e.minimum + 0.05 * size);
    // the column is the greatest magnitude, row by row
    double column = 0.0;
    for (const auto& row : c.result.responses) column = std::max(column, row.values[c.index(q)]);
    CHECK(column <= size * (1.0 + 1e-12));
    CHECK(column > 0.9 * size);
  }
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/stresses");

TEST_CASE("stress of a cantilever at an odd angle: N/A -+ i M/W by hand, and the greatest over the section") {
  for (const bool backwards : {false, true})
    for (const double turn : {0.0, 0.7312, 2.5}) {
      PipeBeam beam;
      beam.turn = turn;
      beam.backwards = backwards;
      beam.elements = 3;
      beam.more =
          stress("left", 0.3, "fibre = \"left\"") + stress("right", 0.3, "fibre = \"right\"") +
          stress("N", 0.3, "quantity = \"N\"") + stress("M", 0.3, "quantity = \"M\"\nfibre = \"right\"") +
          stress("both", 0.3, "") + stress("bending", 0.3, "quantity = \"M\"") +
          stress("steep", 0.3, "fibre = \"left\"\nsif = 1.7") +
          stress("back", 0.7, "fibre = \"left\"", "[\"B\", \"A\"]") + cut("N0", "N", 0.3) +
          cut("M0", "M", 0.3) +
          output("sum", "combination",
                 fmt::format("terms = {{ N0 = {{ factor = {:.17g}, unit = \"1/m^2\" }}, M0 = {{ factor = "
                             "{:.17g}, unit = \"m/m^4\" }} }}",
                             1.0 / area, 1.0 / modulus));
      for (const std::string& engine : locating_engines) {
        CAPTURE(engine);
        CAPTURE(turn);
        const Computed c = compute(beam.text(), engine);
        const double rest = 6.0 * 0.7, axial = 11.0 / area, bending = -weight * rest * rest / 2.0 / modulus;
        const auto is = [&](const char* name, double value) {
          CAPTURE(name);
          CHECK(std::abs(c.last(name) - value) < 1e-10 * (axial - bending));
        };
        is("left", axial - bending);
        is("right", axial + bending);
        is("N", axial);
        is("M", bending);
        is("both", axial - bending);
        is("bending", -bending);
        is("steep", axial - 1.7 * bending);
        is("back", axial + bending);  // left of the way back is right
        is("sum", axial + bending);
        CHECK(std::abs(c.extremes("both").maximum - (axial - bending)) < 1e-10 * axial);
        CHECK(std::abs(c.extremes("both").minimum - (axial + bending)) < 1e-10 * std::abs(bending));
        CHECK(stretch_of(c, "both", c.extremes("both").at_maximum).fibre == Fibre::left);
        CHECK(stretch_of(c, "both", c.extremes("both").at_minimum).fibre == Fibre::right);
        CHECK(unit_text(c.model.outputs[c.index("sum")].unit, c.model.units) == "kN/m^2");
        CHECK(unit_text(c.model.outputs[c.index("left")].unit, c.model.units) == "kN/m^2");
      }
    }
}

TEST_CASE("envelope at rest: qL^2/8 in the middle, the shear at the ends, a propped cantilever at 5/8") {
  for (const int elements : {1, 2, 3}) {
    CAPTURE(elements);
    PipeBeam beam;
    beam.elements = elements;
    beam.supports = on_two_supports();
    const std::string way = "[\"A\", \"B\"]";
    beam.more = envelope("M", "M", way) + envelope("V", "V", way) + envelope("N", "N", way) +
                envelope("sigma", "stress", way) +
                envelope("right", "stress", way, "fibre = \"right\"\nsif = 2.0") +
                envelope("back", "M", "[\"B\", \"A\"]");
    Computed c = compute(beam.text());
    const double M = weight * 36.0 / 8.0, V = weight * 3.0;
    const auto extreme = [&](const char* name, double maximum, double at_maximum, double minimum,
                             double at_minimum) {
      CAPTURE(name);
      const OutputExtremes& e = c.extremes(name);
      const double size = std::max(std::abs(maximum), std::abs(minimum));
      CHECK(std::abs(e.maximum - maximum) < 1e-10 * size);
      CHECK(std::abs(e.minimum - minimum) < 1e-10 * size);
      if (at_maximum >= 0.0) CHECK(std::abs(e.at_maximum.station - at_maximum) < 1e-6);
      if (at_minimum >= 0.0) CHECK(std::abs(e.at_minimum.station - at_minimum) < 1e-6);
      CHECK(std::abs(c.last(name) - size) < 1e-10 * size);
    };
    extreme("M", M, 0.5, 0.0, -1.0);
    extreme("V", V, 0.0, -V, 1.0);
    extreme("N", 11.0, -1.0, 11.0, -1.0);
    extreme("sigma", 11.0 / area + M / modulus, 0.5, 11.0 / area - M / modulus, 0.5);
    extreme("right", 11.0 / area + 2.0 * M / modulus, 0.5, 11.0 / area, -1.0);
    extreme("back", 0.0, -1.0, -M, 0.5);
    CHECK(stretch_of(c, "back", c.extremes("back").at_minimum).from == "B");
    beam.supports = clamped_at_A + "[[supports]]\nnode = \"B\"\nfix = [\"uy\"]\n";
    c = compute(beam.text());
    extreme("M", 9.0 / 16.0 * M, 0.625, -M, 0.0);
  }
}

TEST_CASE(
    "envelope of a motion: the member force at the place that it tells has the same extreme at the same "
    "time") {
  for (const char* engine : {"exact", "newmark"}) check_places(engine);
}

TEST_CASE("envelopes and stresses: turned, mirrored, the other way round, reduced, in other units") {
  const std::string way = "[\"A\", \"B\"]";
  PipeBeam plain;
  plain.elements = 3;
  plain.run = "t_end = 0.3\noutput_dt = 0.05\n";
  const std::string there =
      envelope("M", "M", way) + envelope("sigma", "stress", way) + stress("both", 0.2, "");
  plain.more = there;
  const Computed c = compute(plain.text());
  const auto same = [&](const PipeBeam& other, double of_stress, bool turned_over, double station) {
    const Computed d = compute(other.text());
    for (const char* name : {"M", "sigma", "both"}) {
      CAPTURE(name);
      const bool moment = name[0] == 'M';
      const double factor = moment ? of_stress * std::pow(other.L, 3) : of_stress;
      const OutputExtremes &a = c.extremes(name), &b = d.extremes(name);
      const double size = std::max(std::abs(a.maximum), std::abs(a.minimum));
      const bool swapped = moment && turned_over;
      CHECK(std::abs((swapped ? -b.minimum : b.maximum) / factor - a.maximum) < 1e-9 * size);
      CHECK(std::abs((swapped ? -b.maximum : b.minimum) / factor - a.minimum) < 1e-9 * size);
      CHECK(std::abs((swapped ? b.t_minimum : b.t_maximum) - a.t_maximum) < 1e-6);
    }
    const OutputPlace place = c.extremes("sigma").at_maximum, other_place = d.extremes("sigma").at_maximum;
    CHECK(std::abs(other_place.station - (station < 0.0 ? 1.0 - place.station : place.station)) < 1e-6);
    const bool left = stretch_of(c, "sigma", place).fibre == Fibre::left;
    CHECK((stretch_of(d, "sigma", other_place).fibre == Fibre::left) == (left != turned_over));
  };
  CHECK(c.extremes("sigma").maximum > 11.0 / area);
  PipeBeam turned = plain;
  turned.turn = 1.234;
  same(turned, 1.0, false, 1.0);
  PipeBeam mirrored = turned;
  mirrored.mirrored = true;
  same(mirrored, 1.0, true, 1.0);
  PipeBeam backwards = turned;
  backwards.backwards = true;
  same(backwards, 1.0, false, 1.0);
  PipeBeam back = turned;
  back.more = envelope("M", "M", "[\"B\", \"A\"]") + envelope("sigma", "stress", "[\"B\", \"A\"]") +
              stress("both", 0.8, "", "[\"B\", \"A\"]");
  same(back, 1.0, true, -1.0);
  PipeBeam units = turned;
  units.F = 1e3;
  units.L = 1e3;
  units.units = "{ force = \"N\", mass = \"t\", length = \"mm\", time = \"s\" }";
  same(units, 1e-3, false, 1.0);
  PipeBeam reduced = turned;
  reduced.more += "[reduction]\ncutoff_omega = 1e7\n";
  same(reduced, 1.0, false, 1.0);
}

TEST_CASE("an envelope follows a load that is changed on the way") {
  struct Changes : Result {
    [[nodiscard]] bool steers() const override { return true; }
    bool steer(const Sample& now, Steering& run) override {
      if (now.t >= 0.05 && !changed) run.set_load("snow", History::constant(90.0));
      changed = changed || now.t >= 0.05;
      return true;
    }
    bool changed = false;
  };
  PipeBeam beam;
  beam.turn = 0.7;
  beam.elements = 3;
  beam.more =
      "[[loads]]\nname = \"snow\"\nnodes = [\"A\", \"B\"]\ndirection = [0.0, -1.0]\ndistributed = 5.0\n" +
      envelope("M", "M", "[\"A\", \"B\"]") + cut("at_A", "M", 0.0) + cut("middle", "M", 0.5);
  const Scene scene =
      parse_scene(beam.text(), "test.toml", {{"run.engine", "exact"}, {"run.certify", "false"}});
  const Model model = build_model(scene);
  Changes changes;
  const Report report = simulate(model, scene.run, changes);
  REQUIRE(changes.changed);
  // At the clamp it is greatest all the time; a stale load would leave it behind.
  CHECK(report.response[1].minimum < 2.0 * changes.responses.front().values[1]);
  for (const auto& row : changes.responses) {
    CAPTURE(row.t);
    CHECK(row.values[0] ==
          doctest::Approx(std::max(std::abs(row.values[1]), std::abs(row.values[2]))).epsilon(1e-9));
  }
  CHECK(report.response[0].minimum == doctest::Approx(report.response[1].minimum).epsilon(1e-10));
}

TEST_CASE("an envelope of pieces of two members, with its greatest on the second") {
  const std::string text =
      head + "[nodes]\nA = [0.0, 0.0]\nB = [2.0, 0.0]\nC = [8.0, 0.0]\n" +
      "[[members]]\nnodes = [\"B\", \"A\"]\nsection = \"s\"\n[[members]]\nnodes = [\"B\", \"C\"]\nsection = "
      "\"s\"\n" +
      "[[supports]]\nnode = \"A\"\nfix = [\"ux\", \"uy\"]\n[[supports]]\nnode = \"C\"\nfix = [\"uy\"]\n" +
      envelope("M", "M", "[\"A\", \"B\", \"C\"]");
  const Computed c = compute(text);
  const OutputExtremes& e = c.extremes("M");
  CHECK(e.maximum == doctest::Approx(4.0 * 64.0 / 8.0).epsilon(1e-10));
  CHECK(stretch_of(c, "M", e.at_maximum).from == "B");
  CHECK(stretch_of(c, "M", e.at_maximum).to == "C");
  CHECK(e.at_maximum.station == doctest::Approx(2.0 / 6.0).epsilon(1e-6));
}

TEST_CASE("what is wrong with stresses, envelopes and factors is said") {
  const auto refusal = [](const std::string& what) -> std::string {
    try {
      (void)build_model(parse_scene(frame(cut("M", "M", 0.5) + cut("N", "N", 0.5) + what), "test.toml", {}));
    } catch (const SceneError& error) {
      return error.what();
    }
    return "";
  };
  const auto has = [](const std::string& text, const std::string& part) {
    CAPTURE(text);
    CHECK(text.find(part) != std::string::npos);
  };
  has(refusal(stress("x", 0.5, "")),
      "output.x.at: stresses of section 's' cannot be computed: give it a shape");
  has(refusal(envelope("x", "stress", "[\"A\", \"B\"]")),
      "output.x.nodes: stresses of section 's' cannot be computed");
  has(refusal(stress("x", 0.5, "quantity = \"V\"")), "expected one of \"N\", \"M\"");
  has(refusal(envelope("x", "gap", "[\"A\", \"B\"]")), "expected one of \"N\", \"V\", \"M\", \"stress\"");
  has(refusal(envelope("x", "M", "[\"A\", \"C\"]")), "no member has nodes");
  has(refusal(envelope("x", "M", "[\"A\"]")), "the names of two or more nodes");
  has(refusal(envelope("x", "M", "[\"A\", \"B\"]", "fibre = \"left\"")),
      "has no meaning with kind = \"envelope\"");
  has(refusal(envelope("e", "M", "[\"A\", \"B\"]") + output("x", "combination", "terms = { e = 1.0 }")),
      "is a greatest value");
  const auto terms = [&](const std::string& text) {
    return refusal(output("x", "combination", "terms = " + text));
  };
  has(terms("{ M = { factor = 1.0, unit = \"1/m^2\" }, N = { factor = 1.0, unit = \"1/m^2\" } }"),
      "output.x.terms.N: terms 'N' [kN/m^2] with its factor and 'M' [kN/m] with its factor have different "
      "units");
  has(terms("{ M = { factor = 1.0, unit = \"1/mm\" } }"),
      "found \"1/mm\", expected a product of powers of kN, t, m and s");
  has(terms("{ M = { factor = 1.0 } }"), "unit");
  CHECK(terms("{ M = { factor = 1.0, unit = \"1/m\" }, N = 1.0 }").empty());
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("slow/behaviour/stresses");

TEST_CASE("envelope of a motion by ida: the member force at the place that it tells has the same extreme") {
  check_places("ida");
}

TEST_SUITE_END();

}  // namespace signorini::tests::stresses
