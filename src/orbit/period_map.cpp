#include "orbit/period_map.hpp"

#include <cmath>
#include <limits>

#include "contact/friction.hpp"
#include "orbit/displacement_range.hpp"
#include "run/run_listener.hpp"
#include "sensitivity/tangent_run.hpp"
#include "signorini/simulate.hpp"

namespace signorini::orbit {
namespace {

// Number of degrees of freedom from which modes are faster than the series. Chosen value.
constexpr int min_in_modes = 6;

/// Minimum of a sampled function, refined by the parabola through the three samples around the minimum.
class Least {
 public:
  void see(double t, double value) {
    const bool inside = seen_ > 1 && f_[1] < f_[0] && f_[1] <= value && f_[1] <= least_ && t > t_[1];
    if (inside) {
      const double a = (f_[1] - f_[0]) / (t_[1] - t_[0]), b = (value - f_[1]) / (t - t_[1]);
      const double bend = (b - a) / (t - t_[0]), slope = a + bend * (t_[1] - t_[0]);
      vertex_ = f_[1] - slope * slope / (4.0 * bend);
    }
    if (seen_ == 0 || t > t_[1]) {
      t_ = {t_[1], t};
      f_ = {f_[1], value};
    }
    least_ = std::min(least_, value);
    ++seen_;
  }
  [[nodiscard]] double value() const { return std::min(least_, vertex_); }

 private:
  std::array<double, 2> t_{}, f_{};
  long seen_ = 0;
  double least_ = std::numeric_limits<double>::infinity(), vertex_ = least_;
};

/// Records amplitudes, margins and events of one pass.
class CycleRecorder final : public Recorder {
 public:
  CycleRecorder(const Model& model, Recorder* outer, OrbitPass& pass)
      : model_(model), outer_(outer), pass_(pass) {}

  void event(const Event& event) override {
    if (event.contact >= 0 && event.type != EventType::time) pass_.events.push_back(event);
  }
  void sample(const Sample& sample) override {
    const std::vector<Dof>& dofs = model_.physical_dofs();
    const Scales& s = model_.scales;
    const double length = s.displacement * model_.unit.length;
    const double velocity = s.velocity * model_.unit.length / model_.unit.time;
    const double spin = s.angular_velocity / model_.unit.time;
    if (first_) {
      u_low_ = u_high_ = *sample.u;
      v_low_ = v_high_ = *sample.v;
      for (const ContactSample& c : sample.contacts) T_.emplace_back(c.T, c.T);
      margins_.resize(sample.contacts.size());
      first_ = false;
    }
    u_low_ = u_low_.cwiseMin(*sample.u);
    u_high_ = u_high_.cwiseMax(*sample.u);
    v_low_ = v_low_.cwiseMin(*sample.v);
    v_high_ = v_high_.cwiseMax(*sample.v);
    for (Eigen::Index i = 0; i < u_low_.size(); ++i) {
      const bool turns = dofs[static_cast<std::size_t>(i)].rotation;
      grow(pass_.u_amplitude, u_high_[i] - u_low_[i], turns ? s.rotation : length);
      grow(pass_.v_amplitude, v_high_[i] - v_low_[i], turns ? spin : velocity);
    }
    for (std::size_t c = 0; c < T_.size(); ++c) {
      T_[c].first = std::min(T_[c].first, sample.contacts[c].T);
      T_[c].second = std::max(T_[c].second, sample.contacts[c].T);
      const double force = s.force * model_.unit.force;
      grow(pass_.T_amplitude, T_[c].second - T_[c].first, force);
      const double T = sample.contacts[c].T;
      const double limit = contact::sticking_limit(model_.contacts[c], -std::abs(sample.contacts[c].N));
      margins_[c][0].see(sample.t, (limit - T) / force);
      margins_[c][1].see(sample.t, (limit + T) / force);
    }
  }
  void finish() {
    for (const auto& [up, down] : margins_) pass_.margins.push_back({up.value(), down.value()});
  }
  bool progress(double t) override { return outer_ == nullptr || outer_->progress(t); }

