#include "sensitivity/modal_tangents.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "base/rounding.hpp"
#include "contact/law.hpp"
#include "sensitivity/oscillator_pairs.hpp"

namespace signorini {
namespace {

constexpr double longest_decay = 4.0;  // alpha t of a part: as engine/exact/modal/oscillators.hpp asks
constexpr double most_still =
    4096.0;  // of a mode's place, its p/l that is taken out of the motion: three digits
constexpr double nothing_left = 1e-13;                   // of C_p, what is the rounding of C_p - alpha M_p
constexpr std::size_t most_kept = std::size_t{1} << 28;  // bytes of states

/// Forces of one contact in its state, and what a parameter makes of them at fixed motion.
struct LawRates {
  ForceLaw law;                      // N = N_gap g + N_constant, ...
  ForceLaw rates;                    // of its numbers
  double gap = 0.0, gap_rate = 0.0;  // g0 and g0_p
  double surface = 0.0, surface_rate = 0.0;
};

LawRates law_rates(const Contact& contact, std::size_t c, const ContactState& state,
                   const ContactRates& rates, const Forcing& forcing, double t, const TangentSource& source) {
  LawRates result;
  const double pressing = forcing.pressing(c, t, 0);
  result.law = force_law(contact, state, pressing);
  const Rows row = rows(contact, state);
  const Rows& by = rates.rows[index_of(state.state)];
  const std::size_t place = c * source.forcing.count;
  ForceLaw& d = result.rates;
  d.N_gap = -by.normal.gap;
  d.N_constant = -(by.normal.pressing * pressing + row.normal.pressing * source.forcing.pressing[place] +
                   by.normal.constant);
  d.T_gap = -(by.tangent.N * result.law.N_gap + row.tangent.N * d.N_gap);
  d.T_ut = -by.tangent.ut;
  d.T_constant = -(by.tangent.N * result.law.N_constant + row.tangent.N * d.N_constant + by.tangent.constant);
  if (state.state == State::stick && contact.tangential_stiffness)
    d.T_constant -=
        rates.tangential_stiffness * state.anchor + *contact.tangential_stiffness * source.start->anchors[c];
  result.gap = contact.gap;
  result.gap_rate = rates.gap;
  result.surface = forcing.surface(c, t, 0);
  result.surface_rate = source.forcing.surface[place];
  return result;
}

bool any_term(const Combination& c) {
  return std::any_of(c.terms.begin(), c.terms.end(), [](const auto& term) { return term.second != 0.0; });
}

bool stands_still(const ForcingRatesSeries& f) {
  const auto still = [&](const std::vector<double>& rows) {
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (i % f.count != 0 && rows[i] != 0.0) return false;
    return true;
  };
  return (!f.loaded || f.load.rightCols(f.load.cols() - 1).isZero(0.0)) && still(f.pressing) &&
         still(f.surface);
}

/// Degrees of freedom that columns and contacts show; all where they are amplitudes of shapes.
std::vector<Eigen::Index> shown_dofs(const Model& model, const std::vector<const ModelDerivative*>& rates) {
  std::set<Eigen::Index> dofs;
  const auto add = [&](const Combination& form) {
    for (const auto& term : form.terms) dofs.insert(term.first);
  };
  for (const Contact& contact : model.contacts)
    for (const Combination* form : {&contact.normal, &contact.tangent, &contact.body_tangent()}) add(*form);
  for (const ModelDerivative* d : rates)
    for (const ContactRates& c : d->contacts)
      for (const Combination* form : {&c.normal, &c.tangent, &c.body_tangent}) add(*form);
  for (const Column& column : model.columns)
    if (column.dof >= 0) dofs.insert(column.dof);
  if (model.reduction || model.basis)
    for (Eigen::Index i = 0; i < model.size(); ++i) dofs.insert(i);
  return {dofs.begin(), dofs.end()};
}

/// Real amplitudes, then real and imaginary parts of pairs.
Vector flat(const Amplitudes& a) {
  const auto n = static_cast<Eigen::Index>(a.real.size()), pairs = static_cast<Eigen::Index>(a.pair.size());
  Vector x(n + 2 * pairs);
  std::copy(a.real.begin(), a.real.end(), x.data());
  for (Eigen::Index k = 0; k < pairs; ++k) {
    x[n + k] = a.pair[static_cast<std::size_t>(k)].re;
    x[n + pairs + k] = a.pair[static_cast<std::size_t>(k)].im;
  }
  return x;
}

Complex conjugate(Complex a) { return {a.re, -a.im}; }

/// A number as the kind that it is known to be.
template <class T>
T part(double a) {
  return T(a);
}
template <class T>
T part(Complex a) {
  if constexpr (std::is_same_v<T, double>)
    return a.re;
  else
    return a;
}

/// All modes one after the other: real ones, pairs, and their conjugates.
void list(const Amplitudes& a, std::vector<double>& out) { out = a.real; }
void list(const Amplitudes& a, std::vector<Complex>& out) {
  out.assign(a.real.begin(), a.real.end());
  out.insert(out.end(), a.pair.begin(), a.pair.end());
  for (const Complex z : a.pair) out.push_back(conjugate(z));
}
template <class S>
std::vector<S> listed(const Amplitudes& a) {
  std::vector<S> out;
  list(a, out);
  return out;
}
void add_listed(const std::vector<double>& x, Amplitudes& a) {
  for (std::size_t k = 0; k < a.real.size(); ++k) a.real[k] += x[k];
}
void add_listed(const std::vector<Complex>& x, Amplitudes& a) {
  for (std::size_t k = 0; k < a.real.size(); ++k) a.real[k] += x[k].re;
  for (std::size_t k = 0; k < a.pair.size(); ++k) a.pair[k] += x[a.real.size() + k];
}
Amplitudes zero_like(const Spectrum& spectrum) {
  return {std::vector<double>(spectrum.real().size(), 0.0), std::vector<Complex>(spectrum.pairs().size())};
}

template <class S>
using Square = std::vector<S>;  // rows of N numbers

template <class S>
void add_outer(const std::vector<S>& a, const std::vector<S>& b, double factor, Square<S>& out) {
  if (factor == 0.0) return;
  const std::size_t n = a.size();
  for (std::size_t k = 0; k < n; ++k) {
    const S x = a[k] * factor;
    S* row = out.data() + k * n;
    for (std::size_t l = 0; l < n; ++l) row[l] += x * b[l];
  }
}

template <class S>
void add_product(const Square<S>& b, const std::vector<S>& x, double factor, std::vector<S>& out) {
  const std::size_t n = x.size();
  for (std::size_t k = 0; k < n; ++k) {
    const S* row = b.data() + k * n;
    S sum(0.0);
    for (std::size_t l = 0; l < n; ++l) sum += row[l] * x[l];
    out[k] += sum * factor;
  }
}

}  // namespace

/// What a parameter does to a state that does not depend on the stretch: B and G.
template <class S>
struct ParameterModes {
  Square<S> b, g;  // g: empty where it is zero
};

template <class S>
struct StateStore {
  std::vector<ParameterModes<S>> parameters;
  RowMatrix shown;           // of amplitudes in a row (flat): the degrees of freedom that are shown
  OscillatorPairs<S> usual;  // of the usual time; empty: not asked for yet
};

/// Room for the numbers of one step.
template <class S>
struct Workshop {
  OscillatorPairs<S> pairs;
  Square<S> driven, driven_rate, dragging, dragging_rate;
};

struct ModalTangents::Store {
  /// Of one parameter in open modes; empty: none.
  struct Open {
    Eigen::MatrixXd mass, drag, stiffness;  // drag: C_p - alpha M_p
  };
  std::vector<Open> open;
  std::map<std::vector<State>, StateStore<double>> real;
  std::map<std::vector<State>, StateStore<Complex>> pairs;
  std::size_t bytes = 0;
  Workshop<double> real_work;
  Workshop<Complex> pair_work;
  Workshop<double>& work(double) { return real_work; }
  Workshop<Complex>& work(Complex) { return pair_work; }

