#include "model/massless.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/rounding.hpp"
#include "base/text.hpp"
#include "linear/sparse_cholesky.hpp"
#include "model/assembly/dofs.hpp"
#include "model/assembly/motion_names.hpp"
#include "model/assembly/springs.hpp"
#include "model/statics/mechanisms.hpp"

namespace signorini::model {
namespace {

/// Factor w of C in K + w C, the sum used if K alone does not resist all motions. 1e8 is half of the 16 digits of a double.
constexpr double damping_weight = 1e8;

/// Block of s_i A_ij s_j for rows and columns with position[i] >= 0; position[i] is the row of i in the block.
SparseMatrix block(const SparseMatrix& a, const std::vector<int>& position, int size, const Vector& s) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int k = 0; k < a.outerSize(); ++k)
    for (SparseMatrix::InnerIterator it(a, k); it; ++it) {
      const int i = position[static_cast<std::size_t>(it.row())], j = position[static_cast<std::size_t>(k)];
      if (i >= 0 && j >= 0) entries.emplace_back(i, j, s[it.row()] * it.value() * s[k]);
    }
  SparseMatrix b(size, size);
  b.setFromTriplets(entries.begin(), entries.end());
  return b;
}

double largest_diagonal(const SparseMatrix& a) {
  return a.rows() == 0 ? 0.0 : a.diagonal().cwiseAbs().maxCoeff();
}

}  // namespace

void mark_massless(const Scene& scene, const assembly::DofMap& map, const assembly::Assembly& assembly,
                   std::vector<Dof>& dofs) {
  const auto n = static_cast<int>(dofs.size());
  Vector row_size = Vector::Zero(n), held = Vector::Zero(n), s = Vector::Zero(n);
  auto add_rows = [](const SparseMatrix& a, Vector& rows) {
    for (int k = 0; k < a.outerSize(); ++k)
      for (SparseMatrix::InnerIterator it(a, k); it; ++it) rows[it.row()] += std::abs(it.value());
  };
  add_rows(assembly.mass, row_size);
  add_rows(assembly.stiffness, held);
  add_rows(assembly.dampers, held);
  std::vector<int> position(dofs.size(), -1);
  int heavy = 0;
  for (int i = 0; i < n; ++i) {
    Dof& dof = dofs[static_cast<std::size_t>(i)];
    dof.massless = row_size[i] == 0.0;
    if (dof.massless && held[i] == 0.0)
      throw SceneError(assembly::place_of_dof(scene, map, i), "",
                       fmt::format("{} has neither mass nor stiffness nor damping, so its motion is "
                                   "undetermined; give it a mass, a stiffness or a damper",
                                   dof.displacement));
    if (dof.massless) continue;
    const double diagonal = assembly.mass.coeff(i, i);
    if (!(diagonal > 0.0))
      throw SceneError(
          assembly::place_of_structure(scene), "matrices.mass",
          fmt::format("found {} on the diagonal at {}, expected a number > 0, or a row of zeros for a "
                      "massless degree of freedom",
                      diagonal, dof.displacement));
    s[i] = 1.0 / std::sqrt(diagonal);
    position[static_cast<std::size_t>(i)] = heavy++;
  }
  if (heavy == 0)
    throw SceneError(assembly::place_of_structure(scene), "",
                     "nothing in the scene has mass; give masses, densities or mass_per_length");
  // After scaling to a unit diagonal the pivots are dimensionless.
  const linear::SymmetricSolver solver(block(assembly.mass, position, heavy, s));
  if (!solver.ok() || solver.smallest_pivot() <= rounding::many_operations * heavy)
    throw SceneError(
        assembly::place_of_structure(scene), "matrices.mass",
        "the mass matrix is not positive definite on the degrees of freedom whose rows are not zero; correct "
        "it, or give massless degrees of freedom rows and columns of zeros");
}

