#include "sensitivity/discrete_run.hpp"

#include <cmath>

#include "base/rounding.hpp"
#include "contact/friction.hpp"
#include "sensitivity/tangent_event.hpp"

namespace signorini::sensitivity {
namespace {

constexpr std::size_t few_terms = 3;  // coefficients of the forcing: value, first and second derivative

std::string refusal_of(const Model& model, const RunSpec& run) {
  if (run.refine != Refine::root)
    return "discrete derivatives need exact event times, but run.refine = \"linear\" gives interpolated "
           "event times; set run.refine = \"root\"";
  if (run.step == StepControl::doubling)
    return "discrete derivatives need steps of constant length, but run.step = \"doubling\" changes the "
           "length; set "
           "run.step = \"fixed\"";
  if (linear::has_massless(model)) return "discrete derivatives are not available for massless parts";
  for (const Contact& c : model.contacts)
    if (contact::friction_varies(c))
      return std::string("discrete derivatives are not available for ") + contact::friction_description(c);
  return {};
}

SeriesPoint point_of(const motion::Point& p) {
  return {p.u, p.v, p.a, p.forces, Vector::Zero(p.forces.size())};
}

}  // namespace

DiscreteRun::DiscreteRun(const Model& model, const RunSpec& run,
                         const std::vector<ModelDerivative>& derivatives, const std::vector<double>& sizes,
                         TangentListener& listener)
    : model_(model),
      structure_(model),
      systems_(model, structure_),
      listener_(listener),
      grid_(run.grid()),
      t_end_(run.t_end),
      step_(model, structure_),
      matrix_(model, structure_) {
  states_.reserve(derivatives.size());
  for (std::size_t p = 0; p < derivatives.size(); ++p)
    states_.emplace_back(model, structure_, systems_, derivatives[p], sizes[p], run.t_end);
  if (const std::string reason = refusal_of(model, run); !reason.empty()) stop(reason, 0.0);
  impulse_n_.resize(states_.size());
  impulse_t_.resize(states_.size());
  x_.setZero(static_cast<Eigen::Index>(matrix_.size()));
  work_ = x_;
}

void DiscreteRun::stop(const std::string& reason, double t) {
  for (TangentState& state : states_)
    if (std::exchange(state.valid, false)) {
      state.valid_until = t;
      state.reason = reason;
    }
}

void DiscreteRun::begin(const run::RunInstant& start) {
  for (TangentState& state : states_) {
    const ModelDerivative& d = state.derivative;
    NodeDerivative& moved = node_derivatives_.emplace_back();
    moved.u = d.u0;
    moved.v = d.v0;
    moved.a = Vector::Zero(model_.size());
    moved.forces = Vector::Zero(model_.force_count());
    const ForcingDerivatives series = forcing_at(node_derivatives_.size() - 1, 0.0);
    for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
      const Contact& contact = model_.contacts[c];
      const ContactRates& rates = d.contacts[c];
      const double kt = contact.tangential_stiffness.value_or(0.0), T = contact.initial_shear;
      double anchor = contact.tangent.dot(d.u0) + rates.tangent.dot(model_.u0) -
                      driven_rates(series, 1.0, c, 0.0).surface[0];
      if (kt > 0.0) anchor += T * rates.tangential_stiffness / (kt * kt) - rates.initial_shear / kt;
      moved.anchors.push_back(anchor);
    }
  }
  node_ = {0.0, {model_.u0, model_.v0, Vector::Zero(model_.force_count()), Vector::Zero(model_.size())}};
  pass(start);
  rows_at(start);
}

ForcingDerivatives DiscreteRun::forcing_at(std::size_t p, double t) const {
  ForcingDerivatives series;
  ForcingRates(model_, states_[p].derivative, node_.t, motion::Side::after).expand(t, 1.0, few_terms, series);
  return series;
}

void DiscreteRun::factorise(double h) {
  if (factored_ == h) return;
  const linear::Weights weights{1.0, 0.5 * h, 0.25 * h * h};
  const bool done =
      matrix_.set(linear::rows_of(model_, contact_states_),
                  std::vector<linear::Weights>(static_cast<std::size_t>(model_.size()), weights), true);
  factored_ = done ? h : -1.0;
  if (!done) stop("the matrix of a time step is singular; another run.dt may help", node_.t);
}

DiscreteRun::Node DiscreteRun::repeat_step(const motion::Forcing& forcing, double t) {
  if (t == node_.t) return node_;
  Node end{t, {}};
  if (!step_.take(forcing, node_.point, t, t - node_.t, false, end.point))
    stop("the matrix of a time step is singular; another run.dt may help", t);
  return end;
}

