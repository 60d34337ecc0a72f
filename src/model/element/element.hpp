// element.hpp: what a finite element answers: all that the rest of the program knows of one.
//
//   forces on its unknowns:  k u + k_g u + m (a - r g) - (what is spread along it) - (what a strain of its member holds)
//
// k, m, k_g: stiffness(), mass(), geometric(); r: translation(). Unknowns are ux, uy, rz of its nodes, or its own. It lies in
// the plane and has an extent, its length, or its area; density() is mass per extent, so that density() g spreads its weight.
// Bars and beams are lines (line_element.hpp); how a member becomes elements stands in element_kinds.cpp.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "signorini/scene.hpp"

namespace signorini {

using ElementMatrix = Eigen::MatrixXd;
using ElementVector = Eigen::VectorXd;
using PlaneVector = std::array<double, 2>;  // along x and y

struct ElementUnknown {
  std::size_t place = 0;      ///< index into nodes()
  std::size_t component = 0;  ///< 0 ux, 1 uy, 2 rz
  bool own =
      false;  ///< it does not follow the node: the rotation of a hinged end; in pieces of members alone
};

/// Frozen forces along an element at both of its ends, tension positive (assembly/geometric.hpp).
struct AxialForces {
  double a = 0.0, b = 0.0;
  [[nodiscard]] bool none() const { return a == 0.0 && b == 0.0; }
};

/// A force within an element, or a stress, as a functional: factors, by unknown, of the forces on its unknowns, of the
/// acceleration; of a load q = (x, y) per extent; of the displacements (what frozen forces add).
struct Cut {
  explicit Cut(std::size_t unknowns)
      : forces(ElementVector::Zero(static_cast<Eigen::Index>(unknowns))),
        acceleration(forces),
        deflection(forces) {}
  ElementVector forces, acceleration;
  PlaneVector load{0.0, 0.0};
  ElementVector deflection;
};

/// A straight line between two of its nodes, of which it is drawn; beam: bent as a beam is.
struct ElementLine {
  std::size_t from = 0, to = 1;
  bool bends = false;
};

class FiniteElement {
 public:
  /// nodes: of the mesh; member: index into Scene::members.
  FiniteElement(std::vector<int> nodes, int member) : nodes_(std::move(nodes)), member_(member) {}
  virtual ~FiniteElement() = default;
  FiniteElement(const FiniteElement&) = delete;
  FiniteElement& operator=(const FiniteElement&) = delete;

  [[nodiscard]] const std::vector<int>& nodes() const { return nodes_; }
  [[nodiscard]] int member() const { return member_; }
  [[nodiscard]] virtual std::vector<ElementUnknown> unknowns() const = 0;
  /// Does it have unknowns of its own?
  [[nodiscard]] virtual bool has_own() const { return false; }

  /// Length or area, and mass for each of it.
  [[nodiscard]] virtual double extent() const = 0;
  [[nodiscard]] virtual double density() const = 0;

  // In the scene's axes, symmetric to rounding; forces on unknowns by their displacements or accelerations.
  [[nodiscard]] virtual ElementMatrix mass() const = 0;
  [[nodiscard]] virtual ElementMatrix stiffness() const = 0;
  /// Whether frozen forces have a stiffness: without one run.geometric is refused.
  [[nodiscard]] virtual bool has_geometric() const { return false; }
  [[nodiscard]] virtual ElementMatrix geometric(const AxialForces& forces) const;
  /// What stands in it under displacements of its unknowns, a strain of its member, a load per extent, and a pull on each
  /// unit of its mass (gravity, the base's acceleration).
  [[nodiscard]] virtual AxialForces axial_forces(const ElementVector& u, double strain,
                                                 const PlaneVector& load, const PlaneVector& pull) const;

  /// Forces on its unknowns of a load that is spread evenly, per extent.
  [[nodiscard]] virtual ElementVector spread(const PlaneVector& load) const = 0;
  /// Work of the forces that a strain of one (heat) puts on its unknowns.
  [[nodiscard]] virtual double strain_work(const ElementVector& motion) const = 0;

  /// A section force at a part of its length. Elements without sections have none, and no member is made of them.
  [[nodiscard]] virtual Cut cut(OutputQuantity quantity, const PlaneVector& at,
                                const AxialForces& forces) const;

  /// Of what it is drawn.
  [[nodiscard]] virtual std::vector<ElementLine> lines() const = 0;

  /// A motion of everything by (x, y), as its unknowns have it.
  [[nodiscard]] ElementVector translation(const PlaneVector& by) const;
  /// The forces of strain_work.
  [[nodiscard]] ElementVector strain_forces() const;

 private:
  std::vector<int> nodes_;
  int member_;
};

}  // namespace signorini