  StateStore<double>* find(const std::vector<State>& states, double) {
    const auto at = real.find(states);
    return at == real.end() ? nullptr : &at->second;
  }
  StateStore<Complex>* find(const std::vector<State>& states, Complex) {
    const auto at = pairs.find(states);
    return at == pairs.end() ? nullptr : &at->second;
  }
  StateStore<double>& keep(const std::vector<State>& states, StateStore<double> made) {
    return real.insert_or_assign(states, std::move(made)).first->second;
  }
  StateStore<Complex>& keep(const std::vector<State>& states, StateStore<Complex> made) {
    return pairs.insert_or_assign(states, std::move(made)).first->second;
  }
};

class ModalTangents::Stretch {
 public:
  virtual ~Stretch() = default;
  virtual TangentsAt at(double t, bool whole) = 0;
  [[nodiscard]] virtual TangentsAt motion(double t) const = 0;
};

template <class S>
class ModalTangents::StretchOf final : public ModalTangents::Stretch {
 public:
  StretchOf(const Model& model, const std::vector<const ModelDerivative*>& derivatives, Store& store,
            ModalSystem& modes, std::shared_ptr<const StateModes> state, const Decision& decision,
            const Forcing& forcing, std::vector<TangentSource> sources,
            const std::vector<Eigen::Index>& shown, double usual)
      : model_(model),
        derivatives_(derivatives),
        store_(store),
        modes_(modes),
        state_(std::move(state)),
        spectrum_(state_->spectrum),
        mode_(decision.mode),
        forcing_(forcing),
        t_(decision.jet.t),
        begin_(decision.jet.t),
        sources_(std::move(sources)),
        oscillators_(spectrum_, modes.alpha()),
        shown_(shown),
        usual_(usual),
        work_(store.work(S(0.0))) {
    Amplitudes values = zero_like(spectrum_);
    values.real = oscillators_.real();
    values.pair = oscillators_.pairs();
    list(values, l_);
    put(decision.u, decision.v, now_);
    set_forces();
    choose_still();
    known_ = &states();
    for (std::size_t p = 0; p < sources_.size(); ++p) {
      Followed& f = followed_.emplace_back();
      if (sources_[p].start == nullptr) continue;
      put(sources_[p].start->u, sources_[p].start->v, f.now);
      f.modes = &known_->parameters[p];
      dragged_ = dragged_ || !f.modes->g.empty();
      set_constant(p, f);
    }
  }

