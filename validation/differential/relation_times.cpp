// Relations of time: later, and in two parts.
#include <fmt/core.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <functional>

#include "differential/random.hpp"
#include "differential/relation.hpp"
#include "engine/tolerance.hpp"
#include "result/run_directory.hpp"
#include "scene/history_from_spec.hpp"
#include "signorini/simulate.hpp"

namespace signorini::differential {
namespace {

namespace fs = std::filesystem;

/// What a history moves: a static start has taken the loads that have always acted, and only those.
enum class Drives { load, motion, surface };

void each_history(Scene& scene, const std::function<void(HistorySpec&, Drives)>& visit) {
  for (Member& member : scene.members) {
    visit(member.temperature, Drives::motion);
    visit(member.initial_strain, Drives::motion);
  }
  for (Support& support : scene.supports)
    if (support.motion) visit(*support.motion, Drives::motion);
  for (ContactSpec& contact : scene.contacts) {
    visit(contact.normal_force, Drives::motion);
    visit(contact.surface_velocity, Drives::surface);
  }
  for (LoadSpec& load : scene.loads) visit(load.history, Drives::load);
  for (BaseMotionSpec& motion : scene.base_motion) visit(motion.acceleration, Drives::surface);
}

void shift_histories(Scene& scene, double by) {
  each_history(scene, [by](HistorySpec& history, Drives /*of*/) { history.shift += by; });
}

/// Before t = 0 it stands still, as the state at t = 0 takes it; what follows is continuous there but for loads.
bool waits(const HistorySpec& spec, Drives of) {
  const History history = scene::make_history(spec, "history");
  const Piece &before = history.piece_before(0.0), &after = history.piece(0.0);
  for (const int order : {1, 2})
    if (before.value(0.0, order) != 0.0 || before.value(-1.0, order) != 0.0) return false;
  if (of == Drives::surface) return before.value(0.0) == 0.0;
  if (of == Drives::load) return before.value(0.0) == 0.0 || history.is_constant();
  return before.value(0.0) == after.value(0.0) && after.value(0.0, 1) == 0.0;
}

/// Parts without mass follow a load that jumps at once. At t = 0 energies are counted from what has come of that; where
/// the same happens later, it is the work of the load.
bool jumps_at_start(const HistorySpec& spec, Drives of) {
  const History history = scene::make_history(spec, "history");
  const Piece &before = history.piece_before(0.0), &after = history.piece(0.0);
  // What sticks to a surface follows its acceleration.
  const bool rate = of == Drives::surface && before.value(0.0, 1) != after.value(0.0, 1);
  return rate || before.value(0.0) != after.value(0.0);
}

/// A run in a directory, removed with the object.
class KeptRun {
 public:
  explicit KeptRun(const Scene& scene) {
    static std::atomic<long> number{0};
    path_ = fs::temp_directory_path() / fmt::format("signorini-relation-{}-{}", getpid(), number++);
    const Model model = build_model(scene);
    result::RunDirectory directory(path_, scene, model, {true, {"relations"}});
    report_ = simulate(model, scene.run, directory);
    static_cast<void>(directory.finish(report_));
  }
  ~KeptRun() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  KeptRun(const KeptRun&) = delete;
  KeptRun& operator=(const KeptRun&) = delete;
  [[nodiscard]] const Report& report() const { return report_; }

  /// That of the frame at t, as the reader of scenes finds it; which scene asks is nothing to it.
  [[nodiscard]] SavedState state(double t) const {
    const std::string text = fmt::format(
        "schema = 1\nunits = {{ force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }}\n[run]\nt_end "
        "= 1.0\n"
        "initial = {{ run = '{}', t = {} }}\n[nodes]\nA = [0.0, 0.0]\n[[masses]]\nnode = \"A\"\nmass = 1.0\n",
        path_.string(), t);
    SavedState saved = *parse_scene(text, (path_ / "reader.toml").string()).initial.saved;
    saved.structure_differences.clear();
    return saved;
  }

