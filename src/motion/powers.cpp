#include "motion/powers.hpp"

#include "contact/bowl.hpp"
#include "contact/law.hpp"

namespace signorini {

void Powers::at(const Forcing& forcing, double t, const Mode& mode, const Point& point, double* out) const {
  out[0] = forcing.power(t, point.v.data());
  out[1] = structure_.damping_power(point.v.data());
  for (std::size_t k = 0; k < mode.size(); ++k) {
    const ContactMotion m = motion_of(model_.contacts[k], k, forcing, t, point);
    const double slip = working_slip_rate(model_.contacts[k], mode[k].state, m);
    if (const Contact& contact = model_.contacts[k]; contact.curved_surface()) {
      const BodySlide slide = slide_of(contact, k, forcing, t, point.u, point.v);
      out[0] -= bowl_force(contact, point.N(model_.layout, k), slide.ut) * slide.vt;
    }
    const ContactWork power = work_on(model_.contacts[k], mode[k].state, m.N, m.T,
                                      {slip, forcing.surface(k, t, 1), m.vn, m.vn, 1.0});
    out[1] += power.damping;
    out[2 + 3 * k] = power.friction;
    out[3 + 3 * k] = power.surface;
    out[4 + 3 * k] = power.pressing;
  }
}

void Powers::add(const double* powers, double factor, Works& works) const {
  works.loads += factor * powers[0];
  works.damping += factor * powers[1];
  for (std::size_t k = 0; k < works.friction.size(); ++k) {
    works.friction[k] += factor * powers[2 + 3 * k];
    works.surface[k] += factor * powers[3 + 3 * k];
    works.pressing[k] += factor * powers[4 + 3 * k];
  }
}

}  // namespace signorini
