#include "engine/exact/modal/modal_works.hpp"

#include <algorithm>
#include <cmath>

#include "contact/law.hpp"
#include "engine/exact/modal/mode_pairs.hpp"

namespace signorini::modal {
namespace {

// Modal velocity, relative to the greatest one, below which the works of a mode are only rounding.
constexpr double least_velocity = 1e-9;
// Limits of omega^2 t_end^2. Below zero_frequency_bound, a frequency is regarded as zero. Below least_frequency, works are inaccurate.
constexpr double zero_frequency_bound = 1e-12, least_frequency = 1e-3;

template <class S>
using Ends = ModalWorkIntegrals::Ends<S>;

template <class S>
struct Integrals {
  S rates{}, mixed{};  // int y_k' y_l', int y_k y_l'
  S changed{};         // [y_k y_l]: difference of y_k y_l between end and beginning
};

/// Computes the integrals `rates` and `mixed`, each as a [y_k y_l] + b [y_k' y_l'] + c1 [y_k y_l'] + c2 [y_k' y_l].
template <class S>
Integrals<S> integrals(const Ends<S>& k, const Ends<S>& l, double alpha) {
  const S yy = k.y1 * l.y1 - k.y0 * l.y0, rr = k.r1 * l.r1 - k.r0 * l.r0;
  const S yr = k.y1 * l.r1 - k.y0 * l.r0, ry = k.r1 * l.y1 - k.r0 * l.y0;
  Integrals<S> result;
  result.changed = yy;
  if (!(size_of(k.l) + size_of(l.l) > 0.0)) {  // both frequencies are zero: y = -y'/alpha
    result.rates = rr * (-0.5 / alpha);
    result.mixed = rr * (0.5 / (alpha * alpha));
    return result;
  }
  const S difference = l.l - k.l, sum = k.l + l.l;
  const S e = inverse(difference * difference + sum * (2.0 * alpha * alpha));
  // int y_k' y_l': m = -difference e, b = -alpha sum e, a = l_k b + alpha c1, c1 = l_k m, c2 = -l_l m
  const S m = -(difference * e), b = sum * e * (-alpha);
  result.rates = (k.l * b + k.l * m * alpha) * yy + b * rr + k.l * m * yr - l.l * m * ry;
  // int y_k y_l': m2 = -2 alpha e, b2 = difference e, a = l_l b2 - alpha l_l m2, c1 = l_k m2, c2 = -l_l m2
  const S m2 = e * (-2.0 * alpha), b2 = difference * e;
  result.mixed = (l.l * b2 - l.l * m2 * alpha) * yy + b2 * rr + k.l * m2 * yr - l.l * m2 * ry;
  return result;
}

Ends<Complex> complex(const Ends<double>& a) { return {a.l, a.y0, a.r0, a.y1, a.r1}; }

/// Sum over all modes of the mode's entry in `row` times a quantity of the mode: real(k) for real modes, pair(k) for pairs.
template <class Real, class Pair>
double sum_over(const Amplitudes& row, const Real& real, const Pair& pair) {
  double sum = 0.0;
  for (std::size_t k = 0; k < row.real.size(); ++k) sum += row.real[k] * real(k);
  for (std::size_t k = 0; k < row.pair.size(); ++k) sum += real_contribution(row.pair[k] * pair(k));
  return sum;
}

}  // namespace

bool ModalWorkIntegrals::is_accurate_for(const Spectrum& spectrum, double t_end) {
  const double square = t_end * t_end;
  const auto bad = [&](double l) {
    return std::abs(l) * square > zero_frequency_bound && l * square < least_frequency;
  };
  return std::none_of(spectrum.real().begin(), spectrum.real().end(), bad) &&
         std::none_of(spectrum.pairs().begin(), spectrum.pairs().end(),
                      [&](Complex l) { return size_of(l) * square < least_frequency; });
}

void ModalWorkIntegrals::start(const engine::Segment& segment, const StateModes& state,
                               const Oscillators& oscillators, const Amplitudes& forces, double t_end) {
  decision_ = segment.decision;
  state_ = &state;
  oscillators_ = &oscillators;
  forces_ = &forces;
  zero_frequency_limit_ = zero_frequency_bound / (t_end * t_end);
  loads_.clear();
  for (std::size_t i = 0; i < model_.loads.size(); ++i) {
    const double t = decision_->jet.t, f = model_.loads[i].history.piece(t).value(t);
    if (f != 0.0) loads_.emplace_back(i, f);
  }
  slipping_.clear();
  for (std::size_t c = 0; c < decision_->states.size(); ++c)
    if (slip_sign(decision_->states[c].state) != 0) slipping_.push_back(c);
}

ModalWorkIntegrals::Stretch ModalWorkIntegrals::stretch(const ModalPoint& from, const ModalPoint& to,
                                                        double time) const {
  Stretch s{from, to, time, {}, {}, {}, {}};
  const std::vector<double>& l = oscillators_->real();
  for (std::size_t k = 0; k < l.size(); ++k) {
    const double p = forces_->real[k];
    if (std::abs(l[k]) < zero_frequency_limit_) {
      const double d = p / alpha_, r0 = from.rate.real[k] - d, r1 = to.rate.real[k] - d;
      s.drift.push_back(d);
      s.real.push_back({0.0, -r0 / alpha_, r0, -r1 / alpha_, r1});
    } else {
      const double still = p / l[k];
      s.drift.push_back(0.0);
      s.real.push_back(
          {l[k], from.z.real[k] - still, from.rate.real[k], to.z.real[k] - still, to.rate.real[k]});
    }
  }
  const std::vector<Complex>& pairs = oscillators_->pairs();
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const Complex still = forces_->pair[k] * inverse(pairs[k]);
    s.pair.push_back(
        {pairs[k], from.z.pair[k] - still, from.rate.pair[k], to.z.pair[k] - still, to.rate.pair[k]});
  }
  oscillators_->integrate(from, to, *forces_, time, s.area);
  return s;
}