 private:
  fs::path path_;
  Report report_;
};

}  // namespace

std::optional<Related> related_shifted(const Scene& scene, std::uint64_t seed) {
  const InitialSpec& initial = scene.initial;
  if (!initial.is_static && !initial.is_frictional) return std::nullopt;
  bool all_wait = true;
  Scene copy = scene;
  bool jump = false;
  each_history(copy, [&](HistorySpec& history, Drives of) {
    all_wait = all_wait && waits(history, of);
    jump = jump || jumps_at_start(history, of);
  });
  if (!all_wait) return std::nullopt;
  Random draw(seed);
  double later = scene.run.t_end * draw.real(0.05, 0.5);
  if (scene.run.dt) later = std::ceil(later / *scene.run.dt) * *scene.run.dt;
  Related result{fmt::format("shifted by {:.6g}", later), scene};
  result.later = later;
  result.jumps_at_start = jump;
  result.scene.run.t_end += later;
  shift_histories(result.scene, later);
  // What stands until then is part of its extremes; at t = 0 what jumps takes it away before anything is seen.
  Scene waiting = result.scene;
  waiting.run.certify = Certify::no;
  waiting.run.output_times.reset();
  waiting.run.t_end = waiting.run.output_dt.emplace(0.5 * later);
  result.extremes_before = simulate(build_model(waiting), waiting.run).report.response;
  return result;
}

namespace {

/// Which rebounds rest follows from scales, and they from t_end; in both parts as in the whole run.
Scene with_captures_told(Scene scene) {
  const Model model = build_model(scene);
  const double slowest = engine::tolerance_of(model, scene.run).capture_velocity();
  for (std::size_t k = 0; k < scene.contacts.size(); ++k)
    if (ContactSpec& c = scene.contacts[k]; model.contacts[k].takes_impulses() && !c.capture_velocity)
      c.capture_velocity = slowest;
  return scene;
}

}  // namespace

Scene going_on_from(Scene scene, double at, SavedState state) {
  scene.run.t_end -= at;
  scene.initial = {};
  scene.initial.saved = std::move(state);
  shift_histories(scene, -at);
  return scene;
}

std::optional<Related> related_going_on_at(const Scene& as_drawn, double at) {
  const Scene scene = with_captures_told(as_drawn);
  // The whole run keeps the state: scales follow from t_end, and with them what a rebound is that rests.
  Scene whole = scene;
  whole.run.certify = Certify::no;
  if (scene.matrices)
    whole.run.t_end = at;  // no frames there
  else
    whole.run.frames = {at};
  // Rigid contacts on parts without mass go on from a row of contacts.csv, too.
  whole.run.output_times.emplace({at});
  whole.run.output_dt.reset();
  const KeptRun kept(whole);
  if (kept.report().outcome.t < at) return std::nullopt;
  Scene first = whole;
  first.run.frames.clear();
  first.run.output_times.reset();
  first.run.t_end = first.run.output_dt.emplace(at);
  Related result{fmt::format("going on at {:.6g}", at), going_on_from(scene, at, kept.state(at))};
  result.later = -at;
  result.from = at;
  result.extremes_before = simulate(build_model(first), first.run).report.response;
  return result;
}

std::optional<Related> related_going_on(const Scene& scene, std::uint64_t seed) {
  double at = scene.run.t_end * Random(seed).real(0.1, 0.9);
  // It is of first order where a step is another one.
  if (scene.run.engine == Engine::friction_iteration && scene.run.dt)
    at = std::round(at / *scene.run.dt) * *scene.run.dt;
  return related_going_on_at(scene, at);
}

std::optional<Related> related_split_at_event(const Scene& scene, std::uint64_t seed) {
  RunSpec plain = scene.run;
  plain.certify = Certify::no;
  std::vector<double> times;
  for (const Event& event : simulate(build_model(scene), plain).events)
    if (event.contact >= 0 && event.t > 0.0 && event.t < plain.t_end) times.push_back(event.t);
  if (times.empty()) return std::nullopt;
  const int place = Random(seed).integer(0, static_cast<int>(times.size()) - 1);
  return related_going_on_at(scene, times[static_cast<std::size_t>(place)]);
}

}  // namespace signorini::differential
