// Units are names; the reader checks that Newton's law holds between them without a factor.
#include <fmt/core.h>

#include <cmath>
#include <map>

#include "scene/readers.hpp"

namespace signorini {

namespace {

double si_factor(const std::string& unit) {
  static const std::map<std::string, double> factors = {{"N", 1.0},   {"kN", 1e3}, {"MN", 1e6},
                                                        {"kg", 1.0},  {"t", 1e3},  {"m", 1.0},
                                                        {"mm", 1e-3}, {"s", 1.0},  {"ms", 1e-3}};
  return factors.at(unit);
}

bool same(double a, double b) { return std::abs(a - b) < 1e-9 * std::abs(b); }

}  // namespace

void read_units(Table& top, Scene& scene, RecordedScene& record) {
  top.require("units", "");
  Table table = top.child("units");
  Units& units = scene.units;
  units.force = table.choice("force");
  units.mass = table.choice("mass");
  units.length = table.choice("length");
  units.time = table.choice("time");

  const double time = si_factor(units.time);
  const double fitting = si_factor(units.mass) * si_factor(units.length) / (time * time);
  if (!same(si_factor(units.force), fitting)) {
    const std::string product = fmt::format("{} {}/{}^2", units.mass, units.length, units.time);
    std::string answer = "no unit of force that is known here (N, kN, MN)";
    for (const std::string name : {"N", "kN", "MN"}) {
      if (same(si_factor(name), fitting)) answer = "\"" + name + "\"";
    }
    table.fail("force", fmt::format("found \"{}\", expected mass * length / time^2: {} is {}", units.force,
                                    product, answer));
  }
  table.finish();
  record.top.set("units", table.record().inline_table());
}

}  // namespace signorini
