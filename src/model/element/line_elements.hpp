// line_elements.hpp: bars and beams: straight lines from a to b, with x along them and y to their left.
//
//   element  a ----- x ----- b;  f: forces of the nodes on its ends;  p: loads along it
//
//   N(x) = -f_ax - int_0^x p_x            tension is positive
//   V(x) =  f_ay + int_0^x p_y            V = dM/dx
//   M(x) = -m_a  + int_0^x V              positive: tension on the right-hand side, y < 0
//
// With axial prestress (run.geometric), V is the force normal to the deformed axis: N v' is added, so that V = dM/dx.
//
// Loads between the ends are the distributed load q and, with a consistent mass, -rho times the acceleration. The
// acceleration is interpolated like displacements: linear along the line (for a bar also across), cubic across. A
// lumped mass is at the ends: N and V jump at the nodes, and no inertia acts between them.
//
//   distributed:  q_x L/2, q_y L/2 at both ends, and for beams +- q_across L^2/12 as moments
//   strain:  EA strain (-e, e), e: unit vector from a to b
#pragma once

#include "model/element/element.hpp"

namespace signorini::element {

/// Length, cosine and sine of the direction, and the vector from a to b.
struct Axis {
  double length, c, s, dx, dy;
};
[[nodiscard]] Axis axis_between(double dx, double dy);

/// Properties of a bar or a beam.
struct LineData {
  std::array<int, 2> nodes{0, 0};
  int member = 0;
  Axis axis{};
  double EA = 0.0, EI = 0.0, mass_per_length = 0.0;
  MassKind mass = MassKind::consistent;
  bool hinged_a = false, hinged_b = false;  ///< the rotation of the end is internal
};

/// Factors of the displacements and rotations of both ends in the displacement at a position between them, or
/// in its integrals.
struct LineShapes {
  double a = 0.0, rotation_a = 0.0, b = 0.0, rotation_b = 0.0;
};
/// Transverse displacement at the position `part`, 0 to 1, of a beam of length 1, as factors of the displacements and
/// rotations of its ends. Hinged ends rotate so that they carry no moment.
[[nodiscard]] LineShapes hermite_shapes(double part, bool hinged_a = false, bool hinged_b = false);

class LineElement : public FiniteElement {
 public:
  explicit LineElement(const LineData& data)
      : FiniteElement({data.nodes[0], data.nodes[1]}, data.member), data_(data) {}

  [[nodiscard]] const LineData& data() const { return data_; }
  [[nodiscard]] const Axis& axis() const { return data_.axis; }
  [[nodiscard]] double extent() const override { return data_.axis.length; }
  [[nodiscard]] double density() const override { return data_.mass_per_length; }
  [[nodiscard]] bool has_geometric_stiffness() const override { return true; }
  [[nodiscard]] AxialForces axial_forces(const ElementVector& u, double strain, const PlaneVector& load,
                                         const PlaneVector& pull) const override;
  [[nodiscard]] ElementVector load_vector(const PlaneVector& load) const override;
  [[nodiscard]] double strain_work(const ElementVector& motion) const override;
  /// N, V, M at the position at[0] between a and b, 0 to 1.
  [[nodiscard]] SectionForce section_force(OutputQuantity quantity, const PlaneVector& at,
                                           const AxialForces& forces) const override;

 protected:
  using Ends = Eigen::Matrix<double, 6, 1>;  // ux, uy, rz at a and b

  /// Selects from the values at the ends those that belong to unknowns of the element.
  [[nodiscard]] ElementVector restrict_to_unknowns(const Ends& ends) const;
  /// Elongation of the line by a motion of the unknowns.
  [[nodiscard]] double elongation(const ElementVector& motion) const;

  /// Factors of the end motions in the transverse displacement, integrated once and twice from a to a position.
  [[nodiscard]] virtual LineShapes deflection_integral(double part) const = 0;
  [[nodiscard]] virtual LineShapes deflection_double_integral(double part) const = 0;
  /// Factors of the unknowns in the slope v' at a position along the length.
  [[nodiscard]] virtual Ends slope(double part) const = 0;

 private:
  [[nodiscard]] Ends deflection(OutputQuantity quantity, double part, const AxialForces& forces) const;

