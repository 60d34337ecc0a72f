#include "engine/exact/modal/proportional_flow.hpp"

#include "contact/motion.hpp"

#include <algorithm>

namespace signorini {

ProportionalFlow::ProportionalFlow(const Model& model, const OpenBasis& basis, double t_end)
    : model_(model),
      t_end_(t_end),
      system_(model, basis),
      proof_(model, system_.alpha()),
      works_(model, system_.alpha()) {}

/// Why a segment is followed by the series; empty: it is not.
std::string ProportionalFlow::obstacle(const Segment& segment) {
  if (segment.forcing->varies()) return "forces or surfaces that change";
  state_ = system_.state(segment.decision->mode);
  if (!state_->spectrum.failure().empty()) return state_->spectrum.failure();
  if (!ModalWorks::suits(state_->spectrum, t_end_))
    return "frequencies that are neither zero nor fast beside the run";
  return {};
}

std::string ProportionalFlow::start(const Segment& segment, const Vector& q, const Vector& rate,
                                    ModalPoint& now) {
  if (std::string why = obstacle(segment); !why.empty()) return why;
  segment_ = &segment;
  oscillators_ = Oscillators(state_->spectrum, system_.alpha());
  state_->spectrum.to_modes({&q, &rate}, {&now.z, &now.rate});
  forces_ =
      constant_forces(model_, *state_, segment.decision->mode, *segment.forcing, segment.decision->jet.t);
  proof_.start(segment, *state_, oscillators_, forces_);
  works_.start(segment, *state_, oscillators_, forces_, t_end_);
  return {};
}

/// Peaks are looked for only where one may exceed all before.
void ProportionalFlow::find_turns(const ModalPoint& from, double begin, double length, bool observed,
                                  TurningPoints& turning, LastTurns& turns) {
  if (!observed) proof_.see_begin(from, begin, turning, turns);
  const double x_end = length / proof_.unit(), x = proof_.within(turning, x_end);
  if (x >= x_end) return;
  double done = x * proof_.unit();
  ModalPoint point, next;
  oscillators_.advance(from, forces_, done, point);
  const auto go = [&](double step) {
    oscillators_.advance(point, forces_, step, next);
    std::swap(point, next);
    done += step;
  };
  while (done < length) {
    // What went one way up to here may turn at this very point.
    proof_.see_begin(point, begin + done, turning, turns);
    go(proof_.look_ahead(point, turning, length - done));
    if (!(done < length)) return;
    const double step = proof_.expand_finely(point, turning, length - done);
    if (!(step > 0.0)) return;
    Series clock;
    clock.t = begin + done;
    clock.scale = proof_.unit();
    const auto ends = observed && !(done > 0.0) ? TurningPoints::Ends::first_part : TurningPoints::Ends::part;
    turning.find(proof_.slow(), clock, step / proof_.unit(), ends);
    for (const TurningPoints::Turn& turn : turning.turns()) turns[turn.kind] = turn.time;
    go(step);
  }
}

void ProportionalFlow::motion(const ModalPoint& z, Vector& q, Vector& rate, Vector* change) const {
  if (!change) return state_->spectrum.from_modes({&z.z, &z.rate}, {&q, &rate});
  const Amplitudes second = oscillators_.second(z, forces_);
  state_->spectrum.from_modes({&z.z, &z.rate, &second}, {&q, &rate, change});
}

void ProportionalFlow::forces(const ModalPoint& /*at*/, Point& point) const {
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    const ForceLaw law = proof_.law(c);
    const Contact& contact = model_.contacts[c];
    const double gap = contact.gap_at(point.u);
    const double ut =
        along_surface(contact, point.u, segment_->forcing->surface(c, segment_->decision->jet.t, 0));
    const auto row = static_cast<Eigen::Index>(normal_slot(c));
    point.forces[row] = law.N(gap);
    point.forces[row + 1] = law.T(gap, ut);
  }
}

double ProportionalFlow::slope(std::size_t slot, const ModalPoint& /*at*/, const Point& point,
                               double /*t*/) const {
  const std::size_t c = contact_of_guard(slot);
  const ContactMotion now =
      motion_of(model_.contacts[c], c, *segment_->forcing, segment_->decision->jet.t, point);
  const ForceLaw law = proof_.law(c);
  ContactMotion rate;
  rate.N = law.N_rate(now.vn);
  rate.T = law.T_rate(now.vn, now.vt);
  rate.gap = now.vn;
  rate.ut = now.vt;
  rate.vn = now.an;
  rate.vt = now.at;
  return segment_->decision->guards[slot].form.rate(rate);
}

}  // namespace signorini
