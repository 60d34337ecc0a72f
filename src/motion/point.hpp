// point.hpp: the state at one time, and the motion of a contact in this state.
//
//   u, v, N, T, a at t  ->  g, ut, g', ut', g'', ut'' of one contact       contact/motion.hpp
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/rounding.hpp"
#include "contact/friction.hpp"
#include "contact/motion.hpp"
#include "contact/work.hpp"
#include "linear/system_matrices.hpp"
#include "motion/forcing.hpp"
#include "signorini/model.hpp"

namespace signorini::motion {

/// Resolution of times: an integrator treats times closer than this as equal, as IDA does. step: length of the time step.
[[nodiscard]] inline double resolution_at(double t, double step) {
  return rounding::time_resolution * (std::abs(t) + std::abs(step));
}

/// Energy of the structure without its contacts.
struct StructureEnergy {
  double kinetic = 0.0, elastic = 0.0;
};

/// Displacements, velocities (length n) and forces (signorini/force_layout.hpp) at one time.
struct Point {
  Vector u, v, forces;
  Vector a = {};  ///< accelerations; empty if not needed
  /// Energy of u and v, if the engine knows it more accurately than v^T M v/2 and u^T K u/2. On a fine mesh the terms of these
  /// sums are far larger than the result.
  std::optional<StructureEnergy> energy = {};

  [[nodiscard]] double N(const ForceLayout& layout, std::size_t k) const {
    return forces.data()[layout.normal(k)];
  }
  [[nodiscard]] double T(const ForceLayout& layout, std::size_t k) const {
    return forces.data()[layout.tangent(k)];
  }
};

/// Point on the straight line from a (x = 0) to b (x = 1).
[[nodiscard]] inline Point interpolate(const Point& a, const Point& b, double x) {
  return {(1.0 - x) * a.u + x * b.u, (1.0 - x) * a.v + x * b.v, (1.0 - x) * a.forces + x * b.forces,
          (1.0 - x) * a.a + x * b.a};
}

/// Motion of contact k; g'' and ut'' are zero if the point contains no accelerations.
[[nodiscard]] inline ContactMotion motion_of(const Contact& contact, std::size_t k, const Forcing& forcing,
                                             double t, const Point& point) {
  ContactMotion m;
  m.N = point.N(forcing.layout(), k);
  m.T = point.T(forcing.layout(), k);
  contact::set_displacement(contact, point.u, forcing.surface(k, t, 0), m);
  contact::set_velocity(contact, point.v, forcing.surface(k, t, 1), m);
  if (point.a.size() > 0) contact::set_acceleration(contact, point.a, forcing.surface(k, t, 2), m);
  m.applied_normal_force = forcing.applied_normal_force(k, t, 0);
  m.applied_normal_force_rate = forcing.applied_normal_force(k, t, 1);
  contact::set_limit(contact, m);
  return m;
}

/// Tangential displacement and velocity of the touching body relative to the surface. Without a shear element these are ut
/// and ut' of motion_of().
struct BodySlide {
  double ut = 0.0, vt = 0.0;
};
[[nodiscard]] inline BodySlide body_slide(const Contact& contact, std::size_t k, const Forcing& forcing,
                                          double t, const Vector& u, const Vector& v) {
  return {contact.body_tangent().dot(u) - forcing.surface(k, t, 0),
          contact.body_tangent().dot(v) - forcing.surface(k, t, 1)};
}

// Residual of the equation of motion.
//
//   r = M a + C v + K u + sum ( n N + t T ) - P(t)

/// Largest |r_i| at a point whose accelerations are known. Unit: force.
[[nodiscard]] double equilibrium_residual(const Model& model, const linear::SystemMatrices& structure,
                                          const Forcing& forcing, double t, const Point& point);

// Powers: rates at which the system gains and loses energy.
//
//   loads     P(t) . v                       damping   v^T C v + sum_closed cn g'^2
//   friction  T p'  of each contact          surface   -T s'(t)  of each contact       p': slip rate
//
// For the powers of a contact see contact/work.hpp.

/// Integrals of the powers over time. friction, surface and applied_normal_force have one entry per contact;
/// applied_normal_force is the integral of -N, unit force * time.
struct WorkIntegrals {
  explicit WorkIntegrals(std::size_t contacts = 0)
      : friction(contacts, 0.0), surface(contacts, 0.0), applied_normal_force(contacts, 0.0) {}
  double loads = 0.0, damping = 0.0;
  std::vector<double> friction, surface, applied_normal_force;

  void clear() {
    loads = damping = 0.0;
    std::fill(friction.begin(), friction.end(), 0.0);
    std::fill(surface.begin(), surface.end(), 0.0);
    std::fill(applied_normal_force.begin(), applied_normal_force.end(), 0.0);
  }
  /// Changes the signs: the work of the way back.
  void reverse() {
    loads = -loads;
    damping = -damping;
    for (std::vector<double>* works : {&friction, &surface, &applied_normal_force})
      for (double& work : *works) work = -work;
  }
  /// Adds `factor` times the work of contact k.
  void add(std::size_t k, const ContactWork& work, double factor) {
    damping += factor * work.damping;
    friction[k] += factor * work.friction;
    surface[k] += factor * work.surface;
    applied_normal_force[k] += factor * work.applied_normal_force;
  }
};

class Powers {
 public:
  Powers(const Model& model, const linear::SystemMatrices& structure)
      : model_(model), structure_(structure) {}

  /// Number of powers at one time: loads, damping, then friction, surface and applied_normal_force (-N) of each contact.
  [[nodiscard]] std::size_t count() const { return 2 + 3 * model_.contacts.size(); }
  /// Writes all powers into out[0 .. count()). motions: motion_of() of each contact at the point.
  void at(const Forcing& forcing, double t, const contact::ContactStates& states, const Point& point,
          const std::vector<ContactMotion>& motions, double* out) const;
  /// Adds `factor` times the powers to the integrals. powers: count() numbers from at().
  void add(const double* powers, double factor, WorkIntegrals& works) const;

 private:
  const Model& model_;
  const linear::SystemMatrices& structure_;
};

// Rounding error of form . x in units of eps, if the entries of x are rounded once.
//
//   translations in the plane: |form| |x|, which does not depend on the directions of the axes
//   other coordinates:         sum |form_i x_i|

inline constexpr std::size_t max_plane_terms = 4;  // for a form on the translations of one or two nodes

/// Rounding error of form . x in units of eps. x(dof): magnitude of a degree of freedom; terms with the factor zero do not
/// contribute.
template <class Size>
double form_magnitude_by(const Model& model, const Combination& form, const Size& x) {
  double terms = 0.0, form_squared = 0.0, x_squared = 0.0;
  for (const auto& [dof, factor] : form.terms) {
    const bool in_plane =
        form.terms.size() <= max_plane_terms && !model.dofs[static_cast<std::size_t>(dof)].rotation;
    if (!in_plane) {
      terms += std::abs(factor * x(dof));
    } else if (factor != 0.0) {
      form_squared += factor * factor;
      x_squared += x(dof) * x(dof);
    }
  }
  return terms + std::sqrt(form_squared * x_squared);
}
/// Rounding error of form . x in units of eps, for a vector x.
template <class Entries>
double form_magnitude(const Model& model, const Combination& form, const Entries& x) {
  return form_magnitude_by(model, form, [&x](int dof) { return x[dof]; });
}

}  // namespace signorini::motion
