#include "engine/exact/modal/damped_proof.hpp"

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "engine/exact/modal/modal_proof.hpp"

namespace signorini::modal {
namespace {

constexpr double max_fast_part_of_guard = 0.25;  // limit of the sum of all fast modes, as a part of the guard
constexpr double guard_noise_part = 1.0 / 16.0;  // part of the decision's rounding bound in a guard's slack
constexpr double max_slow_phase = 4.0;           // largest |l| h of a slow mode
constexpr std::size_t highest_degree = 30;
constexpr double slow_rounding = 1.0 + 1e-12;

}  // namespace

void DampedProof::start() {
  guards_.clear();
  active_guards_.start(motion_.decision().guards);
  all_slow_ = false;
  size_ = motion_.root().cwiseAbs();
  series_.resize(motion_.model().contacts.size());
  for (std::size_t slot = 0; slot < motion_.decision().guards.size(); ++slot) {
    if (active_guards_.idle(slot)) continue;
    const decide::Decision& decision = motion_.decision();
    Watched guard{slot,
                  decision.guards[slot].noise,
                  motion_.quantity_of(decision.form(slot), decision.layout.contact_of_guard(slot)),
                  {},
                  0.0};
    guard.leading_derivative = guard.guard;
    for (std::size_t i = 0; i < active_guards_.leading_order(slot); ++i)
      guard.leading_derivative = motion_.derivative(guard.leading_derivative);
    guards_.push_back(std::move(guard));
  }
}

const DampedProof::Watched* DampedProof::find(std::size_t slot) const {
  const auto found =
      std::find_if(guards_.begin(), guards_.end(), [&](const Watched& w) { return w.slot == slot; });
  return found == guards_.end() ? nullptr : &*found;
}

double DampedProof::magnitude(std::size_t slot, const ModalPoint& at) const {
  const Watched* guard = find(slot);
  return guard == nullptr ? 0.0 : motion_.magnitude(guard->guard, at);
}

double DampedProof::slope(std::size_t slot, const ModalPoint& at) const {
  const Watched* guard = find(slot);
  return guard == nullptr ? 0.0 : motion_.value(motion_.derivative(guard->guard), at);
}

void DampedProof::rearm(const ModalPoint& at) {
  for (const Watched& guard : guards_)
    if (!active_guards_.armed(guard.slot))
      active_guards_.update(guard.slot, motion_.value(guard.guard, at), 4.0 * guard.noise);
}

void DampedProof::measure(const ModalPoint& at) {
  amplitude_ = at.y.cwiseAbs();
  for (Watched& guard : guards_) guard.now = motion_.value(watched(guard), at);
}

/// Smallest number of slow modes, at least `first`, for which all faster modes together contribute at most `most` to f.
Eigen::Index DampedProof::count_slow_modes(const ModalQuantity& f, Eigen::Index first, double most) const {
  double sum = 0.0;
  Eigen::Index k = amplitude_.size();
  for (; k > first; --k) {
    sum += std::abs(f.row[k - 1]) * amplitude_[k - 1];
    if (sum > most) break;
  }
  return k;
}

void DampedProof::set_step(double h, bool all_slow) {
  h_ = h;
  turn_ = all_slow ? std::numeric_limits<double>::infinity() : max_slow_phase * slow_rounding;
  slow_ = all_slow ? size_.size() : std::partition_point(size_.begin(), size_.end(), [&](double size) {
                                      return size * h_ <= turn_;
                                    }) - size_.begin();
}

void DampedProof::choose_step(double remaining) {
  const Eigen::Index n = size_.size();
  Eigen::Index first = all_slow_ ? n : 0;
  double h = remaining;
  for (const Watched& guard : guards_) {
    if (first == n) break;
    first = unknown(guard) || !(guard.now > 0.0)
                ? n
                : count_slow_modes(watched(guard), first, max_fast_part_of_guard * guard.now);
  }
  if (n > 0 && size_[std::min(first, n - 1)] > 0.0)
    h = std::min(h, max_slow_phase / size_[std::min(first, n - 1)]);
  const auto& omega = motion_.time().omega();
  auto place = static_cast<Eigen::Index>(motion_.time().degree()) + 1;
  for (const double w : omega) {
    const bool shows = std::any_of(guards_.begin(), guards_.end(), [&](const Watched& guard) {
      const TimeCoefficients& c = watched(guard).time_coefficients;
      return std::hypot(c[place], c[place + 1]) * static_cast<double>(omega.size()) >
             0.5 * max_fast_part_of_guard * guard.now;
    });
    if (shows || first == n) h = std::min(h, max_slow_phase / w);
    place += 2;
  }
  set_step(h, first == n);
}

void DampedProof::expand(const ModalPoint& at) {
  double reach = slow_ > 0 ? size_[slow_ - 1] * h_ : 0.0;
  for (const double w : motion_.time().omega())
    if (w * h_ <= turn_) reach = std::max(reach, w * h_);
  count_ = std::min(highest_degree, std::max<std::size_t>(10 + static_cast<std::size_t>(5.5 * reach),
                                                          motion_.time().degree())) +
           1;
  terms_.resize(slow_, static_cast<Eigen::Index>(count_));
  const Eigen::VectorXcd turned = motion_.root().head(slow_) * h_;
  terms_.col(0) = at.y.head(slow_);
  for (Eigen::Index j = 1; j < terms_.cols(); ++j)
    terms_.col(j) = terms_.col(j - 1).cwiseProduct(turned) / static_cast<double>(j);
}

DampedProof::Part DampedProof::part_of(const ModalQuantity& f, const ModalPoint& at) const {
  Part part;
  part.p.resize(count_);
  const TimeBasis::FastWaveBound waves =
      motion_.time().taylor(f.time_coefficients, at.time, h_, turn_, part.p);
  part.fast_bound = waves.value;
  part.fast_rate_bound = waves.rate;
  const auto row = f.row.head(slow_);
  const Eigen::VectorXd modes = (terms_.transpose() * row).real();
  for (std::size_t j = 0; j < count_; ++j) part.p[j] += modes[static_cast<Eigen::Index>(j)];
  // Each further term of the series of a mode is at most half of the previous term.
  part.rest = waves.rest + 2.0 * row.cwiseAbs().dot(terms_.col(terms_.cols() - 1).cwiseAbs());
  for (Eigen::Index k = slow_; k < size_.size(); ++k) {
    const double most =
        std::abs(f.row[k]) * amplitude_[k] * std::exp(std::max(0.0, motion_.root()[k].real() * h_));
    part.fast_bound += most;
    part.fast_rate_bound += most * size_[k];
  }
  return part;
}

bool DampedProof::find_zero(const Watched& guard, const ModalPoint& at, Passage& passage, double& limit,
                            double& event) {
  Part part = part_of(watched(guard), at);
  GuardOnStep on_step;
  on_step.p = std::move(part.p);
  on_step.slack = part.rest + rounding::few_operations * motion_.magnitude(watched(guard), at) +
                  guard_noise_part * guard.noise;
  on_step.fast_bound = part.fast_bound;
  on_step.fast_rate_bound = part.fast_rate_bound;
  on_step.noise = guard.noise;
  on_step.leading_order = active_guards_.leading_order(guard.slot);
  on_step.armed = active_guards_.armed(guard.slot);
  ModalPoint point;
  const auto value_at = [&](double x) {
    motion_.advance(at, h_ * x, point);
    return motion_.value(guard.guard, point);
  };
  return find_guard_zero(on_step, guard.slot, h_, value_at, active_guards_, passage, limit, event);
}

Passage DampedProof::pass(const ModalPoint& at, double remaining) {
  measure(at);
  for (const Watched& guard : guards_)
    if (active_guards_.leading_order(guard.slot) > 0 && !(guard.now > 0.0))
      active_guards_.discard_leading_order(guard.slot);
  choose_step(remaining);
  expand(at);
  Passage passage;
  double limit = 1.0, event = 2.0;
  bool doubted = false;
  for (const Watched& guard : guards_) doubted = !find_zero(guard, at, passage, limit, event) || doubted;
  const auto done = end_of_step(std::move(passage), doubted, limit, event, h_, all_slow_);
  return done ? *done : pass(at, remaining);
}

/// N, T, gap and ut of contact c: the order of TurningPointDetector::watched_fields.
std::array<const ModalQuantity*, 4> DampedProof::watched_quantities(std::size_t c) const {
  const DampedMotion::ContactQuantities& own = motion_.contact(c);
  return {&own.N, &own.T, &own.gap, &own.ut};
}

double DampedProof::length_without_turning(const ModalPoint& at, const events::TurningPointDetector& known,
                                           double x_end) const {
  std::vector<double> room(count_), rate(count_ - 1);
  double safe = 1.0;
  for (std::size_t c = 0; c < series_.size() && safe > 0.0; ++c)
    for (std::size_t f = 0; f < 4; ++f) {
      const Part part = part_of(*watched_quantities(c)[f], at);
      for (std::size_t j = 0; j < rate.size(); ++j) rate[j] = static_cast<double>(j + 1) * part.p[j + 1];
      const double off = part.fast_rate_bound * h_ + part.rest * static_cast<double>(count_ + 1);
      const double forth =
          stays_above(rate.data(), rate.size() - 1, x_end, rate[0] < 0.0 ? -1.0 : 1.0, -off, room);
      const events::TurningPointDetector::Range& range =
          known.range(c, events::TurningPointDetector::watched_fields[f]);
      const double off_place = part.fast_bound + part.rest;
      if (range.is_exceeded(part.p[0], part.p[1],
                            off_place) &&  // reason: see ModalProof::length_without_turning()
          range.is_exceeded(
              part.p[0], part.p[1],
              off_place + rounding::elimination * motion_.magnitude(*watched_quantities(c)[f], at)))
        return 0.0;
      if (forth >= safe) continue;
      for (const double sign : {-1.0, 1.0}) {
        const double above = (sign < 0.0 ? range.greatest : -range.least) - off_place;
        safe =
            std::min(safe, std::max(forth, stays_above(part.p.data(), count_ - 1, x_end, sign, above, room)));
      }
    }
  return safe * x_end;
}

double DampedProof::expand_for_turning(const ModalPoint& at, const events::TurningPointDetector& known,
                                       double share, double remaining) {
  amplitude_ = at.y.cwiseAbs();
  const Eigen::Index n = size_.size();
  Eigen::Index first = 0;
  for (std::size_t c = 0; c < series_.size(); ++c)
    for (std::size_t f = 0; f < 4; ++f) {
      const ModalQuantity& quantity = *watched_quantities(c)[f];
      const events::TurningPointDetector::Range& range =
          known.range(c, events::TurningPointDetector::watched_fields[f]);
      first = count_slow_modes(quantity, first, share * range.width(motion_.value(quantity, at)));
    }
  double h = remaining;
  if (n > 0 && size_[std::min(first, n - 1)] > 0.0)
    h = std::min(h, max_slow_phase / size_[std::min(first, n - 1)]);
  for (const double w : motion_.time().omega()) h = std::min(h, max_slow_phase / w);
  set_step(h, first == n);
  expand(at);
  return h_;
}

const std::vector<motion::ContactSeries>& DampedProof::series(const ModalPoint& at) {
  for (std::size_t c = 0; c < series_.size(); ++c) {
    series_[c].reset(count_ - 1);
    for (std::size_t f = 0; f < 4; ++f) {
      const Part part = part_of(*watched_quantities(c)[f], at);
      std::copy(part.p.begin(), part.p.end(),
                series_[c].mutable_coefficients(events::TurningPointDetector::watched_fields[f]));
    }
  }
  return series_;
}

/// Finds extremes exactly at the beginning of a passage: a quantity exceeds its earlier range there, and its rate points back.
void DampedProof::find_turning_at_start(const ModalPoint& at, double time,
                                        events::TurningPointDetector& turning,
                                        LastTurningTimes& turns) const {
  for (std::size_t c = 0; c < series_.size(); ++c)
    for (std::size_t f = 0; f < 4; ++f) {
      const ModalQuantity& quantity = *watched_quantities(c)[f];
      const double value = motion_.value(quantity, at);
      const events::TurningPointDetector::Range& range =
          turning.range(c, events::TurningPointDetector::watched_fields[f]);
      if (value >= range.least && value <= range.greatest) continue;
      const double rate = motion_.value(motion_.derivative(quantity), at);
      if (const auto turn =
              turning.find_at_start(c, events::TurningPointDetector::watched_fields[f], value, rate, time))
        turns[turn->kind] = turn->time;
    }
}

}  // namespace signorini::modal
