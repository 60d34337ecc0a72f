// element.hpp: interface of a finite element to the rest of the program.
//
//   forces on unknowns:  k u + k_g u + m (a - r g) - (distributed load) - (forces of a strain of the element's member)
//
// k, m, k_g: stiffness(), mass(), geometric_stiffness(); r: translation(). Unknowns are ux, uy, rz of the element's
// nodes, and internal unknowns. An element lies in the plane and has an extent, which is its length or its area;
// density() is mass per extent, so density() g is the distributed weight. Bars and beams are lines
// (line_elements.hpp); element_kinds.cpp converts members to elements.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "signorini/scene.hpp"

namespace signorini::element {

using ElementMatrix = Eigen::MatrixXd;
using ElementVector = Eigen::VectorXd;
using PlaneVector = std::array<double, 2>;  // along x and y

struct ElementUnknown {
  std::size_t local_node = 0;  ///< index into nodes()
  std::size_t component = 0;   ///< 0 ux, 1 uy, 2 rz
  /// True for the rotation of a hinged end, an unknown of the element instead of the node. Only in elements of
  /// members.
  bool internal = false;
};

/// Frozen axial forces at both ends of an element, tension positive (assembly/prestress.hpp).
struct AxialForces {
  double a = 0.0, b = 0.0;
  [[nodiscard]] bool is_zero() const { return a == 0.0 && b == 0.0; }
};

/// A section force or a stress as a sum of products. forces, acceleration: factors of the forces on the element's
/// unknowns and of their accelerations; load: factors of a load (x, y) per extent; deflection: factors of the
/// displacements, nonzero only with prestress.
struct SectionForce {
  explicit SectionForce(std::size_t unknowns)
      : forces(ElementVector::Zero(static_cast<Eigen::Index>(unknowns))),
        acceleration(forces),
        deflection(forces) {}
  ElementVector forces, acceleration;
  PlaneVector load{0.0, 0.0};
  ElementVector deflection;
};

/// A line between two nodes, by their indices in nodes(), for drawing. bends: the line is drawn as a cubic.
struct ElementLine {
  std::size_t from = 0, to = 1;
  bool bends = false;
};

class FiniteElement {
 public:
  /// nodes: indices of mesh nodes; member: index into Scene::members; bodies follow after the members.
  FiniteElement(std::vector<int> nodes, int member) : nodes_(std::move(nodes)), member_(member) {}
  virtual ~FiniteElement() = default;
  FiniteElement(const FiniteElement&) = delete;
  FiniteElement& operator=(const FiniteElement&) = delete;

  [[nodiscard]] const std::vector<int>& nodes() const { return nodes_; }
  [[nodiscard]] int member() const { return member_; }
  [[nodiscard]] virtual std::vector<ElementUnknown> unknowns() const = 0;
  /// True if at least one unknown is internal.
  [[nodiscard]] virtual bool has_internal_unknowns() const { return false; }

  /// Length of a line element, or area of a plane element. density() is the mass per length or area.
  [[nodiscard]] virtual double extent() const = 0;
  [[nodiscard]] virtual double density() const = 0;

  // Matrices in the scene's axes, symmetric up to rounding; times displacements or accelerations they give forces.
  [[nodiscard]] virtual ElementMatrix mass() const = 0;
  [[nodiscard]] virtual ElementMatrix stiffness() const = 0;
  /// True if a prestress adds stiffness to this type of element; otherwise run.geometric is an error.
  [[nodiscard]] virtual bool has_geometric_stiffness() const { return false; }
  [[nodiscard]] virtual ElementMatrix geometric_stiffness(const AxialForces& forces) const;
  /// Axial forces under given displacements of the unknowns, a strain of the element's member, a load per extent, and a
  /// body acceleration (gravity minus the acceleration of the base).
  [[nodiscard]] virtual AxialForces axial_forces(const ElementVector& u, double strain,
                                                 const PlaneVector& load, const PlaneVector& pull) const;

  /// Forces on the unknowns by a uniform load (x, y) per extent.
  [[nodiscard]] virtual ElementVector load_vector(const PlaneVector& load) const = 0;
  /// Work that the forces of a unit strain (heat) do on the given motion.
  [[nodiscard]] virtual double strain_work(const ElementVector& motion) const = 0;

  /// A section force at the position at[0], 0 to 1, along the length. Only elements of members have sections; other elements
  /// return zero factors.
  [[nodiscard]] virtual SectionForce section_force(OutputQuantity quantity, const PlaneVector& at,
                                                   const AxialForces& forces) const;

  /// Lines for drawing.
  [[nodiscard]] virtual std::vector<ElementLine> lines() const = 0;

  /// Rigid translation by (x, y), as values of the unknowns.
  [[nodiscard]] ElementVector translation(const PlaneVector& by) const;
  /// Forces on the unknowns by a unit strain; strain_work() is their work.
  [[nodiscard]] ElementVector strain_forces() const;

 private:
  std::vector<int> nodes_;
  int member_;
};

}  // namespace signorini::element