/// Part of x_k^T x_l int z_k' z_l' that is due to the drifts d_k and d_l. product: x_k^T x_l of the mode shapes.
double ModalWorkIntegrals::with_drifts(const Stretch& s, std::size_t k, std::size_t l, double product) const {
  const auto change = [&](std::size_t i) { return s.real[i].y1 - s.real[i].y0; };
  return product * (s.drift[k] * s.drift[l] * s.time + s.drift[k] * change(l) + s.drift[l] * change(k));
}

std::vector<std::size_t> ModalWorkIntegrals::moving(const Stretch& s) const {
  std::vector<double> velocity;
  for (std::size_t k = 0; k < s.real.size(); ++k) {
    const Ends<double>& y = s.real[k];
    velocity.push_back(std::max({std::abs(y.r0), std::abs(y.r1), std::sqrt(std::abs(y.l)) * std::abs(y.y0),
                                 std::sqrt(std::abs(y.l)) * std::abs(y.y1), std::abs(s.drift[k])}));
  }
  std::vector<std::size_t> result;
  if (velocity.empty()) return result;
  const double least = least_velocity * *std::max_element(velocity.begin(), velocity.end());
  for (std::size_t k = 0; k < velocity.size(); ++k)
    if (velocity[k] > least) result.push_back(k);
  return result;
}

/// Adds the contribution of a pair of modes, at least one of which has zero frequency.
void ModalWorkIntegrals::add_two(const Stretch& s, std::size_t k, std::size_t l, Sums& sums) const {
  const Integrals<double> both = integrals(s.real[k], s.real[l], alpha_);
  const double x = state_->spectrum.product(k, l);
  sums.rates += 2.0 * x * both.rates + 2.0 * with_drifts(s, k, l, x);
  for (const std::size_t c : slipping_)  // int y_l y_k' = [y_k y_l] - int y_k y_l'
    sums.crossed[c] += state_->normal[c].real[k] * state_->tangent[c].real[l] * both.mixed +
                       state_->normal[c].real[l] * state_->tangent[c].real[k] * (both.changed - both.mixed);
}

/// Ends of all modes up to the last mode in `oscillating`, as arrays. Modes that are not in `oscillating` have zero entries.
ModalWorkIntegrals::EndArrays ModalWorkIntegrals::end_arrays(
    const Stretch& s, const std::vector<std::size_t>& oscillating) const {
  const Eigen::Index n = oscillating.empty() ? 0 : static_cast<Eigen::Index>(oscillating.back()) + 1;
  EndArrays arrays;
  arrays.l = Eigen::Map<const Eigen::ArrayXd>(oscillators_->real().data(), n);
  for (Eigen::ArrayXd* array : {&arrays.y0, &arrays.r0, &arrays.y1, &arrays.r1}) array->setZero(n);
  for (const std::size_t k : oscillating) {
    const auto i = static_cast<Eigen::Index>(k);
    const Ends<double>& y = s.real[k];
    arrays.y0[i] = y.y0;
    arrays.r0[i] = y.r0;
    arrays.y1[i] = y.y1;
    arrays.r1[i] = y.r1;
  }
  return arrays;
}