/// Derivative of a contact's motion at a node whose time depends on the parameter.
ContactMotion DiscreteRun::along(std::size_t p, std::size_t c, const motion::Forcing& forcing, const Node& at,
                                 const NodeDerivative& moved, const ForcingDerivatives& series) const {
  const Contact& contact = model_.contacts[c];
  const DrivenRates driven = driven_rates(series, 1.0, c, 0.0);
  ContactMotion m = parameter_rate(contact, states_[p].derivative.contacts[c], model_.layout, c,
                                   point_of(at.point), {moved.u, moved.v, moved.a, moved.forces, {}}, driven);
  m.ut -= moved.t * forcing.surface(c, at.t, 1);
  m.vt -= moved.t * forcing.surface(c, at.t, 2);
  m.at -= moved.t * forcing.surface(c, at.t, 3);
  m.applied_normal_force += moved.t * forcing.applied_normal_force(c, at.t, 1);
  m.applied_normal_force_rate += moved.t * forcing.applied_normal_force(c, at.t, 2);
  return m;
}

/// Right-hand sides of the contacts' rows. known: derivatives without the contributions of the new accelerations and forces.
void DiscreteRun::add_rows(std::size_t p, const motion::Forcing& forcing, const Ends& ends,
                           const NodeDerivative& known) {
  const ModelDerivative& d = states_[p].derivative;
  const motion::Point& end = ends.to.point;
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    const Contact& contact = model_.contacts[c];
    const ContactRates& rates = d.contacts[c];
    rates.normal.add_to(x_, -end.N(model_.layout, c));
    rates.tangent.add_to(x_, -end.T(model_.layout, c));
    const ContactMotion m = motion::motion_of(contact, c, forcing, ends.to.t, end);
    const ContactMotion D = along(p, c, forcing, ends.to, known, ends.forcing);
    const Rows row = contact::rows(contact, contact_states_[c]);
    const Rows& by = rates.rows[index_of(contact_states_[c].state)];
    double r = row.normal.rate(D) + by.normal.value(m), q = row.tangent.rate(D) + by.tangent.value(m);
    if (contact_states_[c].state == State::stick && contact.tangential_stiffness)
      q += rates.tangential_stiffness * contact_states_[c].anchor +
           *contact.tangential_stiffness * ends.moved.anchors[c];
    const auto n = static_cast<Eigen::Index>(model_.size());
    x_[n + static_cast<Eigen::Index>(model_.layout.normal(c))] = -r;
    x_[n + static_cast<Eigen::Index>(model_.layout.tangent(c))] = -q;
  }
}

DiscreteRun::NodeDerivative DiscreteRun::advance(std::size_t p, const motion::Forcing& forcing,
                                                 const Ends& ends, double Dt) {
  const ModelDerivative& d = states_[p].derivative;
  const double h = ends.to.t - ends.from.t, Dh = Dt - ends.moved.t;
  const motion::Point &a = ends.from.point, &b = ends.to.point;
  const NodeDerivative& from = ends.moved;
  factorise(h);
  NodeDerivative known{Dt,          {}, {}, Vector::Zero(model_.size()), Vector::Zero(from.forces.size()),
                       from.anchors};
  if (factored_ != h) return known;
  known.u = from.u + h * from.v + 0.25 * h * h * from.a + Dh * (a.v + 0.5 * h * (a.a + b.a));
  known.v = from.v + 0.5 * h * from.a + 0.5 * Dh * (a.a + b.a);
  Vector P = ends.forcing.load.col(0);
  forcing.add_load(ends.to.t, 1, P.data(), Dt);
  x_.setZero();
  auto r = x_.head(model_.size());
  r = P - model_.damping * known.v - model_.stiffness * known.u;
  if (d.mass.nonZeros() > 0) r -= d.mass * b.a;
  if (d.damping.nonZeros() > 0) r -= d.damping * b.v;
  if (d.stiffness.nonZeros() > 0) r -= d.stiffness * b.u;
  add_rows(p, forcing, ends, known);
  matrix_.klu().factors().solve(x_.data(), work_.data());
  known.a = x_.head(model_.size());
  known.u += 0.25 * h * h * known.a;
  known.v += 0.5 * h * known.a;
  known.forces = x_.tail(from.forces.size());
  return known;
}

