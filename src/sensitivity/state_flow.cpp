#include "sensitivity/state_flow.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include "base/rounding.hpp"
#include "model/build.hpp"
#include "sensitivity/contact_rates.hpp"
#include "sensitivity/state_rates.hpp"

namespace signorini::sensitivity {
namespace {

constexpr std::size_t max_mode_bytes = std::size_t{1} << 28;  // largest store of modes in bytes; chosen value
// Largest alpha t that one step covers, as in Oscillators::advance.
constexpr double max_step_decay = 4.0;

/// Many motions at once, one per column, in flat amplitudes: displacements and their rates.
struct ModalBundle {
  Eigen::MatrixXd z, rate;
};

/// Displacement and rate of each mode after `time`, for a motion with these initial values and this force in every mode.
modal::ModalPoint mode_response(const modal::Oscillators& oscillators, const modal::Amplitudes& zero,
                                double z, double rate, double force, double time) {
  const auto all = [&](double value) {
    modal::Amplitudes a = zero;
    std::fill(a.real.begin(), a.real.end(), value);
    std::fill(a.pair.begin(), a.pair.end(), modal::Complex(value));
    return a;
  };
  modal::ModalPoint from{all(z), all(rate), {}, 0.0}, to;
  oscillators.advance(from, all(force), time, to);
  return to;
}

/// out += factor x, where each mode has its own factor.
void add_modewise(const modal::Amplitudes& factor, const Eigen::MatrixXd& x, Eigen::MatrixXd& out) {
  const auto reals = static_cast<Eigen::Index>(factor.real.size());
  const auto pairs = static_cast<Eigen::Index>(factor.pair.size());
  const Eigen::Map<const Vector> real(factor.real.data(), reals);
  out.topRows(reals) += real.asDiagonal() * x.topRows(reals);
  for (Eigen::Index k = 0; k < pairs; ++k) {
    const modal::Complex f = factor.pair[static_cast<std::size_t>(k)];
    const Eigen::Index re = reals + k, im = reals + pairs + k;
    out.row(re) += f.re * x.row(re) - f.im * x.row(im);
    out.row(im) += f.re * x.row(im) + f.im * x.row(re);
  }
}

ModalBundle advanced_modes(const modal::Oscillators& oscillators, const modal::Amplitudes& zero,
                           const ModalBundle& from, const Eigen::MatrixXd& force, double time) {
  ModalBundle to{Eigen::MatrixXd::Zero(from.z.rows(), from.z.cols()),
                 Eigen::MatrixXd::Zero(from.z.rows(), from.z.cols())};
  const modal::ModalPoint c = mode_response(oscillators, zero, 1.0, 0.0, 0.0, time),
                          s = mode_response(oscillators, zero, 0.0, 1.0, 0.0, time),
                          h = mode_response(oscillators, zero, 0.0, 0.0, 1.0, time);
  for (const auto& [by, x] : {std::pair{&c, &from.z}, {&s, &from.rate}, {&h, &force}}) {
    add_modewise(by->z, *x, to.z);
    add_modewise(by->rate, *x, to.rate);
  }
  return to;
}

}  // namespace

bool modes_uncouple(const Model& model) {
  const auto bows = [](const Contact& contact) { return !contact.has_constant_stiffness(); };
  return modal::coupling_refusal(model).empty() &&
         std::none_of(model.contacts.begin(), model.contacts.end(), bows);
}

StateFlow::StateFlow(const Model& model) : model_(model), basis_(model_) {
  if (basis_.failure().empty()) system_.emplace(model_, basis_);
  affected_ = contact_dofs(model_, {});
}

bool StateFlow::matches(const Model& model) const { return model::same_contact_states(model, model_); }

void StateFlow::make(Modes& modes) const {
  const modal::Spectrum& spectrum = modes.state->spectrum;
  const Eigen::Index n = model_.size();
  const auto flat = static_cast<Eigen::Index>(spectrum.real().size() + 2 * spectrum.pairs().size());
  Eigen::MatrixXd in(flat, n), out(n, flat);
  for (Eigen::Index k = 0; k < n; ++k) {
    modal::Amplitudes a;
    spectrum.to_modes(Vector::Unit(n, k), a);
    in.col(k) = flat_modes(a);
  }
  const auto reals = static_cast<Eigen::Index>(spectrum.real().size());
  const auto pairs = static_cast<Eigen::Index>(spectrum.pairs().size());
  for (Eigen::Index k = 0; k < flat; ++k) {
    modal::Amplitudes unit = spectrum.zero();
    if (k < reals)
      unit.real[static_cast<std::size_t>(k)] = 1.0;
    else if (k < reals + pairs)
      unit.pair[static_cast<std::size_t>(k - reals)] = modal::Complex(1.0);
    else
      unit.pair[static_cast<std::size_t>(k - reals - pairs)] = modal::Complex(0.0, 1.0);
    Vector q;
    spectrum.from_modes({&unit}, {&q});
    out.col(k) = q;
  }
  modes.in = in * basis_.projection();
  modes.out = basis_.shapes() * out;
  modes.seen.resize(static_cast<Eigen::Index>(affected_.size()), flat);
  for (std::size_t i = 0; i < affected_.size(); ++i)
    modes.seen.row(static_cast<Eigen::Index>(i)) = modes.out.row(affected_[i]);
  modes.from_tangent.resize(flat, static_cast<Eigen::Index>(model_.contacts.size()));
  for (std::size_t c = 0; c < model_.contacts.size(); ++c)
    modes.from_tangent.col(static_cast<Eigen::Index>(c)) = flat_modes(modes.state->from_tangent[c]);
}

const StateFlow::Modes& StateFlow::modes_of(const contact::ContactStates& contact_states) {
  const std::vector<State> states = contact::states_of(contact_states);
  if (const auto found = known_.find(states); found != known_.end()) return found->second;
  Modes modes;
  if (system_) {
    modes.state = system_->state(contact_states);
    modes.accurate = modes.state->spectrum.failure().empty();
  }
  if (modes.accurate) {
    modes.oscillators = modal::Oscillators(modes.state->spectrum, system_->alpha());
    make(modes);
  }
  const auto bytes = static_cast<std::size_t>(modes.in.size() + modes.out.size()) * sizeof(double);
  if (bytes_ + bytes > max_mode_bytes) {
    known_.clear();
    bytes_ = 0;
  }
  bytes_ += bytes;
  return known_.insert_or_assign(states, std::move(modes)).first->second;
}

bool StateFlow::has_accurate_modes(const contact::ContactStates& contact_states) {
  return modes_of(contact_states).accurate;
}

void StateFlow::advance(const contact::ContactStates& contact_states, double time,
                        std::vector<TangentState>& states) {
  const Modes& modes = modes_of(contact_states);
  std::vector<const Tangent*> starts;
  for (const TangentState& state : states)
    if (state.valid) starts.push_back(&state.now.start);
  const Eigen::Index n = model_.size(), columns = static_cast<Eigen::Index>(starts.size());
  Eigen::MatrixXd W(n, 2 * columns);
  Eigen::MatrixXd held = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(model_.contacts.size()),
                                               columns);  // kt times the tangent of the anchor
  for (Eigen::Index j = 0; j < columns; ++j) {
    const Tangent& start = *starts[static_cast<std::size_t>(j)];
    W.col(j) = start.u;
    W.col(columns + j) = start.v;
    for (std::size_t c = 0; c < contact_states.size(); ++c)
      if (const auto& kt = model_.contacts[c].tangential_stiffness;
          kt && contact_states[c].state == State::stick)
        held(static_cast<Eigen::Index>(c), j) = *kt * start.anchors[c];
  }
  const Eigen::MatrixXd Z = modes.in * W, force = modes.from_tangent * held;
  ModalBundle now{Z.leftCols(columns), Z.rightCols(columns)};
  const modal::Amplitudes zero = modes.state->spectrum.zero();
  const double alpha = system_->alpha();
  const double longest = alpha > 0.0 ? max_step_decay / alpha : std::numeric_limits<double>::infinity();
  for (double done = 0.0; done < time;) {
    const double part = std::min(longest, time - done);
    now = advanced_modes(modes.oscillators, zero, now, force, part);
    done = part < longest ? time : done + part;
  }
  Eigen::MatrixXd second = force - alpha * now.rate, pulled = Eigen::MatrixXd::Zero(force.rows(), columns);
  modal::Amplitudes square = zero;
  square.real = modes.oscillators.real();
  square.pair = modes.oscillators.pairs();
  add_modewise(square, now.z, pulled);
  second -= pulled;
  Eigen::MatrixXd all(force.rows(), 2 * columns);
  all << now.z, now.rate;
  evaluate(contact_states, modes.out * all, modes.seen * second, states);
}