  TangentsAt at(double t, bool whole) override {
    const double longest = longest_decay / modes_.alpha();
    while (t - t_ > longest) advance(longest);
    if (t > t_) advance(t - t_);
    t_ = t;
    return told(whole);
  }

  TangentsAt motion(double t) const override {
    const double longest = longest_decay / modes_.alpha();
    ModalPoint at = now_, next;
    double from = t_;
    while (t > from) {
      const double time = std::min(t - from, longest);
      oscillators_.advance(at, force_, time, next);
      std::swap(at, next);
      from = time < longest ? t : from + time;
    }
    TangentsAt result;
    const Amplitudes bend = second(at, force_);
    show(at, &bend, result.motion);
    tell_forces(result);
    return result;
  }

 private:
  struct Followed {
    ModalPoint now, moved;
    Amplitudes force;  // constant
    const ParameterModes<S>* modes = nullptr;
  };

  void put(const Vector& u, const Vector& v, ModalPoint& out) const {
    spectrum_.to_modes(modes_.amplitudes(u), out.z);
    spectrum_.to_modes(modes_.amplitudes(v), out.rate);
  }
  /// Phi^T x
  [[nodiscard]] Vector shown(const Combination& form) const {
    Vector q = Vector::Zero(model_.size());
    for (const auto& [dof, factor] : form.terms) q += factor * modes_.shapes().row(dof).transpose();
    return q;
  }

  void set_forces() {
    force_ = zero_like(spectrum_);
    std::vector<S> sum(l_.size(), S(0.0));
    const auto add = [&](const Amplitudes& from, double factor) {
      const std::vector<S> x = listed<S>(from);
      for (std::size_t k = 0; k < x.size(); ++k) sum[k] += x[k] * factor;
    };
    for (std::size_t i = 0; i < model_.loads.size(); ++i)
      add(state_->from_load[i], model_.loads[i].history.piece(begin_).value(begin_));
    for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
      const Contact& contact = model_.contacts[c];
      const ForceLaw law = force_law(contact, mode_[c], forcing_.pressing(c, begin_, 0));
      laws_.push_back(law);
      const double gap = contact.gap, surface = forcing_.surface(c, begin_, 0);
      add(state_->from_normal[c], -(law.N_constant + law.N_gap * gap));
      add(state_->from_tangent[c], -(law.T_constant + law.T_gap * gap - law.T_ut * surface));
    }
    add_listed(sum, force_);
    p_ = listed<S>(force_);
  }

