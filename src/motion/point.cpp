#include "motion/point.hpp"

#include "contact/curved_surface.hpp"
#include "contact/law.hpp"

namespace signorini::motion {

double equilibrium_residual(const Model& model, const linear::SystemMatrices& structure,
                            const Forcing& forcing, double t, const Point& point) {
  Vector r = Vector::Zero(model.size());
  forcing.add_load(t, 0, r.data(), -1.0);
  structure.add_product(point.a.data(), point.v.data(), point.u.data(), r.data());
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    model.contacts[k].normal.add_to(r, point.N(model.layout, k));
    model.contacts[k].tangent.add_to(r, point.T(model.layout, k));
    if (const Contact& contact = model.contacts[k]; contact.curved_surface())
      contact.body_tangent().add_to(
          r, contact::restoring_force(contact, point.N(model.layout, k),
                                      body_slide(contact, k, forcing, t, point.u, point.v).ut));
  }
  return r.size() > 0 ? r.cwiseAbs().maxCoeff() : 0.0;
}

void Powers::at(const Forcing& forcing, double t, const contact::ContactStates& states, const Point& point,
                const std::vector<ContactMotion>& motions, double* out) const {
  out[0] = forcing.power(t, point.v.data());
  out[1] = structure_.damping_power(point.v.data());
  for (std::size_t k = 0; k < states.size(); ++k) {
    const ContactMotion& m = motions[k];
    const double slip = contact::working_slip_rate(model_.contacts[k], states[k].state, m);
    if (const Contact& contact = model_.contacts[k]; contact.curved_surface()) {
      const BodySlide slide = body_slide(contact, k, forcing, t, point.u, point.v);
      out[0] -= contact::restoring_force(contact, point.N(model_.layout, k), slide.ut) * slide.vt;
    }
    const ContactWork power = contact::work_on(model_.contacts[k], states[k].state, m.N, m.T,
                                               {slip, forcing.surface(k, t, 1), m.vn, m.vn, 1.0});
    out[1] += power.damping;
    out[2 + 3 * k] = power.friction;
    out[3 + 3 * k] = power.surface;
    out[4 + 3 * k] = power.applied_normal_force;
  }
}

void Powers::add(const double* powers, double factor, WorkIntegrals& works) const {
  works.loads += factor * powers[0];
  works.damping += factor * powers[1];
  for (std::size_t k = 0; k < works.friction.size(); ++k) {
    works.friction[k] += factor * powers[2 + 3 * k];
    works.surface[k] += factor * powers[3 + 3 * k];
    works.applied_normal_force[k] += factor * powers[4 + 3 * k];
  }
}

}  // namespace signorini::motion
