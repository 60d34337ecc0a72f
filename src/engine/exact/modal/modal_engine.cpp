#include "engine/exact/modal/modal_engine.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "base/rounding.hpp"
#include "motion/clock.hpp"
#include "motion/equilibrium.hpp"

namespace signorini {
namespace {

constexpr std::size_t most_parts = 256;  // of a step: each holds the amplitudes of all modes
constexpr int most_touches = 5;          // warnings about one and the same thing
constexpr int most_corrections = 4;      // of the time of a fall; one is enough but where two guards graze

}  // namespace

ModalEngine::ModalEngine(const Model& model, const Structure& structure, ModeSystems& systems, double t_end)
    : model_(model),
      structure_(structure),
      t_end_(t_end),
      system_(model),
      taylor_(model, structure, systems, t_end),
      proof_(model, system_.alpha()),
      works_(model, system_.alpha()),
      turning_(model.contacts.size()) {}

/// Why a segment is followed by the series; empty: it is not.
std::string ModalEngine::obstacle(const Segment& segment) {
  if (!system_.failure().empty()) return system_.failure();
  if (segment.forcing->varies()) return "forces or surfaces that change";
  state_ = system_.state(segment.decision->mode);
  if (!state_->spectrum.failure().empty()) return state_->spectrum.failure();
  if (!ModalWorks::suits(state_->spectrum, t_end_))
    return "frequencies that are neither zero nor fast beside the run";
  return {};
}

void ModalEngine::set_forces(const Segment& segment) {
  const Decision& decision = *segment.decision;
  forces_.real.assign(oscillators_.real().size(), 0.0);
  forces_.pair.assign(oscillators_.pairs().size(), Complex());
  const auto add = [&](const Amplitudes& from, double factor) {
    if (factor == 0.0) return;
    for (std::size_t k = 0; k < forces_.real.size(); ++k) forces_.real[k] += factor * from.real[k];
    for (std::size_t k = 0; k < forces_.pair.size(); ++k) forces_.pair[k] += from.pair[k] * factor;
  };
  const double t = decision.jet.t;
  for (std::size_t i = 0; i < model_.loads.size(); ++i)
    add(state_->from_load[i], model_.loads[i].history.piece(t).value(t));
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    const ForceLaw law = force_law(model_.contacts[c], decision.mode[c], segment.forcing->pressing(c, t, 0));
    const double gap = model_.contacts[c].gap, surface = segment.forcing->surface(c, t, 0);
    if (model_.contacts[c].has_gap()) add(state_->from_normal[c], -(law.N_constant + law.N_gap * gap));
    add(state_->from_tangent[c], -(law.T_constant + law.T_gap * gap - law.T_ut * surface));
  }
}

void ModalEngine::say_fallback(double t, const std::string& why) {
  if (fallbacks_++ > 0) return;
  warnings.push_back(fmt::format("the flow in modes gave way to the Taylor series at t = {:.6g}: {}",
                                 t * model_.unit.time, why));
}

/// The series takes over within a segment: from its beginning, past what has been told already.
Step ModalEngine::give_way() {
  say_fallback(t_, "a guard stays too near to zero for what modes can prove");
  modal_ = false;
  taylor_.start(segment_);
  Step step = taylor_.advance();
  while (step.kind == Step::Kind::accepted && step.end <= t_) step = taylor_.advance();
  step.begin = std::max(step.begin, t_);
  return step;
}

void ModalEngine::start(const Segment& segment) {
  const std::string why = obstacle(segment);
  const bool followed = modal_;
  modal_ = why.empty();
  if (!modal_) {
    say_fallback(segment.decision->jet.t, why);
    taylor_.start(segment);
    return;
  }
  segment_ = segment;
  const Decision& decision = *segment.decision;
  t_ = decision.jet.t;
  // The decision leaves most motions as they are: then nothing is lost on the way through the physical ones.
  if (!followed || q_.size() == 0 || decision.u != end_.u || decision.v != end_.v) {
    q_ = system_.amplitudes(decision.u);
    rate_ = system_.amplitudes(decision.v);
  }
  oscillators_ = Oscillators(state_->spectrum, system_.alpha());
  state_->spectrum.to_modes(q_, now_.z);
  state_->spectrum.to_modes(rate_, now_.rate);
  set_forces(segment);
  proof_.start(segment_, *state_, oscillators_, forces_);
  works_.start(segment_, *state_, oscillators_, forces_, t_end_);
  turning_.start(decision);
  has_worked_ = false;
  end_ = {decision.u, decision.v, decision.jet.forces.col(0), decision.jet.a()};
  ++restarts_;
}