  /// p/l of a mode is a part of its motion that stands still, unless it is far away.
  void choose_still() {
    const std::vector<S> z = listed<S>(now_.z);
    still_.assign(l_.size(), S(0.0));
    soft_.assign(l_.size(), S(0.0));
    for (std::size_t k = 0; k < l_.size(); ++k) {
      const double size = size_of(p_[k]);
      if (size == 0.0) continue;
      if (size <= most_still * size_of(l_[k]) * size_of(z[k]))
        still_[k] = p_[k] * inverse(l_[k]);
      else
        soft_[k] = p_[k];
    }
  }

  [[nodiscard]] StateStore<S>& states() {
    const std::vector<State> key = states_of(mode_);
    if (StateStore<S>* known = store_.find(key, S(0.0))) return *known;
    StateStore<S> made;
    add_shown(made.shown);
    const std::size_t n = l_.size();
    for (std::size_t p = 0; p < sources_.size(); ++p) {
      ParameterModes<S>& m = made.parameters.emplace_back();
      if (sources_[p].start == nullptr) continue;
      m.b.assign(n * n, S(0.0));
      add_matrices(p, m);
      add_contacts(p, m.b);
      store_.bytes += (m.b.size() + m.g.size()) * sizeof(S);
    }
    if (store_.bytes > most_kept) {
      store_.real.clear();
      store_.pairs.clear();
      store_.bytes = 0;
    }
    store_.bytes += 2 * n * n * sizeof(S);  // of the usual time
    return store_.keep(key, std::move(made));
  }

  /// Column k of X: of a mode, or the conjugate one.
  [[nodiscard]] std::vector<Vector> shape(std::size_t k) const {
    const std::size_t reals = spectrum_.real().size(), pairs = spectrum_.pairs().size();
    Amplitudes unit = zero_like(spectrum_);
    Vector q;
    if (k < reals) {
      unit.real[k] = 1.0;
      spectrum_.from_modes({&unit}, {&q});
      return {q};
    }
    const std::size_t j = k < reals + pairs ? k - reals : k - reals - pairs;
    unit.pair[j] = Complex(0.5);
    spectrum_.from_modes({&unit}, {&q});
    unit.pair[j] = Complex(0.0, k < reals + pairs ? -0.5 : 0.5);
    Vector imaginary;
    spectrum_.from_modes({&unit}, {&imaginary});
    return {q, imaginary};
  }
  void add_shown(RowMatrix& out) const {
    const auto reals = static_cast<Eigen::Index>(spectrum_.real().size());
    const auto pairs = static_cast<Eigen::Index>(spectrum_.pairs().size());
    out.resize(static_cast<Eigen::Index>(shown_.size()), reals + 2 * pairs);
    for (Eigen::Index k = 0; k < reals + 2 * pairs; ++k) {
      Amplitudes unit = zero_like(spectrum_);
      if (k < reals)
        unit.real[static_cast<std::size_t>(k)] = 1.0;
      else if (k < reals + pairs)
        unit.pair[static_cast<std::size_t>(k - reals)] = Complex(1.0);
      else
        unit.pair[static_cast<std::size_t>(k - reals - pairs)] = Complex(0.0, 1.0);
      Vector q;
      spectrum_.from_modes({&unit}, {&q});
      for (std::size_t i = 0; i < shown_.size(); ++i)
        out(static_cast<Eigen::Index>(i), k) = modes_.shapes().row(shown_[i]).dot(q);
    }
  }
  void add_column(const std::vector<Vector>& q, std::size_t k, S factor, Square<S>& out) const {
    const std::size_t n = l_.size();
    Amplitudes part;
    spectrum_.to_modes(q[0], part);
    std::vector<S> x = listed<S>(part);
    for (std::size_t i = 0; i < n; ++i) out[i * n + k] += x[i] * factor;
    if (q.size() < 2) return;
    spectrum_.to_modes(q[1], part);
    x = listed<S>(part);
    add_imaginary(x, k, factor, out);
  }
  void add_imaginary(const std::vector<double>&, std::size_t, double, Square<double>&) const {}
  void add_imaginary(const std::vector<Complex>& x, std::size_t k, Complex factor,
                     Square<Complex>& out) const {
    const Complex turned = factor * Complex(0.0, 1.0);
    for (std::size_t i = 0; i < x.size(); ++i) out[i * x.size() + k] += x[i] * turned;
  }

