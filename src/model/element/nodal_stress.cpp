#include "model/element/nodal_stress.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "model/element/body_mesh.hpp"
#include "model/element/plane_element.hpp"

namespace signorini {
namespace {

/// Calls `use` with the elements of a body, which mesh_body() has made.
template <class Use>
void for_elements(const Mesh& mesh, const Scene& scene, std::size_t body, const Use& use) {
  const auto owner = static_cast<int>(scene.members.size() + body);
  for (const auto& element : mesh.elements)
    if (element->member() == owner) use(static_cast<const PlaneElement&>(*element));
}

}  // namespace

std::vector<StressTerm> stress_at_node(const Mesh& mesh, const Scene& scene, std::size_t body, int node) {
  std::map<int, Eigen::Matrix<double, 3, 2>> sums;
  double area = 0.0;
  for_elements(mesh, scene, body, [&](const PlaneElement& e) {
    const auto found = std::find(e.nodes().begin(), e.nodes().end(), node);
    if (found == e.nodes().end()) return;
    const Eigen::MatrixXd rows = e.nodal_stress_rows().middleRows<3>(3 * (found - e.nodes().begin()));
    for (std::size_t l = 0; l < e.nodes().size(); ++l) {
      const Eigen::Matrix<double, 3, 2> own = rows.middleCols<2>(static_cast<Eigen::Index>(2 * l));
      sums.try_emplace(e.nodes()[l], Eigen::Matrix<double, 3, 2>::Zero()).first->second += e.extent() * own;
    }
    area += e.extent();
  });
  std::vector<StressTerm> terms;
  for (const auto& [l, sum] : sums) terms.push_back({l, sum / area});
  return terms;
}

Eigen::SparseMatrix<double, Eigen::RowMajor> nodal_stresses(const Mesh& mesh, const Scene& scene,
                                                            std::size_t body) {
  const BodySpec& spec = scene.bodies[body];
  const auto count = static_cast<Eigen::Index>(spec.node_count);
  const auto own = [&](int node) { return node - static_cast<int>(spec.first_node); };
  std::vector<double> area(spec.node_count, 0.0);
  for_elements(mesh, scene, body, [&](const PlaneElement& e) {
    for (const int n : e.nodes()) area[static_cast<std::size_t>(own(n))] += e.extent();
  });
  std::vector<Eigen::Triplet<double>> entries;
  for_elements(mesh, scene, body, [&](const PlaneElement& e) {
    const Eigen::MatrixXd rows = e.nodal_stress_rows();
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      const int k = own(e.nodes()[static_cast<std::size_t>(i / 3)]);
      const double share = e.extent() / area[static_cast<std::size_t>(k)];
      for (Eigen::Index j = 0; j < rows.cols(); ++j) {
        const int l = own(e.nodes()[static_cast<std::size_t>(j / 2)]);
        entries.emplace_back(3 * k + static_cast<int>(i % 3), 2 * l + static_cast<int>(j % 2),
                             share * rows(i, j));
      }
    }
  });
  Eigen::SparseMatrix<double, Eigen::RowMajor> all(3 * count, 2 * count);
  all.setFromTriplets(entries.begin(), entries.end());
  return all;
}

Eigen::Vector3d stress_of_heat(const BodySpec& body) {
  const PlaneMaterial material = material_of(body);
  return -(material.stresses() * material.thermal_strain());
}

double mises(const BodySpec& body, const Eigen::Vector3d& stress, double heat) {
  const double x = stress[0], y = stress[1], xy = stress[2];
  const double z = body.strain ? body.nu * (x + y) - body.E * heat : 0.0;
  return std::sqrt(0.5 * ((x - y) * (x - y) + (y - z) * (y - z) + (z - x) * (z - x)) + 3.0 * xy * xy);
}

}  // namespace signorini
