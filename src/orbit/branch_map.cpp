#include "orbit/branch_map.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/eigen_dense.hpp"
#include "base/text.hpp"
#include "model/internal_units.hpp"
#include "orbit/orbit_engine.hpp"
#include "orbit/shooting.hpp"
#include "signorini/simulate.hpp"

namespace signorini::orbit {
namespace {

// Steps in s of the finite difference dG/ds. The error is the second derivative times the step, plus
// noise/step. The residual of an orbit estimates the noise, and its square root balances both terms. The
// bounds of the step for the engine `exact` and the step for `ida` are chosen values.
constexpr double difference = 1e-7, greatest_difference = 1e-5, difference_of_steps = 1e-4;
// Limit of the number of cached maps. A step uses the maps of a point, of its finite difference, and of the next point.
constexpr std::size_t max_kept = 4;
// Length of a scene's run, in periods: a transient, and a few passes through the orbit.
constexpr double max_periods = restart_periods + 4.0;
constexpr double same_time = 1e-9;  // rounding of times written as text, relative to a period

}  // namespace

BranchMap::BranchMap(const SceneReader& read, const BranchOptions& options, const Orbit& first,
                     Recorder* recorder)
    : read_(read), options_(options), recorder_(recorder), autonomous_(first.autonomous) {
  const double at = options.resume_from ? options.resume_from->parameter : options.from;
  start_.s = (at - options.from) / (options.to - options.from);
  const SceneReader begun = branch_reader(read_, options_.path, at);
  const Scene scene = begun({});
  t_end_ = std::max(scene.run.t_end, first.phase + 4.0 * first.period);
  drive_ = driving_loads(scene);
  Model on_orbit = build_model(orbit_scene(begun, first));
  machine_ = on_orbit.internal_units;
  phase_ = first.phase / machine_.time;
  first_ = model::rescaled(std::move(on_orbit), scene::inverse(machine_));
  start_.state.u = first_.u0;
  start_.state.v = first_.v0;
  for (const Contact& c : first_.contacts) {
    start_.state.shears.push_back(c.initial_shear);
    start_.state.slips.push_back(c.initial_slip);
  }
  start_.duration = first.period / machine_.time;
}

Orbit BranchMap::orbit_at(const BranchState& state) const {
  Orbit orbit;
  orbit.found = true;
  orbit.autonomous = autonomous_;
  orbit.period = state.duration * machine_.time;
  orbit.phase = phase_ * machine_.time;
  const double section = autonomous_ ? 0.0 : section_;
  const Result rows = at(state.s)->rows(state.state, (1.0 - section) * state.duration);
  orbit.start = last_state(
      with_shifted_excitation(build_model(scene_at(state.s)), orbit.phase + section * orbit.period), rows);
  return orbit;
}

BranchMap BranchMap::doubled() const {
  BranchMap twice = *this;
  twice.options_.orbit.times *= 2;
  twice.section_ *= 0.5;  // section as a fraction of the period, which is now twice as long
  twice.start_.duration *= 2.0;
  twice.kept_.clear();
  return twice;
}

double BranchMap::parameter(double s) const {
  return s == 1.0 ? options_.to : options_.from + s * (options_.to - options_.from);
}

/// The scene at s. Its run includes a transient and a few periods at s, because the scene defines periodic loads only up
/// to the end of its run.
Scene BranchMap::scene_at(double s) const {
  const auto until = [&](double t_end) {
    return branch_reader(read_, options_.path, parameter(s))({{"run.t_end", base::format_number(t_end)}});
  };
  Scene scene = until(t_end_);
  if (autonomous_) return scene;
  const double period = loads_at(scene).period.value_or(0.0) * options_.orbit.times;
  const double needed = phase_ * machine_.time + max_periods * period;
  return needed > t_end_ ? until(needed) : scene;
}

/// Period of the scene's loads. Errors: SceneError if the loads become periodic later than at the start of the branch.
LoadPeriod BranchMap::loads_at(const Scene& scene) const {
  const LoadPeriod loads = options_.orbit.period ? check_period(scene, *options_.orbit.period, drive_)
                                                 : load_period(scene, drive_);
  const double phase = phase_ * machine_.time;
  if (loads.periodic_from > phase + same_time * std::max(phase, loads.period.value_or(0.0)))
    throw SceneError({}, options_.path,
                     fmt::format("found loads that are periodic only from t = {:g} on, expected periodic "
                                 "loads from t = {:g} on, as at the start of the branch",
                                 loads.periodic_from, phase));
  return loads;
}

double BranchMap::period_of(const Scene& scene) const {
  return loads_at(scene).period.value_or(0.0) * options_.orbit.times / machine_.time;
}

double BranchMap::period(double s) const { return autonomous_ ? start_.duration : kept(s).period; }

/// Checks that the model has the unknowns of the first model; otherwise states of the branch are meaningless
/// in it. Errors: SceneError.
void BranchMap::check_structure(const Model& model) const {
  const bool same_basis = model.basis.has_value() == first_.basis.has_value() &&
                          model.reduction.has_value() == first_.reduction.has_value() &&
                          (!model.reduction || model.reduction->shapes == first_.reduction->shapes);
  if (model.size() != first_.size() || model.contacts.size() != first_.contacts.size() || !same_basis)
    throw SceneError({}, options_.path,
                     "the model has other unknowns than the model at the start of the branch");
}

BranchMap::Kept BranchMap::make(double s) const {
  const Scene scene = scene_at(s);
  Model model = build_model(scene);
  RunSpec run = scene.run;
  run.engine = orbit_engine(model, run, start_.duration * machine_.time);
  run.flow = orbit_flow(model, run);
  model = model::rescaled(std::move(model), scene::inverse(machine_));
  check_structure(model);
  model.scales = first_.scales;  // tolerances and amplitudes are comparable along the whole branch
  run = scene::rescaled(run, scene::inverse(machine_));
  const double period = autonomous_ ? 0.0 : period_of(scene);
  auto map = std::make_shared<PeriodMap>(
      with_shifted_excitation(std::move(model), phase_ + section_ * period), run, recorder_);
  map->take_flow(flow_);
  map->share(memory_);
  return {s, section_, period, std::move(map)};
}

const BranchMap::Kept& BranchMap::kept(double at) const {
  const double s = conservative() ? 0.0 : at;  // the map is the same for all energies
  for (const Kept& one : kept_) {
    if (one.map->flow()) flow_ = one.map->flow();
    if (one.s == s && one.section == section_) return one;
  }
  Kept made = make(s);
  if (kept_.size() == max_kept) kept_.erase(kept_.begin());
  kept_.push_back(std::move(made));
  return kept_.back();
}

std::shared_ptr<const PeriodMap> BranchMap::at(double s) const { return kept(s).map; }

OrbitState BranchMap::projected(OrbitState state, const contact::ContactStates& states, double s) const {
  const Model& model = at(s)->model();
  const auto fit = [&](Vector& x, const std::vector<std::pair<const Combination*, double>>& rows) {
    if (rows.empty()) return;
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows.size()), x.size());
    Vector b(static_cast<Eigen::Index>(rows.size()));
    for (Eigen::Index k = 0; k < b.size(); ++k) {
      const auto& [form, value] = rows[static_cast<std::size_t>(k)];
      for (const auto& [dof, factor] : form->terms) A(k, dof) += factor;
      b[k] = value - form->dot(x);
    }
    x += base::least_squares(A, b);
  };
  std::vector<std::pair<const Combination*, double>> places, rates;
  for (std::size_t c = 0; c < states.size(); ++c) {
    const Contact& contact = model.contacts[c];
    if (contact.takes_impulses() && !states[c].is_open()) {
      places.emplace_back(&contact.normal, -contact.gap);
      rates.emplace_back(&contact.normal, 0.0);
    }
    if (contact.sticks_rigidly() && states[c].state == State::stick)
      rates.emplace_back(&contact.tangent, contact.surface_motion.piece(0.0).value(0.0, 1));
  }
  fit(state.u, places);
  fit(state.v, rates);
  return state;
}

