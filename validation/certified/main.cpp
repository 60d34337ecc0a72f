// How often certificates are right: runs of ida beside either companion, against the exact flow (README.md).
//
//   signorini_certified --random 1000 SCENE...
//
// The truth is `exact`, as far as two runs of it with every datum off by one rounding keep its sequence; an
// event counts for coverage where that truth is a thousand times sharper than the bound. One table on stdout,
// a line on stderr for each event that is wrong or outside its bound. Exit code 1 if an event that is called
// certain is wrong.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>

#include "certify/companion.hpp"
#include "certify/event_matcher.hpp"
#include "differential/generator.hpp"
#include "run/cost_estimate.hpp"
#include "signorini/certify.hpp"
#include "signorini/error.hpp"

namespace {

using namespace signorini;
using Clock = std::chrono::steady_clock;

constexpr double sharper = 1000.0;

struct Asked {
  std::vector<std::string> scenes;
  std::vector<double> rtols = {1e-6, 1e-8, 1e-10};
  long random = 0, from = 1;
  double seconds = 20.0;  ///< a run may take
  std::vector<std::string> changes;
  std::FILE* rows = nullptr;  ///< scene, row, bound, error
};

/// Ends a run after its time.
class Deadline : public Recorder {
 public:
  explicit Deadline(double seconds) : end_(Clock::now() + std::chrono::duration<double>(seconds)) {}
  void event(const Event& /*event*/) override {}
  void sample(const Sample& /*sample*/) override {}
  bool progress(double /*t*/) override { return go_on(); }
  [[nodiscard]] bool go_on() const { return Clock::now() < end_; }

 private:
  std::chrono::time_point<Clock, std::chrono::duration<double>> end_;
};

struct Truth {
  certify::EventSequence track;
  Certificate certificate;
};

std::optional<Truth> truth_of(const Model& model, RunSpec run, double seconds) {
  run.engine = Engine::exact;
  run.certify = Certify::yes;
  if (!run::exact_accepts(model, run)) return std::nullopt;
  Deadline deadline(seconds);
  certify::CompanionTracker tracker(model, false, &deadline);
  CertifyOptions options;
  options.go_on = [&] { return deadline.go_on(); };
  CertifiedReport report = simulate_certified(model, run, tracker, options);
  return Truth{{std::move(tracker.events), report.report.outcome.t, ""}, std::move(*report.certificate)};
}

/// What the certificates of one setting were worth.
struct Tally {
  long scenes = 0, complete = 0, events = 0, right = 0, certain_right = 0, certain = 0, wrong = 0;
  long judged = 0, outside = 0;
  std::vector<double> overestimates;
  double own_seconds = 0.0, companion_seconds = 0.0, wait_seconds = 0.0;
};

/// Times of the truth by contact and number, with their errors.
struct Answers {
  struct Answer {
    const certify::TimedEvent* event;
    double error;
  };
  std::vector<std::vector<Answer>> of_contact;

