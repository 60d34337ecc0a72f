// Derivatives of all that a run reports, along series and beside ida, against differences of runs.
#include <doctest/doctest.h>

#include <cmath>

#include "signorini/sensitivity.hpp"
#include "unit/engine/six_masses.hpp"

namespace signorini::tests::tangent_runs {
namespace {

SceneReader reader(const std::string& text, const std::string& engine, const std::string& flow) {
  return [=](const std::vector<Override>& changes) {
    std::vector<Override> all{{"run.engine", engine}, {"run.flow", flow},        {"run.rtol", "1e-9"},
                              {"run.t_end", "2.5"},   {"run.output_dt", "0.19"}, {"contacts.c.gap", "0.03"}};
    all.insert(all.end(), changes.begin(), changes.end());
    return parse_scene(text, "test.toml", all);
  };
}

/// All numbers of a run in one list, and their derivatives by parameter p.
struct Numbers {
  std::vector<double> values, rates;
  std::vector<std::string> names;
};

Numbers numbers(const Sensitivities& s, std::size_t p) {
  Numbers n;
  const auto add = [&](const std::string& name, double value, double rate) {
    n.names.push_back(name);
    n.values.push_back(value);
    n.rates.push_back(rate);
  };
  for (std::size_t i = 0; i < s.events.size(); ++i) {
    const EventRates& rates = s.event_rates[i][p];
    const Event& e = s.events[i];
    add(fmt::format("t of event {}", i), e.t, rates.t);
    add(fmt::format("N_after of event {}", i), e.N_after, rates.N_after);
    add(fmt::format("T_after of event {}", i), e.T_after, rates.T_after);
    add(fmt::format("vn_after of event {}", i), e.vn_after, rates.vn_after);
    add(fmt::format("vt_after of event {}", i), e.vt_after, rates.vt_after);
    if (e.gap) add(fmt::format("gap of event {}", i), *e.gap, rates.gap);
  }
  for (std::size_t i = 0; i < s.times.size(); ++i)
    for (std::size_t c = 0; c < s.columns.size(); ++c)
      add(fmt::format("{} at {}", s.columns[c], s.times[i]), s.values[i][c], s.value_rates[p][i][c]);
  for (const Response& r : s.responses)  // the surface moves, so a greatest force or ut need not be a turn
    if (r.name.starts_with("rest") || r.name == "peak normal")
      add(fmt::format("{} {}", r.name, r.contact), r.value, r.rates[p]);
  return n;
}

}  // namespace

TEST_SUITE_BEGIN("unit/sensitivity/tangent_run");

TEST_CASE(
    "every number of a run by every number of its scene, along series, beside ida, and where modes give way "
    "to the series") {
  const std::vector<std::string> paths{"contacts.a.gap",
                                       "contacts.c.gap",
                                       "contacts.a.normal_stiffness",
                                       "contacts.b.tangential_stiffness",
                                       "contacts.a.friction",
                                       "contacts.a.surface_velocity",
                                       "loads.1.amplitude",
                                       "run.initial.u.1",
                                       "run.initial.v.2"};
  for (const auto& [text, flows] :
       {std::pair{six_masses(proportional, "gap = 0.002", ""),
                  std::vector<std::string>{"taylor", "ida", "modal"}},
        std::pair{six_masses(single_dampers, "gap = 0.002\nnormal_damping = 1.5",
                             "history = { type = \"harmonic\", omega = 7.0, phase = 0.4 }"),
                  std::vector<std::string>{"taylor", "ida", "modal"}}}) {
    std::vector<Sensitivities> found;
    for (const std::string& flow : flows)
      found.push_back(
          sensitivities(flow == "ida" ? reader(text, "ida", "auto") : reader(text, "exact", flow), paths));
    const SceneReader read = reader(text, "exact", "taylor");
    REQUIRE(found[0].events.size() > 2);
    for (std::size_t p = 0; p < paths.size(); ++p) {
      CAPTURE(paths[p]);
      const double x = found[0].parameters[p].value, h = 2e-4 * std::max(0.1, std::abs(x));
      std::vector<std::vector<double>> runs;
      for (const int k : {-2, -1, 1, 2}) {
        const SceneReader moved = [&](const std::vector<Override>& changes) {
          std::vector<Override> all{{paths[p], fmt::format("{:.17g}", x + k * h)}};
          all.insert(all.end(), changes.begin(), changes.end());
          return read(all);
        };
        runs.push_back(numbers(sensitivities(moved, {paths[p]}), 0).values);
      }
      for (std::size_t f = 0; f < found.size(); ++f) {
        CAPTURE(flows[f]);
        const Numbers n = numbers(found[f], p);
        for (const std::vector<double>& run : runs) REQUIRE(run.size() == n.rates.size());
        for (std::size_t i = 0; i < n.rates.size(); ++i) {
          CAPTURE(n.names[i]);
          const double difference =
              (8.0 * (runs[2][i] - runs[1][i]) - (runs[3][i] - runs[0][i])) / (12.0 * h);
          CHECK(std::abs(n.rates[i] - difference) <= 1e-5 * (1.0 + std::abs(difference)));
        }
      }
    }
  }
}

TEST_SUITE_END();

}  // namespace signorini::tests::tangent_runs
