#include "engine/newmark/newmark_works.hpp"

#include "contact/law.hpp"

namespace signorini {

void NewmarkWorks::add(const Forcing& forcing, const Mode& mode, const Point& a, double t0, const Point& b,
                       double t1, double factor, Works& works) {
  const double h = t1 - t0;
  if (!(h > 0.0)) return;
  du_ = b.u - a.u;
  v_ = 0.5 * (a.v + b.v);
  if (forcing.loaded())
    works.loads += 0.5 * factor * (forcing.power(t0, du_.data()) + forcing.power(t1, du_.data()));
  works.damping += factor * h * structure_.damping_power(v_.data());
  for (std::size_t k = 0; k < mode.size(); ++k) {
    const Contact& contact = model_.contacts[k];
    const auto tangent_force = static_cast<Eigen::Index>(2 * k) + 1;
    const double T0 = a.forces[tangent_force], T1 = b.forces[tangent_force], T = 0.5 * (T0 + T1);
    const double ds = forcing.surface(k, t1, 0) - forcing.surface(k, t0, 0);
    if (mode[k].state != State::open && contact.normal_damping > 0.0)
      works.damping += factor * contact.normal_damping * contact.normal.dot(v_) * contact.normal.dot(du_);
    if (mode[k].inside)
      works.damping += factor * inside_loss(contact, contact.gap + contact.normal.dot(a.u),
                                            contact.gap + contact.normal.dot(b.u));
    if (slip_sign(mode[k].state) != 0) {
      double dp = contact.tangent.dot(du_) - ds;
      if (contact.tangential_stiffness) dp -= (T1 - T0) / *contact.tangential_stiffness;
      works.friction[k] += factor * T * dp;
    }
    works.surface[k] -= factor * T * ds;
    if (contact.law != Law::slider)
      works.pressing[k] -= 0.5 * factor * h * (a.forces[tangent_force - 1] + b.forces[tangent_force - 1]);
  }
}

}  // namespace signorini
