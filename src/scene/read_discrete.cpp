// Point masses, springs, supports and damping.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "base/rounding.hpp"
#include "base/text.hpp"
#include "scene/readers.hpp"

namespace signorini::scene {

namespace {

std::array<double, 2> read_pair(Table& table, std::string_view key, bool zero_too) {
  table.require(key, key == "ratios" ? " (required with frequencies)" : " (required with ratios)");
  const std::vector<double> values = *table.numbers(key);
  const bool wrong = values.size() != 2 || std::any_of(values.begin(), values.end(), [&](double x) {
                       return zero_too ? x < 0.0 : !(x > 0.0);
                     });
  if (wrong) table.wrong(key, zero_too ? "two numbers >= 0" : "two numbers > 0");
  return {values[0], values[1]};
}

/// Rayleigh factors from the ratios at two circular frequencies w: zeta(w) = alpha / (2 w) + beta w / 2.
void read_ratios(Table& table, DampingSpec& damping) {
  const auto [z1, z2] = read_pair(table, "ratios", true);
  const auto [f1, f2] = read_pair(table, "frequencies", false);
  if (f1 == f2) table.wrong("frequencies", "two different frequencies");
  const double w1 = 2.0 * std::numbers::pi * f1, w2 = 2.0 * std::numbers::pi * f2;
  // A difference of rounding size is set to zero; the damping is then by mass or by stiffness alone.
  const auto difference = [](double a, double b) {
    return std::abs(a - b) <= rounding::few_operations * std::max(a, b) ? 0.0 : a - b;
  };
  const double bottom = (w2 - w1) * (w2 + w1);
  damping.alpha = 2.0 * w1 * w2 * difference(z1 * w2, z2 * w1) / bottom;
  damping.beta = 2.0 * difference(z2 * w2, z1 * w1) / bottom;
  if (!(damping.alpha >= 0.0 && damping.beta >= 0.0 && std::isfinite(damping.alpha + damping.beta))) {
    const double r = std::max(f1, f2) / std::min(f1, f2);
    table.fail("ratios", fmt::format("these ratios give alpha = {0:.6g} and beta = {1:.6g}, expected both >= "
                                     "0; choose a ratio between {3:.6g} and {4:.6g} at the frequency {2}",
                                     damping.alpha, damping.beta, base::format_number(f2), z1 / r, z1 * r));
  }
}

}  // namespace

void read_masses(Table& top, Scene& scene, ResolvedScene& record) {
  const NameScope space = name_scope(scene);
  for (Table& table : tables_of(top, "masses")) {
    PointMass mass;
    mass.place = table.place();
    mass.node = read_node(table, "node", space);
    mass.mass = table.number("mass");
    mass.inertia = table.number("inertia");
    table.finish();
    scene.masses.push_back(mass);
    record.add("masses", "[[masses]]", table.record());
  }
}

namespace {

/// A key of a table; a message about a contradiction may report its place.
struct ConflictingKey {
  const Table& table;
  const char* key;
};

/// Refuses contradictory keys. The message reports the place of the key that --set gave, otherwise of the first key.
[[noreturn]] void contradict(std::initializer_list<ConflictingKey> keys, const std::string& message) {
  const ConflictingKey* at = keys.begin();
  for (const ConflictingKey& one : keys)
    if (one.table.has(one.key) && one.table.place(one.key).line == SourcePlace::command_line) {
      at = &one;
      break;
    }
  at->table.fail(at->key, message);
}

/// Reads a spring hanger: cold = hot + stiffness travel. The cold load is the preload of the spring.
void read_hanger(Table& table, Spring& spring) {
  Table hanger = table.child("hanger");
  if (table.has("preload"))
    contradict({{table, "preload"}, {table, "hanger"}},
               "preload cannot be combined with hanger, because the cold load of the hanger is the preload; "
               "give only one of them");
  const double hot = hanger.number("hot");
  const std::optional<double> cold = hanger.optional_number("cold"),
                              travel = hanger.optional_number("travel");
  const bool stiff = table.has("stiffness");
  const ConflictingKey hot_key{hanger, "hot"}, cold_key{hanger, "cold"}, travel_key{hanger, "travel"},
      stiffness_key{table, "stiffness"};
  if (const int given = (cold ? 1 : 0) + (travel ? 1 : 0) + (stiff ? 1 : 0); given != 2)
    contradict(
        {{table, "hanger"}, cold_key, travel_key, stiffness_key},
        fmt::format("found {} of cold, travel and the spring's stiffness, expected two of them, from which "
                    "cold = hot + stiffness * travel gives the third",
                    given == 0   ? "none"
                    : given == 1 ? "one"
                                 : "all three"));
  spring.hot_load = hot;
  spring.preload = cold ? *cold : hot + spring.stiffness * *travel;
  if (!stiff && *travel == 0.0)
    hanger.fail("travel", "found 0, expected a travel > 0 or < 0, because stiffness = (cold - hot) / travel");
  if (!stiff) spring.stiffness = (*cold - hot) / *travel;
  if (!(spring.stiffness > 0.0) || !std::isfinite(spring.stiffness))
    contradict({{table, "hanger"}, hot_key, cold_key, travel_key, stiffness_key},
               fmt::format("the stiffness would be {:.6g}, expected > 0: stiffness = (cold - hot) / travel, "
                           "and travel > 0 means motion against direction, which decreases the load",
                           spring.stiffness));
  if (!(spring.preload >= 0.0))
    contradict(
        {travel_key, hot_key, cold_key, stiffness_key},
        fmt::format(
            "the load in the undeformed state, hot + stiffness * travel, would be {:.6g}, expected >= 0",
            spring.preload));
  hanger.finish();
  table.record("hanger", hanger.record().inline_table());
}

}  // namespace

void read_springs(Table& top, Scene& scene, ResolvedScene& record) {
  const NameScope space = name_scope(scene);
  for (Table& table : tables_of(top, "springs")) {
    Spring spring;
    spring.place = table.place();
    spring.node = read_node(table, "node", space);
    if (table.has("against")) {
      spring.against = read_node(table, "against", space);
      if (spring.against == spring.node) table.wrong("against", "a node other than the spring's own node");
    }
    spring.rotation_stiffness = table.number("rotation_stiffness");
    spring.rotation_damping = table.number("rotation_damping");
    const bool turns = table.has("rotation_stiffness") || table.has("rotation_damping");
    if (!turns) table.require("direction", "");
    if (table.has("direction")) {
      spring.direction = read_unit_vector(table, "direction");
      if (table.has("stiffness") || !table.has("hanger")) spring.stiffness = table.number("stiffness");
      spring.damping = table.number("damping");
      if (table.has("hanger"))
        read_hanger(table, spring);
      else
        spring.preload = table.number("preload");
    }
    table.finish("needs a direction in the same table");
    scene.springs.push_back(spring);
    record.add("springs", "[[springs]]", table.record());
  }
}

namespace {

void read_support_motion(Table& table, Support& support, std::size_t held, const Scene& scene) {
  const bool acceleration = table.has("acceleration");
  const char* key = acceleration ? "acceleration" : "motion";
  if (!table.has(key)) return;
  if (acceleration && table.has("motion"))
    table.fail("acceleration", "cannot be combined with motion; give only one of them");
  if (held != 1)
    table.fail(
        key,
        fmt::format(
            "needs exactly one direction in fix, found {} directions; write one support for each direction",
            held));
  if (acceleration && support.rz)
    table.fail("acceleration", "has no meaning for the rotation rz; give motion instead");
  support.motion = read_number_or_history(table, key, scene,
                                          acceleration ? RecordQuantity::acceleration
                                          : support.rz ? RecordQuantity::none
                                                       : RecordQuantity::displacement);
  support.motion_is_acceleration = acceleration;
}

}  // namespace

void read_supports(Table& top, Scene& scene, ResolvedScene& record) {
  const NameScope space = name_scope(scene);
  for (Table& table : tables_of(top, "supports")) {
    Support support;
    support.place = table.place();
    support.key = table.path();
    const std::vector<std::string> nodes = read_one_or_more_nodes(table, space);
    table.require("fix", "");
    const std::vector<std::string> held = table.texts("fix");
    if (held.empty()) table.wrong("fix", "any of \"ux\", \"uy\", \"rz\"");
    for (const std::string& name : held) {
      check_known(name, {"ux", "uy", "rz"}, "degree of freedom", table.place("fix"), table.path("fix"));
      bool& fixed = name == "ux" ? support.ux : name == "uy" ? support.uy : support.rz;
      if (fixed) table.fail("fix", "found \"" + name + "\" twice, expected each direction once");
      fixed = true;
    }
    read_support_motion(table, support, held.size(), scene);
    table.finish();
    for (const std::string& node : nodes) {
      support.node = node;
      scene.supports.push_back(support);
    }
    record.add("supports", "[[supports]]", table.record());
  }
}

void read_damping(Table& top, Scene& scene, ResolvedScene& record) {
  Table table = top.child("damping");
  DampingSpec& damping = scene.damping;
  damping.place = table.place();
  if (table.has("ratios") || table.has("frequencies")) {
    read_ratios(table, damping);
    table.finish("cannot be combined with ratios; give only one of them");
    record.add("damping", "[damping]", table.record());
    return;
  }
  if (table.has("alpha") && table.has("alpha_over_omega1")) {
    table.fail("alpha_over_omega1", "cannot be combined with alpha; give only one of them");
  }
  damping.alpha_over_omega1 = table.optional_number("alpha_over_omega1");
  if (!damping.alpha_over_omega1) damping.alpha = table.number("alpha");
  damping.beta = table.number("beta");
  table.finish();
  record.add("damping", "[damping]", table.record());
}

}  // namespace signorini::scene
