// Random scenes through the engines, which must agree as far as each promises (README.md).
//
//   signorini_differential --from 1 --count 1000
//   signorini_differential --seed 17 --shrink --keep disagreements
//   signorini_differential --scene disagreements/seed-17.toml
//   signorini_differential --transformed exact --from 1 --count 1000      (metamorphic.hpp)
//   signorini_differential --transformed ida --angles 360 --scales 100 --scene models/rigid-frame.toml
//   signorini_differential --coupled --from 1 --count 10000               (coupled.hpp)
//   signorini_differential --loaded --transformed exact                   (draw_loaded.cpp)
//   signorini_differential --flows --from 1 --count 1000                  (flows.hpp)
//   signorini_differential --relations --from 1 --count 1000              (relations.hpp)
//   signorini_differential --relations --structures --from 1 --count 1000 (draw_structure.cpp)
//   signorini_differential --landings --from 1 --count 1000               (landings.hpp)
//   signorini_differential --witness --coupled --from 1 --count 1000      (witnessed.hpp)
//   signorini_differential --pairs --minutes 60                           (pairs.hpp)
//
// One line a scene, then a table. Exit code 1 if any scene is called DISAGREE, or one written in another way
// has another answer, 2 for a wrong command line.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>

#include "differential/coupled.hpp"
#include "differential/flows.hpp"
#include "differential/generator.hpp"
#include "differential/judge.hpp"
#include "differential/landings.hpp"
#include "differential/metamorphic.hpp"
#include "differential/pairs.hpp"
#include "differential/relations.hpp"
#include "differential/shrink.hpp"
#include "differential/witnessed.hpp"

namespace {

using namespace signorini;
using namespace signorini::differential;

struct Asked {
  std::uint64_t from = 1;
  long count = 100;
  double seconds = std::numeric_limits<double>::infinity();
  long run_steps = JudgeSettings{}.steps;
  bool shrink = false, print = false, coupled = false, flows = false, loaded = false, structures = false,
       relations = false, landings = false, verbose = false, witness = false, pairs = false;
  double minutes = 60.0;              ///< --pairs
  std::vector<std::string> features;  ///< --pairs: with one of these
  std::string relation;               ///< the only one
  std::string keep, scene;
  std::string transformed;  ///< engine that computes scenes written in other ways
  std::uint64_t seed_of_ways = 1;
  int angles = 0, scales = 0;  ///< in place of the drawn ways
  std::vector<std::string> changes;

  [[nodiscard]] Engine engine_of_ways() const {
    for (const EngineInfo& engine : all_engines)
      if (engine.name == transformed) return engine.engine;
    return Engine::exact;
  }
};

std::vector<Override> overrides(const std::vector<std::string>& changes) {
  std::vector<Override> list;
  for (const std::string& change : changes) {
    const std::size_t at = change.find('=');
    list.push_back({change.substr(0, at), at == std::string::npos ? "" : change.substr(at + 1)});
  }
  return list;
}

std::string describe(const Judgement& judgement) {
  std::string text = fmt::format("{:<15} {:4} events", to_string(judgement.verdict), judgement.events);
  for (const Comparison& c : judgement.comparisons)
    text += fmt::format("  {}: {:.2g} to {:.4g}{}", c.engine, c.worst, c.until, c.to_end ? "" : " only");
  if (!judgement.what.empty()) text += "  -- " + judgement.what;
  return text;
}

/// Which engines are wrong: what a smaller scene has to show as well.
std::vector<std::string> wrong_engines(const Judgement& judgement) {
  std::vector<std::string> names;
  for (const Comparison& c : judgement.comparisons)
    if (c.verdict == Verdict::disagree) names.push_back(c.engine);
  return names;
}

std::string smaller(const std::string& text, const Judgement& judgement, const JudgeSettings& settings) {
  const std::vector<std::string> wrong = wrong_engines(judgement);
  return shrink(
      text,
      [&](const std::string& candidate) {
        try {
          return wrong_engines(judge(parse_scene(candidate, "smaller.toml"), settings)) == wrong;
        } catch (const Error&) {
          return false;
        }
      },
      2000);
}

class Tally {
 public:
  void add(const Judgement& judgement) {
    ++scenes_[judgement.verdict];
    events_ += judgement.events;
    const auto& all = judgement.comparisons;
    const auto whole = [](const Comparison& c) { return c.to_end; };
    if (!all.empty() && std::all_of(all.begin(), all.end(), whole)) ++to_end_;
    for (const Comparison& c : all) {
      whole_[c.engine] += c.to_end ? 1 : 0;
      ++engines_[c.engine][c.verdict];
      aligned_[c.engine] += c.aligned;
      times_[c.engine] += c.times;
      sharp_times_[c.engine] += c.sharp_times;
      worst_[c.engine].push_back(c.worst);
    }
  }

