// modal_stretch.hpp: motion and tangents on one stretch (modal_tangents.hpp), computed in the modes of its contact state.
//
//   S = double: all modes are real;   S = Complex: some modes are conjugate pairs
#pragma once

#include <algorithm>

#include "base/rounding.hpp"
#include "sensitivity/modal_tangents.hpp"
#include "sensitivity/state_rates.hpp"

namespace signorini::sensitivity {

/// Largest alpha t that one step covers, as in engine/exact/modal/oscillators.hpp.
inline constexpr double max_part_decay = 4.0;
/// Largest ratio of a mode's constant part p/l to its amplitude. At this limit three digits are lost.
inline constexpr double max_static_ratio = 4096.0;

/// Interface of ModalStretchOf for both kinds of modes. at(), motion(): see ModalTangents.
class ModalStretch {
 public:
  virtual ~ModalStretch() = default;
  virtual MotionAndTangents at(double t, bool whole) = 0;
  [[nodiscard]] virtual MotionAndTangents motion(double t) const = 0;
};

template <class S>
class ModalStretchOf final : public ModalStretch {
 public:
  ModalStretchOf(const Model& model, const std::vector<const ModelDerivative*>& derivatives,
                 TangentCache& store, modal::ModalSystem& modes,
                 std::shared_ptr<const modal::StateModes> state, const decide::Decision& decision,
                 const motion::Forcing& forcing, std::vector<TangentSource> sources,
                 const std::vector<Eigen::Index>& shown, double usual)
      : model_(model),
        derivatives_(derivatives),
        store_(store),
        modes_(modes),
        state_(std::move(state)),
        spectrum_(state_->spectrum),
        states_(decision.states),
        forcing_(forcing),
        t_(decision.jet.t),
        begin_(decision.jet.t),
        sources_(std::move(sources)),
        oscillators_(spectrum_, modes.alpha()),
        shown_(shown),
        usual_(usual),
        work_(store.work(S(0.0))) {
    modal::Amplitudes values = spectrum_.zero();
    values.real = oscillators_.real();
    values.pair = oscillators_.pairs();
    list_modes(values, l_);
    rows_ = values.real.size() + values.pair.size();
    put(decision.u, decision.v, now_);
    set_forces();
    choose_static_part();
    known_ = &states();
    for (std::size_t p = 0; p < sources_.size(); ++p) {
      ModalTangent& f = followed_.emplace_back();
      if (sources_[p].start == nullptr) continue;
      put(sources_[p].start->u, sources_[p].start->v, f.now);
      f.modes = &known_->parameters[p];
      has_damping_rates_ = has_damping_rates_ || !f.modes->g.empty();
      set_constant(p, f);
    }
  }

  MotionAndTangents at(double t, bool whole) override {
    const double longest = max_part_decay / modes_.alpha();
    while (t - t_ > longest) advance(longest);
    if (t > t_) advance(t - t_);
    t_ = t;
    return at_end(whole);
  }

  MotionAndTangents motion(double t) const override {
    const double longest = max_part_decay / modes_.alpha();
    modal::ModalPoint at = now_, next;
    double from = t_;
    while (t > from) {
      const double time = std::min(t - from, longest);
      oscillators_.advance(at, force_, time, next);
      std::swap(at, next);
      from = time < longest ? t : from + time;
    }
    MotionAndTangents result;
    const modal::Amplitudes bend = oscillators_.accelerations(at, force_);
    show(at, &bend, result.motion);
    forces_at(result);
    return result;
  }

 private:
  /// The tangent of one parameter in modal coordinates.
  struct ModalTangent {
    modal::ModalPoint now, moved;  // at the beginning and at the end of a step
    modal::Amplitudes force;       // constant force
    const ParameterModes<S>* modes = nullptr;
  };

