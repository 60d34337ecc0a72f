// form.hpp: a linear form on the motion of one contact.
//
//   value = c + a_N N + a_T T + a_g g + a_ut ut + a_vn g' + a_vt ut' + a_an g'' + a_at ut''
//             + a_q q + a_q' q'                          q = normal_force(t)
//
// Residual rows (value = 0) and guards (value > 0) are such forms; so all that an engine needs of a
// contact law is data, and their time derivatives follow from the derivatives of the motion.
#pragma once

#include <cmath>

#include "signorini/contact.hpp"

namespace signorini {

struct Form {
  double N = 0.0, T = 0.0, gap = 0.0, ut = 0.0, vn = 0.0, vt = 0.0, an = 0.0, at = 0.0;
  double pressing = 0.0, pressing_rate = 0.0;
  double constant = 0.0;

  /// Value of the form without its constant: what a derivative of the motion contributes.
  [[nodiscard]] double rate(const ContactMotion& m) const {
    return N * m.N + T * m.T + gap * m.gap + ut * m.ut + vn * m.vn + vt * m.vt + an * m.an + at * m.at +
           pressing * m.pressing + pressing_rate * m.pressing_rate;
  }
  [[nodiscard]] double value(const ContactMotion& m) const { return constant + rate(m); }
  /// Sum of the magnitudes of the terms, given magnitudes in m.
  [[nodiscard]] double magnitude(const ContactMotion& m) const {
    return std::abs(N * m.N) + std::abs(T * m.T) + std::abs(gap * m.gap) + std::abs(ut * m.ut) +
           std::abs(vn * m.vn) + std::abs(vt * m.vt) + std::abs(an * m.an) + std::abs(at * m.at) +
           std::abs(pressing * m.pressing) + std::abs(pressing_rate * m.pressing_rate);
  }
  [[nodiscard]] bool operator==(const Form&) const = default;
  [[nodiscard]] Form operator-() const {
    return {-N, -T, -gap, -ut, -vn, -vt, -an, -at, -pressing, -pressing_rate, -constant};
  }
};

}  // namespace signorini
