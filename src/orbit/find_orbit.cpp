// find_orbit() in five steps: period of the loads, transient, section away from events, Newton's method, multipliers.

#include <fmt/core.h>
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <deque>

#include "base/eigen_dense.hpp"
#include "base/text.hpp"
#include "model/internal_units.hpp"
#include "orbit/branch_continuation.hpp"
#include "orbit/load_period.hpp"
#include "orbit/multipliers.hpp"
#include "orbit/orbit_engine.hpp"
#include "orbit/shooting.hpp"
#include "run/engines.hpp"
#include "sensitivity/contact_rates.hpp"
#include "signorini/simulate.hpp"

namespace signorini {
namespace {

constexpr int max_transients = 3;  // limit of the number of transients, one after the other
// Distance to the neighbouring members of a family that are checked for slip, relative to the amplitude. Chosen value.
constexpr double beside = 1e-6;
// Duration, in periods, of the run that records events: more than 1 because a run does not record an event at
// its beginning.
constexpr double recorded_periods = 1.1;
// Largest number of periods after which a transient is checked for repetition.
constexpr int max_repeats = 6;
// Distance / amplitude up to which two states repeat each other. Chosen value.
constexpr double repetition_tolerance = 1e-3;
// Divisors n of a period T. A search from an initial guess may find any multiple of the period, so the program
// checks whether a self-excited motion closes after T/n already. Larger primes are not checked. Chosen value.
constexpr int shorter_by[] = {2, 3, 5, 7};
// If the residual / amplitude after T/n is at most this value, Newton's method restarts with the period T/n, and may
// change this period by at most this relative value: the remaining error of an orbit that closed to 1e-9
// (shooting.cpp). Chosen value.
constexpr double nearly_closed = 1e-7;

/// One search for an orbit.
class Search {
 public:
  Search(const SceneReader& read, const OrbitOptions& options, Recorder* recorder);
  [[nodiscard]] Orbit find();

 private:
  void set_period(const Scene& scene);
  [[nodiscard]] bool forced();
  [[nodiscard]] bool by_itself();
  [[nodiscard]] bool close(const orbit::OrbitState& state, double section, double period);
  void shorten();
  [[nodiscard]] orbit::PeriodMap map_of(Model model, bool interruptible = true) const {
    orbit::PeriodMap map(std::move(model), run_, interruptible ? recorder_ : nullptr);
    map.share(memory_);
    return map;
  }
  void stability();
  [[nodiscard]] std::string repeated(const orbit::OrbitState& state) const;
  void check_family_edge(const Eigen::MatrixXd& phi);
  void report(const orbit::OrbitState& at_section, double section);
  bool stop(std::string reason) {
    orbit_.reason = std::move(reason);
    return false;
  }

