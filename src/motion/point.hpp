// point.hpp: the state at one time, and the motion of a contact in it.
//
//   u, v, N, T, a at t  ->  g, ut, g', ut', g'', ut'' of one contact       contact/motion.hpp
#pragma once

#include <optional>

#include "contact/friction_limit.hpp"
#include "contact/motion.hpp"
#include "motion/forcing.hpp"

namespace signorini {

/// u, v (length n) and forces (signorini/force_layout.hpp) at one time.
/// Energy of the structure without its contacts.
struct StructureEnergy {
  double kinetic = 0.0, elastic = 0.0;
};

struct Point {
  Vector u, v, forces;
  Vector a = {};  ///< empty if not needed
  /// Energy of u and v, if the engine knows it more accurately than v^T M v and u^T K u: on a fine mesh these are sums
  /// of terms far greater than their result.
  std::optional<StructureEnergy> energy = {};

  [[nodiscard]] double N(const ForceLayout& layout, std::size_t k) const {
    return forces.data()[layout.normal(k)];
  }
  [[nodiscard]] double T(const ForceLayout& layout, std::size_t k) const {
    return forces.data()[layout.tangent(k)];
  }
};

/// Point on the straight line from a to b, 0 <= x <= 1.
[[nodiscard]] inline Point between(const Point& a, const Point& b, double x) {
  return {(1.0 - x) * a.u + x * b.u, (1.0 - x) * a.v + x * b.v, (1.0 - x) * a.forces + x * b.forces,
          (1.0 - x) * a.a + x * b.a};
}

/// Motion of contact k; g'' and ut'' are zero if the point has no accelerations.
[[nodiscard]] inline ContactMotion motion_of(const Contact& contact, std::size_t k, const Forcing& forcing,
                                             double t, const Point& point) {
  ContactMotion m;
  m.N = point.N(forcing.layout(), k);
  m.T = point.T(forcing.layout(), k);
  set_place(contact, point.u, forcing.surface(k, t, 0), m);
  set_velocity(contact, point.v, forcing.surface(k, t, 1), m);
  if (point.a.size() > 0) set_acceleration(contact, point.a, forcing.surface(k, t, 2), m);
  m.pressing = forcing.pressing(k, t, 0);
  m.pressing_rate = forcing.pressing(k, t, 1);
  set_limit(contact, m);
  return m;
}

/// Tangential displacement and velocity of the touching body, relative to the surface: those of the motion unless a
/// shear element is in between.
struct BodySlide {
  double ut = 0.0, vt = 0.0;
};
[[nodiscard]] inline BodySlide slide_of(const Contact& contact, std::size_t k, const Forcing& forcing,
                                        double t, const Vector& u, const Vector& v) {
  return {contact.body_tangent().dot(u) - forcing.surface(k, t, 0),
          contact.body_tangent().dot(v) - forcing.surface(k, t, 1)};
}

}  // namespace signorini
