#include "run/witnessed_motion.hpp"

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "run/engines.hpp"

namespace signorini {
namespace {

// Modes of a state are used if they reproduce a motion to 1e-12 of its size (src/engine/exact/modal), relative to the
// rounding of other sums.
constexpr double round_trip = 1e-12, of_round_trip = round_trip / rounding::of_elimination;

}  // namespace

// A sum over modes starts a flight at g = 0 and does not detect its return if it is lower than the rounding of the sum.
WitnessedEngine witnessed_engine(const RunSpec& run, const Tolerance& tolerance, const std::string& flow,
                                 bool low_flights) {
  WitnessedEngine engine;
  const Accuracy accuracy = name_of(run.engine).accuracy;
  engine.sums_over_modes = flow == "modal";
  const EngineAbilities& can = engine_row(run.engine).can;
  engine.follows = can.laws_at_ends;
  engine.located = can.locates_events(run);
  WitnessLimits& limits = engine.limits;
  limits.capture_velocity = tolerance.capture_velocity();
  limits.knows_low_flights = low_flights && !engine.sums_over_modes;
  if (accuracy == Accuracy::step) limits.step = run.dt.value_or(0.0);
  if (accuracy != Accuracy::tolerance) return engine;
  limits.rtol = tolerance.rtol;
  limits.displacement = tolerance.displacement;
  limits.rotation = tolerance.rotation;
  limits.velocity = tolerance.velocity;
  limits.angular_velocity = tolerance.angular_velocity;
  limits.force = tolerance.force;
  return engine;
}

RecordedEvent recorded_event(const Event& event) {
  RecordedEvent result;
  result.contact = static_cast<std::size_t>(event.contact);
  result.type = to_string(event.type);
  result.from = event.from;
  result.to = event.to;
  result.gap = event.gap;
  result.N = event.N;
  result.T = event.T;
  result.N_after = event.N_after;
  result.T_after = event.T_after;
  result.vn = event.vn;
  result.vn_after = event.vn_after;
  result.vt = event.vt;
  result.vt_after = event.vt_after;
  result.impulse_n = event.impulse_n.value_or(0.0);
  result.impulse_t = event.impulse_t.value_or(0.0);
  if (event.t_uncertainty) result.t_uncertainty = *event.t_uncertainty;
  return result;
}

std::vector<ContactState> left_states(const Model& model, const std::vector<ContactState>& guessed) {
  std::vector<ContactState> states = guessed;
  for (std::size_t k = 0; k < model.continues.size(); ++k) {
    const SavedState::Left& left = model.continues[k];
    if (!model.contacts[k].obeys_coulomb()) continue;
    for (const State state : {State::open, State::closed, State::stick, State::slip_plus, State::slip_minus})
      if (left.state == to_string(state)) states[k] = {state, state == State::stick ? left.slip : 0.0};
    if (states[k].state == State::open && left.gap && *left.gap < 0.0) states[k].state = State::inside;
  }
  return states;
}

Vector left_forces(const Model& model) {
  Vector forces = Vector::Zero(model.force_count());
  for (std::size_t k = 0; k < model.continues.size(); ++k) {
    forces[static_cast<Eigen::Index>(model.layout.normal(k))] = model.continues[k].N;
    forces[static_cast<Eigen::Index>(model.layout.tangent(k))] = model.continues[k].T;
  }
  return forces;
}

WitnessedMotion::WitnessedMotion(const Model& model, const WitnessedEngine& engine)
    : model_(model),
      sums_over_modes_(engine.sums_over_modes),
      massless_(
          std::any_of(model.dofs.begin(), model.dofs.end(), [](const Dof& dof) { return dof.massless; })),
      step_(engine.limits.step),
      jerk_(model.contacts.size(), 0.0) {
  for (std::size_t k = 0; k < model.contacts.size(); ++k)
    if (!model.contacts[k].surface_motion.is_constant() || !model.contacts[k].normal_force.is_constant())
      driven_.push_back(k);
}

void WitnessedMotion::leave(const Forcing& forcing, double t) {
  if (!(step_ > 0.0)) return;
  for (const std::size_t k : driven_) jerk_[k] = std::abs(forcing.surface(k, t, 3));
}

WitnessedSide WitnessedMotion::side(const Forcing& forcing, double t, double dependence) const {
  WitnessedSide side;
  fill(forcing, t, dependence, side);
  return side;
}

Driven WitnessedMotion::driven_at(std::size_t k, const Forcing& forcing, double t) const {
  Driven d;
  d.s = forcing.surface(k, t, 0);
  d.ds = forcing.surface(k, t, 1);
  d.dds = forcing.surface(k, t, 2);
  d.q = forcing.pressing(k, t, 0);
  d.dq = forcing.pressing(k, t, 1);
  d.ddq = forcing.pressing(k, t, 2);
  if (step_ > 0.0)
    d.drift = step_ * step_ / 12.0 *
              (jerk_[k] + std::abs(forcing.surface(k, t, 3)) + step_ * std::abs(forcing.surface(k, t, 4)));
  return d;
}

void WitnessedMotion::fill(const Forcing& forcing, double t, double dependence, WitnessedSide& side) const {
  side.layout = model_.layout;
  for (std::size_t turns : {0U, 1U}) {
    // Between two instants the motion may reach the scene's displacements, even if it is at rest at both.
    const double own = turns ? model_.scales.rotation : model_.scales.displacement;
    side.u_reach[turns] = std::max({own, u_reach_[turns], dependence * of_round_trip * u_modal_[turns]});
    // A body at rest on a surface that starts to move has the rounding of that motion: A cos(w t - pi/2) at t = 0.
    const double given = rounding::of_few / rounding::of_elimination *
                         (turns ? model_.scales.angular_velocity : model_.scales.velocity);
    side.v_reach[turns] = std::max({given, v_reach_[turns], dependence * of_round_trip * v_modal_[turns]});
  }
  if (sums_over_modes_) side.lost = dependence * round_trip * std::sqrt(energy_ + kinetic_);
  side.speeds = speeds_.empty() ? nullptr : speeds_.data();
  if (side.driven.size() == model_.contacts.size()) {
    for (const std::size_t k : driven_) side.driven[k] = driven_at(k, forcing, t);
  } else {
    side.driven.clear();
    for (std::size_t k = 0; k < model_.contacts.size(); ++k) side.driven.push_back(driven_at(k, forcing, t));
  }
  if (!massless_) return;
  side.loads.resize(3);
  for (int order = 0; order < 3; ++order) {
    Vector& load = side.loads[static_cast<std::size_t>(order)];
    load.setZero(model_.size());
    forcing.add_load(t, order, load.data());
  }
}

void WitnessedMotion::reach(const Witness& witness, const Vector& u, const Vector& v) {
  for (int i = 0; i < model_.size(); ++i) {
    const bool turns = model_.dofs[static_cast<std::size_t>(i)].rotation;
    u_reach_[turns] = std::max(u_reach_[turns], std::abs(u[i]));
    v_reach_[turns] = std::max(v_reach_[turns], std::abs(v[i]));
  }
  energy_ = std::max(energy_, witness.twice_energy(u));
  for (std::size_t k = lightness_.size(); k < model_.contacts.size(); ++k)
    lightness_.push_back(witness.lightness(k));
  const double root = std::sqrt(energy_);
  speeds_.resize(lightness_.size());
  for (std::size_t k = 0; k < speeds_.size(); ++k) speeds_[k] = lightness_[k] * root;
  if (!sums_over_modes_) return;
  kinetic_ = std::max(kinetic_, v.dot(model_.mass * v));
  const std::array<double, 2> of_u = witness.modal_size(u), of_v = witness.modal_size(v);
  const std::array<double, 2> by_energy = witness.modal_size(std::sqrt(energy_));
  const double period = model_.omega1 > 0.0 ? 1.0 / model_.omega1 : 0.0;
  for (std::size_t turns : {0U, 1U}) {
    // In a sum over modes, displacements are amplitudes times sines, and the amplitudes are v/omega.
    u_modal_[turns] =
        std::max({u_modal_[turns], of_u[turns], period * by_energy[turns], period * of_v[turns]});
    v_modal_[turns] = std::max({v_modal_[turns], of_v[turns], by_energy[turns]});
  }
}

std::array<double, 2> WitnessedMotion::of_accelerations(const Witness& witness, const Vector& a,
                                                        double dependence) const {
  if (!sums_over_modes_) return {0.0, 0.0};
  const std::array<double, 2> size = witness.modal_size(a);
  return {dependence * of_round_trip * size[0], dependence * of_round_trip * size[1]};
}

}  // namespace signorini
