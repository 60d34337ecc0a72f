// oscillator_pairs.hpp: response of one mode that is driven by the motion of another mode, also if their frequencies are
// close.
//
//   y_l'' + alpha y_l' + l y_l = p:   y_l(t) = z c(l) + r s(l) + p h(l)       z, r: y_l and y_l' at 0
//   w'' + alpha w' + k w = -y_l,  w(0) = w'(0) = 0:   w(t) = z C + r S + p H
//   C = c[k, l] = (c(k) - c(l)) / (k - l),   S and H with s and h
//
// c, s and h are entire functions of l, so C, S and H have no poles where k approaches l. With m = l - alpha^2/4 and the
// frequencies w_l = sqrt(m), C and S are products of sines of (w_k + w_l) t/2 and (w_k - w_l) t/2; if m t^2 is small for both
// modes, C and S are computed as series in m t^2. Rates follow from c' = -l s, s' = c - alpha s, h' = s with
// (l s)[k, l] = k S + s(l). Required: alpha t <= 4. S is double or Complex. Units follow from those of t and l.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "engine/exact/modal/complex_lanes.hpp"

namespace signorini::sensitivity {

template <class S>
class OscillatorPairs {
 public:
  /// Computes C and S for all pairs of the squared frequencies l, at time t.
  void fill(const std::vector<S>& l, double alpha, double t);

  [[nodiscard]] std::size_t size() const { return l_.size(); }
  [[nodiscard]] S c(std::size_t k) const { return c_[k]; }
  [[nodiscard]] S s(std::size_t k) const { return s_[k]; }
  [[nodiscard]] S h(std::size_t k) const { return h_[k]; }
  /// Row k of C (S_row(): of S): size() numbers; both matrices are symmetric.
  [[nodiscard]] const S* C_row(std::size_t k) const { return big_c_.data() + k * l_.size(); }
  [[nodiscard]] const S* S_row(std::size_t k) const { return big_s_.data() + k * l_.size(); }
  /// Column l of H: H[k, l] for all k.
  [[nodiscard]] const std::vector<S>& H_column(std::size_t l);

 private:
  struct Both {
    S c{}, s{};
  };
  [[nodiscard]] Both near_zero(std::size_t k, std::size_t l) const;
  [[nodiscard]] Both turning(std::size_t k, std::size_t l) const;
  [[nodiscard]] Both apart(std::size_t k, std::size_t l) const;
  [[nodiscard]] S h_of(std::size_t k) const;
  [[nodiscard]] S h_pair(std::size_t k, std::size_t l) const;
  void fill_turning(std::size_t k);

  double alpha_ = 0.0, t_ = 0.0, decay_ = 1.0;
  std::vector<S> l_, m_, w_, inverse_w_, sine_, cosine_, half_sine_, half_cosine_, c_, s_;
  std::vector<unsigned char> turns_, slow_;
  std::vector<S> big_c_, big_s_, h_;
  std::map<std::size_t, std::vector<S>> columns_;  // columns of H, computed on request
};

extern template class OscillatorPairs<double>;
extern template class OscillatorPairs<modal::Complex>;

}  // namespace signorini::sensitivity
