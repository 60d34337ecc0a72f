// constants.hpp: functions that visit every constant and every form of a contact, for any contact law.
//
// Code that rescales, perturbs, renumbers or reduces contacts uses these functions, so this code does not depend
// on the laws.
#pragma once

#include "base/unit.hpp"
#include "signorini/contact.hpp"

namespace signorini::contact {

/// Visits the forms on the displacements: normal, tangent and, with a shear element, the tangential form of the body.
template <class AnyContact, class Visit>
void visit_forms(AnyContact& contact, const Visit& visit) {
  visit(contact.normal);
  visit(contact.tangent);
  if (contact.shear) visit(contact.shear->body);
}

/// Visits stiffnesses and dashpot constants of a contact: visit(double&, Unit).
template <class Visit>
void visit_stiffnesses(Contact& contact, const Visit& visit) {
  visit(contact.normal_stiffness, unit::stiffness);
  visit(contact.normal_damping, unit::damping);
  if (contact.tangential_stiffness) visit(*contact.tangential_stiffness, unit::stiffness);
  if (!contact.shear) return;
  visit(contact.shear->stiffness, unit::stiffness);
  visit(contact.shear->damping, unit::damping);
}

/// Visits all constants that have a unit: visit(double&, Unit). Constants of the contact's law are included, forms and
/// histories are not.
template <class Visit>
void visit_constants(Contact& contact, const Visit& visit) {
  visit(contact.gap, unit::length);
  visit_stiffnesses(contact, visit);
  if (contact.pendulum_surface) {
    visit(contact.pendulum_surface->radius, unit::length);
    visit(contact.pendulum_surface->nominal_force, unit::force);
  }
  for (const FrictionConstant& constant : friction_constants)
    if (auto& value = contact.friction.*constant.value) visit(*value, constant.unit);
  if (contact.capture_velocity) visit(*contact.capture_velocity, unit::velocity);
  visit(contact.initial_shear, unit::force);
  visit(contact.initial_memory, unit::length);
  if (auto law = contact.law->with_constants(visit)) contact.law = std::move(law);
}

}  // namespace signorini::contact