  void add_matrices(std::size_t p, ParameterModes<S>& m) {
    const Store::Open& open = store_.open[p];
    if (open.mass.size() + open.drag.size() + open.stiffness.size() == 0) return;
    if (open.drag.size() > 0) m.g.assign(m.b.size(), S(0.0));
    const auto product = [](const Eigen::MatrixXd& a, std::vector<Vector> q) {
      for (Vector& part : q) part = a * part;
      return q;
    };
    for (std::size_t k = 0; k < l_.size(); ++k) {
      const std::vector<Vector> x = shape(k);
      if (open.stiffness.size() > 0) add_column(product(open.stiffness, x), k, S(1.0), m.b);
      if (open.mass.size() > 0) add_column(product(open.mass, x), k, -l_[k], m.b);
      if (open.drag.size() > 0) add_column(product(open.drag, x), k, S(1.0), m.g);
    }
  }

  /// A form's modes: what forces along it do, and what modes show of it.
  struct Seen {
    std::vector<S> from, row;
  };
  [[nodiscard]] Seen seen(const Combination& form) const {
    const Vector q = shown(form);
    Amplitudes from, row;
    spectrum_.to_modes(q, from);
    spectrum_.of_form(q, row);
    return {listed<S>(from), listed<S>(row)};
  }

