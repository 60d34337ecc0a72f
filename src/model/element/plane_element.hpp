// plane_element.hpp: triangles and quadrilaterals of a plane continuum.
//
//   k = t int B^T D B,   m = rho t int N^T N,   sigma = D (B u - alpha T e),   strains (e_x, e_y, g_xy)
//
//   plane stress  D = E/(1 - nu^2) [1 nu 0; nu 1 0; 0 0 (1 - nu)/2],             e = (1, 1, 0)
//   plane strain  D = E/((1 + nu)(1 - 2 nu)) [1 - nu, nu, 0; nu, 1 - nu, 0; 0 0 (1 - 2 nu)/2],  e = (1 + nu)(1, 1, 0)
//
// q4 has two incompatible modes, 1 - a^2 and 1 - b^2, each for ux and uy (QM6). The derivatives of these modes by x, y use
// the Jacobian at the element's centre and det J_0 / det J. The modes therefore do no work in a constant stress, and
// distorted elements represent a constant stress exactly. The modes have no mass and are eliminated in the element.
// A lumped mass: row sums for t3 and q4; for t6 and q8 the diagonal, scaled to the total mass, so that no entry is
// negative.
// Stresses are evaluated at Barlow's points and extrapolated to the nodes. The error of these stresses has nearly the
// order of the displacement error, one order better than that of strains evaluated at the nodes.
// Source: Barlow, Int. J. Numer. Meth. Eng. 10 (1976) 243; Taylor, Beresford, Wilson, Int. J. Numer. Meth.
// Eng. 10 (1976) 1211; Hinton, Rock, Zienkiewicz, Earthq. Eng. Struct. Dyn. 4 (1976) 245.
#pragma once

#include "mesh/shape_functions.hpp"
#include "model/element/element.hpp"

namespace signorini::element {

/// Units: E force/length^2, density mass/length^3.
struct PlaneMaterial {
  double E = 0.0, nu = 0.0, density = 0.0, thickness = 1.0;
  bool plane_strain = false;  ///< plane strain; false: plane stress

  [[nodiscard]] Eigen::Matrix3d elasticity_matrix() const;  ///< D
  [[nodiscard]] Eigen::Vector3d thermal_strain() const;     ///< e
};

class PlaneElement final : public FiniteElement {
 public:
  /// at: positions of the nodes.
  PlaneElement(std::vector<int> nodes, int member, PlaneShape shape, std::vector<PlaneVector> at,
               const PlaneMaterial& material, MassKind mass);

  [[nodiscard]] std::vector<ElementUnknown> unknowns() const override;
  [[nodiscard]] double extent() const override { return area_; }
  [[nodiscard]] double density() const override { return material_.density * material_.thickness; }
  [[nodiscard]] ElementMatrix mass() const override;
  [[nodiscard]] ElementMatrix stiffness() const override;
  [[nodiscard]] ElementVector load_vector(const PlaneVector& load) const override;
  [[nodiscard]] double strain_work(const ElementVector& motion) const override;
  [[nodiscard]] std::vector<ElementLine> lines() const override;

  [[nodiscard]] PlaneShape shape() const { return shape_; }
  [[nodiscard]] const PlaneMaterial& material() const { return material_; }
  /// Factors of the unknowns in sigma_x, sigma_y, tau_xy at (a, b), without thermal stresses: 3 x unknowns.
  [[nodiscard]] Eigen::MatrixXd stress_rows(double a, double b) const;
  /// Points of highest accuracy: the centre of t3 and q4, 3 points of t6, 2 x 2 of q8.
  struct StressSample {
    PlaneVector at{0.0, 0.0};
    Eigen::MatrixXd rows;  ///< rows of stress_rows()
  };
  [[nodiscard]] std::vector<StressSample> stress_samples() const;
  /// Stresses at the nodes, rows 3 k to 3 k + 2 for node k, extrapolated from the points of highest accuracy. t3:
  /// constant; t6: linear through 3 points; q4, q8: bilinear through 2 x 2.
  [[nodiscard]] Eigen::MatrixXd nodal_stress_rows() const;

 private:
  struct PointShapes {
    Eigen::VectorXd values;
    Eigen::MatrixX2d slopes;  // derivatives by x and y
    double det;
  };
  [[nodiscard]] PointShapes at_point(double a, double b) const;
  [[nodiscard]] Eigen::Matrix2d jacobian(const Eigen::MatrixX2d& slopes) const;
  [[nodiscard]] Eigen::MatrixXd strain_rows(const PointShapes& place) const;
  [[nodiscard]] Eigen::Matrix<double, 3, 4> incompatible_rows(double a, double b, double det) const;
  [[nodiscard]] Eigen::MatrixXd incompatible_motion() const;
  [[nodiscard]] Eigen::MatrixXd mass_of_nodes() const;

  PlaneShape shape_;
  std::vector<PlaneVector> at_;
  PlaneMaterial material_;
  MassKind mass_;
  double area_ = 0.0;
};

}  // namespace signorini::element
