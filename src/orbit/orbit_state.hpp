// orbit_state.hpp: state of a motion at an instant, and its coordinates at a section.
//
//   z = (u, v, T)      u, v of dofs with mass, u of dofs with a damper only, T = kt (ut - p) of sticking contacts
//   z_i / scale_i      model scales: displacement, velocity, force
//   z = z0 + B x       tangent space of the contact state, B orthonormal:
//     n . du = 0, n . dv = 0        closed rigid contacts
//     t . dv = 0                    rigidly sticking contacts
//
// Degrees of freedom with neither mass nor damper follow from z by equilibrium. Units: machine units of the
// computed model.
#pragma once

#include "decide/decision.hpp"
#include "signorini/model.hpp"

namespace signorini::orbit {

/// A state from which a run can begin.
struct OrbitState {
  Vector u, v;
  std::vector<double> shears;  ///< T, one per contact
  std::vector<int> slips;      ///< direction of slip: -1, 0, 1, one per contact
};

/// The motion just after an instant.
struct OrbitPoint {
  double t = 0.0;
  contact::ContactStates states;
  Vector u, v, a, forces, force_rates;  ///< forces: in the order of `layout`
  std::vector<linear::DofKind> kinds;   ///< kinds of the degrees of freedom
  ForceLayout layout;
};
/// The motion at time t just after the solver has decided the contact states.
[[nodiscard]] OrbitPoint orbit_point(double t, const decide::Decision& after);
/// The state at a point: its u and v, and shears and slips of all contacts.
[[nodiscard]] OrbitState orbit_state(const OrbitPoint& point);

/// The model with this state at t = 0.
[[nodiscard]] Model with_initial_state(Model model, const OrbitState& state);

/// The model with loads, normal forces and surfaces shifted by `time`: their values at t = time act at t = 0.
[[nodiscard]] Model with_shifted_excitation(Model model, double time);

/// Coordinates of states at a section, in the tangent space of the contact state there.
class OrbitSection {
 public:
  OrbitSection(const Model& model, const OrbitPoint& at);

  /// Dimension of the tangent space: number of columns of B.
  [[nodiscard]] Eigen::Index size() const { return basis_.cols(); }
  [[nodiscard]] const Eigen::MatrixXd& basis() const { return basis_; }
  [[nodiscard]] Vector coordinates(const OrbitPoint& point) const;
  /// Time derivatives of the coordinates.
  [[nodiscard]] Vector rates(const OrbitPoint& point) const;
  /// Coordinates from u, v and forces, or from derivatives of all three.
  [[nodiscard]] Vector coordinates(const Vector& u, const Vector& v, const Vector& forces) const;
  /// Values in the order of the coordinates z: u_i and v_i get the value of their degree of freedom, shears get 1.
  [[nodiscard]] Vector spread(const Vector& of_dofs) const;
  /// Returns `state` changed by B x; x: coordinates of the change, in scales of the model.
  [[nodiscard]] OrbitState moved(OrbitState state, const Vector& x) const;
  /// Converts dz, relative to the model's scales, to displacements, velocities and shears.
  [[nodiscard]] OrbitState unscaled(const Vector& dz) const;
  /// Coordinates z are ordered: displacements() displacements, velocities() velocities, then shears.
  [[nodiscard]] std::size_t displacements() const { return u_.size(); }
  [[nodiscard]] std::size_t velocities() const { return v_.size(); }

 private:
  const Model& model_;
  std::vector<Eigen::Index> u_, v_;
  std::vector<std::size_t> shears_;  // contacts whose shears are coordinates
  Vector scales_;
  Eigen::MatrixXd basis_;
};

}  // namespace signorini::orbit