/// Adds the contributions of all pairs of oscillating modes.
void ModalWorkIntegrals::add_oscillating(const EndArrays& arrays, Sums& sums) const {
  const ModePairs& pairs = state_->pairs;
  const Eigen::Index n = arrays.l.size();
  const ModeEnds ends{arrays.l.data(), arrays.y0.data(), arrays.r0.data(), arrays.y1.data(),
                      arrays.r1.data()};
  Eigen::ArrayXd own(pairs.available() ? 0 : n), yy(n), mixed(n);
  for (Eigen::Index k = 1; k < n; ++k) {
    if (arrays.y0[k] == 0.0 && arrays.y1[k] == 0.0 && arrays.r0[k] == 0.0 && arrays.r1[k] == 0.0) continue;
    if (!pairs.available()) pairs_of_mode(state_->spectrum, alpha_, k, own.data());
    const double* shared = pairs.available() ? pairs.row(k) : own.data();
    sums.rates -= 2.0 * pair_integrals(ends, alpha_, k, shared, yy.data(), mixed.data());
    for (const std::size_t c : slipping_)
      sums.crossed[c] += cross_integral(state_->normal[c].real.data(), state_->tangent[c].real.data(), k,
                                        yy.data(), mixed.data());
  }
}

void ModalWorkIntegrals::add_real(const Stretch& s, const std::vector<std::size_t>& moving,
                                  Sums& sums) const {
  const Spectrum& spectrum = state_->spectrum;
  std::vector<std::size_t> oscillating, resting;
  for (const std::size_t k : moving) {
    const Ends<double>& y = s.real[k];
    (y.l == 0.0 ? resting : oscillating).push_back(k);
    sums.rates += spectrum.norm_squared(k) * integrals(y, y, alpha_).rates +
                  with_drifts(s, k, k, spectrum.norm_squared(k));
    for (const std::size_t c : slipping_)
      sums.crossed[c] +=
          state_->normal[c].real[k] * state_->tangent[c].real[k] * 0.5 * (y.y1 * y.y1 - y.y0 * y.y0);
  }
  for (std::size_t i = 0; i < resting.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) add_two(s, resting[i], resting[j], sums);
    for (const std::size_t k : oscillating) add_two(s, k, resting[i], sums);
  }
  add_oscillating(end_arrays(s, oscillating), sums);
}

/// Adds the contributions of complex modes: products with real modes, with complex modes and with conjugates of complex modes.
void ModalWorkIntegrals::add_pairs(const Stretch& s, const std::vector<std::size_t>& moving,
                                   Sums& sums) const {
  const Spectrum& spectrum = state_->spectrum;
  const std::size_t rank = spectrum.rank();
  const VectorProducts& own = spectrum.products();
  for (std::size_t i = 0; i < s.pair.size(); ++i) {
    const auto product = [&](const auto* c, const auto* h, Complex l) {
      Complex sum;
      for (std::size_t a = 0; a < rank; ++a)
        sum += own.h_pair[i * rank + a] * c[a] - own.c_pair[i * rank + a] * h[a];
      return sum * inverse(s.pair[i].l - l);
    };
    for (const std::size_t k : moving) {
      const Integrals<Complex> both = integrals(s.pair[i], complex(s.real[k]), alpha_);
      const Complex x = product(own.c.data() + k * rank, own.h.data() + k * rank, oscillators_->real()[k]);
      sums.rates += 2.0 * real_contribution(x * (both.rates + (s.pair[i].y1 - s.pair[i].y0) * s.drift[k]));
      for (const std::size_t c : slipping_)
        sums.crossed[c] +=
            real_contribution(state_->normal[c].pair[i] * both.mixed) * state_->tangent[c].real[k] +
            real_contribution(state_->tangent[c].pair[i] * (both.changed - both.mixed)) *
                state_->normal[c].real[k];
    }
    for (std::size_t j = 0; j < s.pair.size(); ++j)
      for (const bool conjugate : {false, true}) {
        const auto turned = [&](Complex a) { return conjugate ? Complex(a.re, -a.im) : a; };
        const Ends<Complex>& y = s.pair[j];
        const Integrals<Complex> both = integrals(
            s.pair[i], {turned(y.l), turned(y.y0), turned(y.r0), turned(y.y1), turned(y.r1)}, alpha_);
        Complex x = spectrum.pair_norm_squared(i);
        if (i != j || conjugate) {
          std::vector<Complex> c(rank), h(rank);
          for (std::size_t a = 0; a < rank; ++a) {
            c[a] = turned(own.c_pair[j * rank + a]);
            h[a] = turned(own.h_pair[j * rank + a]);
          }
          x = product(c.data(), h.data(), turned(y.l));
        }
        sums.rates += real_contribution(x * both.rates);
        for (const std::size_t c : slipping_)
          sums.crossed[c] +=
              real_contribution(state_->normal[c].pair[i] * turned(state_->tangent[c].pair[j]) * both.mixed);
      }
  }
}