void check_massless(const Scene& scene, const Model& model, const assembly::DofMap& map) {
  std::vector<int> position, where;
  for (int i = 0; i < model.size(); ++i) {
    const bool massless = model.dofs[static_cast<std::size_t>(i)].massless;
    position.push_back(massless ? static_cast<int>(where.size()) : -1);
    if (massless) where.push_back(i);
  }
  if (where.empty()) return;
  const auto describe = [&](const Eigen::MatrixXd& motions) {
    Vector motion = Vector::Zero(model.size());
    for (std::size_t j = 0; j < where.size(); ++j)
      motion[where[j]] = motions(static_cast<Eigen::Index>(j), 0);
    return assembly::describe_motion(motion, map);
  };
  const auto count = static_cast<int>(where.size());
  const Vector ones = Vector::Ones(model.size());
  const SparseMatrix k =
      block(assembly::with_springs(model.stiffness, assembly::contact_springs(model.contacts)), position,
            count, ones);
  const SparseMatrix c = block(model.damping, position, count, ones);
  const SparseMatrix symmetric = 0.5 * (c + SparseMatrix(c.transpose()));
  // If K resists all motions, any positive weight of C is suitable; this value makes C and K equal in size. If K does
  // not, C needs a larger weight, because null_motions() also returns motions of negative energy.
  const double weight = largest_diagonal(c) > 0.0 && largest_diagonal(k) > 0.0
                            ? largest_diagonal(k) / largest_diagonal(c)
                            : 1.0;
  Eigen::MatrixXd null = statics::null_motions(SparseMatrix(k + weight * symmetric));
  if (null.cols() == 0) return;
  null = statics::null_motions(SparseMatrix(k + damping_weight * weight * symmetric));
  if (null.cols() == 0) return;
  const Vector motion = null.col(0) / null.col(0).cwiseAbs().maxCoeff();
  const double energy = motion.dot(k * motion);
  Eigen::Index most = 0;
  motion.cwiseAbs().maxCoeff(&most);
  const SourcePlace place = assembly::place_of_dof(scene, map, where[static_cast<std::size_t>(most)]);
  if (energy < -rounding::many_operations * assembly::term_magnitude(k, motion))
    throw SceneError(
        place, scene.matrices ? "matrices.stiffness" : "",
        fmt::format(
            "the {} is unstable: it moves no mass and no damper, and its stiffness, including contacts, is "
            "{:.6g}; expected a stiffness > 0, or a mass or damper that this motion moves",
            describe(null), energy));
  throw SceneError(place, "",
                   fmt::format("the {} is undetermined: it moves no mass, and no stiffness, damping or "
                               "contact restrains it; add one of these",
                               describe(null)));
}

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

/// Massless degrees of freedom with a damper.
std::vector<int> damped_massless_dofs(const Model& model) {
  std::vector<int> list;
  for (int i = 0; i < model.size(); ++i)
    if (model.dofs[static_cast<std::size_t>(i)].massless && model.damping.coeff(i, i) > 0.0)
      list.push_back(i);
  return list;
}

/// C restricted to the degrees of freedom in `list`.
SparseMatrix part_of(const SparseMatrix& c, const std::vector<int>& list) {
  std::vector<int> position(static_cast<std::size_t>(c.rows()), -1);
  for (std::size_t j = 0; j < list.size(); ++j)
    position[static_cast<std::size_t>(list[j])] = static_cast<int>(j);
  Triplets entries;
  for (int column = 0; column < c.outerSize(); ++column)
    for (SparseMatrix::InnerIterator it(c, column); it; ++it) {
      const int row = position[static_cast<std::size_t>(it.row())],
                at = position[static_cast<std::size_t>(column)];
      if (row >= 0 && at >= 0) entries.emplace_back(row, at, it.value());
    }
  const auto size = static_cast<Eigen::Index>(list.size());
  SparseMatrix part(size, size);
  part.setFromTriplets(entries.begin(), entries.end());
  return part;
}

/// Changes z to another basis of the same space: for each column there is a row with 1 in this column and 0 in all other
/// columns. Returns these rows, one per column.
std::vector<Eigen::Index> reduce_to_pivot_rows(Eigen::MatrixXd& z) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index j = 0; j < z.cols(); ++j) {
    Eigen::Index row = 0;
    z.col(j).cwiseAbs().maxCoeff(&row);
    z.col(j) /= z(row, j);
    for (Eigen::Index other = 0; other < z.cols(); ++other)
      if (other != j) z.col(other) -= z(row, other) * z.col(j);
    rows.push_back(row);
  }
  for (Eigen::Index j = 0; j < z.cols(); ++j) {
    const double rounding = rounding::many_operations * z.col(j).cwiseAbs().maxCoeff();
    for (double& x : z.col(j)) x = std::abs(x) <= rounding ? 0.0 : x;
  }
  return rows;
}

/// B^T n, with terms of rounding size set to zero.
Combination in_basis(const Combination& form, const SparseMatrix& basis) {
  Vector sum = Vector::Zero(basis.cols()), size = sum;
  for (const auto& [i, factor] : form.terms)
    for (int j = 0; j < basis.outerSize(); ++j)
      if (const double b = basis.coeff(i, j); b != 0.0) {
        sum[j] += factor * b;
        size[j] += std::abs(factor * b);
      }
  Combination result;
  for (int j = 0; j < sum.size(); ++j)
    if (std::abs(sum[j]) > rounding::few_operations * size[j]) result.terms.emplace_back(j, sum[j]);
  return result;
}

void change_basis(Model& model, const SparseMatrix& basis, const std::vector<bool>& undamped) {
  model.stiffness = SparseMatrix(basis.transpose() * SparseMatrix(model.stiffness * basis));
  model.damping = SparseMatrix(basis.transpose() * SparseMatrix(model.damping * basis));
  model.damping.prune([&](Eigen::Index row, Eigen::Index column, double) {
    return !undamped[static_cast<std::size_t>(row)] && !undamped[static_cast<std::size_t>(column)];
  });
  for (Load& load : model.loads) load.direction = in_basis(load.direction, basis);
  for (Contact& contact : model.contacts) {
    contact.normal = in_basis(contact.normal, basis);
    contact.tangent = in_basis(contact.tangent, basis);
  }
  // B^-1 = 2 I - B, because (B - I)^2 = 0: B adds multiples of unchanged degrees of freedom to other ones.
  for (Vector* x : {&model.u0, &model.v0}) *x = 2.0 * *x - basis * *x;
  model.basis = basis;
}

}  // namespace