  Answers(const Truth& truth, std::size_t contacts) : of_contact(contacts) {
    for (std::size_t i = 0; i < truth.track.events.size(); ++i) {
      const certify::TimedEvent& event = truth.track.events[i];
      if (event.is_change() && truth.certificate.certain(i))
        of_contact[static_cast<std::size_t>(event.contact)].push_back(
            {&event, truth.certificate.t_errors[i]});
    }
  }
};

void judge_run(const std::string& name, const certify::EventSequence& track, const Certificate& certificate,
               const Truth& truth, std::size_t contacts, Tally& tally, std::FILE* rows) {
  const Answers answers(truth, contacts);
  std::vector<std::size_t> next(contacts, 0);
  std::vector<bool> astray(contacts, false);
  double greatest = 0.0;  // bound
  for (std::size_t i = 0; i < track.events.size(); ++i) {
    const certify::TimedEvent& event = track.events[i];
    if (!event.is_change()) continue;
    const auto k = static_cast<std::size_t>(event.contact);
    const std::size_t number = next[k]++;
    const bool certain = certificate.certain(i);
    const double off_by = certain ? certificate.t_errors[i] : 0.0;
    greatest = std::max(greatest, off_by);
    if (event.t + off_by >= truth.certificate.until) continue;  // nobody knows
    ++tally.events;
    tally.certain += certain ? 1 : 0;
    const auto* answer = number < answers.of_contact[k].size() ? &answers.of_contact[k][number] : nullptr;
    const bool same = answer != nullptr && answer->event->type == event.type &&
                      answer->event->from == event.from && answer->event->to == event.to;
    if (!same) {
      if (certain) {
        ++tally.wrong;
        fmt::print(stderr, "{}: row {} at {:.12g}, {}, is certain and wrong (exact: {})\n", name, i + 1,
                   event.t, to_string(event.type), answer != nullptr ? answer->event->t : -1.0);
      }
      astray[k] = true;
      continue;
    }
    if (astray[k]) continue;
    ++tally.right;
    if (!certain) continue;
    ++tally.certain_right;
    const double bound = off_by, off = std::abs(event.t - answer->event->t);
    if (!event.is_located || answer->error * sharper > bound) continue;
    ++tally.judged;
    if (off > 0.0) {
      tally.overestimates.push_back(bound / off);
      if (rows != nullptr) fmt::print(rows, "{},{},{:.6g},{:.6g}\n", name, i + 1, bound, off);
    }
    if (off <= bound) continue;
    ++tally.outside;
    fmt::print(stderr, "{}: row {} at {:.12g} is off by {:.3g}, bound {:.3g}\n", name, i + 1, event.t, off,
               bound);
  }
  // What the exact flow has and a run that is called certain has not.
  const double known = std::min({certificate.until, track.reached, truth.certificate.until});
  for (std::size_t k = 0; k < contacts; ++k)
    for (std::size_t number = next[k]; number < answers.of_contact[k].size() && !astray[k]; ++number) {
      const auto& [event, error] = answers.of_contact[k][number];
      if (event->t + error + greatest >= known) break;
      ++tally.wrong;
      fmt::print(stderr, "{}: an event of exact at {:.12g}, {}, is missing before {:.12g}\n", name, event->t,
                 to_string(event->type), known);
    }
}

using Setting = std::pair<double, Companion>;

void examine(const std::string& name, const Scene& scene, const Asked& asked,
             std::map<Setting, Tally>& tallies) {
  const Model model = build_model(scene);
  for (const double rtol : asked.rtols) {
    RunSpec run = scene.run;
    run.engine = Engine::ida;
    run.certify = Certify::yes;
    run.rtol = rtol;
    run.output_dt.reset();
    run.output_times = std::vector{run.t_end};
    run.frames.clear();
    // Rebounds rest below a velocity that follows rtol: the truth is that of the same velocity.
    const auto held = certify::plan_companion(model, run).runs.front().model;
    const std::optional<Truth> truth = truth_of(held, run, asked.seconds);
    if (!truth) return;
    for (const Companion companion : {Companion::finer, Companion::exact}) {
      run.companion = companion;
      Deadline deadline(asked.seconds);
      certify::CompanionTracker tracker(model, false, &deadline);
      CertifyOptions options;
      options.go_on = [&] { return deadline.go_on(); };
      const CertifiedReport report = simulate_certified(model, run, tracker, options);
      Tally& tally = tallies[{rtol, companion}];
      ++tally.scenes;
      tally.complete += report.certificate->complete ? 1 : 0;
      tally.own_seconds += report.report.wall_time;
      tally.companion_seconds += report.certificate->wall_time;
      tally.wait_seconds += report.certificate->wait;
      const certify::EventSequence track{std::move(tracker.events), report.report.outcome.t, ""};
      judge_run(fmt::format("{}, rtol {:g}, {}", name, rtol, report.certificate->companion), track,
                *report.certificate, *truth, model.contacts.size(), tally, asked.rows);
    }
  }
}

double percent(long part, long whole) {
  return whole == 0 ? 100.0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

void print(std::map<Setting, Tally>& tallies) {
  fmt::print(
      "| rtol | companion | scenes | certain to the end | events | right ones certain, % | wrong ones "
      "certain |"
      " within their bound, % | of | overestimate: median | cost: companion / run | wait / run |\n");
  fmt::print("|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (auto& [setting, t] : tallies) {
    std::sort(t.overestimates.begin(), t.overestimates.end());
    const double median = t.overestimates.empty() ? 0.0 : t.overestimates[t.overestimates.size() / 2];
    fmt::print("| {:g} | {} | {} | {} | {} | {:.2f} | {} | {:.3f} | {} | {:.2g} | {:.2g} | {:.2g} |\n",
               setting.first, setting.second == Companion::exact ? "exact" : "finer", t.scenes, t.complete,
               t.events, percent(t.certain_right, t.right), t.wrong, percent(t.judged - t.outside, t.judged),
               t.judged, median, t.companion_seconds / t.own_seconds, t.wait_seconds / t.own_seconds);
  }
}

std::vector<Override> overrides(const std::vector<std::string>& changes) {
  std::vector<Override> list;
  for (const std::string& change : changes) {
    const std::size_t at = change.find('=');
    if (at == std::string::npos) throw UsageError("--set: expected PATH=VALUE");
    list.push_back({change.substr(0, at), change.substr(at + 1)});
  }
  return list;
}

int run_study(const Asked& asked) {
  std::map<Setting, Tally> tallies;
  const auto attempt = [&](const std::string& name, const auto& scene) {
    try {
      examine(name, scene(), asked, tallies);
    } catch (const Error& error) {
      fmt::print(stderr, "{}: {}\n", name, error.what());
    }
  };
  for (const std::string& path : asked.scenes)
    attempt(path, [&] { return read_scene(path, overrides(asked.changes)); });
  for (long seed = asked.from; seed < asked.from + asked.random; ++seed) {
    const std::string name = fmt::format("seed-{}", seed);
    attempt(name, [&] {
      return parse_scene(differential::draw_scene(static_cast<std::uint64_t>(seed)), name + ".toml");
    });
  }
  print(tallies);
  return std::any_of(tallies.begin(), tallies.end(), [](const auto& t) { return t.second.wrong > 0; }) ? 1
                                                                                                       : 0;
}

}  // namespace

int main(int argc, char** argv) {
  Asked asked;
  CLI::App app{"How often certificates are right", "signorini_certified"};
  app.add_option("SCENE", asked.scenes, "scene files");
  app.add_option("--random", asked.random, "so many random scenes besides");
  app.add_option("--from", asked.from, "the first seed");
  app.add_option("--rtol", asked.rtols, "tolerances of ida")->delimiter(',');
  app.add_option("--seconds", asked.seconds, "a run may take");
  app.add_option("--set", asked.changes, "PATH=VALUE in each SCENE");
  std::string rows;
  app.add_option("--rows", rows, "a file for each event's bound and error");
  CLI11_PARSE(app, argc, argv);
  if (!rows.empty() && (asked.rows = std::fopen(rows.c_str(), "w")) == nullptr) {
    fmt::print(stderr, "{}: cannot be written\n", rows);
    return 3;
  }
  const int code = run_study(asked);
  if (asked.rows != nullptr) std::fclose(asked.rows);
  return code;
}