  void put(const Vector& u, const Vector& v, modal::ModalPoint& out) const {
    spectrum_.to_modes(modes_.basis().amplitudes(u), out.z);
    spectrum_.to_modes(modes_.basis().amplitudes(v), out.rate);
  }
  void set_forces() {
    force_ = modal::constant_forces(model_, *state_, states_, forcing_, begin_);
    p_ = modes_of<S>(force_);
    for (std::size_t c = 0; c < model_.contacts.size(); ++c)
      laws_.push_back(
          modal::force_law(model_.contacts[c], states_[c], forcing_.applied_normal_force(c, begin_, 0)));
  }

  /// Splits the constant part p/l from the motion of each mode, unless it is far larger than the motion (soft_).
  void choose_static_part() {
    const std::vector<S> z = modes_of<S>(now_.z);
    static_part_.assign(l_.size(), S(0.0));
    soft_.assign(l_.size(), S(0.0));
    for (std::size_t k = 0; k < l_.size(); ++k) {
      const double size = modal::size_of(p_[k]);
      if (size == 0.0) continue;
      if (size <= max_static_ratio * modal::size_of(l_[k]) * modal::size_of(z[k]))
        static_part_[k] = p_[k] * modal::inverse(l_[k]);
      else
        soft_[k] = p_[k];
    }
  }

  [[nodiscard]] StateStore<S>& states() {
    const std::vector<State> key = contact::states_of(states_);
    if (StateStore<S>* known = store_.find(key, S(0.0))) return *known;
    StateRates<S> of({model_, modes_, *state_, states_, forcing_, begin_}, l_);
    StateStore<S> made;
    made.shown = of.shown(shown_);
    for (std::size_t p = 0; p < sources_.size(); ++p) {
      ParameterModes<S>& m = made.parameters.emplace_back();
      if (sources_[p].start == nullptr) continue;
      m = of.parameter_modes(store_.open[p], derivatives_[p]->contacts, sources_[p]);
      store_.bytes += (m.b.size() + m.g.size()) * sizeof(S);
    }
    if (store_.bytes > max_state_bytes) {
      store_.real.clear();
      store_.pairs.clear();
      store_.bytes = 0;
    }
    store_.bytes += 2 * l_.size() * l_.size() * sizeof(S);  // memory of C and S for the usual step
    return store_.keep(key, std::move(made));
  }

  /// Sets the constant force of a tangent: the terms f of modal_tangents.hpp, which do not depend on the motion.
  void set_constant(std::size_t p, ModalTangent& f) const {
    const TangentSource& source = sources_[p];
    Vector q = Vector::Zero(model_.size());
    if (source.forcing.loaded) q += modes_.basis().shapes().transpose() * source.forcing.load.col(0);
    for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
      const Contact& contact = model_.contacts[c];
      const ContactRates& rates = derivatives_[p]->contacts[c];
      const LawRates at = law_rates(contact, c, states_[c], rates, forcing_, begin_, source);
      const double N = at.law.N(at.gap), T = at.law.T(at.gap, -at.surface);
      const double N_p = at.N_derivative(at.gap, at.gap_rate);
      const double T_p = at.T_derivative(at.gap, at.gap_rate, -at.surface, -at.surface_rate);
      if (N_p != 0.0) q -= N_p * modes_.basis().amplitudes_of(contact.normal);
      if (T_p != 0.0) q -= T_p * modes_.basis().amplitudes_of(contact.tangent);
      if (any_term(rates.normal)) q -= N * modes_.basis().amplitudes_of(rates.normal);
      if (any_term(rates.tangent)) q -= T * modes_.basis().amplitudes_of(rates.tangent);
    }
    if (const Eigen::MatrixXd& mass = store_.open[p].mass; mass.size() > 0) {
      Vector pulled;
      spectrum_.from_modes({&force_}, {&pulled});
      q -= mass * pulled;
    }
    spectrum_.to_modes(q, f.force);
    std::vector<S> standing(l_.size(), S(0.0));
    add_product(f.modes->b, static_part_, -1.0, standing);
    add_modes(standing, f.force);
  }