  void print() {
    fmt::print("\n| verdict | scenes |\n|---|---|\n");
    for (const auto& [verdict, count] : scenes_) fmt::print("| {} | {} |\n", to_string(verdict), count);
    fmt::print("\n{} scenes compared to the end by all engines; {} events of the reference\n\n", to_end_,
               events_);
    fmt::print(
        "| engine | agree | unresolved | ill-conditioned | too long | undecided | DISAGREE | to the end |");
    fmt::print(" events in order | times sharp, % | error/allowed: median | greatest |\n");
    fmt::print("|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (auto& [engine, counts] : engines_) {
      std::vector<double>& worst = worst_[engine];
      std::sort(worst.begin(), worst.end());
      fmt::print("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {:.2f} | {:.2g} | {:.2g} |\n", engine,
                 counts[Verdict::agree], counts[Verdict::unresolved], counts[Verdict::ill_conditioned],
                 counts[Verdict::too_long], counts[Verdict::undecided], counts[Verdict::disagree],
                 whole_[engine], aligned_[engine], 100.0 * sharp_share(engine), worst[worst.size() / 2],
                 worst.back());
    }
  }

  [[nodiscard]] int exit_code() { return scenes_[Verdict::disagree] > 0 ? 1 : 0; }

 private:
  std::map<Verdict, long> scenes_;
  [[nodiscard]] double sharp_share(const std::string& engine) {
    return times_[engine] == 0
               ? 1.0
               : static_cast<double>(sharp_times_[engine]) / static_cast<double>(times_[engine]);
  }

  long to_end_ = 0;
  std::size_t events_ = 0;
  std::map<std::string, long> whole_;
  std::map<std::string, std::map<Verdict, long>> engines_;
  std::map<std::string, std::size_t> aligned_, times_, sharp_times_;
  std::map<std::string, std::vector<double>> worst_;
};

void examine(const std::string& name, const std::string& text, const Asked& asked, Tally& tally) {
  JudgeSettings settings;
  settings.steps = asked.run_steps;
  Judgement judgement;
  const auto start = std::chrono::steady_clock::now();
  try {
    judgement = judge(parse_scene(text, name + ".toml"), settings);
  } catch (const SceneError& error) {
    judgement.verdict = Verdict::refused;
    judgement.what = error.what();
  }
  const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  tally.add(judgement);
  fmt::print("{} {:5.2f} s  {}\n", name, took, describe(judgement));
  std::fflush(stdout);
  if (judgement.verdict != Verdict::disagree || asked.keep.empty()) return;
  std::filesystem::create_directories(asked.keep);
  std::ofstream(std::filesystem::path(asked.keep) / (name + ".toml"))
      << (asked.shrink ? smaller(text, judgement, settings) : text);
}

/// Of scenes written in other ways.
struct Ways {
  long scenes = 0, compared = 0, same = 0, unlike = 0, refused = 0, to_end = 0, stopped = 0;
  std::size_t events = 0;
  double worst = 0.0;

