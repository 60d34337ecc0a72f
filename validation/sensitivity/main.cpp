// Derivatives of event times on random scenes, by a key drawn at random, against differences of `exact` (README.md).
//
//   signorini_sensitivities --count 100 --from 1 [--seconds 5] [--verbose]
//
//   D(h) = ( 8 (t(p+h) - t(p-h)) - (t(p+2h) - t(p-2h)) ) / 12h       at three h, ten apart
//
// Of the three the two that differ least are taken, and their difference is how well the differences know the
// derivative. An event is judged where they know it to a thousandth of its size, and all five runs have the same sequence
// up to it. It agrees if |dt/dp - D| <= 1e-6 |D| + 3 (their difference) + 1e-9 t/p. One table on stdout, a line on
// stderr for each scene that disagrees. Exit code 1 if any does.
#include <fmt/core.h>
#include <toml++/toml.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <ctime>
#include <map>
#include <random>

#include "differential/generator.hpp"
#include "signorini/error.hpp"
#include "signorini/sensitivity.hpp"
#include "signorini/simulate.hpp"

namespace {

using namespace signorini;
/// Ends a run after its time of the processor: another program beside it cuts nothing short.
class Deadline : public Result {
 public:
  explicit Deadline(double seconds) : end_(now() + seconds) {}
  bool progress(double /*t*/) override { return now() < end_; }

 private:
  static double now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }
  double end_;
};

/// "matrices.mass.2.3": alone it would make the matrix unsymmetric.
bool off_diagonal(const std::string& path) {
  if (!path.starts_with("matrices.")) return false;
  const std::size_t last = path.rfind('.'), before = path.rfind('.', last - 1);
  return path.substr(last) != path.substr(before, last - before);
}

/// All numbers of a table by path, but those of [run] and what is no datum.
void collect(const toml::node& node, const std::string& path, std::vector<std::string>& found) {
  if (const auto* table = node.as_table()) {
    for (const auto& [key, value] : *table) {
      const std::string name(key.str());
      if (path.empty() && (name == "run" || name == "units" || name == "schema" || name == "reduction"))
        continue;
      collect(value, path.empty() ? name : path + "." + name, found);
    }
  } else if (const auto* array = node.as_array()) {
    for (std::size_t i = 0; i < array->size(); ++i)
      collect((*array)[i], fmt::format("{}.{}", path, i + 1), found);
  } else if (const auto number = node.value<double>();
             number && !node.is_boolean() && std::isfinite(*number)) {
    if (path.find("elements") == std::string::npos && path.find("rounds") == std::string::npos &&
        !off_diagonal(path))
      found.push_back(path);
  }
}

struct Tally {
  long scenes = 0, refused = 0, ended = 0, cut = 0;
  long events = 0, agreed = 0, disagreed = 0, unknown = 0, without = 0;
  std::map<std::string, long> reasons;
};

struct Asked {
  std::uint64_t count = 100, from = 1;
  double seconds = 5.0;
  bool verbose = false;
};

bool same_event(const Event& a, const Event& b) {
  return a.contact == b.contact && a.type == b.type && a.from == b.from && a.to == b.to;
}

/// Times of events at p + k h, k = -2, -1, 1, 2; empty: a run is refused, or takes too long.
std::vector<std::vector<Event>> moved_runs(const SceneReader& read, const Parameter& p, double h,
                                           const Asked& asked) {
  std::vector<std::vector<Event>> runs;
  for (const int k : {-2, -1, 1, 2}) {
    try {
      Scene scene = read({{p.path, fmt::format("{:.17g}", p.value + k * h)}});
      scene.run.flow = Flow::taylor;
      scene.run.certify = Certify::no;
      Deadline result(asked.seconds);
      const Report report = simulate(build_model(scene), scene.run, result);
      if (report.outcome.kind == Outcome::Kind::interrupted) return {};
      runs.push_back(std::move(result.events));
    } catch (const Error&) {
      return {};
    }
  }
  return runs;
}