void ModalEngine::see_touches(const Passage& passage, double begin) {
  for (const std::size_t slot : passage.touches)
    if (++touches_ <= most_touches)
      warnings.push_back(fmt::format(
          "contact '{}': its {} touches zero near {:.9g}; whether it falls there is not decidable "
          "at this precision, and it was taken not to",
          model_.contacts[contact_of_guard(slot)].name, to_string(segment_.decision->guards[slot].kind),
          begin * model_.unit.time));
}

/// Peaks are looked for only where one may exceed all before.
void ModalEngine::find_turns(const ModalPoint& from, double begin, double length) {
  const double x_end = length / proof_.unit(), x = proof_.within(turning_, x_end);
  if (x >= x_end) return;
  double done = x * proof_.unit();
  ModalPoint point, next;
  oscillators_.advance(from, forces_, done, point);
  while (done < length) {
    const double step = proof_.expand_finely(point, turning_, length - done);
    if (!(step > 0.0)) return;
    Series clock;
    clock.t = begin + done;
    clock.scale = proof_.unit();
    turning_.find(proof_.slow(), clock, step / proof_.unit(), TurningPoints::Ends::searched);
    for (const TurningPoints::Turn& turn : turning_.turns()) last_turns_[turn.kind] = turn.time;
    oscillators_.advance(point, forces_, step, next);
    std::swap(point, next);
    done += step;
  }
}

/// How far off the fall of a guard lies by the u, v and forces that the decision will see, and how far off
/// the rounding of the modes may put it.
ModalEngine::Fall ModalEngine::fall_of(std::size_t slot, const Point& point) const {
  const std::size_t c = contact_of_guard(slot);
  const Form& guard = segment_.decision->guards[slot].form;
  const ContactMotion now =
      motion_of(model_.contacts[c], c, *segment_.forcing, segment_.decision->jet.t, point);
  const ForceLaw law = proof_.law(c);
  ContactMotion rate;
  rate.N = law.N_gap * now.vn;
  rate.T = law.T_gap * now.vn + law.T_ut * now.vt;
  rate.gap = now.vn;
  rate.ut = now.vt;
  rate.vn = now.an;
  rate.vt = now.at;
  const double slope = guard.rate(rate);
  if (!(slope < 0.0)) return {};
  return {-guard.value(now) / slope, -rounding::of_many * proof_.magnitude(slot, now_) / slope};
}

/// The end of the last part moves to where the guard falls in u, v and the forces that they make: in modes it
/// is zero to the rounding of the modes, which is more than the decision allows. Returns how sharp that is.
double ModalEngine::sharpen(std::size_t slot) {
  Part& part = parts_.back();
  for (int i = 0;; ++i) {
    t_ = part.begin + part.length;
    fill(now_, end_);
    const Fall fall = fall_of(slot, end_);
    const bool sharp = std::abs(fall.off) <= std::max(0.25 * resolution_at(t_, 0.0), fall.blur);
    if (i == most_corrections || sharp) return fall.blur;
    part.length = std::max(0.0, part.length + fall.off);
    oscillators_.advance(part.at, forces_, part.length, now_);
  }
}

