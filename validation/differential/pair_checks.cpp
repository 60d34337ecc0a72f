#include "differential/pair_checks.hpp"

#include <fmt/core.h>

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>

#include "differential/flows.hpp"
#include "differential/judge.hpp"
#include "differential/metamorphic.hpp"
#include "differential/pair_commands.hpp"
#include "differential/relation_judge.hpp"
#include "signorini/error.hpp"
#include "study/reduction/find_cutoff.hpp"

namespace signorini::differential {
namespace {

using Kind = Checked::Kind;
using Found = std::vector<Checked>;

bool asks(const CheckRequest& request, Check check) {
  return std::find(request.checks.begin(), request.checks.end(), check) != request.checks.end();
}

Checked by_likeness(const std::string& how, const Likeness& found, const SeenRun& run, double t_end) {
  using Class = Likeness::Class;
  if (!is_explained(found.verdict))
    return {Kind::broken, how,
            fmt::format("{}{}{}: {}", to_string(found.verdict), found.of.empty() ? "" : ", ", found.of,
                        found.what)};
  constexpr double least_part = 0.05;
  const bool compared =
      found.verdict == Class::same || found.verdict == Class::other_order ||
      (found.verdict == Class::ended_before && found.until > least_part * t_end) ||
      (found.verdict == Class::stopped_alike && run.end != Track::End::refused && run.t > least_part * t_end);
  return {compared ? Kind::held : Kind::idle, how,
          compared ? "" : fmt::format("{}: {}", to_string(found.verdict), found.what)};
}

Checked by_engines(const Scene& scene, const CheckRequest& request) {
  JudgeSettings settings;
  settings.steps = request.bounds.steps;
  settings.engine_steps = 4 * request.bounds.steps;
  settings.seconds = request.bounds.seconds;
  settings.scene_seconds = 4.0 * request.bounds.seconds;
  const Judgement found = judge(scene, settings);
  if (found.verdict == Verdict::disagree) return {Kind::broken, "engines", found.what};
  const bool compared = found.verdict == Verdict::agree || found.verdict == Verdict::unresolved ||
                        found.verdict == Verdict::ill_conditioned;
  return {compared ? Kind::held : Kind::idle, "engines",
          compared ? "" : fmt::format("{}: {}", to_string(found.verdict), found.what)};
}

Checked by_flows(const Scene& drawn, const CheckRequest& request) {
  const std::optional<Scene> scene = for_both_flows(drawn);
  if (!scene) return {Kind::idle, "flows", "modes do not follow it"};
  MetamorphicSettings settings;
  settings.factor = roundings_of_modes;
  settings.bounds = request.bounds;
  const Metamorphic judge(*scene, settings);
  if (!judge.hindrance().empty()) return {Kind::idle, "flows", judge.hindrance()};
  const Sameness found = judge.compare(in_modes(*scene));
  if (found.verdict == Sameness::Verdict::same) return {Kind::held, "flows", ""};
  return {found.verdict == Sameness::Verdict::refused ? Kind::idle : Kind::broken, "flows", found.what};
}

using Relation = std::optional<Related> (*)(const Scene& scene, std::uint64_t seed);
struct NamedRelation {
  const char* name;
  Relation of;
};

std::vector<NamedRelation> relations_of(const CheckRequest& request) {
  const bool goes_on = asks(request, Check::going_on), units = asks(request, Check::in_units);
  std::vector<NamedRelation> all;
  const auto fits = [&](const std::string& name) {
    if (!request.only.empty()) return name == request.only;
    if (goes_on || units) return (goes_on && name.rfind("going on", 0) == 0) || (units && name == "in units");
    return true;
  };
  for (const RelationKind& kind : relation_kinds)
    if (fits(kind.name)) all.push_back({kind.name, kind.of});
  if (fits("going on at an event")) all.push_back({"going on at an event", related_split_at_event});
  if (request.only.empty() && all.size() > 1)
    std::rotate(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(request.seed % all.size()), all.end());
  return all;
}

Found by_relations(const Scene& scene, const CheckRequest& request) {
  Found found;
  const RelationJudge judge(scene, request.bounds);
  if (judge.run().end == Track::End::refused) return {{Kind::refused, "run", judge.run().said}};
  if (judge.run().end == Track::End::too_long) return {{Kind::idle, "run", "too long"}};
  long held = 0;
  const long wanted =
      asks(request, Check::going_on) && asks(request, Check::in_units) ? 3 : request.relations;
  for (const NamedRelation& relation : relations_of(request)) {
    if (held >= wanted) break;
    const std::optional<Related> related = relation.of(scene, request.seed);
    if (!related) continue;
    const Likeness likeness =
        request.planted ? judge.compare(*related, request.planted(related->scene)) : judge.compare(*related);
    found.push_back(by_likeness(relation.name, likeness, judge.run(), scene.run.t_end));
    if (found.back().kind != Kind::idle) ++held;
  }
  return found;
}

/// The scene of the text, with what changes it as a whole: other units, a later start.
SceneReader reader(const CheckRequest& request) {
  const Scene scene = reduction::find_cutoff(parse_scene(request.text, "pair.toml"));
  SceneReader read = [text = request.text, found = scene.reduction](const std::vector<Override>& changes) {
    Scene changed = parse_scene(text, "pair.toml", changes);
    return found ? reduction::find_cutoff(std::move(changed), found) : changed;
  };
  const bool computes =
      asks(request, Check::derivatives) || asks(request, Check::orbit) || asks(request, Check::verify);
  if (!computes) return read;
  if (asks(request, Check::going_on)) {
    const double at = 0.3 * scene.run.t_end;
    const std::optional<Related> later = related_going_on_at(scene, at);
    if (!later) throw UsageError("the run does not come so far");
    read = [before = std::move(read), at, state = *later->scene.initial.saved](
               const std::vector<Override>& changes) { return going_on_from(before(changes), at, state); };
  }
  if (asks(request, Check::in_units))
    read = [before = std::move(read)](const std::vector<Override>& changes) {
      Scene changed = before(changes);
      const double length = changed.matrices ? 1.0 : 1000.0;
      return in_units(changed, {1e-3, length, 1e3})->scene;
    };
  return read;
}

Found by_commands(const CheckRequest& request) {
  Found found;
  const std::string load = "loads.push.amplitude", own = request.parameter;
  if (asks(request, Check::sweep)) return {by_sweep(request, load)};
  const SceneReader read = reader(request);
  if (asks(request, Check::derivatives)) {
    if (!own.empty()) found.push_back(by_derivatives(read, own));
    found.push_back(by_derivatives(read, load));
  }
  if (asks(request, Check::orbit)) found.push_back(by_orbit(read, request.seed));
  if (asks(request, Check::verify)) found.push_back(by_verify(read({})));
  return found;
}

}  // namespace

std::vector<Checked> check_scene(const CheckRequest& request) {
  try {
    for (const Check check : {Check::derivatives, Check::orbit, Check::sweep, Check::verify})
      if (asks(request, check)) return by_commands(request);
    if (request.only == "engines")
      return {by_engines(reduction::find_cutoff(parse_scene(request.text, "pair.toml")), request)};
    if (request.only == "flows")
      return {by_flows(reduction::find_cutoff(parse_scene(request.text, "pair.toml")), request)};
    const Scene scene = reader(request)({});
    Found found = by_relations(scene, request);
    constexpr std::uint64_t each = 4;
    const bool plain = !asks(request, Check::going_on) && !asks(request, Check::in_units);
    if (request.only.empty() && plain && !request.planted && request.seed % each == 0 && !found.empty() &&
        found[0].kind != Kind::refused)
      found.push_back(by_engines(scene, request));
    return found;
  } catch (const Error& error) {
    return {{Kind::refused, "", error.what()}};
  }
}

namespace {

std::string one_line(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\t') c = ' ';
  return text;
}

std::string all_of(int from) {
  std::string text;
  std::array<char, 4096> part{};
  for (ssize_t n = 0; (n = read(from, part.data(), part.size())) > 0;)
    text.append(part.data(), static_cast<std::size_t>(n));
  return text;
}

}  // namespace

std::vector<Checked> check_scene_apart(const CheckRequest& request) {
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) return check_scene(request);
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    constexpr unsigned most_seconds = 120;
    alarm(most_seconds);
    close(ends[0]);
    // What the heap says of a crash; the parent tells of the signal.
    if (std::freopen("/dev/null", "w", stderr) == nullptr) _exit(1);
    std::string text;
    for (const Checked& c : check_scene(request))
      text += fmt::format("{}\t{}\t{}\n", static_cast<int>(c.kind), one_line(c.how), one_line(c.what));
    for (std::size_t at = 0; at < text.size();) {
      const ssize_t n = write(ends[1], text.data() + at, text.size() - at);
      if (n <= 0) break;
      at += static_cast<std::size_t>(n);
    }
    _exit(0);
  }
  close(ends[1]);
  const std::string text = child > 0 ? all_of(ends[0]) : "";
  close(ends[0]);
  if (child < 0) return check_scene(request);
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) return {{Kind::idle, "run", "too long"}};
  if (WIFSIGNALED(status))
    return {{Kind::broken, "process", fmt::format("ends by signal {}", WTERMSIG(status))}};
  if (status != 0) return {{Kind::broken, "process", "ends by itself"}};
  Found found;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at), first = text.find('\t', at),
                      second = text.find('\t', first + 1);
    found.push_back({static_cast<Kind>(text[at] - '0'), text.substr(first + 1, second - first - 1),
                     text.substr(second + 1, end - second - 1)});
    at = end + 1;
  }
  return found;
}

}  // namespace signorini::differential
