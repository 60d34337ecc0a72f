// What the engines `newmark` and `friction-iteration` reach, against the exact flow of the same scene.
//
//   signorini_newmark_errors [SCENE FIRST_DT HALVINGS ENGINE [PATH=VALUE ...]]
//
// One row a step size: events that agree in order with the exact list, the greatest error of their times, the
// greatest error of displacements at the output times relative to the greatest displacement, orders between
// rows, time and solves a step. Without arguments: the public cases.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

struct Row {
  double dt, time_error = 0.0, u_error = 0.0;
};

std::vector<Event> state_changes(const Result& result) {
  std::vector<Event> events;
  for (const Event& e : result.events)
    if (e.type != EventType::time) events.push_back(e);
  return events;
}

/// Events closer than this part of the run are one instant, within which their order means nothing.
constexpr double simultaneous = 1e-9;

void sort_instants(std::vector<Event>& events, double t_end) {
  for (std::size_t i = 0; i < events.size();) {
    std::size_t j = i + 1;
    while (j < events.size() && events[j].t - events[i].t < simultaneous * t_end) ++j;
    std::sort(events.begin() + static_cast<std::ptrdiff_t>(i),
              events.begin() + static_cast<std::ptrdiff_t>(j),
              [](const Event& a, const Event& b) { return a.contact < b.contact; });
    i = j;
  }
}

Result run(const std::string& scene, std::vector<Override> changes, const std::string& engine, double dt) {
  changes.push_back({"run.engine", engine});
  changes.push_back({"run.dt", fmt::format("{}", dt)});
  const Scene s = read_scene(scene, changes);
  return simulate(build_model(s), s.run);
}

void table(const std::string& scene, const std::vector<Override>& changes, const std::string& engine,
           double first_dt, int halvings) {
  const Result exact = run(scene, changes, "exact", first_dt);
  const double t_end = exact.rows.back().t;
  std::vector<Event> expected = state_changes(exact);
  sort_instants(expected, t_end);
  double scale = 0.0;
  for (const Result::Row& row : exact.rows) scale = std::max(scale, row.u.cwiseAbs().maxCoeff());
  std::string shown;
  for (const Override& o : changes) shown += fmt::format(" {}={}", o.path, o.value);
  fmt::print("\n{} {}{}\n", scene.substr(scene.rfind('/') + 1), engine, shown);
  fmt::print("{:>10} {:>11} {:>10} {:>6} {:>10} {:>6} {:>9} {:>9} {:>7}  {}\n", "dt", "events", "time",
             "order", "u", "order", "energy", "steps", "us/step", "solves/step");
  Row before{0.0};
  double dt = first_dt;
  for (int i = 0; i <= halvings; ++i, dt *= 0.5) {
    const Result result = run(scene, changes, engine, dt);
    std::vector<Event> found = state_changes(result);
    sort_instants(found, t_end);
    Row row{dt};
    std::size_t agreeing = 0;
    for (; agreeing < std::min(expected.size(), found.size()); ++agreeing) {
      const Event &a = expected[agreeing], &b = found[agreeing];
      if (a.contact != b.contact || a.from != b.from || a.to != b.to) break;
      row.time_error = std::max(row.time_error, std::abs(a.t - b.t));
    }
    for (std::size_t j = 0; j < std::min(exact.rows.size(), result.rows.size()); ++j)
      row.u_error = std::max(row.u_error, (exact.rows[j].u - result.rows[j].u).cwiseAbs().maxCoeff() / scale);
    const auto order = [&](double a, double b) {
      return before.dt > 0.0 && b > 0.0 ? std::log2(a / b) : 0.0;
    };
    const Report& report = result.report;
    const auto steps = static_cast<double>(std::max(report.counters.steps, 1L));
    fmt::print(
        "{:10.3g} {:4}/{:3}/{:3} {:10.3g} {:6.2f} {:10.3g} {:6.2f} {:9.1e} {:9} {:7.2f} {:11.2f}  {}\n", dt,
        agreeing, found.size(), expected.size(), row.time_error, order(before.time_error, row.time_error),
        row.u_error, order(before.u_error, row.u_error),
        report.audit.energy.value / report.audit.energy_scale, report.counters.steps,
        1e6 * report.wall_time / steps, static_cast<double>(report.counters.solves) / steps,
        report.outcome.reason);
    before = row;
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc >= 5) {
    std::vector<Override> changes;
    for (int i = 5; i < argc; ++i) {
      const std::string word = argv[i];
      changes.push_back({word.substr(0, word.find('=')), word.substr(word.find('=') + 1)});
    }
    table(argv[1], changes, argv[4], std::stod(argv[2]), std::stoi(argv[3]));
    return 0;
  }
  const std::string cases = SIGNORINI_CASES "/";
  for (const char* refine : {"root", "linear"})
    for (const auto& [name, dt, halvings] :
         {std::tuple{"01a_coulomb_decay_rigid", 0.08, 7}, std::tuple{"01b_coulomb_decay_compliant", 0.08, 7},
          std::tuple{"02b_belt_fs_gt_fk", 0.08, 7}, std::tuple{"03b_den_hartog_2stop", 0.08, 7},
          std::tuple{"05b_two_mass_symmetric", 0.08, 7}, std::tuple{"06_point_compliant_kn1e+06", 8e-4, 7}})
      table(cases + name + ".toml", {{"run.refine", refine}}, "newmark", dt, halvings);
}
