// Orders of convergence in the energy norm and of stresses at nodes, by an exact solution of plane elasticity.
#include <doctest/doctest.h>

#include <Eigen/LU>
#include <complex>

#include "model/element/nodal_stress.hpp"
#include "unit/model/element/plane_parts.hpp"

using namespace signorini;
using namespace signorini::test;

namespace {

/// 2 G (u + i v) = kappa phi - z conj(phi'),  sigma_x + sigma_y = 4 Re phi',  sigma_y - sigma_x + 2 i tau = 2 conj(z) phi''
/// with phi = exp z (Kolosov, Muskhelishvili).
struct Exponential {
  element::PlaneMaterial material;
  [[nodiscard]] double G() const { return material.E / (2.0 * (1.0 + material.nu)); }
  [[nodiscard]] double kappa() const {
    return material.plane_strain ? 3.0 - 4.0 * material.nu : (3.0 - material.nu) / (1.0 + material.nu);
  }
  [[nodiscard]] element::PlaneVector displacement(double x, double y) const {
    const std::complex<double> z(x, y), e = std::exp(z);
    const std::complex<double> w = (kappa() * e - z * std::conj(e)) / (2.0 * G());
    return {w.real(), w.imag()};
  }
  [[nodiscard]] Eigen::Vector3d stress(double x, double y) const {
    const std::complex<double> z(x, y), e = std::exp(z);
    const double sum = 4.0 * e.real();
    const std::complex<double> rest = 2.0 * std::conj(z) * e;
    return {0.5 * (sum - rest.real()), 0.5 * (sum + rest.real()), 0.5 * rest.imag()};
  }
};

struct StressErrors {
  double energy = 0.0;  ///< sqrt(int (s_h - s) D^-1 (s_h - s)) over that of s
  double nodes = 0.0;   ///< greatest at nodes inside
};

StressErrors stress_errors(PlaneShape shape, int n, bool strain) {
  const Exponential exact{{3.0e4, 0.3, 1.0, 1.0, strain}};
  // Neither square nor along the axes.
  const PlaneSystem system(mesh::rectangle_mesh({{0.1, -0.3}, {1.0, 0.8}, 0.37}, {shape, {n, n}, {1.7, 0.6}}),
                           exact.material);
  const Eigen::VectorXd u0 = system.sampled([&](double x, double y) { return exact.displacement(x, y); });
  std::vector<bool> held(static_cast<std::size_t>(system.size()), false),
      edge(system.mesh.nodes.size(), false);
  for (const auto& group : system.mesh.groups)
    for (const int k : group.nodes) {
      edge[static_cast<std::size_t>(k)] = true;
      held[static_cast<std::size_t>(2 * k)] = held[static_cast<std::size_t>(2 * k + 1)] = true;
    }
  const Eigen::VectorXd u = system.solve(Eigen::VectorXd::Zero(system.size()), held, u0);
  const Eigen::Matrix3d compliance = exact.material.elasticity_matrix().inverse();
  const PlaneShape points = mesh::corner_count(shape) == 3 ? PlaneShape::t6 : PlaneShape::q8;
  double error = 0.0, whole = 0.0;
  std::vector<Eigen::Vector3d> mean(system.mesh.nodes.size(), Eigen::Vector3d::Zero());
  std::vector<double> area(system.mesh.nodes.size(), 0.0);
  for (std::size_t e = 0; e < system.elements.size(); ++e) {
    const element::PlaneElement& element = *system.elements[e];
    const Eigen::VectorXd own = system.of_element(e, u);
    for (const mesh::IntegrationPoint& p : mesh::integration_points(points)) {
      const mesh::ShapeValues shapes = mesh::shape_functions(shape, p.a, p.b);
      Eigen::Vector2d at(0.0, 0.0);
      Eigen::Matrix2d j = Eigen::Matrix2d::Zero();
      for (std::size_t k = 0; k < element.nodes().size(); ++k) {
        const auto& node = system.node(element.nodes()[k]);
        at += shapes.values[static_cast<Eigen::Index>(k)] * Eigen::Vector2d(node.x, node.y);
        j += Eigen::Vector2d(node.x, node.y) * shapes.gradients.row(static_cast<Eigen::Index>(k));
      }
      const Eigen::Vector3d wanted = exact.stress(at[0], at[1]);
      const Eigen::Vector3d off = element.stress_rows(p.a, p.b) * own - wanted;
      error += p.weight * j.determinant() * off.dot(compliance * off);
      whole += p.weight * j.determinant() * wanted.dot(compliance * wanted);
    }
    const Eigen::VectorXd stresses = element.nodal_stress_rows() * own;
    for (std::size_t k = 0; k < element.nodes().size(); ++k) {
      const auto node = static_cast<std::size_t>(element.nodes()[k]);
      mean[node] += element.extent() * stresses.segment<3>(3 * static_cast<Eigen::Index>(k));
      area[node] += element.extent();
    }
  }
  StressErrors errors;
  errors.energy = std::sqrt(error / whole);
  for (std::size_t k = 0; k < mean.size(); ++k) {
    if (edge[k]) continue;
    const Eigen::Vector3d wanted = exact.stress(system.mesh.nodes[k].x, system.mesh.nodes[k].y);
    errors.nodes = std::max(errors.nodes, (mean[k] / area[k] - wanted).norm() / wanted.norm());
  }
  return errors;
}

}  // namespace

TEST_SUITE_BEGIN("unit/model/element/plane_orders");

TEST_CASE(
    "stresses converge with order 1 (t3, q4) and 2 (t6, q8) in the energy norm, at inner nodes no slower") {
  for (const bool strain : {false, true})
    for (const PlaneShape shape : all_plane_shapes) {
      CAPTURE(strain);
      CAPTURE(name_of(shape));
      const double order = mesh::has_midside_nodes(shape) ? 2.0 : 1.0;
      const StressErrors coarse = stress_errors(shape, 6, strain), fine = stress_errors(shape, 12, strain);
      CAPTURE(coarse.energy);
      CAPTURE(fine.energy);
      CAPTURE(coarse.nodes);
      CAPTURE(fine.nodes);
      CHECK(std::log2(coarse.energy / fine.energy) >= order - 0.1);
      CHECK(fine.energy <= 0.1);
      CHECK(std::log2(coarse.nodes / fine.nodes) >= order - 0.1);
    }
}

TEST_SUITE_END();
