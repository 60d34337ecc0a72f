// guard_form.hpp: guards of a contact, as functions of its motion.
//
//   G = f + sum of a b                                       f, a, b: forms (form.hpp)
//   G^(k) = f^(k) + sum_j C(k, j) a^(j) b^(k-j)              k-th time derivative
//   |a b - p q| <= |p| db + (|q| + db) da                    |a - p| <= da, |b - q| <= db
//
// A guard is positive while its state is valid; its first zero is an event. Guards continue smoothly beyond their zero, so a
// root finder may evaluate them slightly after the event. Engines and decisions evaluate guards only with the functions of
// GuardForm. motion[k] is the k-th time derivative of the motion; noise[k] contains the magnitudes below which entries of
// motion[k] are treated as zero.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

#include "signorini/form.hpp"

namespace signorini {

/// Guards, named after the change of state at the zero of the guard. closing: g of an open contact; opening: -g in state
/// inside; separation: -N; slip_plus, slip_minus: distance of T from the friction limit in the direction + or -;
/// friction_limit: distance of T from the friction limit in the direction of T; sliding: the slip rate; user_1 to user_3: the
/// guards of a law with its own states; none: an unused entry.
enum class Guard : unsigned char {
  none,
  closing,
  opening,
  separation,
  slip_plus,
  slip_minus,
  friction_limit,
  sliding,
  user_1,
  user_2,
  user_3
};

/// Motion of one contact just after an instant: motion[k] is the k-th time derivative. noise[k]: for each entry of motion[k],
/// the error caused by one rounding of the data.
struct MotionJet {
  static constexpr std::size_t orders = 5;  ///< the motion and its first four derivatives
  std::array<ContactMotion, orders> motion, noise;
};

struct GuardForm {
  Guard kind = Guard::none;
  Form form;
  /// Products a b; nullptr: the guard has no products and is linear.
  std::shared_ptr<const std::vector<FormProduct>> products = nullptr;

  [[nodiscard]] bool is_linear() const { return products == nullptr; }
  [[nodiscard]] double value(const ContactMotion& m) const {
    return is_linear() ? form.value(m) : form.value(m) + derivative_of_products(&m, 0);
  }
  /// Time derivative G^(k).
  [[nodiscard]] double derivative(const ContactMotion* motion, std::size_t k) const {
    const double d = k == 0 ? form.value(motion[0]) : form.rate(motion[k]);
    return is_linear() ? d : d + derivative_of_products(motion, k);
  }
  /// Derivative of G at the motion m, if the motion changes at the rates `by`. by: time derivative, derivative with respect to
  /// a parameter, or a small change of the motion.
  [[nodiscard]] double rate(const ContactMotion& m, const ContactMotion& by) const {
    return is_linear() ? form.rate(by) : form.rate(by) + rate_of_products(m, by);
  }
  /// Bound of the rounding error of G^(k).
  [[nodiscard]] double rounding(const ContactMotion* motion, const ContactMotion* noise,
                                std::size_t k) const {
    const double r = form.magnitude(noise[k]);
    return is_linear() ? r : r + rounding_of_products(motion, noise, k);
  }
  /// Bound of the error of G, from bounds of the errors and of the magnitudes of its forms: error(form), size(form).
  template <class Error, class Size>
  [[nodiscard]] double error(const Error& error_of, const Size& size_of) const {
    double sum = error_of(form);
    if (is_linear()) return sum;
    for (const auto& [a, b] : *products) {
      const double da = error_of(a), db = error_of(b);
      sum += size_of(a) * db + (size_of(b) + db) * da;
    }
    return sum;
  }
  /// True if a form of the guard satisfies the condition.
  template <class Condition>
  [[nodiscard]] bool any_form(const Condition& condition) const {
    if (condition(form)) return true;
    if (is_linear()) return false;
    for (const auto& [a, b] : *products)
      if (condition(a) || condition(b)) return true;
    return false;
  }

  [[nodiscard]] bool operator==(const GuardForm& other) const;

 private:
  [[nodiscard]] double derivative_of_products(const ContactMotion* motion, std::size_t k) const;
  [[nodiscard]] double rate_of_products(const ContactMotion& m, const ContactMotion& by) const;
  [[nodiscard]] double rounding_of_products(const ContactMotion* motion, const ContactMotion* noise,
                                            std::size_t k) const;
};

}  // namespace signorini
