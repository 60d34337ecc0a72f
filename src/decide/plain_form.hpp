// plain_form.hpp: fast values of a form with at most six terms, as most forms are.
//
//   f = c + N N + T T + gap g + ut ut + vn g' + vt ut'        other terms of the form are zero
//
// The values agree with Form to the last bit, for finite motions: omitting zeros does not change a sum.
#pragma once

#include <cmath>

#include "signorini/form.hpp"

namespace signorini {

[[nodiscard]] inline bool is_plain(const Form& f) {
  return f.an == 0.0 && f.at == 0.0 && f.pressing == 0.0 && f.pressing_rate == 0.0 && f.limit == 0.0 &&
         f.limit_rate == 0.0;
}

/// The form must outlive it.
class QuickForm {
 public:
  explicit QuickForm(const Form& form) : f_(form), plain_(is_plain(form)) {}

  [[nodiscard]] double rate(const ContactMotion& m) const {
    return plain_ ? f_.N * m.N + f_.T * m.T + f_.gap * m.gap + f_.ut * m.ut + f_.vn * m.vn + f_.vt * m.vt
                  : f_.rate(m);
  }
  [[nodiscard]] double value(const ContactMotion& m) const { return f_.constant + rate(m); }
  [[nodiscard]] double magnitude(const ContactMotion& m) const {
    return plain_ ? std::abs(f_.N * m.N) + std::abs(f_.T * m.T) + std::abs(f_.gap * m.gap) +
                        std::abs(f_.ut * m.ut) + std::abs(f_.vn * m.vn) + std::abs(f_.vt * m.vt)
                  : f_.magnitude(m);
  }

 private:
  const Form& f_;
  bool plain_;
};

}  // namespace signorini
