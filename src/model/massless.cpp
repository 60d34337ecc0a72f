#include "model/massless.hpp"

#include <fmt/core.h>

#include <cmath>

#include "base/rounding.hpp"
#include "model/assembly/dof_place.hpp"
#include "model/assembly/motion_names.hpp"
#include "model/assembly/springs.hpp"
#include "model/statics/null_motions.hpp"

namespace signorini {
namespace {

/// Factor that gives C as much weight as K, where K alone does not resist: half of the digits.
constexpr double by_far = 1e8;

/// The rows and columns with `keep`, scaled to s_i A_ij s_j.
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

void mark_massless(const Scene& scene, const DofMap& map, const Assembly& assembly, std::vector<Dof>& dofs) {
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
      throw SceneError(
          place_of_dof(scene, map, i), "",
          fmt::format("{} has neither mass nor stiffness nor damping, so nothing decides its motion",
                      dof.displacement));
    if (dof.massless) continue;
    const double diagonal = assembly.mass.coeff(i, i);
    if (!(diagonal > 0.0))
      throw SceneError(
          place_of_structure(scene), "matrices.mass",
          fmt::format("found {} on the diagonal at {}, expected a number > 0, or a row of zeros for a "
                      "massless degree of freedom",
                      diagonal, dof.displacement));
    s[i] = 1.0 / std::sqrt(diagonal);
    position[static_cast<std::size_t>(i)] = heavy++;
  }
  if (heavy == 0) throw SceneError(place_of_structure(scene), "", "nothing in the scene has mass");
  // After scaling to a unit diagonal the pivots are dimensionless.
  const SymmetricSolver solver(block(assembly.mass, position, heavy, s));
  if (!solver.ok() || solver.smallest_pivot() <= rounding::of_many * heavy)
    throw SceneError(
        place_of_structure(scene), "matrices.mass",
        "the mass matrix must be positive definite on the degrees of freedom whose rows are not zero; "
        "a massless degree of freedom must have a row of zeros only");
}

void check_massless(const Scene& scene, const Model& model, const DofMap& map) {
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
    return describe_motion(motion, map);
  };
  const auto count = static_cast<int>(where.size());
  const Vector ones = Vector::Ones(model.size());
  const SparseMatrix k =
      block(with_springs(model.stiffness, contact_springs(model.contacts)), position, count, ones);
  const SparseMatrix c = block(model.damping, position, count, ones);
  const SparseMatrix symmetric = 0.5 * (c + SparseMatrix(c.transpose()));
  // If K resists all motions, any positive weights will do; these make both matrices count. If it does not, C must
  // count for more, because null_motions also returns motions of negative energy.
  const double weight = largest_diagonal(c) > 0.0 && largest_diagonal(k) > 0.0
                            ? largest_diagonal(k) / largest_diagonal(c)
                            : 1.0;
  Eigen::MatrixXd null = null_motions(SparseMatrix(k + weight * symmetric));
  if (null.cols() == 0) return;
  null = null_motions(SparseMatrix(k + by_far * weight * symmetric));
  if (null.cols() == 0) return;
  const Vector motion = null.col(0) / null.col(0).cwiseAbs().maxCoeff();
  const double energy = motion.dot(k * motion);
  Eigen::Index most = 0;
  motion.cwiseAbs().maxCoeff(&most);
  const SourcePlace place = place_of_dof(scene, map, where[static_cast<std::size_t>(most)]);
  if (energy < -rounding::of_many * term_size(k, motion))
    throw SceneError(
        place, scene.matrices ? "matrices.stiffness" : "",
        fmt::format("the {} is unstable: it moves no mass and no damper, and its stiffness is negative, "
                    "{:.6g}, contacts included; expected a stiffness > 0, or mass or damping on it",
                    describe(null), energy));
  throw SceneError(
      place, "",
      fmt::format("nothing decides the {}: it moves no mass, and no stiffness, damping or contact "
                  "holds it",
                  describe(null)));
}

}  // namespace signorini