  void advance(double time) {
    const bool usual = std::abs(time - usual_) <= 4.0 * rounding::eps * (t_ + time);
    OscillatorPairs<S>& pairs = usual ? known_->usual : work_.pairs;
    if (!usual || pairs.size() == 0) pairs.fill(l_, modes_.alpha(), time);
    move(pairs);
    std::swap(now_, moved_);
    for (ModalTangent& f : followed_) std::swap(f.now, f.moved);
    t_ += time;
  }

  /// Computes for all pairs of modes y_l[k, l] (oscillator_pairs.hpp) of the motion without its constant part and of the rate
  /// of the motion, and the time derivatives of both.
  void fill_driven(OscillatorPairs<S>& pairs) {
    const std::size_t n = l_.size();
    std::vector<S> z = modes_of<S>(now_.z), r = modes_of<S>(now_.rate), a(n, S(0.0));
    const double alpha = modes_.alpha();
    for (std::size_t k = 0; k < n; ++k) {
      a[k] = p_[k] - r[k] * alpha - z[k] * l_[k];
      z[k] -= static_part_[k];
    }
    work_.driven.resize(n * n);
    work_.driven_rate.resize(n * n);
    const auto drive = [&](const std::vector<S>& place, const std::vector<S>& rate, Square<S>& y,
                           Square<S>& y_rate) {
      y.resize(n * n);
      y_rate.resize(n * n);
      std::vector<S> tail(n);
      for (std::size_t l = 0; l < n; ++l) tail[l] = pairs.s(l) * place[l];
      for (std::size_t k = 0; k < rows_; ++k) {
        const S *c = pairs.C_row(k), *s = pairs.S_row(k);
        S *out = y.data() + k * n, *out_rate = y_rate.data() + k * n;
        for (std::size_t l = 0; l < n; ++l) {
          out[l] = c[l] * place[l] + s[l] * rate[l];
          out_rate[l] = (c[l] - s[l] * alpha) * rate[l] - (l_[k] * s[l] * place[l] + tail[l]);
        }
      }
    };
    drive(z, r, work_.driven, work_.driven_rate);
    for (std::size_t l = 0; l < n; ++l) {
      if (modal::size_of(soft_[l]) == 0.0) continue;
      const std::vector<S>& h = pairs.H_column(l);
      for (std::size_t k = 0; k < rows_; ++k) {
        work_.driven[k * n + l] += h[k] * soft_[l];
        work_.driven_rate[k * n + l] += pairs.S_row(k)[l] * soft_[l];
      }
    }
    if (has_damping_rates_) drive(r, a, work_.dragging, work_.dragging_rate);
  }

  /// Advances every mode independently under a constant force, by the time of `pairs`.
  void turn(const modal::ModalPoint& from, const modal::Amplitudes& force, const OscillatorPairs<S>& pairs,
            modal::ModalPoint& to) const {
    const std::size_t reals = from.z.real.size(), count = from.z.pair.size();
    const double alpha = modes_.alpha();
    to.z.real.resize(reals);
    to.rate.real.resize(reals);
    to.z.pair.resize(count);
    to.rate.pair.resize(count);
    const auto one = [&](auto z, auto r, auto f, std::size_t k, auto& place, auto& rate) {
      place = of_kind<decltype(z)>(z * pairs.c(k) + r * pairs.s(k) + f * pairs.h(k));
      rate = of_kind<decltype(z)>(r * (pairs.c(k) - pairs.s(k) * alpha) - z * (l_[k] * pairs.s(k)) +
                                  f * pairs.s(k));
    };
    for (std::size_t k = 0; k < reals; ++k)
      one(from.z.real[k], from.rate.real[k], force.real[k], k, to.z.real[k], to.rate.real[k]);
    if constexpr (std::is_same_v<S, modal::Complex>)
      for (std::size_t k = 0; k < count; ++k)
        one(from.z.pair[k], from.rate.pair[k], force.pair[k], reals + k, to.z.pair[k], to.rate.pair[k]);
  }