  const SceneReader& read_;
  OrbitOptions options_;
  Recorder* recorder_;
  Model given_;  // model of the scene, in the scene's units
  std::optional<orbit::PeriodMap> map_;
  double unit_ = 1.0;    // unit of time of the computed model, in the scene's unit
  double before_ = 0.0;  // time from which the loads are periodic, rounded up to whole periods; machine units
  double period_ = 0.0;  // period of the loads times OrbitOptions::times, machine units
  double tolerance_, closed_ = 0.0;
  Orbit orbit_;
  orbit::ShootingResult shot_;
  orbit::OrbitState initial_;
  Model first_;  // initial model of the scene, in machine units
  RunSpec run_;
  std::shared_ptr<modal::ModalCache> memory_ = std::make_shared<modal::ModalCache>();
};

/// Length of a run, in the scene's unit of time, up to which periodic histories must be defined.
double long_enough(const orbit::LoadPeriod& loads, const OrbitOptions& options) {
  const double T = loads.period.value_or(0.0) * options.times;
  return loads.periodic_from + T * (4.0 * options.transient + 4.0);
}

void check_options(const OrbitOptions& options) {
  if (options.times < 1)
    throw UsageError(fmt::format("--times: found {}, expected an integer of at least 1", options.times));
  if (options.transient < 0)
    throw UsageError(
        fmt::format("--transient: found {}, expected an integer of at least 0", options.transient));
  if (options.energy && !(*options.energy > 0.0 && std::isfinite(*options.energy)))
    throw UsageError(fmt::format("--energy: found {}, expected an energy > 0", *options.energy));
  if (options.period && !(*options.period > 0.0 && std::isfinite(*options.period)))
    throw UsageError(fmt::format("--period: found {}, expected a time > 0", *options.period));
}

Search::Search(const SceneReader& read, const OrbitOptions& options, Recorder* recorder)
    : read_(read), options_(options), recorder_(recorder), tolerance_(options.tolerance) {
  check_options(options);
  const Scene scene = read({});
  set_period(scene);
}

/// Checks that the scene has no excitation, because --energy requires a conservative motion. Errors: UsageError.
void check_conservative(const Scene& scene, const orbit::LoadPeriod& loads) {
  if (!scene.loads.empty() || loads.period || loads.surfaces_move)
    throw UsageError(
        "--energy: found a load or a moving surface, expected a scene without both, in which energy is "
        "conserved");
}

/// Sets the model, its engine, and the period of the loads.
void Search::set_period(const Scene& scene) {
  const bool conservative = options_.energy.has_value();
  orbit::LoadPeriod loads = options_.period && !conservative ? orbit::check_period(scene, *options_.period)
                                                             : orbit::load_period(scene);
  // If all loads have amplitude zero, as at an end of a branch over the amplitude, the orbit is the state of
  // rest with the period of these loads.
  if (!loads.period && !loads.surfaces_move && !conservative)
    loads = orbit::load_period(scene, orbit::driving_loads(scene));
  orbit_.autonomous =
      !loads.period || (options_.period && !orbit::load_period(scene).period && loads.surfaces_move);
  if (conservative) check_conservative(scene, loads);
  if (orbit_.autonomous && !loads.surfaces_move && !conservative)
    throw SceneError(
        {}, "loads",
        "found no periodic load, no moving surface and no --period; an orbit needs one of these");
  const double t_end = std::max(scene.run.t_end, long_enough(loads, options_));
  const Scene longer = read_({{"run.t_end", base::format_number(t_end)}});
  given_ = build_model(longer);
  sensitivity::check_tangent_laws(longer, given_);
  if (conservative && given_.damping.norm() > 0.0)
    throw UsageError(
        "--energy: found damping, expected a scene without damping, in which energy is conserved");
  run_ = longer.run;
  run_.engine = orbit::orbit_engine(given_, run_, loads.period.value_or(scene.run.t_end) * options_.times);
  if (!run::engine_row(run_.engine).capabilities.supports_orbits)
    throw SceneError(
        scene.run.place, "run.engine",
        fmt::format("found \"{}\", expected {}: orbits need the motion between events to rounding accuracy, "
                    "or tangents of the motion",
                    to_string(run_.engine), run::engines_that(&run::EngineCapabilities::supports_orbits)));
  run_.flow = orbit::orbit_flow(given_, run_);
  closed_ = orbit::orbit_state_error(run_);
  const Factors to_machine = scene::inverse(given_.internal_units);
  first_ = model::rescaled(given_, to_machine);
  run_ = scene::rescaled(run_, to_machine);
  run_.t_end = scene.run.t_end / given_.internal_units.time;
  unit_ = given_.internal_units.time;
  for (const Contact& c : first_.contacts) {
    initial_.shears.push_back(c.initial_shear);
    initial_.slips.push_back(c.initial_slip);
  }
  initial_.u = first_.u0;
  initial_.v = first_.v0;
  const double period = conservative ? options_.period.value_or(0.0) : loads.period.value_or(0.0);
  period_ = period * options_.times / unit_;
  const double whole =
      period > 0.0 ? std::ceil(loads.periodic_from / period - 1e-9) * period : loads.periodic_from;
  before_ = std::max(0.0, whole) / unit_;
  orbit_.phase = before_ * unit_;
}

bool Search::forced() {
  const orbit::PeriodMap scene = map_of(first_);
  orbit::OrbitState state = initial_;
  double length = before_ + options_.transient * period_;
  const Model base = orbit::with_shifted_excitation(first_, before_);
  const orbit::PeriodMap at_phase = map_of(base);
  for (int i = 0; i < max_transients; ++i) {
    const orbit::OrbitPass transient =
        length > 0.0 ? (i == 0 ? scene : at_phase).pass({state, length, false}) : orbit::OrbitPass{};
    if (length > 0.0) {
      if (!transient.done()) return stop("the transient stopped: " + transient.outcome.reason);
      state = orbit::orbit_state(transient.end);
    }
    length = std::max(1, options_.transient) * period_ * (i + 1);
    const orbit::OrbitPass once = at_phase.pass({state, recorded_periods * period_, false});
    if (!once.done()) return stop("the run over one period stopped: " + once.outcome.reason);
    const double section = orbit::section_away_from(once.instants, period_);
    orbit::OrbitState at_section = state;
    if (section > 0.0) {
      const orbit::OrbitPass to_section = at_phase.pass({state, section, false});
      if (!to_section.done()) return stop("the run to the section stopped: " + to_section.outcome.reason);
      at_section = orbit::orbit_state(to_section.end);
    }
    std::shared_ptr<sensitivity::StateFlow> flow = map_ ? map_->flow() : nullptr;
    map_ = map_of(orbit::with_shifted_excitation(base, section));
    map_->take_flow(std::move(flow));
    if (close(at_section, section, period_)) return true;
    if (shot_.interrupted) return false;
    if (i + 1 == max_transients) orbit_.reason += repeated(at_section);
  }
  return false;
}

/// Text that completes the reason of a failure: the number of periods after which the transient repeats
/// itself, for instance 2 beyond a flip. Empty if no repetition is found.
std::string Search::repeated(const orbit::OrbitState& state) const {
  orbit::OrbitState now = state;
  std::optional<orbit::OrbitPass> first;
  for (int k = 1; k <= max_repeats; ++k) {
    const orbit::OrbitPass pass = map_->pass({now, period_, false});
    if (!pass.done()) return {};
    now = orbit::orbit_state(pass.end);
    if (!first) first = pass;
    if (k == 1 && orbit::orbit_residual(map_->model(), pass) <= repetition_tolerance)
      return {};  // the motion is nearly an orbit
    const orbit::OrbitSection section(map_->model(), first->begin);
    const Vector gap = section.coordinates(pass.end) - section.coordinates(first->begin);
    if (k > 1 && orbit::gap_residual(section, *first, gap) <= repetition_tolerance)
      return fmt::format("; the transient repeats itself only after {} periods: use --times {}", k,
                         k * options_.times);
  }
  return {};
}

bool Search::by_itself() {
  const orbit::PeriodMap scene = map_of(first_);
  const double length = before_ + std::max(run_.t_end, options_.transient * period_);
  const orbit::OrbitPass transient = scene.pass({initial_, length, false});
  if (!transient.done()) return stop("the transient stopped: " + transient.outcome.reason);
  const orbit::ReturnMapStart found = orbit::return_map_start(first_, transient.instants);
  if (!(found.period > 0.0) && period_ > 0.0) {
    map_ = map_of(first_);
    return close(initial_, 0.0, period_);
  }
  if (!(found.period > 0.0))
    return stop(
        fmt::format("up to t = {:.6g} the transient does not return near the state at one of its earlier "
                    "events; use a longer t_end, so that the transient decays further",
                    length * unit_));
  const orbit::OrbitPass to_section = scene.pass({initial_, found.section, false});
  if (!to_section.done()) return stop("the transient stopped: " + to_section.outcome.reason);
  map_ = map_of(orbit::with_shifted_excitation(first_, found.section));
  const double period = period_ > 0.0 ? period_ : found.period * options_.times;
  return close(orbit::orbit_state(to_section.end), 0.0, period);
}

bool Search::close(const orbit::OrbitState& state, double section, double period) {
  shot_ = orbit::shoot(*map_, {state, period, orbit_.autonomous, closed_, options_.energy}, tolerance_);
  orbit_.steps = shot_.steps;
  orbit_.residual = shot_.residual;
  if (!shot_.closed) return stop(shot_.reason);
  shorten();
  orbit_.reason.clear();
  orbit_.period = shot_.duration * unit_;
  orbit_.section = section * unit_;
  return true;
}

/// Reduces the period to the smallest one: if the period T found is a multiple of it, the orbit also closes after T/n.
void Search::shorten() {
  if (!orbit_.autonomous || options_.times > 1 || !(shot_.pass.u_amplitude > 0.0)) return;
  for (const int n : shorter_by)
    for (double part = shot_.duration / n;; part = shot_.duration / n) {
      const orbit::OrbitPass pass = map_->pass({shot_.state, part, false});
      if (!pass.done() || orbit::orbit_residual(map_->model(), pass) > nearly_closed) break;
      orbit::ShootingResult shot =
          orbit::shoot(*map_, {shot_.state, part, true, closed_, options_.energy}, tolerance_);
      if (!shot.closed || std::abs(shot.duration - part) > nearly_closed * part) break;
      shot_ = std::move(shot);
      orbit_.residual = shot_.residual;
    }
}

/// Computes multipliers and families.
void Search::stability() {
  const orbit::OrbitPass& pass = shot_.pass;
  if (pass.end_derivatives.size() == 0) {
    orbit_.reason = "multipliers are not available: " + pass.reason;
    return;
  }
  const Model& model = map_->model();
  const Eigen::MatrixXd phi = orbit::monodromy(model, pass);
  const orbit::OrbitPass next = map_->pass({orbit::orbit_state(pass.end), shot_.duration});
  const Eigen::MatrixXd again = next.done() && next.end_derivatives.size() == pass.end_derivatives.size()
                                    ? orbit::monodromy(model, next)
                                    : Eigen::MatrixXd();
  const orbit::Multipliers all = orbit::multipliers_of(phi);
  // One multiplier is 1 along the motion; for conservative orbits a second one is 1 because orbits exist at
  // neighbouring energies.
  const std::size_t ones = orbit::count_ones(all), of_time = options_.energy ? 2 : orbit_.autonomous ? 1 : 0;
  std::size_t families = ones > of_time ? ones - of_time : 0;
  for (std::size_t c = 0; c < pass.never_slips.size(); ++c) {
    const Contact& contact = model.contacts[c];
    const bool anchored = contact.tangential_stiffness || contact.sticks_rigidly();
    if (families == 0 || !pass.never_slips[c] || !anchored || pass.begin.states[c].state != State::stick)
      continue;
    orbit_.families.push_back("contact '" + contact.name + "' never slips");
    --families;
  }
  if (families > 0) orbit_.families.push_back("a motion without a restoring force");
  orbit::set_multipliers(all, again, orbit_.families.size() + of_time,
                         orbit::error_of(phi, pass.derivatives_error, closed_), options_.energy.has_value(),
                         orbit_);
  if (!orbit_.families.empty()) check_family_edge(phi);
}

/// Sets orbit_.reason if a contact that never slips in this orbit slips in a neighbouring member of the
/// family: Phi then is valid on one side only.
void Search::check_family_edge(const Eigen::MatrixXd& phi) {
  const orbit::OrbitPass& pass = shot_.pass;
  const orbit::OrbitSection section(map_->model(), pass.begin);
  const Eigen::MatrixXd A = phi - Eigen::MatrixXd::Identity(phi.rows(), phi.cols());
  const Eigen::MatrixXd ways = base::smallest_singular_vectors(
      A, std::min(A.cols(), static_cast<Eigen::Index>(orbit_.families.size())));
  for (Eigen::Index k = 0; k < ways.cols(); ++k)
    for (const double side : {-beside, beside}) {
      const Vector way = ways.col(k) / orbit::gap_residual(section, pass, section.basis() * ways.col(k));
      const orbit::OrbitPass other =
          map_->pass({section.moved(orbit::orbit_state(pass.begin), side * way), shot_.duration, false});
      for (std::size_t c = 0; c < pass.never_slips.size() && other.done(); ++c)
        if (pass.never_slips[c] && !other.never_slips[c])
          orbit_.reason = fmt::format(
              "multipliers are valid on one side of the orbit only: contact '{}' reaches its friction limit, "
              "and slips in neighbouring orbits",
              map_->model().contacts[c].name);
    }
}

/// An event that precedes the orbit's time 0 by less than this fraction of the period is an event at time 0.
/// Chosen value: the remaining error of an orbit that closed to 1e-9.
constexpr double same_instant = 1e-9;

/// Converts times since the section to times since the orbit's time 0, and sorts the events. A run from time
/// 0 would not record an event at its beginning, and rounding would decide whether it records one at its end.
std::vector<Event> events_from_time_zero(std::vector<Event> events, double section, double period) {
  for (Event& event : events) {
    event.t += section;
    if (event.t >= period * (1.0 - same_instant)) event.t = std::max(0.0, event.t - period);
  }
  std::stable_sort(events.begin(), events.end(), [](const Event& a, const Event& b) { return a.t < b.t; });
  return events;
}

/// Stores in orbit_ the state at the orbit's time 0, and the events, energies and amplitude of one period.
void Search::report(const orbit::OrbitState& at_section, double section) {
  const Model base = orbit_.autonomous ? map_->model() : orbit::with_shifted_excitation(first_, before_);
  const orbit::PeriodMap map = map_of(base, false), from_section = map_of(map_->model(), false);
  orbit::OrbitState start = at_section;
  if (section > 0.0)
    start = orbit::orbit_state(from_section.pass({at_section, shot_.duration - section, false}).end);
  const Result rows = map.rows(start, shot_.duration);
  orbit_.start = last_state(orbit::with_shifted_excitation(given_, orbit_.phase), rows);
  orbit::PassOptions leg{at_section, shot_.duration, false};
  leg.nodes = orbit::PassOptions::reported_nodes;
  const orbit::OrbitPass once = from_section.pass(leg);
  orbit_.sequence = events_from_time_zero(once.events, orbit_.section, orbit_.period);
  orbit_.cycle = once.cycle_energy;
  orbit_.amplitude = once.amplitude;
}

Orbit Search::find() {
  orbit_.found = orbit_.autonomous ? by_itself() : forced();
  if (!orbit_.found) return std::move(orbit_);
  stability();
  report(shot_.state, orbit_.section / unit_);
  return std::move(orbit_);
}

}  // namespace

Orbit find_orbit(const SceneReader& read, const OrbitOptions& options, Recorder* recorder) {
  return Search(read, options, recorder).find();
}

Scene orbit_scene(const SceneReader& read, const Orbit& orbit) {
  Scene scene = read({});
  if (orbit.phase > 0.0) {
    std::vector<Override> changes = orbit::shifted_excitation(scene, orbit.phase);
    changes.push_back(
        {"run.t_end", base::format_number(std::max(scene.run.t_end, orbit.phase + 2.0 * orbit.period))});
    scene = read(changes);
  }
  constexpr double rows = 200.0;
  scene.run.t_end = orbit.period;
  scene.run.frames.clear();
  scene.run.output_times.reset();
  scene.run.output_dt = std::min(scene.run.output_dt.value_or(orbit.period), orbit.period / rows);
  scene.initial.is_static = scene.initial.is_frictional = false;
  scene.initial.stages.clear();
  scene.initial.components.clear();
  scene.initial.saved = orbit.start;
  return scene;
}

// continue_branch(): the branch of the orbit that find_orbit() returns, and the branches that begin on this branch.

namespace {

Orbit first_orbit(const SceneReader& read, const BranchOptions& options, Recorder* recorder) {
  OrbitOptions search = options.orbit;
  if (options.path == orbit::over_energy) search.energy = options.from;
  return find_orbit(orbit::branch_reader(read, options.path, options.from), search, recorder);
}

}  // namespace

Branch continue_branch(const SceneReader& read, const BranchOptions& options, Recorder* recorder,
                       const std::function<void(const BranchPoint&)>& seen) {
  if (!(std::isfinite(options.from) && std::isfinite(options.to)) || options.from == options.to)
    throw UsageError("--over: expected PATH=FROM:TO with two different numbers");
  if (options.path == orbit::over_energy && !(options.from > 0.0 && options.to > 0.0))
    throw UsageError("--over energy: expected two energies above 0; without energy nothing moves");
  if (options.path == orbit::over_energy && options.orbit.energy)
    throw UsageError("--energy: cannot be combined with --over energy, which sets the energy");
  const Orbit orbit = options.resume_from ? options.resume_from->orbit : first_orbit(read, options, recorder);
  if (!orbit.found) {
    Branch none;
    none.end = fmt::format("no orbit found at {} = {:.9g}: {}", options.path, options.from, orbit.reason);
    return none;
  }
  Branch branch;
  if (options.resume_from) branch.sequences = options.resume_from->sequences;
  orbit::BranchContinuation main(options, orbit::BranchMap(read, options, orbit, recorder), branch, 1, 0,
                                 seen);
  main.follow();
  branch.end = main.end();
  branch.complete = main.complete();
  branch.last = main.mark();
  std::deque<orbit::Junction> waiting(std::make_move_iterator(main.junctions().begin()),
                                      std::make_move_iterator(main.junctions().end()));
  while (!waiting.empty() && !branch.interrupted) {
    const orbit::Junction junction = std::move(waiting.front());
    waiting.pop_front();
    const int number = static_cast<int>(branch.sides.size()) + 2;
    orbit::BranchContinuation walk(options, junction.map, branch, number, junction.generation, seen);
    walk.follow_from(junction);
    branch.sides.push_back({number, junction.from, junction.kind, junction.map.parameter(junction.at.state.s),
                            walk.end(), walk.complete()});
    for (orbit::Junction& next : walk.junctions()) waiting.push_back(std::move(next));
  }
  return branch;
}

}  // namespace signorini