  void add_contacts(std::size_t p, Square<S>& b) const {
    for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
      const ContactRates& rates = derivatives_[p]->contacts[c];
      const LawRates at = law_rates(model_.contacts[c], c, mode_[c], rates, forcing_, begin_, sources_[p]);
      const Seen n{listed<S>(state_->from_normal[c]), listed<S>(state_->normal[c])};
      const Seen t{listed<S>(state_->from_tangent[c]), listed<S>(state_->tangent[c])};
      add_outer(n.from, n.row, at.rates.N_gap, b);
      add_outer(t.from, n.row, at.rates.T_gap, b);
      add_outer(t.from, t.row, at.rates.T_ut, b);
      if (any_term(rates.normal)) {
        const Seen by = seen(rates.normal);
        add_outer(n.from, by.row, at.law.N_gap, b);
        add_outer(t.from, by.row, at.law.T_gap, b);
        add_outer(by.from, n.row, at.law.N_gap, b);
      }
      if (any_term(rates.tangent)) {
        const Seen by = seen(rates.tangent);
        add_outer(t.from, by.row, at.law.T_ut, b);
        add_outer(by.from, n.row, at.law.T_gap, b);
        add_outer(by.from, t.row, at.law.T_ut, b);
      }
    }
  }

  /// f: what does not depend on the motion.
  void set_constant(std::size_t p, Followed& f) const {
    const TangentSource& source = sources_[p];
    Vector q = Vector::Zero(model_.size());
    if (source.forcing.loaded) q += modes_.shapes().transpose() * source.forcing.load.col(0);
    for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
      const Contact& contact = model_.contacts[c];
      const ContactRates& rates = derivatives_[p]->contacts[c];
      const LawRates at = law_rates(contact, c, mode_[c], rates, forcing_, begin_, source);
      const ForceLaw &law = at.law, &by = at.rates;
      const double N = law.N_gap * at.gap + law.N_constant;
      const double T = law.T_gap * at.gap - law.T_ut * at.surface + law.T_constant;
      const double N_p = by.N_gap * at.gap + law.N_gap * at.gap_rate + by.N_constant;
      const double T_p = by.T_gap * at.gap + law.T_gap * at.gap_rate - by.T_ut * at.surface -
                         law.T_ut * at.surface_rate + by.T_constant;
      if (N_p != 0.0) q -= N_p * shown(contact.normal);
      if (T_p != 0.0) q -= T_p * shown(contact.tangent);
      if (any_term(rates.normal)) q -= N * shown(rates.normal);
      if (any_term(rates.tangent)) q -= T * shown(rates.tangent);
    }
    if (const Eigen::MatrixXd& mass = store_.open[p].mass; mass.size() > 0) {
      Vector pulled;
      spectrum_.from_modes({&force_}, {&pulled});
      q -= mass * pulled;
    }
    spectrum_.to_modes(q, f.force);
    std::vector<S> standing(l_.size(), S(0.0));
    add_product(f.modes->b, still_, -1.0, standing);
    add_listed(standing, f.force);
  }

  void advance(double time) {
    const bool usual = std::abs(time - usual_) <= 4.0 * rounding::eps * (t_ + time);
    OscillatorPairs<S>& pairs = usual ? known_->usual : work_.pairs;
    if (!usual || pairs.size() == 0) pairs.fill(l_, modes_.alpha(), time);
    move(pairs);
    std::swap(now_, moved_);
    for (Followed& f : followed_) std::swap(f.now, f.moved);
    t_ += time;
  }

  /// y_l[k, l] of the motion without what stands still, and the same of its rate; with their own rates.
  void fill_driven(OscillatorPairs<S>& pairs) {
    const std::size_t n = l_.size();
    std::vector<S> z = listed<S>(now_.z), r = listed<S>(now_.rate), a(n, S(0.0));
    const double alpha = modes_.alpha();
    for (std::size_t k = 0; k < n; ++k) {
      a[k] = p_[k] - r[k] * alpha - z[k] * l_[k];
      z[k] -= still_[k];
    }
    work_.driven.resize(n * n);
    work_.driven_rate.resize(n * n);
    const auto drive = [&](const std::vector<S>& place, const std::vector<S>& rate, Square<S>& y,
                           Square<S>& y_rate) {
      y.resize(n * n);
      y_rate.resize(n * n);
      std::vector<S> tail(n);
      for (std::size_t l = 0; l < n; ++l) tail[l] = pairs.s(l) * place[l];
      for (std::size_t k = 0; k < n; ++k) {
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
      if (size_of(soft_[l]) == 0.0) continue;
      const std::vector<S>& h = pairs.H_column(l);
      for (std::size_t k = 0; k < n; ++k) {
        work_.driven[k * n + l] += h[k] * soft_[l];
        work_.driven_rate[k * n + l] += pairs.S_row(k)[l] * soft_[l];
      }
    }
    if (dragged_) drive(r, a, work_.dragging, work_.dragging_rate);
  }

  /// Of one point, without what drives it besides constant forces.
  void turn(const ModalPoint& from, const Amplitudes& force, const OscillatorPairs<S>& pairs,
            ModalPoint& to) const {
    const std::size_t reals = from.z.real.size(), count = from.z.pair.size();
    const double alpha = modes_.alpha();
    to.z.real.resize(reals);
    to.rate.real.resize(reals);
    to.z.pair.resize(count);
    to.rate.pair.resize(count);
    const auto one = [&](auto z, auto r, auto f, std::size_t k, auto& place, auto& rate) {
      place = part<decltype(z)>(z * pairs.c(k) + r * pairs.s(k) + f * pairs.h(k));
      rate = part<decltype(z)>(r * (pairs.c(k) - pairs.s(k) * alpha) - z * (l_[k] * pairs.s(k)) +
                               f * pairs.s(k));
    };
    for (std::size_t k = 0; k < reals; ++k)
      one(from.z.real[k], from.rate.real[k], force.real[k], k, to.z.real[k], to.rate.real[k]);
    if constexpr (std::is_same_v<S, Complex>)
      for (std::size_t k = 0; k < count; ++k)
        one(from.z.pair[k], from.rate.pair[k], force.pair[k], reals + k, to.z.pair[k], to.rate.pair[k]);
  }

  void move(OscillatorPairs<S>& pairs) {
    turn(now_, force_, pairs, moved_);
    fill_driven(pairs);
    const std::size_t n = l_.size();
    std::vector<S> add(n), add_rate(n);
    for (Followed& f : followed_) {
      if (f.modes == nullptr) continue;
      turn(f.now, f.force, pairs, f.moved);
      const auto sum = [&](const Square<S>& b, const Square<S>& y, std::vector<S>& out) {
        for (std::size_t k = 0; k < n; ++k) {
          const S *x = b.data() + k * n, *w = y.data() + k * n;
          S total(0.0);
          for (std::size_t l = 0; l < n; ++l) total += x[l] * w[l];
          out[k] = total;
        }
      };
      sum(f.modes->b, work_.driven, add);
      sum(f.modes->b, work_.driven_rate, add_rate);
      add_listed(add, f.moved.z);
      add_listed(add_rate, f.moved.rate);
      if (f.modes->g.empty()) continue;
      sum(f.modes->g, work_.dragging, add);
      sum(f.modes->g, work_.dragging_rate, add_rate);
      add_listed(add, f.moved.z);
      add_listed(add_rate, f.moved.rate);
    }
  }

  /// p - alpha z' - l z
  [[nodiscard]] Amplitudes second(const ModalPoint& at, const Amplitudes& force) const {
    Amplitudes a = force;
    const double alpha = modes_.alpha();
    for (std::size_t k = 0; k < a.real.size(); ++k)
      a.real[k] -= alpha * at.rate.real[k] + oscillators_.real()[k] * at.z.real[k];
    for (std::size_t k = 0; k < a.pair.size(); ++k)
      a.pair[k] -= at.rate.pair[k] * alpha + oscillators_.pairs()[k] * at.z.pair[k];
    return a;
  }

  void physical(const ModalPoint& at, const Amplitudes* second, SeriesPoint& out) const {
    Vector q, rate, change;
    std::vector<const Amplitudes*> from{&at.z, &at.rate};
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
    modes_.motions(modal, in);
  }

  /// Of the degrees of freedom that are shown.
  void show(const ModalPoint& at, const Amplitudes* second, SeriesPoint& out) const {
    const auto one = [&](const Amplitudes& from, Vector& to) {
      const Vector values = known_->shown * flat(from);
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

  [[nodiscard]] Amplitudes second_of_tangent(const Followed& f) const {
    Amplitudes a = second(f.now, f.force);
    std::vector<S> z = listed<S>(now_.z), drive(z.size(), S(0.0));
    for (std::size_t k = 0; k < z.size(); ++k) z[k] -= still_[k];
    add_product(f.modes->b, z, -1.0, drive);
    if (!f.modes->g.empty()) add_product(f.modes->g, listed<S>(now_.rate), -1.0, drive);
    add_listed(drive, a);
    return a;
  }

  [[nodiscard]] TangentsAt told(bool whole) const {
    TangentsAt result;
    const Amplitudes bend = second(now_, force_);
    whole ? physical(now_, &bend, result.motion) : show(now_, &bend, result.motion);
    tell_forces(result);
    for (std::size_t p = 0; p < followed_.size(); ++p) {
      const Followed& f = followed_[p];
      SeriesPoint& w = result.tangents.emplace_back();
      if (f.modes == nullptr) continue;
      if (whole) {
        const Amplitudes a = second_of_tangent(f);
        physical(f.now, &a, w);
      } else {
        show(f.now, nullptr, w);
      }
      tell_force_rates(p, result.motion, w);
    }
    return result;
  }

  void tell_forces(TangentsAt& at) const {
    SeriesPoint& m = at.motion;
    const auto rows = static_cast<Eigen::Index>(2 * model_.contacts.size());
    m.forces.resize(rows);
    m.force_rates.resize(rows);
    at.force_bends.resize(rows);
    for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
      const Contact& contact = model_.contacts[c];
      const ForceLaw& law = laws_[c];
      const auto n = static_cast<Eigen::Index>(normal_slot(c));
      const double ut = contact.tangent.dot(m.u) - forcing_.surface(c, begin_, 0);
      m.forces[n] = law.N_gap * contact.gap_at(m.u) + law.N_constant;
      m.forces[n + 1] = law.T_gap * contact.gap_at(m.u) + law.T_ut * ut + law.T_constant;
      for (const auto& [of, out] : {std::pair{&m.v, &m.force_rates}, std::pair{&m.a, &at.force_bends}}) {
        const double normal = contact.normal.dot(*of), tangent = contact.tangent.dot(*of);
        (*out)[n] = law.N_gap * normal;
        (*out)[n + 1] = law.T_gap * normal + law.T_ut * tangent;
      }
    }
  }

  void tell_force_rates(std::size_t p, const SeriesPoint& m, SeriesPoint& w) const {
    w.forces.resize(m.forces.size());
    w.force_rates.resize(m.forces.size());
    for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
      const Contact& contact = model_.contacts[c];
      const ContactRates& rates = derivatives_[p]->contacts[c];
      const LawRates at = law_rates(contact, c, mode_[c], rates, forcing_, begin_, sources_[p]);
      const ForceLaw &law = at.law, &by = at.rates;
      const auto n = static_cast<Eigen::Index>(normal_slot(c));
      const double gap = contact.gap_at(m.u), ut = contact.tangent.dot(m.u) - at.surface;
      const double gap_p = contact.normal.dot(w.u) + rates.normal.dot(m.u) + at.gap_rate;
      const double ut_p = contact.tangent.dot(w.u) + rates.tangent.dot(m.u) - at.surface_rate;
      w.forces[n] = law.N_gap * gap_p + by.N_gap * gap + by.N_constant;
      w.forces[n + 1] = law.T_gap * gap_p + by.T_gap * gap + law.T_ut * ut_p + by.T_ut * ut + by.T_constant;
      const double vn = contact.normal.dot(m.v), vt = contact.tangent.dot(m.v);
      const double vn_p = contact.normal.dot(w.v) + rates.normal.dot(m.v);
      const double vt_p = contact.tangent.dot(w.v) + rates.tangent.dot(m.v);
      w.force_rates[n] = law.N_gap * vn_p + by.N_gap * vn;
      w.force_rates[n + 1] = law.T_gap * vn_p + by.T_gap * vn + law.T_ut * vt_p + by.T_ut * vt;
    }
  }

  const Model& model_;
  const std::vector<const ModelDerivative*>& derivatives_;
  Store& store_;
  ModalSystem& modes_;
  std::shared_ptr<const StateModes> state_;
  const Spectrum& spectrum_;
  const Mode mode_;
  const Forcing forcing_;
  double t_, begin_;
  std::vector<TangentSource> sources_;
  Oscillators oscillators_;
  std::vector<S> l_, p_, still_, soft_;
  std::vector<ForceLaw> laws_;
  Amplitudes force_;
  ModalPoint now_, moved_;
  std::vector<Followed> followed_;
  bool dragged_ = false;
  const std::vector<Eigen::Index>& shown_;
  double usual_;
  StateStore<S>* known_ = nullptr;
  Workshop<S>& work_;
};