/// Derivative of the end time of a step with respect to parameter p.
double DiscreteRun::end_of(std::size_t p, const run::RunStep& step, const Ends& ends) {
  if (step.step.kind != engine::Step::Kind::event) {
    const auto jumps = breakpoints_at(model_, states_[p].derivative, ends.to.t, step.step.resolution);
    if (!jumps.empty()) return jumps.front().rate;
    return ends.to.t >= t_end_ ? 0.0 : ends.moved.t;
  }
  const auto& first = step.step.triggered.front();
  const std::size_t c = first.contact;
  const ContactState& state = contact_states_[c];
  const auto forms = contact::guards(model_.contacts[c], state);
  std::size_t i = 0;
  while (i + 1 < forms.size() && forms[i].kind != first.guard) ++i;
  const Form& by = states_[p].derivative.contacts[c].guards[index_of(state.state)][i];
  const ContactMotion m = motion::motion_of(model_.contacts[c], c, step.forcing, ends.to.t, ends.to.point);
  const auto guard = [&](double Dt) {
    const NodeDerivative moved = advance(p, step.forcing, ends, Dt);
    return forms[i].rate(m, along(p, c, step.forcing, ends.to, moved, ends.forcing)) + by.value(m);
  };
  const double h = ends.to.t - ends.from.t;
  const double standing = guard(ends.moved.t), rate = (guard(ends.moved.t + h) - standing) / h;
  return ends.moved.t - standing / rate;
}

/// Computes an output row between nodes: repeats the step up to the output time, which does not depend on the parameter.
void DiscreteRun::row(const run::RunStep& step, double t) {
  const Node at = repeat_step(step.forcing, t);
  TangentSample sample{t, step.forcing, contact_states_, point_of(at.point), {}, {}, {}, {}};
  for (std::size_t p = 0; p < states_.size(); ++p) {
    sample.tangents.emplace_back();
    sample.driven.emplace_back();
    sample.anchors.push_back(node_derivatives_[p].anchors);
    if (!states_[p].valid) continue;
    const ForcingDerivatives series = forcing_at(p, t);
    const NodeDerivative moved = advance(p, step.forcing, {node_, at, node_derivatives_[p], series}, 0.0);
    sample.tangents.back() = {moved.u, moved.v, moved.a, moved.forces, Vector::Zero(moved.forces.size())};
    for (std::size_t c = 0; c < model_.contacts.size(); ++c)
      sample.driven.back().push_back(driven_rates(series, 1.0, c, 0.0));
  }
  listener_.sample(sample, true, false);
}

void DiscreteRun::step(const run::RunStep& step) {
  for (; next_ < grid_.size() && grid_[next_] < step.step.end; ++next_) row(step, grid_[next_]);
  const Node end = repeat_step(step.forcing, step.step.end);
  std::vector<NodeDerivative> next = node_derivatives_;
  for (std::size_t p = 0; p < states_.size(); ++p) {
    if (!states_[p].valid) continue;
    const ForcingDerivatives series = forcing_at(p, end.t);
    const Ends ends{node_, end, node_derivatives_[p], series};
    next[p] = advance(p, step.forcing, ends, end_of(p, step, ends));
  }
  node_ = end;
  node_derivatives_ = std::move(next);
}

/// Computes the derivatives of the velocities after an impact.
void DiscreteRun::hit(std::size_t p, const run::RunInstant& now) {
  impulse_n_[p].clear();
  impulse_t_[p].clear();
  const auto& impulses = now.after.impulses;
  if (std::none_of(impulses.begin(), impulses.end(), [](const decide::Impulse& i) { return i.normal > 0.0; }))
    return;
  std::vector<double> surface;
  const ForcingDerivatives series = forcing_at(p, now.t);
  for (std::size_t c = 0; c < model_.contacts.size(); ++c)
    surface.push_back(driven_rates(series, 1.0, c, 0.0).surface[1] +
                      node_derivatives_[p].t * now.forcing_before.surface(c, now.t, 2));
  ImpactRates rates = impact_rates(systems_, states_[p].derivative, now.states_before, now.after,
                                   now.v_before, node_derivatives_[p].v, surface);
  if (!rates.known) return stop("the equations of the impact are singular", now.t);
  node_derivatives_[p].v = std::move(rates.v);
  impulse_n_[p] = std::move(rates.normal);
  impulse_t_[p] = std::move(rates.tangent);
}

/// Updates the derivatives of anchors that are set at this instant, like TangentEvents::move_anchors.
void DiscreteRun::hold(std::size_t p, const run::RunInstant& now) {
  const ForcingDerivatives series = forcing_at(p, now.t);
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    const Contact& contact = model_.contacts[c];
    const ContactState &old = now.states_before[c], &state = now.after.states[c];
    if (!contact.tangential_stiffness || state.state != State::stick) continue;
    if (old.state == State::stick && old.anchor == state.anchor) continue;
    const ContactMotion m = motion::motion_of(contact, c, now.forcing_before, now.t, node_.point);
    const ContactMotion D = along(p, c, now.forcing_before, node_, node_derivatives_[p], series);
    node_derivatives_[p].anchors[c] = slip_derivative(contact, states_[p].derivative.contacts[c], m, D);
  }
}

