// point.hpp: the state at one time, and the motion of a contact in it.
//
//   g = g0 + n . u,   ut = t . u - s(t),   g' = n . v,   ut' = t . v - s'(t)
#pragma once

#include "motion/forcing.hpp"

namespace signorini {

/// u, v (length n) and forces (N_1, T_1, N_2, ...) at one time.
struct Point {
  Vector u, v, forces;
  Vector a = {};  ///< empty where it is not needed
};

/// Motion of contact k; g'' and ut'' are zero without accelerations in the point.
[[nodiscard]] inline ContactMotion motion_of(const Contact& contact, std::size_t k, const Forcing& forcing,
                                             double t, const Point& point) {
  ContactMotion m;
  m.N = point.forces[static_cast<Eigen::Index>(2 * k)];
  m.T = point.forces[static_cast<Eigen::Index>(2 * k) + 1];
  m.gap = contact.gap + contact.normal.dot(point.u);
  m.ut = contact.tangent.dot(point.u) - forcing.surface(k, t, 0);
  m.vn = contact.normal.dot(point.v);
  m.vt = contact.tangent.dot(point.v) - forcing.surface(k, t, 1);
  if (point.a.size() > 0) {
    m.an = contact.normal.dot(point.a);
    m.at = contact.tangent.dot(point.a) - forcing.surface(k, t, 2);
  }
  m.pressing = forcing.pressing(k, t, 0);
  m.pressing_rate = forcing.pressing(k, t, 1);
  return m;
}

/// Tangential displacement and velocity of the touching body, relative to the surface: those of the motion
/// unless a shear element stands between.
struct BodySlide {
  double ut = 0.0, vt = 0.0;
};
[[nodiscard]] inline BodySlide slide_of(const Contact& contact, std::size_t k, const Forcing& forcing,
                                        double t, const Vector& u, const Vector& v) {
  return {contact.body_tangent().dot(u) - forcing.surface(k, t, 0),
          contact.body_tangent().dot(v) - forcing.surface(k, t, 1)};
}

}  // namespace signorini
