#include "published/runs.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace signorini::published {

Result run(const std::string& scene, const Settings& settings, std::vector<Override> changes) {
  changes.push_back({"run.engine", settings.engine});
  changes.push_back({"run.rtol", settings.rtol});
  changes.push_back({"run.dt", fmt::format("{}", settings.dt)});
  const std::string path = scene.find('/') == std::string::npos ? SIGNORINI_PUBLISHED "/" + scene : scene;
  const Scene read = read_scene(path, changes);
  Result result = simulate(build_model(read), read.run);
  if (result.report.outcome.kind != Outcome::Kind::done)
    throw std::runtime_error(scene + ", " + settings.engine + ": " + result.report.outcome.reason);
  return result;
}

const Event* nth(const Result& result, EventType type, std::size_t n) {
  for (const Event& e : result.events)
    if (e.type == type && n-- == 0) return &e;
  return nullptr;
}

double time_of(const Result& result, EventType type, std::size_t n) {
  const Event* e = nth(result, type, n);
  return e ? e->t : missing;
}

const Result::Row& row_at(const Result& result, double t) {
  for (const Result::Row& row : result.rows)
    if (std::abs(row.t - t) <= 4.0 * std::numeric_limits<double>::epsilon() * t) return row;
  throw std::runtime_error(fmt::format("no row at {}", t));
}

std::string list(const std::vector<double>& values) { return fmt::format("[{}]", fmt::join(values, ", ")); }

}  // namespace signorini::published