  void move(OscillatorPairs<S>& pairs) {
    turn(now_, force_, pairs, moved_);
    fill_driven(pairs);
    const std::size_t n = l_.size();
    std::vector<S> add(n), add_rate(n);
    for (ModalTangent& f : followed_) {
      if (f.modes == nullptr) continue;
      turn(f.now, f.force, pairs, f.moved);
      const auto sum = [&](const Square<S>& b, const Square<S>& y, std::vector<S>& out) {
        for (std::size_t k = 0; k < rows_; ++k) out[k] = inner(b.data() + k * n, y.data() + k * n, n);
      };
      sum(f.modes->b, work_.driven, add);
      sum(f.modes->b, work_.driven_rate, add_rate);
      add_modes(add, f.moved.z);
      add_modes(add_rate, f.moved.rate);
      if (f.modes->g.empty()) continue;
      sum(f.modes->g, work_.dragging, add);
      sum(f.modes->g, work_.dragging_rate, add_rate);
      add_modes(add, f.moved.z);
      add_modes(add_rate, f.moved.rate);
    }
  }

  void physical(const modal::ModalPoint& at, const modal::Amplitudes* second, SeriesPoint& out) const {
    Vector q, rate, change;
    std::vector<const modal::Amplitudes*> from{&at.z, &at.rate};
    std::vector<Vector*> to{&q, &rate}, in{&out.u, &out.v};
    std::vector<const Vector*> modal{&q, &rate};
    if (second != nullptr) {
      from.push_back(second);
      to.push_back(&change);
      modal.push_back(&change);
      in.push_back(&out.a);
    } else {
      out.a = Vector::Zero(model_.size());
    }
    spectrum_.from_modes(from, to);
    modes_.basis().motions(modal, in);
  }

  /// Values of the displayed degrees of freedom; all others are zero.
  void show(const modal::ModalPoint& at, const modal::Amplitudes* second, SeriesPoint& out) const {
    const auto one = [&](const modal::Amplitudes& from, Vector& to) {
      const Vector values = known_->shown * flat_modes(from);
      to = Vector::Zero(model_.size());
      for (std::size_t i = 0; i < shown_.size(); ++i) to[shown_[i]] = values[static_cast<Eigen::Index>(i)];
    };
    one(at.z, out.u);
    one(at.rate, out.v);
    if (second != nullptr)
      one(*second, out.a);
    else
      out.a = Vector::Zero(model_.size());
  }

  [[nodiscard]] modal::Amplitudes second_of_tangent(const ModalTangent& f) const {
    modal::Amplitudes a = oscillators_.accelerations(f.now, f.force);
    std::vector<S> z = modes_of<S>(now_.z), drive(z.size(), S(0.0));
    for (std::size_t k = 0; k < z.size(); ++k) z[k] -= static_part_[k];
    add_product(f.modes->b, z, -1.0, drive);
    if (!f.modes->g.empty()) add_product(f.modes->g, modes_of<S>(now_.rate), -1.0, drive);
    add_modes(drive, a);
    return a;
  }

  [[nodiscard]] MotionAndTangents at_end(bool whole) const {
    MotionAndTangents result;
    const modal::Amplitudes bend = oscillators_.accelerations(now_, force_);
    whole ? physical(now_, &bend, result.motion) : show(now_, &bend, result.motion);
    forces_at(result);
    for (std::size_t p = 0; p < followed_.size(); ++p) {
      const ModalTangent& f = followed_[p];
      SeriesPoint& w = result.tangents.emplace_back();
      if (f.modes == nullptr) continue;
      if (whole) {
        const modal::Amplitudes a = second_of_tangent(f);
        physical(f.now, &a, w);
      } else {
        show(f.now, nullptr, w);
      }
      force_rates_at(p, result.motion, w);
    }
    return result;
  }