  LineData data_;
};

/// Linear shape functions, integrated once and twice from a to a position (`part` of the length).
[[nodiscard]] LineShapes linear_integral(double length, double part);
[[nodiscard]] LineShapes linear_double_integral(double length, double part);

// The plane Euler-Bernoulli beam element.
//
//   axial    EA/L [1 -1; -1 1]                  rho L/6 [2 1; 1 2]
//   bending  EI/L^3 [12 6L -12 6L; ...]         rho L/420 [156 22L 54 -13L; ...]
//
//   force N  N/30L [36 3L -36 3L; ...]  for v, rz: the integral of N v'^2, N linear from a to b
//
// These matrices are in the beam's axes (x from a to b, y to the left) and are rotated into the scene's axes. Unknowns of an
// element: ux, uy, rz at a, then at b; rz counter-clockwise. rho: mass per length. A lumped mass puts rho L/2 on ux and uy of
// both ends and none on the rotations.
// Source: Przemieniecki, Theory of Matrix Structural Analysis (1968), sections 5.6, 11.3 and 15.2.

using BeamMatrix = Eigen::Matrix<double, 6, 6>;

/// Stiffness in the scene's axes of a beam that spans (dx, dy); force per length, moments per radian.
[[nodiscard]] BeamMatrix beam_stiffness(double dx, double dy, double ea, double ei);

/// Geometric stiffness in the scene's axes of a beam that spans (dx, dy) under an axial force, tension positive, that
/// varies linearly from a to b.
[[nodiscard]] BeamMatrix beam_geometric_stiffness(double dx, double dy, double force_a, double force_b);

/// Mass matrix in the scene's axes of a beam that spans (dx, dy).
[[nodiscard]] BeamMatrix beam_mass(double dx, double dy, double mass_per_length, MassKind kind);

/// A beam; EI includes the flexibility of a pipe bend.
class BeamElement final : public LineElement {
 public:
  using LineElement::LineElement;

  [[nodiscard]] std::vector<ElementUnknown> unknowns() const override;
  [[nodiscard]] bool has_internal_unknowns() const override { return data().hinged_a || data().hinged_b; }
  [[nodiscard]] ElementMatrix mass() const override;
  [[nodiscard]] ElementMatrix stiffness() const override;
  [[nodiscard]] ElementMatrix geometric_stiffness(const AxialForces& forces) const override;
  [[nodiscard]] std::vector<ElementLine> lines() const override { return {{0, 1, true}}; }

 private:
  [[nodiscard]] LineShapes deflection_integral(double part) const override;
  [[nodiscard]] LineShapes deflection_double_integral(double part) const override;
  [[nodiscard]] Ends slope(double part) const override;
};

// The bar of a truss, hinged at both ends.
//
//   K = EA/L [ e e^T  -e e^T; -e e^T  e e^T ],   M = rho L/6 [2 I  I; I  2 I],   e = (dx, dy)/L
//
// These matrices are in the scene's axes. The mass acts in both directions; otherwise a bar would have no rotational inertia. A
// lumped mass is rho L/2 at each end. The matrices have the unknowns of beams, with zero rows and columns for
// the rotations; the element itself has only ux and uy of both ends.
// Source: Przemieniecki, Theory of Matrix Structural Analysis (1968), sections 5.4 and 11.2.

/// Stiffness of a bar that spans (dx, dy); force per length.
[[nodiscard]] BeamMatrix bar_stiffness(double dx, double dy, double ea);

/// Geometric stiffness of a bar that spans (dx, dy) under an axial force, tension positive: N/L across the bar, as for a
/// string. If the force varies linearly from a to b, its mean is used.
[[nodiscard]] BeamMatrix bar_geometric_stiffness(double dx, double dy, double force_a, double force_b);

/// Mass matrix of a bar that spans (dx, dy).
[[nodiscard]] BeamMatrix bar_mass(double dx, double dy, double mass_per_length, MassKind kind);

class BarElement final : public LineElement {
 public:
  using LineElement::LineElement;

  [[nodiscard]] std::vector<ElementUnknown> unknowns() const override;
  [[nodiscard]] ElementMatrix mass() const override;
  [[nodiscard]] ElementMatrix stiffness() const override;
  [[nodiscard]] ElementMatrix geometric_stiffness(const AxialForces& forces) const override;
  [[nodiscard]] std::vector<ElementLine> lines() const override { return {{0, 1, false}}; }

 private:
  [[nodiscard]] LineShapes deflection_integral(double part) const override;
  [[nodiscard]] LineShapes deflection_double_integral(double part) const override;
  [[nodiscard]] Ends slope(double part) const override;
};

}  // namespace signorini::element