  void print() const {
    fmt::print(
        "\n| scenes | written otherwise | same | to the end | UNLIKE | REFUSED | ended otherwise | events | "
        "error/allowed |\n");
    fmt::print("|---|---|---|---|---|---|---|---|---|\n| {} | {} | {} | {} | {} | {} | {} | {} | {:.2g} |\n",
               scenes, compared, same, to_end, unlike, refused, stopped, events, worst);
  }
  [[nodiscard]] int exit_code() const { return unlike + refused > 0 ? 1 : 0; }
};

void rewrite(const std::string& name, const std::string& text, const Asked& asked, Ways& ways) {
  MetamorphicSettings settings;
  settings.engine = asked.engine_of_ways();
  settings.bounds.steps = asked.run_steps;
  settings.bounds.seconds = JudgeSettings{}.seconds;
  Scene scene =
      parse_scene(text, asked.scene.empty() ? name + ".toml" : asked.scene, overrides(asked.changes));
  if (asked.flows) {
    settings.factor = roundings_of_modes;
    const std::optional<Scene> suited = for_both_flows(scene);
    if (!suited) return;
    scene = *suited;
  }
  const Metamorphic judge(scene, settings);
  if (!judge.hindrance().empty()) {
    fmt::print("{}: not for this: {}\n", name, judge.hindrance());
    return;
  }
  ++ways.scenes;
  const bool campaign = asked.angles > 0 || asked.scales > 0;
  for (const Transformed& other : asked.flows ? std::vector<Transformed>{in_modes(scene)}
                                  : campaign  ? angles_and_scales(scene, asked.angles, asked.scales)
                                              : transformations(scene, asked.seed_of_ways)) {
    const Sameness found = judge.compare(other);
    ++ways.compared;
    ways.events += found.events;
    ways.to_end += found.to_end ? 1 : 0;
    ways.stopped += found.ended ? 0 : 1;
    const bool same = found.verdict == Sameness::Verdict::same;
    const bool refused = found.verdict == Sameness::Verdict::refused;
    ++(same ? ways.same : refused ? ways.refused : ways.unlike);
    if (same) ways.worst = std::max(ways.worst, found.worst);
    fmt::print("{} {}: {} {} events, {:.2g} of allowed{}{}\n", name, other.name,
               same      ? "same"
               : refused ? "REFUSED"
                         : "UNLIKE",
               found.events, found.worst,
               !found.ended    ? ", ENDED OTHERWISE"
               : !found.to_end ? ", not to the end"
                               : "",
               found.what.empty() ? "" : "  -- " + found.what);
    std::fflush(stdout);
  }
}

/// Of rigid contacts that move each other.
struct Decisions {
  std::map<std::string, long> scenes, causes;
  long instants = 0, confirmed = 0, as_told = 0, unclear = 0, undecided = 0;
  double worst = 0.0;

  void print() const {
    fmt::print("\n| verdict | scenes |\n|---|---|\n");
    for (const auto& [verdict, count] : scenes) fmt::print("| {} | {} |\n", verdict, count);
    fmt::print("\n| why a run stops: what could follow | scenes |\n|---|---|\n");
    for (const auto& [cause, count] : causes) fmt::print("| {} | {} |\n", cause, count);
    fmt::print(
        "\n{} instants: {} with one continuation, which the run follows to {:.2g} at worst, in {} from "
        "speeds that "
        "may be rounding; {} unclear; {} left open by rounding\n",
        instants, confirmed, worst, as_told, unclear, undecided);
  }
  [[nodiscard]] int exit_code() const {
    using Verdict = CoupledFinding::Verdict;
    const auto any = [&](Verdict verdict) { return scenes.count(to_string(verdict)) > 0; };
    return any(Verdict::refused) || any(Verdict::unlike) || any(Verdict::broken) ? 1 : 0;
  }
};

void look_at_decisions(const std::string& name, const std::string& text, Decisions& decisions) {
  using Verdict = CoupledFinding::Verdict;
  const CoupledFinding found = examine_coupled(parse_scene(text, name + ".toml"));
  ++decisions.scenes[to_string(found.verdict)];
  if (!found.cause.empty())
    ++decisions.causes[found.verdict == Verdict::refused ? found.cause.substr(0, found.cause.find(','))
                                                         : found.cause];
  decisions.instants += found.instants;
  decisions.confirmed += found.confirmed;
  decisions.as_told += found.as_told;
  decisions.unclear += found.unclear;
  decisions.undecided += found.undecided;
  decisions.worst = std::max(decisions.worst, found.worst);
  if (found.verdict == Verdict::agrees && found.undecided == 0) return;
  fmt::print("{}: {} at t = {:.9g}, {} undecided; {} -- {}\n", name, to_string(found.verdict), found.t,
             found.undecided, found.cause, found.what);
  std::fflush(stdout);
}

/// Of runs before their witness.
struct Alarms {
  long scenes = 0, refused = 0, runs = 0, checked = 0, with_alarms = 0;
  std::map<std::string, long> laws;