double ModalWorkIntegrals::gap_integral(const Stretch& s, std::size_t c) const {
  return model_.contacts[c].gap * s.time + sum_over(
                                               state_->normal[c],
                                               [&](std::size_t k) { return s.area.real[k]; },
                                               [&](std::size_t k) { return s.area.pair[k]; });
}

/// Integral int g ut', with g = g_a + g_d t + sum a y and ut' = v_d + sum b y'. gap: g at the beginning; crossed: Sums::crossed
double ModalWorkIntegrals::gap_times_slide(const Stretch& s, std::size_t c, double gap,
                                           double crossed) const {
  const Amplitudes &a = state_->normal[c], &b = state_->tangent[c];
  const auto drift = [&](std::size_t k) { return s.drift[k]; };
  const auto none = [](std::size_t) { return Complex(); };
  const double g_drift = sum_over(a, drift, none), v_drift = sum_over(b, drift, none);
  const auto at_begin = [&](const Amplitudes& row) {
    return sum_over(
        row, [&](std::size_t k) { return s.real[k].y0; }, [&](std::size_t k) { return s.pair[k].y0; });
  };
  const double end = sum_over(
      b, [&](std::size_t k) { return s.real[k].y1; }, [&](std::size_t k) { return s.pair[k].y1; });
  // int y = -[y' + alpha y]/l, or -[y]/alpha for zero frequency
  const double area = sum_over(
      b,
      [&](std::size_t k) {
        const Ends<double>& y = s.real[k];
        return y.l == 0.0 ? -(y.y1 - y.y0) / alpha_ : -(y.r1 - y.r0 + alpha_ * (y.y1 - y.y0)) / y.l;
      },
      [&](std::size_t k) {
        const Ends<Complex>& y = s.pair[k];
        return -((y.r1 - y.r0 + (y.y1 - y.y0) * alpha_) * inverse(y.l));
      });
  return v_drift * gap_integral(s, c) + (gap - at_begin(a)) * (end - at_begin(b)) +
         g_drift * (s.time * end - area) + crossed;
}

void ModalWorkIntegrals::add(const ModalProof& proof, const ModalPoint& from, const ModalPoint& to,
                             double time, motion::WorkIntegrals& works) const {
  if (!(time > 0.0)) return;
  const Stretch s = stretch(from, to, time);
  for (const auto& [load, factor] : loads_)
    works.loads +=
        factor * sum_over(
                     state_->load[load], [&](std::size_t k) { return to.z.real[k] - from.z.real[k]; },
                     [&](std::size_t k) { return to.z.pair[k] - from.z.pair[k]; });
  Sums sums;
  sums.crossed.assign(model_.contacts.size(), 0.0);
  if (slipping_.empty()) {
    for (std::size_t k = 0; k < s.real.size(); ++k)
      sums.rates += integrals(s.real[k], s.real[k], alpha_).rates + with_drifts(s, k, k, 1.0);
  } else {
    const std::vector<std::size_t> modes = moving(s);
    add_real(s, modes, sums);
    add_pairs(s, modes, sums);
  }
  works.damping += alpha_ * sums.rates;
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    const ContactState& state = decision_->states[c];
    if (state.is_open()) continue;
    const Contact& contact = model_.contacts[c];
    const ForceLaw law = proof.law(c);
    if (!contact.normal_force_given())
      works.applied_normal_force[c] -= law.N_gap * gap_integral(s, c) + law.N_constant * time;
    const int direction = slip_sign(state.state);
    if (direction == 0) continue;
    const ModalKinematics begin = proof.kinematics(c, from), end = proof.kinematics(c, to);
    const Form rate = contact::slip_rate(contact, direction);
    const double slide = end.ut - begin.ut, rise = end.gap - begin.gap;
    works.friction[c] += law.T_constant * (rate.vt * slide + rate.vn * rise) +
                         law.T_gap * (rate.vt * gap_times_slide(s, c, begin.gap, sums.crossed[c]) +
                                      rate.vn * 0.5 * rise * (end.gap + begin.gap));
  }
}

}  // namespace signorini::modal