void DiscreteRun::fill(std::size_t p, const run::RunInstant& now, const Node& before,
                       const NodeDerivative& was) {
  TangentState& state = states_[p];
  const ForcingDerivatives series = forcing_at(p, now.t);
  const NodeDerivative& is = node_derivatives_[p];
  state.dt = is.t;
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    const Contact& contact = model_.contacts[c];
    const ContactMotion from = along(p, c, now.forcing_before, before, was, series);
    const ContactMotion to = along(p, c, now.forcing_after, node_, is, series);
    EventRates& rates = state.rates[c];
    rates.t = is.t;
    rates.gap = contact.optional_gap(to.gap).value_or(rates.gap);
    rates.N = from.N;
    rates.T = from.T;
    rates.vn = from.vn;
    rates.vt = from.vt;
    rates.N_after = to.N;
    rates.T_after = to.T;
    rates.vn_after = to.vn;
    rates.vt_after = to.vt;
    if (impulse_n_[p].empty() || !now.after.impulses[c].hit) continue;
    rates.impulse_n = impulse_n_[p][c];
    rates.impulse_t = impulse_t_[p][c];
  }
}

void DiscreteRun::pass(const run::RunInstant& now) {
  const Node before = node_;
  const std::vector<NodeDerivative> was = node_derivatives_;
  for (std::size_t p = 0; p < states_.size(); ++p) {
    if (!states_[p].valid) continue;
    hit(p, now);
    hold(p, now);
  }
  contact_states_ = now.after.states;
  factored_ = -1.0;
  node_ = {now.t, {now.after.u, now.after.v, now.after.jet.forces.col(0), now.after.jet.a()}};
  newmark::NewmarkStep::Key key;
  for (const State s : contact::states_of(contact_states_)) key.push_back(static_cast<int>(s));
  step_.set(std::move(key), linear::rows_of(model_, contact_states_));
  const SeriesPoint from = point_of(before.point), to = point_of(node_.point);
  const motion::Series none;
  InstantMotion motion{now, from, to, none, {}, {}, {}, {}};
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    motion.motion_before.push_back(motion_of(model_.contacts[c], c, now.forcing_before, now.t, from));
    motion.motion_after.push_back(motion_of(model_.contacts[c], c, now.forcing_after, now.t, to));
  }
  for (std::size_t p = 0; p < states_.size(); ++p) {
    TangentState& state = states_[p];
    state.rates.assign(model_.contacts.size(), EventRates{});
    state.dt = EventRates::none;
    if (!state.valid) continue;
    const ForcingDerivatives series = forcing_at(p, now.t);
    const NodeDerivative here = node_derivatives_[p];
    node_derivatives_[p] = advance(p, now.forcing_after, {node_, node_, here, series}, here.t);
    state.now.point.u = node_derivatives_[p].u - node_derivatives_[p].t * node_.point.v;
    fill(p, now, before, was[p]);
  }
  listener_.at_instant(motion, states_);
}

void DiscreteRun::instant(const run::RunInstant& instant) {
  pass(instant);
  rows_at(instant);
}

/// Writes output rows at the instant itself; they contain the values just after the instant.
void DiscreteRun::rows_at(const run::RunInstant& instant) {
  for (; next_ < grid_.size() && grid_[next_] <= instant.t; ++next_) {
    TangentSample sample{
        grid_[next_], instant.forcing_after, contact_states_, point_of(node_.point), {}, {}, {}, {}};
    for (std::size_t p = 0; p < states_.size(); ++p) {
      const NodeDerivative& m = node_derivatives_[p];
      const bool known = states_[p].valid && m.t == 0.0;  // output times are fixed, so the node must not move
      sample.tangents.push_back(known ? SeriesPoint{m.u, m.v, m.a, m.forces, Vector::Zero(m.forces.size())}
                                      : SeriesPoint{});
      sample.driven.emplace_back();
      const ForcingDerivatives series = forcing_at(p, instant.t);
      for (std::size_t c = 0; c < model_.contacts.size(); ++c)
        sample.driven.back().push_back(driven_rates(series, 1.0, c, 0.0));
      sample.anchors.push_back(m.anchors);
    }
    listener_.sample(sample, true, false);
  }
}

}  // namespace signorini::sensitivity
