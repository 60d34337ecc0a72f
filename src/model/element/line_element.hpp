// line_element.hpp: bars and beams: straight lines from a to b, with x along them and y to their left.
//
//   element  a ----- x ----- b;  f: forces of the nodes on its ends;  p: loads along it
//
//   N(x) = -f_ax - int_0^x p_x            tension is positive
//   V(x) =  f_ay + int_0^x p_y            V = dM/dx
//   M(x) = -m_a  + int_0^x V              positive: tension on the right-hand side, y < 0
//
// With frozen axial forces (run.geometric) N v' is added to V, which stays normal to the bent axis, so that V = dM/dx.
//
// Loads between the ends are the distributed load q and, with a consistent mass, -rho times the acceleration,
// interpolated like the element's displacements: linear along the line (for a bar also across it), cubic across. A
// lumped mass is at the ends: N and V jump at the nodes, and there is no inertia between them.
//
//   distributed:  q_x L/2, q_y L/2 at both ends, and for beams +- q_across L^2/12 as moments
//   strain:  EA strain (-e, e), e along it
#pragma once

#include "model/element/element.hpp"

namespace signorini {

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
  bool hinged_a = false, hinged_b = false;  ///< the end has a rotation of its own
};

/// Displacement in one direction at a position between the ends, by displacements and rotations of the ends; or its
/// integrals.
struct LineShapes {
  double a = 0.0, turn_a = 0.0, b = 0.0, turn_b = 0.0;
};
/// Transverse displacement at a position of a beam of length 1, by its end rotations; hinged ends rotate so that they
/// carry no moment.
[[nodiscard]] LineShapes cubic_at(double part, bool hinged_a = false, bool hinged_b = false);

class LineElement : public FiniteElement {
 public:
  explicit LineElement(const LineData& data)
      : FiniteElement({data.nodes[0], data.nodes[1]}, data.member), data_(data) {}

  [[nodiscard]] const LineData& data() const { return data_; }
  [[nodiscard]] const Axis& axis() const { return data_.axis; }
  [[nodiscard]] double extent() const override { return data_.axis.length; }
  [[nodiscard]] double density() const override { return data_.mass_per_length; }
  [[nodiscard]] bool has_geometric() const override { return true; }
  [[nodiscard]] AxialForces axial_forces(const ElementVector& u, double strain, const PlaneVector& load,
                                         const PlaneVector& pull) const override;
  [[nodiscard]] ElementVector spread(const PlaneVector& load) const override;
  [[nodiscard]] double strain_work(const ElementVector& motion) const override;
  /// N, V, M at the position at[0] between a and b, 0 to 1.
  [[nodiscard]] Cut cut(OutputQuantity quantity, const PlaneVector& at,
                        const AxialForces& forces) const override;

 protected:
  using Ends = Eigen::Matrix<double, 6, 1>;  // ux, uy, rz at a and b

  /// Drops the rotations that the element does not have.
  [[nodiscard]] ElementVector of_unknowns(const Ends& ends) const;
  /// Elongation of the line.
  [[nodiscard]] double stretch(const ElementVector& motion) const;

  /// Transverse displacement, integrated once and twice up to a position.
  [[nodiscard]] virtual LineShapes across_once(double part) const = 0;
  [[nodiscard]] virtual LineShapes across_twice(double part) const = 0;
  /// v' at a position along the length.
  [[nodiscard]] virtual Ends slope(double part) const = 0;

 private:
  [[nodiscard]] Ends deflection(OutputQuantity quantity, double part, const AxialForces& forces) const;

  LineData data_;
};

/// Linear shape functions, integrated once and twice.
[[nodiscard]] LineShapes linear_once(double length, double part);
[[nodiscard]] LineShapes linear_twice(double length, double part);

}  // namespace signorini
