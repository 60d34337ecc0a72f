// Random scenes through the engines, which must agree as far as each promises (README.md).
//
//   signorini_differential --from 1 --count 1000
//   signorini_differential --seed 17 --shrink --keep disagreements
//   signorini_differential --scene disagreements/seed-17.toml
//
// One line a scene, then a table. Exit code 1 if any scene is called DISAGREE, 2 for a wrong command line.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>

#include "differential/generator.hpp"
#include "differential/judge.hpp"
#include "differential/shrink.hpp"

namespace {

using namespace signorini;
using namespace signorini::differential;

struct Asked {
  std::uint64_t from = 1;
  long count = 100;
  double seconds = std::numeric_limits<double>::infinity();
  long run_steps = JudgeSettings{}.steps;
  bool shrink = false, print = false;
  std::string keep, scene;
};

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
  Tally tally;
  if (!asked.scene.empty()) {
    std::ifstream file(asked.scene);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    examine(std::filesystem::path(asked.scene).stem().string(), text, asked, tally);
    return tally.exit_code();
  }
  const auto start = std::chrono::steady_clock::now();
  for (long i = 0; i < asked.count; ++i) {
    const std::uint64_t seed = asked.from + static_cast<std::uint64_t>(i);
    const std::string text = draw_scene(seed);
    if (asked.print) {
      fmt::print("{}\n", text);
      continue;
    }
    if (std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() > asked.seconds) {
      fmt::print("time is up before seed {}\n", seed);
      break;
    }
    examine(fmt::format("seed-{}", seed), text, asked, tally);
  }
  if (!asked.print) tally.print();
  return tally.exit_code();
}