  void print() const {
    fmt::print("\n{} scenes ({} refused), {} runs, {} instants and stretches, {} runs with alarms\n", scenes,
               refused, runs, checked, with_alarms);
    for (const auto& [law, count] : laws) fmt::print("  {}: {}\n", law, count);
  }
  [[nodiscard]] int exit_code() const { return with_alarms > 0 ? 1 : 0; }
};

void look_at_witness(const std::string& name, const std::string& text, const Asked& asked, Alarms& alarms) {
  ++alarms.scenes;
  try {
    const Witnessed found = before_the_witness(
        parse_scene(text, asked.scene.empty() ? name + ".toml" : asked.scene, overrides(asked.changes)),
        asked.run_steps);
    alarms.runs += found.runs;
    alarms.checked += found.checked;
    std::map<std::string, long> ways;
    for (const Alarm& a : found.alarms) {
      ++ways[a.way];
      ++alarms.laws[a.way + ", " + a.law];
      fmt::print("{} {}: {} {} {} times, t = {:.9g} ({}): {:.3g}, limit {:.3g}{}\n", name, a.way, a.law,
                 a.contact, a.count, a.worst.t, a.worst.event, a.worst.value, a.worst.limit,
                 a.worst.unexplained ? " GRAVE" : "");
    }
    alarms.with_alarms += static_cast<long>(ways.size());
  } catch (const SceneError&) {
    ++alarms.refused;
  }
  std::fflush(stdout);
}

std::vector<std::string> names_of_relations() {
  std::vector<std::string> names;
  for (const RelationKind& kind : relation_kinds) names.emplace_back(kind.name);
  return names;
}

void look_at_relations(const std::string& name, const std::string& text, const Asked& asked,
                       RelationTally& tally) {
  RelationSettings settings;
  settings.seed = asked.seed_of_ways;
  settings.only = asked.relation;
  campaign_of_relations(text, name, settings, {asked.keep, asked.shrink, asked.verbose}, tally);
}

int look_at_pairs(const Asked& asked) {
  PairSettings settings;
  settings.from = asked.from;
  settings.minutes = asked.minutes;
  settings.only = asked.features;
  settings.keep = asked.keep;
  settings.shrink = asked.shrink;
  settings.verbose = asked.verbose;
  if (asked.print && asked.features.size() == 2) {
    const std::vector<Feature>& all = all_features();
    const auto called = [&](const std::string& name) {
      return std::find_if(all.begin(), all.end(), [&](const Feature& f) { return f.name == name; });
    };
    const auto a = called(asked.features[0]), b = called(asked.features[1]);
    if (a == all.end() || b == all.end()) return 2;
    fmt::print("{}\n", draw_pair(all, *a, *b, asked.from, 0).text);
    return 0;
  }
  const PairTable table = examine_pairs(settings);
  table.print();
  return table.exit_code();
}

/// A scene of the seed, of the kind that is asked for.
std::string drawn(const Asked& asked, std::uint64_t seed) {
  if (asked.structures) return draw_structure_scene(seed);
  if (asked.relations) return draw_whole_scene(seed);
  if (asked.landings) return draw_landing_scene(seed);
  return asked.coupled ? draw_coupled_scene(seed) : asked.loaded ? draw_loaded_scene(seed) : draw_scene(seed);
}

Asked read_command_line(int argc, char** argv, CLI::App& app) {
  Asked asked;
  std::uint64_t seed = 0;
  auto* one = app.add_option("--seed", seed, "one scene");
  app.add_option("--from", asked.from, "first seed")->excludes(one);
  app.add_option("--count", asked.count, "how many seeds from there on")->excludes(one);
  app.add_option("--time", asked.seconds, "begin no further scene after so many seconds");
  app.add_option("--run-steps", asked.run_steps, "steps and events that one run of one engine may take");
  app.add_flag("--shrink", asked.shrink, "keep the smallest scene that shows the disagreement");
  app.add_option("--keep", asked.keep, "directory for scenes on which engines disagree");
  app.add_flag("--print", asked.print, "print the scenes, run nothing");
  app.add_option("--scene", asked.scene, "judge a scene file instead of drawn ones")->excludes(one);
  app.add_option("--transformed", asked.transformed, "write each scene in other ways, too, and run it with")
      ->check(CLI::IsMember({"exact", "ida", "newmark"}));
  app.add_option("--angles", asked.angles, "of --transformed: so many turns around, in place of drawn ways");
  app.add_option("--scales", asked.scales, "and so many scales of force, length and time over 40 decades");
  app.add_option("--set", asked.changes, "PATH=VALUE in each scene that is transformed, or witnessed")
      ->allow_extra_args(false);
  app.add_flag(
         "--coupled", asked.coupled,
         "draw rigid contacts that move each other, and hold each decision against all that could follow")
      ->excludes("--transformed");
  app.add_flag("--loaded", asked.loaded, "draw frames with heat, moments, supports that move, stops, stages")
      ->excludes("--coupled");
  app.add_flag("--structures", asked.structures,
               "draw rigid bodies, bends, hangers and pendulums, by P-delta or without")
      ->excludes("--coupled")
      ->excludes("--loaded");
  app.add_flag("--witness", asked.witness,
               "run each scene with all engines, and print what their witness finds");
  app.add_flag("--flows", asked.flows,
               "change each scene to what modes follow, and run it with both flows of exact")
      ->excludes("--transformed");
  app.add_flag("--relations", asked.relations,
               "draw all that a scene can say, and hold each beside related ones")
      ->excludes("--coupled")
      ->excludes("--transformed")
      ->excludes("--flows");
  app.add_flag("--landings", asked.landings,
               "draw stiff bodies that fall on rigid contacts late, and look at each landing")
      ->excludes("--coupled")
      ->excludes("--relations");
  app.add_flag("--pairs", asked.pairs, "every pair of features in random scenes, and a table of them")
      ->excludes("--coupled")
      ->excludes("--relations");
  app.add_option("--minutes", asked.minutes, "of --pairs: no scene begins later");
  app.add_option("--feature", asked.features, "of --pairs: pairs with this feature; of two, this pair")
      ->allow_extra_args(false);
  app.add_option("--relation", asked.relation, "of --relations: this one only")
      ->check(CLI::IsMember(names_of_relations()));
  app.add_flag("--verbose", asked.verbose,
               "of --relations and --pairs: a line for each that is explained, too");
  app.add_option("--ways", asked.seed_of_ways, "seed of angles, orders and scales");
  app.parse(argc, argv);
  if (*one) {
    asked.from = seed;
    asked.count = 1;
  }
  if (asked.shrink && asked.keep.empty()) asked.keep = ".";
  return asked;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("random scenes through the engines exact, ida and newmark");
  Asked asked;
  try {
    asked = read_command_line(argc, argv, app);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (asked.pairs) return look_at_pairs(asked);
  Tally tally;
  Ways ways;
  Decisions decisions;
  RelationTally relations;
  LandingsTally landings;
  Alarms alarms;
  const auto look_at = [&](const std::string& name, const std::string& text) {
    if (asked.witness)
      look_at_witness(name, text, asked, alarms);
    else if (asked.relations)
      look_at_relations(name, text, asked, relations);
    else if (asked.landings)
      look_at_landings(name, text, landings);
    else if (asked.coupled)
      look_at_decisions(name, text, decisions);
    else if (asked.transformed.empty() && !asked.flows)
      examine(name, text, asked, tally);
    else
      rewrite(name, text, asked, ways);
  };
  const auto finish = [&] {
    if (asked.witness)
      alarms.print();
    else if (asked.relations)
      relations.print();
    else if (asked.landings)
      landings.print();
    else if (asked.coupled)
      decisions.print();
    else if (!asked.transformed.empty() || asked.flows)
      ways.print();
    else if (asked.scene.empty())
      tally.print();
    return std::max({tally.exit_code(), ways.exit_code(), decisions.exit_code(), landings.exit_code(),
                     alarms.exit_code(), relations.unexplained() > 0 ? 1 : 0});
  };
  if (!asked.scene.empty()) {
    std::ifstream file(asked.scene);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    look_at(std::filesystem::path(asked.scene).stem().string(), text);
    return finish();
  }
  const auto start = std::chrono::steady_clock::now();
  for (long i = 0; i < asked.count; ++i) {
    const std::uint64_t seed = asked.from + static_cast<std::uint64_t>(i);
    const std::string text = drawn(asked, seed);
    if (asked.print) {
      fmt::print("{}\n", text);
      continue;
    }
    if (std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() > asked.seconds) {
      fmt::print("time is up before seed {}\n", seed);
      break;
    }
    look_at(fmt::format("seed-{}", seed), text);
  }
  return asked.print ? 0 : finish();
}
