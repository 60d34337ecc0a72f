#include "motion/friction_series.hpp"

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "contact/massless_slip.hpp"
#include "contact/slots.hpp"

namespace signorini {

FrictionSeries::FrictionSeries(const Contact& contact, std::size_t index, int s, const Form& normal,
                               const Series& series)
    : contact_(&contact), index_(index), sign_(s) {
  if (contact.friction.by_force()) {
    begin_by_force(normal, series);
    return;
  }
  if (contact.sliding_point()) {
    begin_massless(s, normal, series);
    return;
  }
  friction_.begin(contact, s, slip_rate(0, series));
  row_ = sliding_row(s, friction_.first());
}

/// N_0 follows from g or q, because all degrees of freedom of such a contact have mass.
void FrictionSeries::begin_by_force(const Form& normal, const Series& series) {
  const Friction& friction = contact_->friction;
  const double pressed = -normal_coefficient(*contact_, index_, normal, series, 0);
  limit_.emplace(friction, pressed);
  row_ = sliding_row(sign_, limit_->slope());
  row_.constant = sign_ * (limit_->slope() * pressed - friction_limit(friction, pressed));
}

/// Determines the slip rate of a point without mass from the spring that holds it.
void FrictionSeries::begin_massless(int s, const Form& normal, const Series& series) {
  const Contact& c = *contact_;
  const ShearElement& element = *c.sliding_point();
  const double *u = series.u.data(), *u1 = u + series.u.rows(), per_time = 1.0 / series.scale;
  const ForcingSeries& f = series.forcing;
  const double length = element.body.dot(u) - c.tangent.dot(u);
  const double along =
      s * per_time * (element.body.dot(u1) - f.surface[index_ * f.count + 1]);  // the body's own velocity
  const double pressed = -normal_coefficient(c, index_, normal, series, 0);
  // The contribution of a dashpot to the growth of |N| needs accelerations (doubtful()).
  const double growth = normal.gap * per_time * c.normal.dot(u1) +
                        normal.pressing * per_time * f.pressing[index_ * f.count + 1];
  const double pull = s * element.stiffness * length + element.damping * along;
  const double zero =
      rounding::of_elimination * (std::abs(normal.gap) * (std::abs(c.gap) + c.normal.magnitude(u)) +
                                  element.stiffness * (element.body.magnitude(u) + c.tangent.magnitude(u)));
  double rate = 0.0;
  if (pressed <= zero) {  // T and N begin together
    constant_ = true;
    if (element.damping > 0.0)
      rate = pull / element.damping;
    else if (growth > 0.0)
      rate = *massless_slip_rate(c.friction, element.stiffness * along, element.stiffness, growth);
    row_ = sliding_row(s, sliding_friction(c, std::max(rate, 0.0)));
    return;
  }
  if (const auto found = massless_slip_rate(c.friction, pull, element.damping, pressed)) {
    rate = *found;
  } else {
    const double greatest = greatest_rate();
    rate = along - c.friction.kinetic * growth / element.stiffness;
    if (rate >= greatest) {
      constant_ = true;
      row_ = sliding_row(s, sliding_friction(c, rate));
      return;
    }
    doubtful_ = normal.vn != 0.0;
    rate = greatest;
    jump_ = length - s * sliding_friction(c, rate) * pressed / element.stiffness;
  }
  friction_.begin(c, s, s * rate);
  ContactMotion m;
  m.N = -pressed;
  m.vt = s * rate;
  row_ = sliding_row_tangent(c, s, m);
  row_.constant = -row_.vt * m.vt;
}

double FrictionSeries::greatest_rate() const { return rate_of_saturation(contact_->friction); }

void FrictionSeries::follow_at_once() {
  constant_ = true;
  jump_ = 0.0;
  row_ = sliding_row(sign_, contact_->friction.kinetic);
}

/// Coefficient k of the slip rate.
double FrictionSeries::slip_rate(std::size_t k, const Series& series) const {
  return static_cast<double>(k + 1) / series.scale * ut_coefficient(*contact_, index_, series, k + 1);
}

double FrictionSeries::known(int k, const Series& series) {
  if (k == 0 || constant_) return 0.0;
  const auto level = static_cast<std::size_t>(k);
  if (limit_) {
    if (k > 1)
      limit_->take(-series.forces(static_cast<Eigen::Index>(series.layout.normal(index_)),
                                  static_cast<Eigen::Index>(level - 1)));
    return -sign_ * limit_->known();
  }
  const auto pressing = [&](std::size_t i) {
    return series.forces(static_cast<Eigen::Index>(series.layout.normal(index_)),
                         static_cast<Eigen::Index>(i));
  };
  if (!contact_->sliding_point()) return friction_.next(slip_rate(level, series), pressing);
  if (k > 1) friction_.take_rate(slip_rate(level - 1, series));
  return friction_.without_rate(pressing);
}

}  // namespace signorini