void judge(const Sensitivities& s, const SceneReader& read, std::uint64_t seed, const Asked& asked,
           Tally& tally) {
  const Parameter& p = s.parameters[0];
  const double size = p.value != 0.0 ? std::abs(p.value) : 512.0 * std::abs(p.step);
  std::vector<std::vector<std::vector<Event>>> all;
  std::vector<double> steps;
  for (const double part : {3e-4, 3e-5, 3e-6}) {
    all.push_back(moved_runs(read, p, part * size, asked));
    steps.push_back(part * size);
  }
  bool said = false;
  for (std::size_t i = 0; i < s.events.size(); ++i) {
    ++tally.events;
    const double rate = s.event_rates[i][0].t;
    if (!std::isfinite(rate)) {
      ++tally.without;
      continue;
    }
    std::vector<double> estimates;
    for (std::size_t j = 0; j < all.size(); ++j) {
      const auto& runs = all[j];
      bool same = runs.size() == 4;
      for (const auto& run : runs) {
        same = same && run.size() > i;
        for (std::size_t e = 0; same && e <= i; ++e) same = same_event(run[e], s.events[e]);
      }
      if (!same) continue;
      estimates.push_back((8.0 * (runs[2][i].t - runs[1][i].t) - (runs[3][i].t - runs[0][i].t)) /
                          (12.0 * steps[j]));
    }
    double best = 0.0, apart = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j + 1 < estimates.size(); ++j)
      if (const double d = std::abs(estimates[j] - estimates[j + 1]); d < apart) {
        apart = d;
        best = estimates[j];
      }
    const double least = 1e-9 * s.events[i].t / size;
    if (!(apart <= 1e-3 * std::abs(best) + least)) {
      ++tally.unknown;
      continue;
    }
    if (std::abs(rate - best) <= 1e-6 * std::abs(best) + 3.0 * apart + least) {
      ++tally.agreed;
      continue;
    }
    ++tally.disagreed;
    if (!said || asked.verbose)
      fmt::print(stderr, "seed {} by {} = {:g}: event {} at {:.9g}: {:.9g}, differences {:.9g} +- {:.1g}\n",
                 seed, p.path, p.value, i + 1, s.events[i].t, rate, best, apart);
    said = true;
  }
}

void run_seed(std::uint64_t seed, const Asked& asked, Tally& tally) {
  const std::string text = differential::draw_scene(seed);
  // exact does not follow friction that depends on the slip rate
  std::vector<Override> always{{"run.engine", "exact"}};
  if (text.find("stribeck_velocity") != std::string::npos)
    always = {{"run.engine", "ida"}, {"run.rtol", "1e-11"}};
  const SceneReader read = [&](const std::vector<Override>& changes) {
    std::vector<Override> all = always;
    all.insert(all.end(), changes.begin(), changes.end());
    return parse_scene(text, fmt::format("seed-{}.toml", seed), all);
  };
  std::vector<std::string> paths;
  const toml::table root = toml::parse(read({}).resolved);
  collect(root, "", paths);
  std::mt19937_64 random(seed);
  const std::string path = paths[random() % paths.size()];
  ++tally.scenes;
  try {
    Deadline recorder(asked.seconds);
    const Sensitivities s = sensitivities(read, {path}, &recorder);
    if (s.report.outcome.kind == Outcome::Kind::interrupted) {
      ++tally.cut;
      return;
    }
    if (!s.parameters[0].reason.empty()) {
      ++tally.ended;
      ++tally.reasons[s.parameters[0].reason];
    }
    judge(s, read, seed, asked, tally);
  } catch (const Error& error) {
    ++tally.refused;
    if (asked.verbose) fmt::print(stderr, "seed {} by {}: {}\n", seed, path, error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"derivatives of random scenes against differences", "signorini_sensitivities"};
  Asked asked;
  app.add_option("--count", asked.count, "scenes");
  app.add_option("--from", asked.from, "the first seed");
  app.add_option("--seconds", asked.seconds, "of the processor that a run may take");
  app.add_flag("--verbose", asked.verbose, "say every disagreement and refusal");
  CLI11_PARSE(app, argc, argv);
  Tally tally;
  for (std::uint64_t seed = asked.from; seed < asked.from + asked.count; ++seed) run_seed(seed, asked, tally);
  fmt::print("scenes {}, refused {}, too long {}, derivatives that end before the run {}\n", tally.scenes,
             tally.refused, tally.cut, tally.ended);
  fmt::print("events {}: agree {}, disagree {}, not known to differences {}, without derivative {}\n",
             tally.events, tally.agreed, tally.disagreed, tally.unknown, tally.without);
  if (asked.verbose)
    for (const auto& [reason, count] : tally.reasons) fmt::print("  {} x {}\n", count, reason);
  return tally.disagreed > 0 ? 1 : 0;
}