/// Computes the contact quantities of the tangents from their motion.
void StateFlow::evaluate(const contact::ContactStates& contact_states, const Eigen::MatrixXd& moved,
                         const Eigen::MatrixXd& seen, std::vector<TangentState>& states) const {
  const Eigen::Index columns = seen.cols();
  Eigen::Index j = 0;
  for (TangentState& state : states) {
    if (!state.valid) continue;
    SeriesPoint& w = state.now.point;
    w.u = state.now.start.u = moved.col(j);
    w.v = state.now.start.v = moved.col(columns + j);
    w.a = Vector::Zero(model_.size());
    for (std::size_t i = 0; i < affected_.size(); ++i)
      w.a[affected_[i]] = seen(static_cast<Eigen::Index>(i), j);
    w.forces = w.force_rates = Vector::Zero(model_.force_count());
    for (std::size_t c = 0; c < contact_states.size(); ++c) {
      const Contact& contact = model_.contacts[c];
      const modal::ForceLaw law = modal::force_law(contact, contact_states[c], 0.0);
      const auto slot = static_cast<Eigen::Index>(model_.layout.normal(c)),
                 t = static_cast<Eigen::Index>(model_.layout.tangent(c));
      w.forces[slot] = law.N_rate(contact.normal.dot(w.u));
      w.forces[t] = law.T_rate(contact.normal.dot(w.u), contact.tangent.dot(w.u));
      if (contact.tangential_stiffness && contact_states[c].state == State::stick)
        w.forces[t] -= *contact.tangential_stiffness * state.now.start.anchors[c];
      w.force_rates[slot] = law.N_rate(contact.normal.dot(w.v));
      w.force_rates[t] = law.T_rate(contact.normal.dot(w.v), contact.tangent.dot(w.v));
    }
    ++j;
  }
}

}  // namespace signorini::sensitivity
