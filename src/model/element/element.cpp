#include "model/element/element.hpp"

namespace signorini::element {

ElementMatrix FiniteElement::geometric_stiffness(const AxialForces& /*forces*/) const {
  const auto n = static_cast<Eigen::Index>(unknowns().size());
  return ElementMatrix::Zero(n, n);
}

AxialForces FiniteElement::axial_forces(const ElementVector& /*u*/, double /*strain*/,
                                        const PlaneVector& /*load*/, const PlaneVector& /*pull*/) const {
  return {};
}

SectionForce FiniteElement::section_force(OutputQuantity /*quantity*/, const PlaneVector& /*at*/,
                                          const AxialForces& /*forces*/) const {
  return SectionForce(unknowns().size());
}

ElementVector FiniteElement::translation(const PlaneVector& by) const {
  const std::vector<ElementUnknown> all = unknowns();
  ElementVector motion = ElementVector::Zero(static_cast<Eigen::Index>(all.size()));
  for (std::size_t j = 0; j < all.size(); ++j)
    if (all[j].component < 2) motion[static_cast<Eigen::Index>(j)] = by[all[j].component];
  return motion;
}

ElementVector FiniteElement::strain_forces() const {
  const auto n = static_cast<Eigen::Index>(unknowns().size());
  ElementVector forces(n);
  for (Eigen::Index j = 0; j < n; ++j) forces[j] = strain_work(ElementVector::Unit(n, j));
  return forces;
}

}  // namespace signorini::element
