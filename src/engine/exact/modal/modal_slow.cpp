// The slow part of contact quantities: polynomials on a step, and bounds on the contribution of fast modes.
#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Core>

#include "base/wide_lanes.hpp"
#include "engine/exact/modal/modal_proof.hpp"
#include "engine/exact/modal/settle_guard.hpp"

namespace signorini {
namespace {

constexpr std::size_t most_degree = 30;

/// Errors of N, T, g and ut (TurningPoints::watched) that follow from errors of g and ut.
std::array<double, 4> of_law(const ForceLaw& law, double normal, double tangent) {
  return {std::abs(law.N_gap) * normal, std::abs(law.T_gap) * normal + std::abs(law.T_ut) * tangent, normal,
          tangent};
}

}  // namespace

/// Selects the modes that a step of length h_ follows as polynomials.
void ModalProof::part_modes(bool all_slow) {
  const std::vector<double>& l = oscillators_->real();
  const std::vector<Complex>& pairs = oscillators_->pairs();
  const double square = turn * turn * (1.0 + 1e-12);
  fast_ = static_cast<std::size_t>(
      std::partition_point(l.begin(), l.end(), [&](double value) { return value * h_ * h_ < square; }) -
      l.begin());
  if (all_slow) fast_ = l.size();
  pair_slow_.assign(pairs.size(), true);
  for (std::size_t k = 0; k < pairs.size(); ++k) pair_slow_[k] = size_of(pairs[k]) * h_ * h_ <= square;
}

/// Bounds on the contributions of fast modes and of the remainder of the slow ones to N, T, g and ut
/// (TurningPoints::watched), or to their rates: each mode moves by at most A, and by sqrt(l) A in a unit of time.
ModalProof::Watch4 ModalProof::ripples(std::size_t c, bool of_rate) const {
  const ForceLaw& law = laws_[c];
  double normal = of_rate ? normal_rest_[c].rate : normal_rest_[c].place;
  double tangent = of_rate ? tangent_rest_[c].rate : tangent_rest_[c].place;
  for (std::size_t k = fast_; k < amplitude_.size(); ++k) {
    const double most = of_rate ? amplitude_[k] * std::sqrt(oscillators_->real()[k]) : amplitude_[k];
    normal += std::abs(state_->normal[c].real[k]) * most;
    tangent += std::abs(state_->tangent[c].real[k]) * most;
  }
  return of_law(law, normal, tangent);
}

/// Part of [0, 1] on which each of N, T, g and ut is monotone or constant, without a turning point. N follows g; T
/// follows g in slip and ut in stick.
ModalProof::Watch4 ModalProof::one_way(std::size_t c, double x_end, std::vector<double>& p) const {
  const ForceLaw& law = laws_[c];
  const Watch4 ripple = ripples(c, true);
  const auto goes = [&](ContactSeries::Field rate, double off) {
    const double* a = slow_[c].of(rate);
    return stays_above(a, degree_, x_end, a[0] < 0.0 ? -1.0 : 1.0, -off, p);
  };
  const double gap = goes(ContactSeries::vn, ripple[2]), ut = goes(ContactSeries::vt, ripple[3]);
  const double N = law.N_gap != 0.0 ? gap : 1.0;
  const double T = std::min(law.T_gap != 0.0 ? gap : 1.0, law.T_ut != 0.0 ? ut : 1.0);
  return {N, T, gap, ut};
}

double ModalProof::within(const ModalPoint& /*at*/, const TurningPoints& known, double x_end) const {
  if (std::find(pair_slow_.begin(), pair_slow_.end(), false) != pair_slow_.end()) return 0.0;
  std::vector<double> p(degree_ + 1);
  double safe = 1.0;  // part of x_end
  for (std::size_t c = 0; c < slow_.size() && safe > 0.0; ++c) {
    const Watch4 ripple = ripples(c, false), forth = one_way(c, x_end, p);
    const Watch4 unsure = of_law(laws_[c], rounding::of_elimination * normal_size_[c].place,
                                 rounding::of_elimination * tangent_size_[c].place);
    for (std::size_t f = 0; f < ripple.size(); ++f) {
      const TurningPoints::Range& range = known.range(c, TurningPoints::watched[f]);
      const double* a = slow_[c].of(TurningPoints::watched[f]);
      // see_begin sums the slope in another order: if the slope is only rounding, its sign may differ.
      if (range.is_left(a[0], a[1], ripple[f] + unsure[f])) return 0.0;
      if (forth[f] >= safe) continue;
      for (const double sign : {-1.0, 1.0}) {
        const double room = (sign < 0.0 ? range.greatest : -range.least) - ripple[f];
        safe = std::min(safe, std::max(forth[f], stays_above(a, degree_, x_end, sign, room, p)));
      }
    }
  }
  return safe * x_end;
}

/// Detects peaks between passages: values that rose up to the end of the previous passage and decrease from there.
void ModalProof::see_begin(const ModalPoint& at, double time, TurningPoints& turning,
                           LastTurns& turns) const {
  for (std::size_t c = 0; c < laws_.size(); ++c) {
    const Shown now = shown(c, at);
    const ForceLaw& law = laws_[c];
    const Watch4 value{law.N(now.gap), law.T(now.gap, now.ut), now.gap, now.ut};
    const Watch4 rate{law.N_rate(now.vn), law.T_rate(now.vn, now.vt), now.vn, now.vt};
    for (std::size_t f = 0; f < value.size(); ++f)
      if (const auto peak = turning.begins(c, TurningPoints::watched[f], value[f], rate[f], time))
        turns[peak->kind] = peak->time;
  }
}

double ModalProof::expand_beside(const ModalPoint& at, const TurningPoints& known, double share,
                                 double remaining) {
  oscillators_->amplitudes(at, *forces_, amplitude_, pair_amplitude_);
  const std::size_t n = amplitude_.size();
  std::size_t first = 0;
  for (std::size_t c = 0; c < slow_.size(); ++c) {
    const ForceLaw& law = laws_[c];
    const Shown now = shown(c, at);
    const double N = law.N(now.gap), T = law.T(now.gap, now.ut);
    const auto allowed = [&](ContactSeries::Field field, double value, double factor) {
      return factor == 0.0 ? Oscillators::never
                           : share * known.range(c, field).width(value) / std::abs(factor);
    };
    const double normal =
        std::min({allowed(ContactSeries::gap, now.gap, 1.0), allowed(ContactSeries::N, N, law.N_gap),
                  allowed(ContactSeries::T, T, law.T_gap)});
    const double tangent =
        std::min(allowed(ContactSeries::slide, now.ut, 1.0), allowed(ContactSeries::T, T, law.T_ut));
    double normal_sum = 0.0, tangent_sum = 0.0;
    std::size_t k = n;
    for (; k > first; --k) {
      normal_sum += std::abs(state_->normal[c].real[k - 1]) * amplitude_[k - 1];
      tangent_sum += std::abs(state_->tangent[c].real[k - 1]) * amplitude_[k - 1];
      if (normal_sum > normal || tangent_sum > tangent) break;
    }
    first = std::max(first, k);
  }
  h_ = std::min(remaining, longest_decay / alpha_);
  if (n > 0 && oscillators_->real()[std::min(first, n - 1)] > 0.0)
    h_ = std::min(h_, turn / std::sqrt(oscillators_->real()[std::min(first, n - 1)]));
  for (const Complex l : oscillators_->pairs()) h_ = std::min(h_, turn / std::sqrt(size_of(l)));
  part_modes(first == n);
  expand(at);
  return h_;
}

/// taylor_of_mode for all slow real modes at once, term by term.
SIGNORINI_WIDE_LANES void ModalProof::expand_real(const ModalPoint& at) {
  const double* l = oscillators_->real().data();
  const double square = h_ * h_, *z = at.z.real.data(), *rate = at.rate.real.data();
  double* first = coefficients_.data();
  for (std::size_t k = 0; k < fast_; ++k) first[k] = z[k];
  double* second = first + fast_;
  for (std::size_t k = 0; k < fast_; ++k) second[k] = h_ * rate[k];
  const double* p = forces_->real.data();
  for (std::size_t j = 0; j + 2 < count_; ++j) {
    double* next = second + fast_;
    const double down = 1.0 / static_cast<double>(j + 2);
    const double pull = square * down / static_cast<double>(j + 1), drag = alpha_ * h_ * down;
    if (j == 0)
      for (std::size_t k = 0; k < fast_; ++k) next[k] = (p[k] - l[k] * first[k]) * pull - second[k] * drag;
    else
      for (std::size_t k = 0; k < fast_; ++k) next[k] = -(l[k] * first[k]) * pull - second[k] * drag;
    first = second;
    second = next;
  }
}

/// Coefficients of the slow modes in t / h, `count_` of each.
void ModalProof::expand_modes(const ModalPoint& at) {
  const std::vector<double>& l = oscillators_->real();
  const std::vector<Complex>& pairs = oscillators_->pairs();
  const double fastest = fast_ > 0 ? std::sqrt(std::abs(l[fast_ - 1])) * h_ : 0.0;
  const bool any_pair = std::any_of(pair_slow_.begin(), pair_slow_.end(), [](bool slow) { return slow; });
  const double reach = any_pair ? turn : std::max(fastest, 0.5 * alpha_ * h_);
  degree_ = std::min<std::size_t>(most_degree, 10 + static_cast<std::size_t>(5.5 * reach));
  count_ = degree_ + 3;
  coefficients_.resize(count_ * fast_);
  expand_real(at);
  pair_coefficients_.resize(count_ * pairs.size());
  for (std::size_t k = 0; k < pairs.size(); ++k)
    if (pair_slow_[k])
      taylor_of_mode(at.z.pair[k], at.rate.pair[k], forces_->pair[k], pairs[k], alpha_, h_, count_,
                     pairs.size(), pair_coefficients_.data() + k);
}

/// Sum of a row over the modes: a polynomial for slow ones, the static value for fast ones; returns a bound on the
/// remainder.
ModalProof::Size ModalProof::sum(const Amplitudes& row, double still, std::vector<double>& out) const {
  const std::vector<Complex>& pairs = oscillators_->pairs();
  out.assign(count_, 0.0);
  const auto slow = static_cast<Eigen::Index>(fast_), terms = static_cast<Eigen::Index>(count_);
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> of_modes(
      coefficients_.data(), terms, slow);
  const Eigen::Map<const Eigen::VectorXd> shown(row.real.data(), slow);
  Eigen::Map<Eigen::VectorXd>(out.data(), terms).noalias() = of_modes * shown;
  // each further term of a mode's series is at most half of the previous one
  const auto rest = static_cast<Eigen::Index>(count_ - degree_ - 1);
  double left = 2.0 * (of_modes.bottomRows(rest).cwiseAbs() * shown.cwiseAbs()).sum();
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (!pair_slow_[k]) {
      still += whole(row.pair[k] * forces_->pair[k] * inverse(pairs[k]));
      continue;
    }
    for (std::size_t j = 0; j < count_; ++j) {
      const Complex term = row.pair[k] * pair_coefficients_[j * pairs.size() + k];
      out[j] += whole(term);
      if (j > degree_) left += 4.0 * size_of(term);
    }
  }
  out[0] += still;
  return {left, left * static_cast<double>(degree_ + 3) / h_};
}

