#include "model/element/nodal_stress.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "base/eigen_dense.hpp"
#include "mesh/shape_functions.hpp"
#include "model/element/body_mesh.hpp"
#include "model/element/plane_element.hpp"

namespace signorini::element {
namespace {

// Limits of sum |c_j| >= 1, the factor by which errors at the stress points grow at a node: `inside` for the node's own
// elements, max_amplification for neighbours. Chosen values; the tests body_stresses depend on them. At an inner node of squares
// the sum is 1 (plane) or below 1.5 (parabola); at a boundary it is 2 for a line through two evenly spaced points, and 2.5
// for a plane at a corner.
constexpr double inside = 1.5, max_amplification = 10.0;
constexpr double alike = 1e-6;  // relative difference of sum |c_j| below which two patches are equal
constexpr double met = 1e-9;    // largest residual of the conditions for c, if a polynomial exists

/// Monomials x^i y^j, i + j <= degree.
Eigen::VectorXd powers(double x, double y, int degree) {
  Eigen::VectorXd q((degree + 1) * (degree + 2) / 2);
  Eigen::Index k = 0;
  for (int order = 0; order <= degree; ++order)
    for (int j = 0; j <= order; ++j) q[k++] = std::pow(x, order - j) * std::pow(y, j);
  return q;
}

/// The stresses of a body as functions of its displacements.
class BodyStresses {
 public:
  /// mesh: must contain the elements of the body, from mesh_body().
  BodyStresses(const Mesh& mesh, const Scene& scene, std::size_t body)
      : mesh_(mesh),
        first_(static_cast<int>(scene.bodies[body].first_node)),
        around_(scene.bodies[body].node_count) {
    const auto owner = static_cast<int>(scene.members.size() + body);
    for (const auto& element : mesh.elements) {
      if (element->member() != owner) continue;
      for (const int node : element->nodes()) around_[own(node)].push_back(elements_.size());
      elements_.push_back(static_cast<const PlaneElement*>(element.get()));
    }
    samples_.resize(elements_.size());
  }

  [[nodiscard]] std::vector<StressTerm> at(int node) {
    const int degree = degree_at(node);
    std::vector<Fit> fits;
    fits.push_back(fitted(node, around_[own(node)], degree));
    if (fits.front().amplified <= inside) return terms_of(fits.front().sums);
    for (Fit& fit : at_neighbours(node, degree)) fits.push_back(std::move(fit));
    if (degree > 1 && is_extrapolated(fits))
      if (const auto sums = best_of(at_neighbours(node, degree + 1))) return terms_of(*sums);
    if (const auto sums = best_of(fits)) return terms_of(*sums);
    return mean(node);
  }

 private:
  using Rows = Eigen::Matrix<double, 3, 2>;
  using Sums = std::map<int, Rows>;  // by node
  struct Fit {
    double amplified = std::numeric_limits<double>::infinity();
    Sums sums;
  };

  /// Degree of the polynomial of the stresses in the elements at a node.
  [[nodiscard]] int degree_at(int node) const {
    const std::vector<std::size_t>& ring = around_[own(node)];
    return !ring.empty() && mesh::has_midside_nodes(elements_[ring.front()]->shape()) ? 2 : 1;
  }
  /// Polynomials through the stress points around each neighbour, evaluated at the node.
  [[nodiscard]] std::vector<Fit> at_neighbours(int node, int degree) {
    std::vector<Fit> fits;
    for (const int other : neighbours(node)) fits.push_back(fitted(node, around_[own(other)], degree));
    return fits;
  }
  /// True if the polynomial through the node's own elements, which is the first one, and that of the best neighbour are
  /// extrapolated: then the node lies at a boundary.
  [[nodiscard]] static bool is_extrapolated(const std::vector<Fit>& fits) {
    double least = std::numeric_limits<double>::infinity();
    for (const Fit& fit : fits) least = std::min(least, fit.amplified);
    return least > inside && fits.front().amplified > (1.0 + alike) * least;
  }
  /// Mean of the fits with the smallest amplification; nullopt if none is suitable.
  [[nodiscard]] static std::optional<Sums> best_of(const std::vector<Fit>& fits) {
    double least = max_amplification;
    for (const Fit& fit : fits) least = std::min(least, fit.amplified);
    const auto is_best = [&](const Fit& fit) { return fit.amplified <= (1.0 + alike) * least; };
    const auto count = static_cast<double>(std::count_if(fits.begin(), fits.end(), is_best));
    if (count == 0.0) return std::nullopt;
    Sums sums;
    for (const Fit& fit : fits)
      if (is_best(fit))
        for (const auto& [n, rows] : fit.sums)
          sums.try_emplace(n, Rows::Zero()).first->second += rows / count;
    return sums;
  }

  const Mesh& mesh_;
  int first_;
  std::vector<std::vector<std::size_t>> around_;  // elements at each node of the body
  std::vector<const PlaneElement*> elements_;
  std::vector<std::vector<PlaneElement::StressSample>> samples_;  // computed on first use; empty before

  [[nodiscard]] std::size_t own(int node) const { return static_cast<std::size_t>(node - first_); }

