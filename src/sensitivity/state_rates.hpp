// state_rates.hpp: derivatives of the modal equations of a contact state: matrices B and G of modal_tangents.hpp.
//
//   B = Y Phi^T ( K_p + contacts' ) Phi X - Y Phi^T M_p Phi X L,    G = Y Phi^T ( C_p - alpha M_p ) Phi X
//   contacts' = sum of n (N_gap,p n + N_gap n_p)^T + n_p N_gap n^T + ..., outer products of forms
//
// Column k of a product belongs to mode k: the mode shape is multiplied by the unconstrained matrix and projected on the
// modes.
#pragma once

#include <algorithm>
#include <type_traits>
#include <vector>

#include "engine/exact/modal/small_matrices.hpp"
#include "engine/exact/modal/spectrum.hpp"
#include "sensitivity/contact_rates.hpp"
#include "signorini/model.hpp"

namespace signorini::sensitivity {

// Lists of all modes of a state, and square matrices over these modes.
//
//   S = double: real modes only;   S = Complex: real modes, modes of pairs, and their conjugates

/// Flat amplitudes: real amplitudes, then real parts and imaginary parts of pairs.
inline Vector flat_modes(const modal::Amplitudes& a) {
  const auto n = static_cast<Eigen::Index>(a.real.size()), pairs = static_cast<Eigen::Index>(a.pair.size());
  Vector x(n + 2 * pairs);
  std::copy(a.real.begin(), a.real.end(), x.data());
  for (Eigen::Index k = 0; k < pairs; ++k) {
    x[n + k] = a.pair[static_cast<std::size_t>(k)].re;
    x[n + pairs + k] = a.pair[static_cast<std::size_t>(k)].im;
  }
  return x;
}

inline modal::Complex conjugate(modal::Complex a) { return {a.re, -a.im}; }

/// Converts a number to type T; for T = double the real part is taken.
template <class T>
T of_kind(double a) {
  return T(a);
}
template <class T>
T of_kind(modal::Complex a) {
  if constexpr (std::is_same_v<T, double>)
    return a.re;
  else
    return a;
}

/// Lists the values of all modes: real modes, modes of pairs, and for Complex also the conjugates of pairs.
inline void list_modes(const modal::Amplitudes& a, std::vector<double>& out) { out = a.real; }
inline void list_modes(const modal::Amplitudes& a, std::vector<modal::Complex>& out) {
  out.assign(a.real.begin(), a.real.end());
  out.insert(out.end(), a.pair.begin(), a.pair.end());
  for (const modal::Complex z : a.pair) out.push_back(conjugate(z));
}
template <class S>
std::vector<S> modes_of(const modal::Amplitudes& a) {
  std::vector<S> out;
  list_modes(a, out);
  return out;
}
inline void add_modes(const std::vector<double>& x, modal::Amplitudes& a) {
  for (std::size_t k = 0; k < a.real.size(); ++k) a.real[k] += x[k];
}
inline void add_modes(const std::vector<modal::Complex>& x, modal::Amplitudes& a) {
  for (std::size_t k = 0; k < a.real.size(); ++k) a.real[k] += x[k].re;
  for (std::size_t k = 0; k < a.pair.size(); ++k) a.pair[k] += x[a.real.size() + k];
}
template <class S>
using Square = std::vector<S>;  // N x N, row after row

/// out += factor a b^T, for out: n x n.
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

/// sum_l x_l y_l, computed as four independent sums.
template <class S>
S inner(const S* x, const S* y, std::size_t n) {
  S sum[4] = {S(0.0), S(0.0), S(0.0), S(0.0)};
  std::size_t l = 0;
  for (; l + 4 <= n; l += 4)
    for (std::size_t i = 0; i < 4; ++i) sum[i] += x[l + i] * y[l + i];
  for (; l < n; ++l) sum[0] += x[l] * y[l];
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/// out += factor b x, for b: n x n.
template <class S>
void add_product(const Square<S>& b, const std::vector<S>& x, double factor, std::vector<S>& out) {
  const std::size_t n = x.size();
  for (std::size_t k = 0; k < n; ++k) out[k] += inner(b.data() + k * n, x.data(), n) * factor;
}

/// Derivatives of the matrices with respect to one parameter, in unconstrained modes; empty if a matrix does not change.
struct UnconstrainedRates {
  Eigen::MatrixXd mass, damping, stiffness;  ///< damping: C_p - alpha M_p
};

/// B and G of one parameter in a contact state; they are the same for all stretches in this state.
template <class S>
struct ParameterModes {
  Square<S> b, g;  ///< g: empty if G is zero
};

/// The contact states at the beginning of a stretch, and their modes.
struct StateAt {
  const Model& model;
  const modal::ModalSystem& modes;
  const modal::StateModes& state;
  const contact::ContactStates& states;
  const motion::Forcing& forcing;
  double begin;
};

inline bool any_term(const Combination& c) {
  return std::any_of(c.terms.begin(), c.terms.end(), [](const auto& term) { return term.second != 0.0; });
}

template <class S>
class StateRates {
 public:
  /// All arguments must outlive the object. l: eigenvalues of the listed modes.
  StateRates(const StateAt& at, const std::vector<S>& l) : at_(at), spectrum_(at.state.spectrum), l_(l) {}

  /// Mode shapes at the given degrees of freedom. Rows: degrees of freedom; columns: flat amplitudes (flat_modes()).
  [[nodiscard]] modal::RowMatrix shown(const std::vector<Eigen::Index>& dofs) const {
    const std::size_t reals = spectrum_.real().size(), pairs = spectrum_.pairs().size();
    modal::RowMatrix out(static_cast<Eigen::Index>(dofs.size()),
                         static_cast<Eigen::Index>(reals + 2 * pairs));
    for (std::size_t k = 0; k < reals + 2 * pairs; ++k) {
      modal::Amplitudes unit = spectrum_.zero();
      if (k < reals)
        unit.real[k] = 1.0;
      else if (k < reals + pairs)
        unit.pair[k - reals] = modal::Complex(1.0);
      else
        unit.pair[k - reals - pairs] = modal::Complex(0.0, 1.0);
      const Vector q = to_unconstrained_modes(unit);
      for (std::size_t i = 0; i < dofs.size(); ++i)
        out(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
            at_.modes.basis().shapes().row(dofs[i]).dot(q);
    }
    return out;
  }

  [[nodiscard]] ParameterModes<S> parameter_modes(const UnconstrainedRates& open,
                                                  const std::vector<ContactRates>& contacts,
                                                  const TangentSource& source) const {
    ParameterModes<S> m;
    m.b.assign(l_.size() * l_.size(), S(0.0));
    add_matrices(open, m);
    add_contacts(contacts, source, m.b);
    return m;
  }

 private:
  [[nodiscard]] Vector to_unconstrained_modes(const modal::Amplitudes& a) const {
    Vector q;
    spectrum_.from_modes({&a}, {&q});
    return q;
  }

  /// Column k of X, which belongs to a mode or a conjugate: its real part and, for pairs, its imaginary part.
  [[nodiscard]] std::vector<Vector> shape(std::size_t k) const {
    const std::size_t reals = spectrum_.real().size(), pairs = spectrum_.pairs().size();
    modal::Amplitudes unit = spectrum_.zero();
    if (k < reals) {
      unit.real[k] = 1.0;
      return {to_unconstrained_modes(unit)};
    }
    const std::size_t j = k < reals + pairs ? k - reals : k - reals - pairs;
    unit.pair[j] = modal::Complex(0.5);
    const Vector real = to_unconstrained_modes(unit);
    unit.pair[j] = modal::Complex(0.0, k < reals + pairs ? -0.5 : 0.5);
    return {real, to_unconstrained_modes(unit)};
  }

  /// Column k of out += factor times the amplitudes of q (real part, and for pairs imaginary part).
  void add_column(const std::vector<Vector>& q, std::size_t k, S factor, Square<S>& out) const {
    modal::Amplitudes part;
    for (std::size_t imaginary = 0; imaginary < q.size(); ++imaginary) {
      spectrum_.to_modes(q[imaginary], part);
      const std::vector<S> x = modes_of<S>(part);
      const S turned = imaginary == 0 ? factor : quarter_turn(factor);
      for (std::size_t i = 0; i < x.size(); ++i) out[i * x.size() + k] += x[i] * turned;
    }
  }
  /// The number multiplied by i. Never called for double, because real modes have no imaginary part.
  static double quarter_turn(double) { return 0.0; }
  static modal::Complex quarter_turn(modal::Complex a) { return {-a.im, a.re}; }

  void add_matrices(const UnconstrainedRates& open, ParameterModes<S>& m) const {
    if (open.mass.size() + open.damping.size() + open.stiffness.size() == 0) return;
    if (open.damping.size() > 0) m.g.assign(m.b.size(), S(0.0));
    const auto product = [](const Eigen::MatrixXd& a, std::vector<Vector> q) {
      for (Vector& part : q) part = a * part;
      return q;
    };
    for (std::size_t k = 0; k < l_.size(); ++k) {
      const std::vector<Vector> x = shape(k);
      if (open.stiffness.size() > 0) add_column(product(open.stiffness, x), k, S(1.0), m.b);
      if (open.mass.size() > 0) add_column(product(open.mass, x), k, -l_[k], m.b);
      if (open.damping.size() > 0) add_column(product(open.damping, x), k, S(1.0), m.g);
    }
  }

  /// A linear form in modal coordinates. from: amplitudes that a unit force along the form excites; row: coefficients of the
  /// form in the modes.
  struct ModalForm {
    std::vector<S> from, row;
  };
  [[nodiscard]] ModalForm modal_form(const Combination& form) const {
    const Vector q = at_.modes.basis().amplitudes_of(form);
    modal::Amplitudes from, row;
    spectrum_.to_modes(q, from);
    spectrum_.of_form(q, row);
    return {modes_of<S>(from), modes_of<S>(row)};
  }

  void add_contacts(const std::vector<ContactRates>& contacts, const TangentSource& source,
                    Square<S>& b) const {
    const modal::StateModes& state = at_.state;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const ContactRates& rates = contacts[c];
      const LawRates at =
          law_rates(at_.model.contacts[c], c, at_.states[c], rates, at_.forcing, at_.begin, source);
      const ModalForm n{modes_of<S>(state.from_normal[c]), modes_of<S>(state.normal[c])};
      const ModalForm t{modes_of<S>(state.from_tangent[c]), modes_of<S>(state.tangent[c])};
      add_outer(n.from, n.row, at.rates.N_gap, b);
      add_outer(t.from, n.row, at.rates.T_gap, b);
      add_outer(t.from, t.row, at.rates.T_ut, b);
      if (any_term(rates.normal)) {
        const ModalForm by = modal_form(rates.normal);
        add_outer(n.from, by.row, at.law.N_gap, b);
        add_outer(t.from, by.row, at.law.T_gap, b);
        add_outer(by.from, n.row, at.law.N_gap, b);
      }
      if (any_term(rates.tangent)) {
        const ModalForm by = modal_form(rates.tangent);
        add_outer(t.from, by.row, at.law.T_ut, b);
        add_outer(by.from, n.row, at.law.T_gap, b);
        add_outer(by.from, t.row, at.law.T_ut, b);
      }
    }
  }

  const StateAt at_;
  const modal::Spectrum& spectrum_;
  const std::vector<S>& l_;
};

}  // namespace signorini::sensitivity
