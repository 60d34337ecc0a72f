// motion.hpp: motion of a contact, computed from the motion of the structure.
//
//   g = g0 + n . u,   ut = t . u - s,   g' = n . v,   ut' = t . v - s',   g'' = n . a,   ut'' = t . a - s''
//   p = ut - T / kt                     slip; p = ut without tangential stiffness
//
// s: motion of the surface. u, v, a: vectors of any type with operator[] for a degree of freedom.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "signorini/contact.hpp"

namespace signorini::contact {

/// ut if u contains displacements, ut' if u contains velocities. surface: displacement or velocity of the surface.
template <class U>
[[nodiscard]] double along_surface(const Contact& contact, const U& u, double surface) {
  return contact.tangent.dot(u) - surface;
}
template <class V>
[[nodiscard]] double gap_rate(const Contact& contact, const V& v) {
  return contact.normal.dot(v);
}

template <class U>
void set_displacement(const Contact& contact, const U& u, double surface, ContactMotion& m) {
  m.gap = contact.gap_at(u);
  m.ut = along_surface(contact, u, surface);
}

template <class V>
void set_velocity(const Contact& contact, const V& v, double surface_velocity, ContactMotion& m) {
  m.vn = gap_rate(contact, v);
  m.vt = along_surface(contact, v, surface_velocity);
}

template <class A>
void set_acceleration(const Contact& contact, const A& a, double surface_acceleration, ContactMotion& m) {
  m.an = contact.normal.dot(a);
  m.at = contact.tangent.dot(a) - surface_acceleration;
}

/// Slip p. When a contact begins to stick, its p becomes the anchor. The function is linear: for increments of ut and T it
/// returns the increment of p.
[[nodiscard]] inline double slip_of(const Contact& contact, double ut, double T) {
  const std::optional<double> kt = contact.anchor_spring();
  return kt ? ut - T / *kt : ut;
}
[[nodiscard]] inline double slip_of(const Contact& contact, const ContactMotion& m) {
  return slip_of(contact, m.ut, m.T);
}

/// For a contact with compliance split: subtracts the deformation of its springs from m, so that m is the motion of the
/// touching surfaces.
inline void remove_split_compliance(const Contact& contact, State state, ContactMotion& m) {
  if (!contact.compliance_split() || is_open(state)) return;
  if (contact.tangential_stiffness) {
    const int s = slip_sign(state);
    const double ratio = contact.normal_stiffness / *contact.tangential_stiffness;
    m.ut = slip_of(contact, m);
    m.vt = s == 0 ? 0.0 : m.vt + s * contact.friction.kinetic * ratio * m.vn;
  }
  m.gap = m.vn = 0.0;
}

// Matrix with one column per linear form, restricted to the degrees of freedom on which the forms depend.
//
//   H_ij = weight_d factor_d of form j,   d: i-th degree of freedom of the forms, in the order of first occurrence

/// Matrix H, degrees of freedom x forms. weight: factor for each degree of freedom; if absent, all factors are 1.
[[nodiscard]] Eigen::MatrixXd form_columns(const std::vector<const Combination*>& forms,
                                           const std::function<double(int)>& weight = {});

}  // namespace signorini::contact