  const std::vector<PlaneElement::StressSample>& samples(std::size_t element) {
    if (samples_[element].empty()) samples_[element] = elements_[element]->stress_samples();
    return samples_[element];
  }
  /// Nodes of the elements at a node.
  [[nodiscard]] std::set<int> neighbours(int node) const {
    std::set<int> nodes;
    for (const std::size_t e : around_[own(node)])
      nodes.insert(elements_[e]->nodes().begin(), elements_[e]->nodes().end());
    nodes.erase(node);
    return nodes;
  }
  static void add(const PlaneElement& e, double factor, const Eigen::MatrixXd& rows, Sums& sums) {
    for (std::size_t l = 0; l < e.nodes().size(); ++l)
      sums.try_emplace(e.nodes()[l], Rows::Zero()).first->second +=
          factor * rows.middleCols<2>(static_cast<Eigen::Index>(2 * l));
  }
  static std::vector<StressTerm> terms_of(const Sums& sums) {
    std::vector<StressTerm> terms;
    for (const auto& [node, rows] : sums) terms.push_back({node, rows});
    return terms;
  }

  /// Polynomial fit through the stress points of the elements in `ring`; `amplified` is infinite if they do not determine it.
  Fit fitted(int node, const std::vector<std::size_t>& ring, int degree) {
    std::vector<const PlaneElement::StressSample*> points;
    std::vector<const PlaneElement*> of;
    double size = 0.0;
    const MeshNode& at = mesh_.node(node);
    for (const std::size_t e : ring)
      for (const PlaneElement::StressSample& sample : samples(e)) {
        points.push_back(&sample);
        of.push_back(elements_[e]);
        size = std::max(size, std::hypot(sample.at[0] - at.x, sample.at[1] - at.y));
      }
    if (points.empty()) return {};
    const Eigen::VectorXd wanted = powers(0.0, 0.0, degree);
    if (static_cast<Eigen::Index>(points.size()) < wanted.size()) return {};
    Eigen::MatrixXd conditions(wanted.size(), static_cast<Eigen::Index>(points.size()));
    for (std::size_t j = 0; j < points.size(); ++j)
      conditions.col(static_cast<Eigen::Index>(j)) =
          powers((points[j]->at[0] - at.x) / size, (points[j]->at[1] - at.y) / size, degree);
    const Eigen::VectorXd c = base::least_squares(conditions, wanted);
    if ((conditions * c - wanted).cwiseAbs().maxCoeff() > met) return {};
    Fit fit{c.cwiseAbs().sum(), {}};
    for (std::size_t j = 0; j < points.size(); ++j)
      add(*of[j], c[static_cast<Eigen::Index>(j)], points[j]->rows, fit.sums);
    return fit;
  }

  [[nodiscard]] std::vector<StressTerm> mean(int node) const {
    Sums sums;
    double area = 0.0;
    for (const std::size_t k : around_[own(node)]) area += elements_[k]->extent();
    for (const std::size_t k : around_[own(node)]) {
      const PlaneElement& e = *elements_[k];
      const auto place = std::find(e.nodes().begin(), e.nodes().end(), node) - e.nodes().begin();
      add(e, e.extent() / area, e.nodal_stress_rows().middleRows<3>(3 * place), sums);
    }
    return terms_of(sums);
  }
};

}  // namespace

std::vector<StressTerm> stress_at_node(const Mesh& mesh, const Scene& scene, std::size_t body, int node) {
  return BodyStresses(mesh, scene, body).at(node);
}

Eigen::SparseMatrix<double, Eigen::RowMajor> nodal_stresses(const Mesh& mesh, const Scene& scene,
                                                            std::size_t body) {
  const BodySpec& spec = scene.bodies[body];
  const auto count = static_cast<int>(spec.node_count), first = static_cast<int>(spec.first_node);
  BodyStresses stresses(mesh, scene, body);
  std::vector<Eigen::Triplet<double>> entries;
  for (int k = 0; k < count; ++k)
    for (const StressTerm& term : stresses.at(first + k))
      for (int i = 0; i < 3; ++i)
        for (int c = 0; c < 2; ++c)
          entries.emplace_back(3 * k + i, 2 * (term.node - first) + c, term.rows(i, c));
  Eigen::SparseMatrix<double, Eigen::RowMajor> all(3 * count, 2 * count);
  all.setFromTriplets(entries.begin(), entries.end());
  return all;
}

Eigen::Vector3d thermal_stress(const BodySpec& body) {
  const PlaneMaterial material = material_of(body);
  return -(material.elasticity_matrix() * material.thermal_strain());
}

double von_mises_stress(const BodySpec& body, const Eigen::Vector3d& stress, double heat) {
  const double x = stress[0], y = stress[1], xy = stress[2];
  const double z = body.plane_strain ? body.nu * (x + y) - body.E * heat : 0.0;
  return std::sqrt(0.5 * ((x - y) * (x - y) + (y - z) * (y - z) + (z - x) * (z - x)) + 3.0 * xy * xy);
}

}  // namespace signorini::element