/// Gaps and slides of all contacts as polynomials in t / h, from slow modes and the static values of fast ones.
void ModalProof::expand(const ModalPoint& at) {
  expand_modes(at);
  const std::size_t contacts = model_.contacts.size();
  normal_rest_.resize(contacts);
  tangent_rest_.resize(contacts);
  std::vector<double> n, t;
  for (std::size_t c = 0; c < contacts; ++c) {
    normal_rest_[c] = sum(state_->normal[c], still_normal_[c][fast_], n);
    tangent_rest_[c] = sum(state_->tangent[c], still_tangent_[c][fast_], t);
    n[0] += model_.contacts[c].gap;
    t[0] -= surface_[c];
    ContactSeries& slow = slow_[c];
    slow.reset(degree_);
    const ForceLaw& law = laws_[c];
    for (std::size_t j = 0; j <= degree_; ++j) {
      const double rate = static_cast<double>(j + 1) / h_;
      slow.place(ContactSeries::gap)[j] = n[j];
      slow.place(ContactSeries::ut)[j] = slow.place(ContactSeries::slide)[j] = t[j];
      slow.place(ContactSeries::vn)[j] = rate * n[j + 1];
      slow.place(ContactSeries::vt)[j] = rate * t[j + 1];
      slow.place(ContactSeries::an)[j] = rate * n[j + 2] * static_cast<double>(j + 2) / h_;
      slow.place(ContactSeries::N)[j] = law.N_gap * n[j] + (j == 0 ? law.N_constant : 0.0);
      slow.place(ContactSeries::T)[j] = law.T_gap * n[j] + law.T_ut * t[j] + (j == 0 ? law.T_constant : 0.0);
    }
  }
}

}  // namespace signorini
