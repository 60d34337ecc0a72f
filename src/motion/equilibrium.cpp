#include "motion/equilibrium.hpp"

#include "contact/bowl.hpp"

namespace signorini {

double imbalance(const Model& model, const Structure& structure, const Forcing& forcing, double t,
                 const Point& point) {
  Vector r = Vector::Zero(model.size());
  forcing.add_load(t, 0, r.data(), -1.0);
  structure.add_product(point.a.data(), point.v.data(), point.u.data(), r.data());
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    model.contacts[k].normal.add_to(r, point.N(model.layout, k));
    model.contacts[k].tangent.add_to(r, point.T(model.layout, k));
    if (const Contact& contact = model.contacts[k]; contact.curved_surface())
      contact.body_tangent().add_to(r, bowl_force(contact, point.N(model.layout, k),
                                                  slide_of(contact, k, forcing, t, point.u, point.v).ut));
  }
  return r.size() > 0 ? r.cwiseAbs().maxCoeff() : 0.0;
}

}  // namespace signorini