  void forces_at(MotionAndTangents& at) const {
    SeriesPoint& m = at.motion;
    const auto rows = model_.force_count();
    m.forces.resize(rows);
    m.force_rates.resize(rows);
    at.force_bends.resize(rows);
    for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
      const Contact& contact = model_.contacts[c];
      const modal::ForceLaw& law = laws_[c];
      const auto n = static_cast<Eigen::Index>(model_.layout.normal(c)),
                 t = static_cast<Eigen::Index>(model_.layout.tangent(c));
      const double ut = contact.tangent.dot(m.u) - forcing_.surface(c, begin_, 0);
      m.forces[n] = law.N(contact.gap_at(m.u));
      m.forces[t] = law.T(contact.gap_at(m.u), ut);
      for (const auto& [of, out] : {std::pair{&m.v, &m.force_rates}, std::pair{&m.a, &at.force_bends}}) {
        const double normal = contact.normal.dot(*of), tangent = contact.tangent.dot(*of);
        (*out)[n] = law.N_rate(normal);
        (*out)[t] = law.T_rate(normal, tangent);
      }
    }
  }

  void force_rates_at(std::size_t p, const SeriesPoint& m, SeriesPoint& w) const {
    w.forces.resize(m.forces.size());
    w.force_rates.resize(m.forces.size());
    for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
      const Contact& contact = model_.contacts[c];
      const ContactRates& rates = derivatives_[p]->contacts[c];
      const LawRates at = law_rates(contact, c, states_[c], rates, forcing_, begin_, sources_[p]);
      const auto n = static_cast<Eigen::Index>(model_.layout.normal(c)),
                 t = static_cast<Eigen::Index>(model_.layout.tangent(c));
      const double gap = contact.gap_at(m.u), ut = contact.tangent.dot(m.u) - at.surface;
      const double gap_p = contact.normal.dot(w.u) + rates.normal.dot(m.u) + at.gap_rate;
      const double ut_p = contact.tangent.dot(w.u) + rates.tangent.dot(m.u) - at.surface_rate;
      w.forces[n] = at.N_derivative(gap, gap_p);
      w.forces[t] = at.T_derivative(gap, gap_p, ut, ut_p);
      const double vn = contact.normal.dot(m.v), vt = contact.tangent.dot(m.v);
      const double vn_p = contact.normal.dot(w.v) + rates.normal.dot(m.v);
      const double vt_p = contact.tangent.dot(w.v) + rates.tangent.dot(m.v);
      w.force_rates[n] = at.N_rate_derivative(vn, vn_p);
      w.force_rates[t] = at.T_rate_derivative(vn, vn_p, vt, vt_p);
    }
  }

  const Model& model_;
  const std::vector<const ModelDerivative*>& derivatives_;
  TangentCache& store_;
  modal::ModalSystem& modes_;
  std::shared_ptr<const modal::StateModes> state_;
  const modal::Spectrum& spectrum_;
  const contact::ContactStates states_;
  const motion::Forcing forcing_;
  double t_, begin_;
  std::vector<TangentSource> sources_;
  modal::Oscillators oscillators_;
  // Eigenvalue and constant force of each mode; p/l, if it is split off, else 0; p, if p/l is not split off, else 0.
  std::vector<S> l_, p_, static_part_, soft_;
  std::size_t rows_;  // number of modes, with one mode for each conjugate pair
  std::vector<modal::ForceLaw> laws_;
  modal::Amplitudes force_;
  modal::ModalPoint now_, moved_;
  std::vector<ModalTangent> followed_;
  bool has_damping_rates_ = false;
  const std::vector<Eigen::Index>& shown_;
  double usual_;                    // most frequent step length, for which data are stored
  StateStore<S>* known_ = nullptr;  // stored data of the contact state
  StepWorkspace<S>& work_;
};

}  // namespace signorini::sensitivity