ModalTangents::ModalTangents(const Model& model, const std::vector<const ModelDerivative*>& derivatives,
                             double usual)
    : model_(model), derivatives_(derivatives), shown_(shown_dofs(model, derivatives)), usual_(usual) {}
ModalTangents::~ModalTangents() = default;

bool ModalTangents::start(ModalSystem& modes, const Decision& decision, const Forcing& forcing,
                          std::vector<TangentSource> sources) {
  stretch_.reset();
  if (!modes.failure().empty() || forcing.varies()) return false;
  for (const TangentSource& source : sources)
    if (source.start != nullptr && !stands_still(source.forcing)) return false;
  std::shared_ptr<const StateModes> state = modes.state(decision.mode);
  if (!state->spectrum.failure().empty()) return false;
  if (!store_) {
    store_ = std::make_unique<Store>();
    for (const ModelDerivative* d : derivatives_) {
      Store::Open& open = store_->open.emplace_back();
      const auto in_modes = [&](const SparseMatrix& a) {
        return Eigen::MatrixXd(modes.shapes().transpose() * (a * modes.shapes()));
      };
      if (d->stiffness.nonZeros() > 0) open.stiffness = in_modes(d->stiffness);
      if (d->mass.nonZeros() > 0) open.mass = in_modes(d->mass);
      const SparseMatrix drag = d->damping - modes.alpha() * d->mass;
      if (drag.norm() > nothing_left * (d->damping.norm() + modes.alpha() * d->mass.norm()))
        open.drag = in_modes(drag);
    }
  }
  if (state->spectrum.pairs().empty())
    stretch_ = std::make_unique<StretchOf<double>>(model_, derivatives_, *store_, modes, std::move(state),
                                                   decision, forcing, std::move(sources), shown_, usual_);
  else
    stretch_ = std::make_unique<StretchOf<Complex>>(model_, derivatives_, *store_, modes, std::move(state),
                                                    decision, forcing, std::move(sources), shown_, usual_);
  return true;
}

TangentsAt ModalTangents::at(double t, bool whole) { return stretch_->at(t, whole); }
TangentsAt ModalTangents::motion(double t) const { return stretch_->motion(t); }

}  // namespace signorini