Step ModalEngine::advance() {
  if (!modal_) return taylor_.advance();
  Step step;
  step.begin = t_;
  parts_.clear();
  turns_.clear();
  last_turns_.clear();
  ++steps_;
  for (;;) {
    const double remaining = segment_.end - t_;
    const Passage passage = proof_.pass(now_, remaining);
    ++proofs_;
    double end = t_ + passage.length;
    const bool last =
        !passage.fired && (end >= segment_.end || segment_.end - end <= resolution_at(end, 0.0));
    if (last) end = segment_.end;
    const bool stuck = !passage.fired && !last && !(passage.length > 0.01 * resolution_at(t_, 0.0));
    if (stuck && parts_.empty()) return give_way();
    if (stuck) break;
    if (!std::isfinite(passage.length)) {
      step.kind = Step::Kind::failed;
      step.end = t_;
      step.reason = "the motion overflows";
      return step;
    }
    see_touches(passage, t_);
    parts_.push_back({t_, end - t_, now_});
    ModalPoint next;
    oscillators_.advance(now_, forces_, last ? remaining : passage.length, next);
    find_turns(now_, t_, passage.length);
    now_ = std::move(next);
    t_ = end;
    if (passage.fired) {
      step.resolution = sharpen(*passage.fired);
      step.kind = Step::Kind::event;
      step.fired = {{contact_of_guard(*passage.fired), segment_.decision->guards[*passage.fired].kind}};
      break;
    }
    if (last) break;
    proof_.rearm(now_);
    if (parts_.size() >= most_parts) break;
  }
  for (const auto& [kind, time] : last_turns_) turns_.push_back(time);
  std::sort(turns_.begin(), turns_.end());
  step.end = t_;
  step.resolution = std::max(step.resolution, resolution_at(t_, parts_.back().length));
  if (step.kind != Step::Kind::event) fill(now_, end_);
  return step;
}

ModalPoint ModalEngine::at(double t) const {
  if (t >= t_) return now_;
  auto part = std::upper_bound(parts_.begin(), parts_.end(), t,
                               [](double time, const Part& p) { return time < p.begin; });
  if (part != parts_.begin()) --part;
  ModalPoint point;
  oscillators_.advance(part->at, forces_, t - part->begin, point);
  return point;
}

/// u, v, a and forces; keeps q of the end of the step.
void ModalEngine::fill(const ModalPoint& z, Point& point) {
  Amplitudes second;
  const double alpha = system_.alpha();
  for (std::size_t k = 0; k < z.z.real.size(); ++k)
    second.real.push_back(forces_.real[k] - alpha * z.rate.real[k] - oscillators_.real()[k] * z.z.real[k]);
  for (std::size_t k = 0; k < z.z.pair.size(); ++k)
    second.pair.push_back(forces_.pair[k] - z.rate.pair[k] * alpha - oscillators_.pairs()[k] * z.z.pair[k]);
  Vector q, rate, change;
  state_->spectrum.from_modes({&z.z, &z.rate, &second}, {&q, &rate, &change});
  system_.motions({&q, &rate, &change}, {&point.u, &point.v, &point.a});
  point.forces.resize(static_cast<Eigen::Index>(2 * model_.contacts.size()));
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    const ForceLaw law = proof_.law(c);
    const Contact& contact = model_.contacts[c];
    const double gap = contact.gap_at(point.u);
    const double ut =
        contact.tangent.dot(point.u) - segment_.forcing->surface(c, segment_.decision->jet.t, 0);
    const auto row = static_cast<Eigen::Index>(normal_slot(c));
    point.forces[row] = law.N_gap * gap + law.N_constant;
    point.forces[row + 1] = law.T_gap * gap + law.T_ut * ut + law.T_constant;
  }
  if (&point == &end_) {
    q_ = std::move(q);
    rate_ = std::move(rate);
  }
}

void ModalEngine::evaluate(double t, Point& point) {
  if (!modal_) return taylor_.evaluate(t, point);
  if (t == t_)
    point = end_;
  else
    fill(at(t), point);
}

void ModalEngine::integrate(double from, double to, Works& works) {
  if (!modal_) return taylor_.integrate(from, to, works);
  if (!has_worked_ || worked_to_ != from) worked_ = at(from);
  ModalPoint next = at(to);
  works_.add(proof_, worked_, next, to - from, works);
  worked_ = std::move(next);
  worked_to_ = to;
  has_worked_ = true;
}

double ModalEngine::residual() {
  if (!modal_) return taylor_.residual();
  return imbalance(model_, structure_, *segment_.forcing, t_, end_);
}

void ModalEngine::count() {
  counters = taylor_.counters;
  counters.steps += steps_;
  counters.restarts += restarts_;
  counters.contact_states = system_.made();
  counters.proof_steps = proofs_;
  counters.fallbacks = fallbacks_;
  warnings.insert(warnings.end(), taylor_.warnings.begin(), taylor_.warnings.end());
}

}  // namespace signorini