OrbitPass BranchMap::pass(const BranchState& state, bool tangents, bool outputs) const {
  PassOptions leg{state.state, state.duration, tangents, outputs};
  if (outputs) leg.nodes = PassOptions::reported_nodes;  // the pass of a point of the branch
  return at(state.s)->pass(leg);
}

OrbitPass BranchMap::margins(const BranchState& state) const {
  return at(state.s)->pass({state.state, state.duration, false, false, margin_samples});
}

Vector BranchMap::parameter_derivative(const BranchState& state, const OrbitPass& pass) const {
  const OrbitSection section(first_, pass.begin);
  const Eigen::Index n = section.basis().rows();
  if (conservative()) return -Vector::Unit(n + 1, n);
  const auto rows_of = [&](const OrbitPass& of) {
    Vector rows(n + (keeps_energy() ? 1 : 0));
    rows.head(n) = section.coordinates(of.end) - section.coordinates(of.begin);
    if (keeps_energy()) rows[n] = of.energy / energy_unit();
    return rows;
  };
  const auto gap = [&](double s) -> std::optional<Vector> {
    const OrbitPass other = this->pass(
        {projected(state.state, pass.begin.states, s), autonomous_ ? state.duration : period(s), s}, false);
    if (!other.done()) return std::nullopt;
    return rows_of(other);
  };
  const Vector here = rows_of(pass);
  const double noise = gap_residual(section, pass, here.head(n));
  const double h = engine_info(at(state.s)->run().engine).accuracy == Accuracy::rounding
                       ? std::clamp(std::sqrt(noise), difference, greatest_difference)
                       : difference_of_steps;
  const double side = state.s < 0.5 ? h : -h;  // stays within the range
  if (const auto other = gap(state.s + side)) return (*other - here) / side;
  if (const auto other = gap(state.s - side)) return (here - *other) / side;
  return Vector::Zero(here.size());
}

}  // namespace signorini::orbit