 private:
  static void grow(double& amplitude, double range, double scale) {
    amplitude = std::max(amplitude, 0.5 * range / scale);
  }

  const Model& model_;
  Recorder* outer_;
  OrbitPass& pass_;
  bool first_ = true;
  Vector u_low_, u_high_, v_low_, v_high_;
  std::vector<std::pair<double, double>> T_;
  std::vector<std::array<Least, 2>> margins_;
};

class NoRows final : public sensitivity::TangentListener {
 public:
  void sample(const sensitivity::TangentSample& /*sample*/, bool /*row*/, bool /*turn*/) override {}
  void at_instant(const sensitivity::InstantMotion& /*motion*/,
                  const std::vector<sensitivity::TangentState>& /*states*/) override {}
  [[nodiscard]] bool exceeds(std::size_t /*contact*/, std::size_t /*which*/,
                             double /*value*/) const override {
    return false;
  }
};

/// A derivative of the model in which all entries are zero.
sensitivity::ModelDerivative still(const Model& model) {
  sensitivity::ModelDerivative d;
  d.mass = d.damping = d.stiffness = SparseMatrix(model.size(), model.size());
  d.loads.resize(model.loads.size());
  d.contacts.resize(model.contacts.size());
  d.u0 = d.v0 = Vector::Zero(model.size());
  return d;
}

/// Tangents of all columns of a section's basis.
class Bundle {
 public:
  /// flow: closed form that advances the columns between events, or null.
  Bundle(const Model& model, const RunSpec& run, const OrbitPoint& begin, sensitivity::StateFlow* flow)
      : section_(model, begin) {
    for (Eigen::Index k = 0; k < section_.size(); ++k) {
      const OrbitState column = section_.unscaled(section_.basis().col(k));
      sensitivity::ModelDerivative d = still(model);
      d.u0 = column.u;
      d.v0 = column.v;
      for (std::size_t c = 0; c < d.contacts.size(); ++c) d.contacts[c].initial_shear = column.shears[c];
      columns_.push_back(std::move(d));
    }
    sizes_.assign(columns_.size(), 1.0);
    tangents_.emplace(model, run, columns_, sizes_, listener_);
    tangents_->cross_smooth_grazes();
    if (flow != nullptr) tangents_->use_state_flow(*flow);
  }

  [[nodiscard]] sensitivity::TangentRun& run() { return *tangents_; }

  void finish(OrbitPass& pass) const {
    const std::vector<sensitivity::TangentState>& states = tangents_->states();
    for (const sensitivity::TangentState& state : states)
      if (!state.valid) {
        pass.reason = state.reason;
        return;
      }
    for (const sensitivity::TangentState& state : states)
      pass.derivatives_error = std::max(pass.derivatives_error, state.error);
    const auto columns = section_.size();
    pass.end_derivatives.resize(section_.basis().rows(), columns);
    for (Eigen::Index k = 0; k < columns; ++k)
      pass.end_derivatives.col(k) = end_of(states[static_cast<std::size_t>(k)]);
  }

 private:
  [[nodiscard]] Vector end_of(const sensitivity::TangentState& state) const {
    return section_.coordinates(state.now.start.u, state.now.start.v, state.now.point.forces);
  }

  OrbitSection section_;
  std::vector<sensitivity::ModelDerivative> columns_;
  std::vector<double> sizes_;
  NoRows listener_;
  std::optional<sensitivity::TangentRun> tangents_;
};

/// Records the data of a pass, and forwards the data of the run to the tangents.
class Follower final : public run::RunListener {
 public:
  Follower(const Model& model, const RunSpec& run, const PassOptions& leg, OrbitPass& pass,
           sensitivity::StateFlow* flow, modal::ModalCache& kept)
      : model_(model),
        run_(run),
        leg_(leg),
        pass_(pass),
        flow_(flow),
        share_{&kept, nullptr},
        range_(model, leg.duration, leg.nodes) {}

  /// Peaks inside steps are not needed: extremes of outputs are searched separately.
  [[nodiscard]] run::ListenerNeeds needs() { return {&share_, false}; }

