// orbit_state.hpp: the state of a motion at an instant, and its coordinates at a section.
//
//   z = (u, v, T)      u, v of what has mass, u of what has a damper alone, T = kt (ut - p) of contacts that stick
//   z_i / scale_i      model scales: displacement, velocity, force
//   z = z0 + B x       the tangent of the contact state, B orthonormal:
//     n . du = 0, n . dv = 0        rigid contacts that are closed
//     t . dv = 0                    contacts that stick rigidly
//
// What has neither mass nor damper follows from the rest. Units: of the model that is computed, the machine's.
#pragma once

#include "decide/decision.hpp"
#include "signorini/model.hpp"

namespace signorini {

/// From which a run can begin.
struct OrbitState {
  Vector u, v;
  std::vector<double> shears;  ///< T, one a contact
  std::vector<int> slips;      ///< -1, 0, 1, one a contact
};

/// The motion just after an instant.
struct OrbitPoint {
  double t = 0.0;
  Mode mode;
  Vector u, v, a, forces, force_rates;  ///< forces: in the order of `layout`
  std::vector<DofKind> kinds;           ///< of this mode
  ForceLayout layout;
};
[[nodiscard]] OrbitPoint orbit_point(double t, const Decision& after);
[[nodiscard]] OrbitState orbit_state(const OrbitPoint& point);

/// The model with this state at t = 0.
[[nodiscard]] Model begun_at(Model model, const OrbitState& state);

/// Loads, compressions and surfaces earlier by `time`: those of t = time act at t = 0.
[[nodiscard]] Model driven_from(Model model, double time);

/// Coordinates at a section.
class OrbitSection {
 public:
  OrbitSection(const Model& model, const OrbitPoint& at);

  /// Directions: columns of B.
  [[nodiscard]] Eigen::Index size() const { return basis_.cols(); }
  [[nodiscard]] const Eigen::MatrixXd& basis() const { return basis_; }
  [[nodiscard]] Vector coordinates(const OrbitPoint& point) const;
  /// Their derivatives by time.
  [[nodiscard]] Vector rates(const OrbitPoint& point) const;
  /// From derivatives of u, v and forces.
  [[nodiscard]] Vector coordinates(const Vector& u, const Vector& v, const Vector& forces) const;
  /// Entries of u and v from one figure a degree of freedom; 1 of shears.
  [[nodiscard]] Vector spread(const Vector& of_dofs) const;
  /// state + B x
  [[nodiscard]] OrbitState moved(OrbitState state, const Vector& x) const;
  /// dz, of coordinates, as displacements, velocities and shears.
  [[nodiscard]] OrbitState unscaled(const Vector& dz) const;
  /// Entries of coordinates: [0, u), [u, u + v), the rest are shears.
  [[nodiscard]] std::size_t displacements() const { return u_.size(); }
  [[nodiscard]] std::size_t velocities() const { return v_.size(); }

 private:
  const Model& model_;
  std::vector<Eigen::Index> u_, v_;
  std::vector<std::size_t> shears_;  // contacts
  Vector scales_;
  Eigen::MatrixXd basis_;
};

}  // namespace signorini
