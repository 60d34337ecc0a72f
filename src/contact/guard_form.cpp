#include "signorini/guard_form.hpp"

#include <cmath>

namespace signorini {

namespace {

/// Binomial coefficients C(k, j), returned one by one for j = 0, 1, ...
class Binomials {
 public:
  explicit Binomials(std::size_t k) : k_(static_cast<double>(k)) {}
  double next() {
    const double now = value_;
    j_ += 1.0;
    value_ *= (k_ - j_ + 1.0) / j_;
    return now;
  }

 private:
  double k_, j_ = 0.0, value_ = 1.0;
};

double derivative_of(const Form& form, const ContactMotion* motion, std::size_t k) {
  return k == 0 ? form.value(motion[0]) : form.rate(motion[k]);
}

}  // namespace

double GuardForm::derivative_of_products(const ContactMotion* motion, std::size_t k) const {
  double sum = 0.0;
  for (const auto& [a, b] : *products) {
    Binomials binomials(k);
    for (std::size_t j = 0; j <= k; ++j)
      sum += binomials.next() * derivative_of(a, motion, j) * derivative_of(b, motion, k - j);
  }
  return sum;
}

double GuardForm::rounding_of_products(const ContactMotion* motion, const ContactMotion* noise,
                                       std::size_t k) const {
  double sum = 0.0;
  for (const auto& [a, b] : *products) {
    Binomials binomials(k);
    for (std::size_t j = 0; j <= k; ++j) {
      const double da = a.magnitude(noise[j]), db = b.magnitude(noise[k - j]);
      sum += binomials.next() * (std::abs(derivative_of(a, motion, j)) * db +
                                 (std::abs(derivative_of(b, motion, k - j)) + db) * da);
    }
  }
  return sum;
}

double GuardForm::rate_of_products(const ContactMotion& m, const ContactMotion& by) const {
  double sum = 0.0;
  for (const auto& [a, b] : *products) sum += a.rate(by) * b.value(m) + a.value(m) * b.rate(by);
  return sum;
}

bool GuardForm::operator==(const GuardForm& other) const {
  if (kind != other.kind || form != other.form || is_linear() != other.is_linear()) return false;
  return is_linear() || products == other.products || *products == *other.products;
}

}  // namespace signorini