  void begin(const run::RunInstant& start) override {
    pass_.begin = pass_.end = orbit_point(start.t, start.after);
    range_.begin_stretch(start.t, start.after.u, start.after.v);
    for (std::size_t c = 0; c < model_.contacts.size(); ++c)
      pass_.never_slips.push_back(!pass_.begin.states[c].is_open() &&
                                  slip_sign(pass_.begin.states[c].state) == 0);
    if (!leg_.tangents) return;
    bundle_.emplace(model_, run_, pass_.begin, flow_);
    bundle_->run().use_shared_modes(share_);
    bundle_->run().begin(start);
  }
  void step(const run::RunStep& step) override {
    range_.follow(step);
    if (bundle_) bundle_->run().step(step);
  }
  void instant(const run::RunInstant& instant) override {
    if (bundle_) bundle_->run().instant(instant);
    pass_.end = orbit_point(instant.t, instant.after);
    range_.begin_stretch(instant.t, instant.after.u, instant.after.v);
    bool changes = !instant.after.impulses.empty();
    for (std::size_t c = 0; c < instant.states_before.size(); ++c)
      if (instant.states_before[c].state != instant.after.states[c].state) {
        changes = true;
        pass_.never_slips[c] = false;
      }
    if (changes) pass_.instants.push_back(pass_.end);
  }
  void end(const run::RunPoint& last, const engine::StepperReport& engine) override {
    if (bundle_) bundle_->run().end(last, engine);
  }
  void finish() const {
    pass_.amplitude = range_.amplitude();
    if (bundle_) bundle_->finish(pass_);
  }

 private:
  const Model& model_;
  const RunSpec& run_;
  const PassOptions& leg_;
  OrbitPass& pass_;
  sensitivity::StateFlow* flow_;
  modal::SharedModalData share_;
  DisplacementRange range_;
  std::optional<Bundle> bundle_;
};

Energy change(const Energy& from, const Energy& to) {
  Energy d;
  for (const EnergyColumn& column : energy_columns) d.*column.value = to.*column.value - from.*column.value;
  return d;
}

}  // namespace

PeriodMap::PeriodMap(Model model, const RunSpec& run, Recorder* recorder)
    : model_(std::move(model)), run_(run), recorder_(recorder) {
  model_.internal_units = {};  // the model is in machine units already
  model_.reaction_sums.clear();
  model_.warnings.clear();
  run_.certify = Certify::no;
  run_.output_times.reset();
  run_.frames.clear();
}

OrbitPass PeriodMap::pass(const PassOptions& leg) const {
  OrbitPass pass;
  Model model = with_initial_state(model_, leg.start);
  if (!leg.outputs) model.outputs.clear();
  RunSpec run = run_;
  run.t_end = leg.duration;
  run.output_dt = leg.duration / leg.samples;
  RunSpec bare = run;  // tangents need no output rows
  bare.output_dt = leg.duration;
  CycleRecorder recorder(model, recorder_, pass);
  if (leg.tangents && model_.size() >= min_in_modes && (!flow_ || !flow_->matches(model_)))
    flow_ = sensitivity::modes_uncouple(model_) ? std::make_shared<sensitivity::StateFlow>(model_) : nullptr;
  Follower follower(model, bare, leg, pass, flow_.get(), *memory_);
  const Report report = run::simulate(model, run, recorder, follower, follower.needs());
  pass.outcome = report.outcome;
  pass.interrupted = report.outcome.kind == Outcome::Kind::interrupted;
  pass.response = report.response;
  pass.energy = report.audit.initial.stored();
  pass.cycle_energy = change(report.audit.initial, report.audit.final);
  recorder.finish();
  if (pass.done()) follower.finish();
  return pass;
}

Result PeriodMap::rows(const OrbitState& start, double duration) const {
  RunSpec run = run_;
  run.t_end = duration;
  run.output_dt = duration;
  Model model = with_initial_state(model_, start);
  model.outputs.clear();
  return simulate(model, run);
}

}  // namespace signorini::orbit