void separate_undamped(Model& model) {
  const std::vector<int> damped = damped_massless_dofs(model);
  if (damped.empty()) return;
  Eigen::MatrixXd z = statics::null_motions(part_of(model.damping, damped));
  if (z.cols() == 0) return;
  const std::vector<Eigen::Index> rows = reduce_to_pivot_rows(z);
  const int n = model.size();
  SparseMatrix basis(n, n);
  Triplets entries;
  for (int i = 0; i < n; ++i) entries.emplace_back(i, i, 1.0);
  std::vector<bool> undamped(static_cast<std::size_t>(n), false);
  for (Eigen::Index j = 0; j < z.cols(); ++j) {
    const int p = damped[static_cast<std::size_t>(rows[static_cast<std::size_t>(j)])];
    undamped[static_cast<std::size_t>(p)] = true;
    for (Eigen::Index i = 0; i < z.rows(); ++i)
      if (const int row = damped[static_cast<std::size_t>(i)]; row != p && z(i, j) != 0.0)
        entries.emplace_back(row, p, z(i, j));
  }
  basis.setFromTriplets(entries.begin(), entries.end());
  change_basis(model, basis, undamped);
}

namespace {

constexpr std::size_t rotation = 2, most_listed = 3;

/// For each node: whether elements end there, whether one of them rotates with the node, and whether one is a plane element.
class Turning {
 public:
  explicit Turning(const assembly::DofMap& map) : map_(map), nodes_(map.mesh.nodes.size()) {
    for (const auto& e : map.mesh.elements) {
      for (const int node : e->nodes()) {
        at(node).carried = true;
        at(node).plane = at(node).plane || e->nodes().size() > 2;
      }
      for (const element::ElementUnknown& unknown : e->unknowns())
        if (!unknown.internal && unknown.component == rotation)
          at(e->nodes()[unknown.local_node]).turns = true;
    }
  }
  /// True if elements end at the node, but neither an element nor a rigid body rotates with the node.
  [[nodiscard]] bool idle(const std::string& node) const {
    const int n = map_.mesh.by_name.at(node);
    const Node& here = nodes_[static_cast<std::size_t>(n)];
    return here.carried && !here.turns && map_.body[static_cast<std::size_t>(n)] == assembly::DofMap::absent;
  }
  [[nodiscard]] bool has_plane_element(const std::string& node) const {
    return nodes_[static_cast<std::size_t>(map_.mesh.by_name.at(node))].plane;
  }

 private:
  struct Node {
    bool carried = false, turns = false, plane = false;
  };
  Node& at(int node) { return nodes_[static_cast<std::size_t>(node)]; }

  const assembly::DofMap& map_;
  std::vector<Node> nodes_;
};

/// Table keys and the nodes that they name, in the order of the scene.
using Named = std::vector<std::pair<std::string, std::vector<std::string>>>;

void name(Named& list, const std::string& key, const std::string& node) {
  if (list.empty() || list.back().first != key) list.push_back({key, {}});
  if (list.back().second.empty() || list.back().second.back() != node) list.back().second.push_back(node);
}

std::string nodes_of(const std::vector<std::string>& nodes) {
  return (nodes.size() == 1 ? "node " : "nodes ") + base::join_quoted(nodes, most_listed);
}

}  // namespace

std::vector<std::string> unconnected_rotations(const Scene& scene, const assembly::DofMap& map) {
  if (map.is_matrix_scene()) return {};
  const Turning turning(map);
  Named moved, held;
  for (const PointMass& mass : scene.masses)
    if (mass.inertia > 0.0 && turning.idle(mass.node)) name(moved, "inertia", mass.node);
  for (const Spring& spring : scene.springs) {
    if (spring.rotation_stiffness == 0.0 && spring.rotation_damping == 0.0) continue;
    for (const std::string& node : {spring.node, spring.against})
      if (!node.empty() && turning.idle(node)) name(moved, "a rotational spring", node);
  }
  for (const Support& support : scene.supports)
    if (support.rz && turning.idle(support.node) && turning.has_plane_element(support.node))
      name(held, support.key, support.node);
  std::vector<std::string> warnings;
  for (const auto& [what, nodes] : moved)
    warnings.push_back(fmt::format("{} at {} has no effect on the structure: no element rotates with {}",
                                   what, nodes_of(nodes), nodes.size() == 1 ? "it" : "them"));
  for (const auto& [key, nodes] : held)
    warnings.push_back(
        fmt::format("{}.fix: rz at {} has no effect, because elements of bodies have no rotations; to clamp "
                    "a body, fix ux and uy of several nodes",
                    key, nodes_of(nodes)));
  return warnings;
}

}  // namespace signorini::model
