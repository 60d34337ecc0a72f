#include "engine/exact/modal/proportional_flow.hpp"

#include "contact/motion.hpp"
#include "engine/exact/modal/modal_flow.hpp"

namespace signorini::modal {

ProportionalFlow::ProportionalFlow(const Model& model, const UnconstrainedBasis& basis, double t_end)
    : model_(model),
      t_end_(t_end),
      system_(model, basis),
      proof_(model, system_.alpha()),
      works_(model, system_.alpha()) {}

/// Sets state_. Returns the reason why uncoupled modes cannot represent the motion in a segment, or an empty string.
std::string ProportionalFlow::unsupported_reason(const engine::Segment& segment) {
  if (segment.forcing->varies()) return "forces or surface motions are not constant";
  state_ = system_.state(segment.decision->states);
  if (!state_->spectrum.failure().empty()) return state_->spectrum.failure();
  if (!ModalWorkIntegrals::is_accurate_for(state_->spectrum, t_end_))
    return "a frequency is neither zero nor fast compared with the run";
  return {};
}

std::string ProportionalFlow::start(const engine::Segment& segment, const Vector& q, const Vector& rate,
                                    ModalPoint& now) {
  if (std::string why = unsupported_reason(segment); !why.empty()) return why;
  segment_ = &segment;
  oscillators_ = Oscillators(state_->spectrum, system_.alpha());
  state_->spectrum.to_modes({&q, &rate}, {&now.z, &now.rate});
  forces_ =
      constant_forces(model_, *state_, segment.decision->states, *segment.forcing, segment.decision->jet.t);
  proof_.start(segment, *state_, oscillators_, forces_);
  works_.start(segment, *state_, oscillators_, forces_, t_end_);
  return {};
}

void ProportionalFlow::find_turning_points(const ModalPoint& from, double begin, double length, bool observed,
                                           events::TurningPointDetector& turning, LastTurningTimes& turns) {
  const auto advance = [&](const ModalPoint& at, double step, ModalPoint& to) {
    oscillators_.advance(at, forces_, step, to);
  };
  find_turning_points_in_passage(proof_, advance, from, begin, length, observed, turning, turns);
}

std::optional<engine::FastModeBound> ProportionalFlow::fast_mode_bound(const ModalPoint& from, double time,
                                                                       double omega) const {
  std::vector<double> real, pair;
  oscillators_.amplitudes(from, forces_, real, pair);
  const std::size_t contacts = model_.contacts.size();
  std::vector<double> normal(contacts, 0.0), tangent(contacts, 0.0);
  SumOfModes u(eigenvector_condition()), v(eigenvector_condition()), a(eigenvector_condition());
  const auto add = [&](double rate, double most, const auto& shown) {
    u.add(most);
    v.add(most * rate);
    a.add(most * rate * rate);
    for (std::size_t c = 0; c < contacts; ++c) {
      normal[c] += shown(state_->normal[c]) * most;
      tangent[c] += shown(state_->tangent[c]) * most;
    }
  };
  for (std::size_t k = 0; k < real.size(); ++k) {
    const double rate = std::sqrt(std::abs(oscillators_.real()[k]));
    if (!(std::max(rate, oscillators_.alpha()) > omega)) continue;
    if (!(oscillators_.damped_omega()[k] > 0.0)) return std::nullopt;
    add(rate, real[k], [&](const Amplitudes& of) { return std::abs(of.real[k]); });
  }
  for (std::size_t k = 0; k < pair.size(); ++k) {
    const double rate = std::sqrt(size_of(oscillators_.pairs()[k]));
    if (!(rate > omega)) continue;
    const double grown = std::exp(std::abs(oscillators_.pair_damped_omega()[k].im) * time);
    add(rate, 2.0 * pair[k] * grown, [&](const Amplitudes& of) { return size_of(of.pair[k]); });
  }
  engine::FastModeBound r{u.value(), v.value(), a.value(), Eigen::VectorXd::Zero(model_.force_count())};
  for (std::size_t c = 0; c < contacts; ++c) {
    const ForceLaw law = proof_.law(c);
    r.forces[static_cast<Eigen::Index>(model_.layout.normal(c))] = std::abs(law.N_gap) * normal[c];
    r.forces[static_cast<Eigen::Index>(model_.layout.tangent(c))] =
        std::abs(law.T_gap) * normal[c] + std::abs(law.T_ut) * tangent[c];
  }
  return r;
}

void ProportionalFlow::motion(const ModalPoint& z, Vector& q, Vector& rate, Vector* change) const {
  if (!change) return state_->spectrum.from_modes({&z.z, &z.rate}, {&q, &rate});
  const Amplitudes second = oscillators_.accelerations(z, forces_);
  state_->spectrum.from_modes({&z.z, &z.rate, &second}, {&q, &rate, change});
}

void ProportionalFlow::forces(const ModalPoint& /*at*/, motion::Point& point) const {
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    const ForceLaw law = proof_.law(c);
    const Contact& contact = model_.contacts[c];
    const double gap = contact.gap_at(point.u);
    const double ut =
        contact::along_surface(contact, point.u, segment_->forcing->surface(c, segment_->decision->jet.t, 0));
    point.forces.data()[model_.layout.normal(c)] = law.N(gap);
    point.forces.data()[model_.layout.tangent(c)] = law.T(gap, ut);
  }
}

double ProportionalFlow::slope(std::size_t slot, const ModalPoint& /*at*/, const motion::Point& point,
                               double /*t*/) const {
  const std::size_t c = model_.layout.contact_of_guard(slot);
  const ContactMotion now =
      motion::motion_of(model_.contacts[c], c, *segment_->forcing, segment_->decision->jet.t, point);
  const ForceLaw law = proof_.law(c);
  ContactMotion rate;
  rate.N = law.N_rate(now.vn);
  rate.T = law.T_rate(now.vn, now.vt);
  rate.gap = now.vn;
  rate.ut = now.vt;
  rate.vn = now.an;
  rate.vt = now.at;
  return segment_->decision->form(slot).rate(rate);
}

}  // namespace signorini::modal
