#include "model/assembly/assembly.hpp"

#include <fmt/core.h>
#include <cmath>

#include "base/rounding.hpp"
#include "model/assembly/member_pieces.hpp"
#include "model/assembly/prestress.hpp"
#include "model/assembly/ties.hpp"

namespace signorini::assembly {
namespace {

// Entries a_ij, a_ji may differ by this fraction of the largest entry: other programs print few digits.
constexpr double symmetry_tolerance = 1e-9;

double largest(const SparseMatrix& a) {
  double result = 0.0;
  for (int k = 0; k < a.outerSize(); ++k)
    for (SparseMatrix::InnerIterator it(a, k); it; ++it) result = std::max(result, std::abs(it.value()));
  return result;
}

SparseMatrix read(const MatrixSpec& spec, int n, const std::string& key) {
  SparseMatrix a(n, n);
  if (spec.size == 0 && spec.entries.empty()) return a;  // a missing matrix is zero
  if (spec.size != n)
    throw SceneError(
        spec.place, key,
        fmt::format(
            "found a matrix of size {0} x {0}, expected {1} x {1}, one row and column per degree of freedom",
            spec.size, n));
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& e : spec.entries)
    if (e.value != 0.0) entries.emplace_back(e.row, e.column, e.value);
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

/// Other programs print symmetric matrices with rounded digits, so entries a_ij and a_ji that differ slightly are averaged.
SparseMatrix read_symmetric(const MatrixSpec& spec, int n, const std::string& key) {
  const SparseMatrix a = read(spec, n, key);
  const SparseMatrix transposed = a.transpose();
  const SparseMatrix difference = a - transposed;
  if (largest(difference) > symmetry_tolerance * largest(a))
    throw SceneError(
        spec.place, key,
        "the matrix is not symmetric; expected entries ij and ji that agree to 1e-9 of the largest entry");
  return 0.5 * (a + transposed);
}

}  // namespace

Assembly assemble_matrices(const Scene& scene, const DofMap& map) {
  const MatricesSpec& matrices = *scene.matrices;
  const auto n = static_cast<int>(matrices.dofs.size());
  Assembly a;
  a.mass = read_symmetric(matrices.mass, n, "matrices.mass");
  a.dampers = read(matrices.damping, n, "matrices.damping");
  a.stiffness = read_symmetric(matrices.stiffness, n, "matrices.stiffness");
  a.weight = Vector::Zero(n);
  for (const BaseMotionSpec& motion : scene.base_motion) {
    Vector r = Vector::Zero(n);
    combination(map, motion.direction, "base_motion.direction", false).add_to(r, 1.0);
    a.base.emplace_back(a.mass * r);
  }
  return a;
}

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;
using Column = Vector SupportColumns::*;

struct Builder {
  const Scene& scene;
  const DofMap& map;
  Triplets mass, dampers, stiffness;
  Vector weight, weight_size;  // weight_size: sum of the magnitudes of the terms of each entry
  std::vector<Vector> base;    // one per base motion
  std::vector<SupportColumns> moving;

  /// Adds an element matrix. numbers: numbers of the element's unknowns. Fixed unknowns are omitted; unknowns of moving
  /// supports are added to the support's column.
  template <class Matrix, class Numbers>
  void add(Triplets& target, Column column, const Matrix& a, const Numbers& numbers) {
    if (!any_tied(map, numbers.data(), numbers.size())) return add_own(target, column, a, numbers);
    const TiedElement tied(map, numbers.data(), numbers.size());
    add_own(target, column, tied.transform(a), tied.numbers);
  }

  template <class Matrix, class Numbers>
  void add_own(Triplets& target, Column column, const Matrix& a, const Numbers& numbers) {
    for (std::size_t i = 0; i < numbers.size(); ++i)
      for (std::size_t j = 0; j < numbers.size(); ++j) {
        const double value = a(static_cast<int>(i), static_cast<int>(j));
        if (numbers[i] < 0 || value == 0.0) continue;
        if (numbers[j] >= 0) target.emplace_back(numbers[i], numbers[j], value);
        if (const int s = DofMap::support_of_code(numbers[j]); numbers[j] < 0 && s >= 0)
          (moving[static_cast<std::size_t>(s)].*column)[numbers[i]] += value;
      }
  }

  void add_element(std::size_t number) {
    const element::FiniteElement& e = map.mesh.element(number);
    const std::vector<int> numbers = map.element_numbers(number);
    const element::ElementMatrix m = e.mass();
    if (!map.within_body(e)) add(stiffness, &SupportColumns::stiffness, e.stiffness(), numbers);
    if (const auto moved = map.mesh.moved.find(number); moved != map.mesh.moved.end())
      return add_moved_mass(m, moved->second);
    add(mass, &SupportColumns::mass, m, numbers);
    add_inertia(m * e.translation(scene.gravity), numbers,
                [&](int n, double force) { add_weight(n, force); });
    for (std::size_t i = 0; i < base.size(); ++i)
      add_inertia(m * e.translation(scene.base_motion[i].direction.vector), numbers,
                  [&](int n, double force) { map.add(base[i], n, force); });
  }

  /// Adds the mass matrix W^T m W, W = moved.weights. W maps rigid translations to themselves, so weight and base motion act
  /// on the whole mass.
  void add_moved_mass(const element::ElementMatrix& m, const element::MovedMass& moved) {
    std::vector<int> numbers;
    element::ElementVector gravity(static_cast<Eigen::Index>(2 * moved.nodes.size()));
    std::vector<element::ElementVector> along(base.size(), gravity);
    for (std::size_t i = 0; i < moved.nodes.size(); ++i)
      for (std::size_t c = 0; c < 2; ++c) {
        const auto at = static_cast<Eigen::Index>(2 * i + c);
        numbers.push_back(map.numbers_at(moved.nodes[i])[c]);
        gravity[at] = scene.gravity[c];
        for (std::size_t k = 0; k < base.size(); ++k) along[k][at] = scene.base_motion[k].direction.vector[c];
      }
    const element::ElementMatrix own = moved.weights.transpose() * m * moved.weights;
    add(mass, &SupportColumns::mass, own, numbers);
    add_inertia(own * gravity, numbers, [&](int n, double force) { add_weight(n, force); });
    for (std::size_t k = 0; k < base.size(); ++k)
      add_inertia(own * along[k], numbers, [&](int n, double force) { map.add(base[k], n, force); });
  }

  /// Adds the geometric stiffness of an element to the stiffness matrix and to the columns of moving supports.
  void add_geometric(std::size_t number) {
    const element::FiniteElement& e = map.mesh.element(number);
    const element::AxialForces forces = map.axial_forces_in(number);
    if (forces.is_zero() || map.within_body(e)) return;
    add(stiffness, &SupportColumns::stiffness, e.geometric_stiffness(forces), map.element_numbers(number));
  }

  void add_weight(int number, double force) {
    for (const TiedTerm& term : map.terms(number)) {
      if (term.number < 0) continue;
      weight[term.number] += force * term.factor;
      weight_size[term.number] += std::abs(force * term.factor);
    }
  }
  /// Sets rounding errors of the weight to zero, such as the moment of a body directly above its support.
  void zero_rounding_errors() {
    for (Eigen::Index i = 0; i < weight.size(); ++i)
      if (std::abs(weight[i]) <= rounding::few_operations * weight_size[i]) weight[i] = 0.0;
  }

  /// Calls add_to(number, force) for each unknown of an element. forces: mass matrix times an acceleration that is equal at
  /// all nodes.
  template <class Add>
  void add_inertia(const element::ElementVector& forces, const std::vector<int>& numbers, const Add& add_to) {
    for (std::size_t i = 0; i < numbers.size(); ++i) add_to(numbers[i], forces[static_cast<Eigen::Index>(i)]);
  }

  void add_mass(const PointMass& m, const std::string& key) {
    if (!(m.mass >= 0.0) || !(m.inertia >= 0.0))
      throw SceneError(m.place, key, "found a negative mass or inertia, expected numbers >= 0");
    const std::array<int, 3> numbers = map.numbers_at(element::find_node(map.mesh, m.node, m.place, key));
    const Eigen::Vector3d values(m.mass, m.mass, m.inertia);
    add(mass, &SupportColumns::mass, Eigen::Matrix3d(values.asDiagonal()), numbers);
    for (std::size_t c = 0; c < 2; ++c) {
      add_weight(numbers[c], m.mass * scene.gravity[c]);
      for (std::size_t i = 0; i < base.size(); ++i)
        map.add(base[i], numbers[c], m.mass * scene.base_motion[i].direction.vector[c]);
    }
  }

  void add_spring(const Spring& s, const std::string& key) {
    const auto d = clean_direction(s.direction);
    const double length = std::hypot(d[0], d[1]);
    if (!(length > 0.0))
      throw SceneError(s.place, key + ".direction",
                       "found a direction of length zero, expected the direction of the spring");
    const auto na = map.numbers_at(element::find_node(map.mesh, s.node, s.place, key));
    std::array<int, 3> nb{-1, -1, -1};
    if (!s.against.empty()) nb = map.numbers_at(element::find_node(map.mesh, s.against, s.place, key));
    const std::array<int, 4> numbers{na[0], na[1], nb[0], nb[1]};
    if (any_tied(map, numbers.data(), 4)) return add_tied_spring(s, d, na, nb);
    const Eigen::Vector4d a = Eigen::Vector4d(d[0], d[1], -d[0], -d[1]) / length;
    const Eigen::Matrix4d unit = a * a.transpose();
    add(stiffness, &SupportColumns::stiffness, Eigen::Matrix4d(s.stiffness * unit), numbers);
    add(dampers, &SupportColumns::dampers, Eigen::Matrix4d(s.damping * unit), numbers);
    add_rotational_spring(s, {na[2], nb[2]});
  }

  void add_rotational_spring(const Spring& s, const std::array<int, 2>& turns) {
    const Eigen::Matrix2d turning{{1.0, -1.0}, {-1.0, 1.0}};
    add(stiffness, &SupportColumns::stiffness, Eigen::Matrix2d(s.rotation_stiffness * turning), turns);
    add(dampers, &SupportColumns::dampers, Eigen::Matrix2d(s.rotation_damping * turning), turns);
  }

  /// Adds k a a^T for a spring of stiffness k, where a is the form of its elongation; terms of a that cancel add no stiffness.
  void add_tied_spring(const Spring& s, const std::array<double, 2>& d, const std::array<int, 3>& na,
                       const std::array<int, 3>& nb) {
    const double length = std::hypot(d[0], d[1]);
    TiedForm form(map);
    for (std::size_t c = 0; c < 2; ++c) {
      form.add(na[c], d[c] / length);
      form.add(nb[c], -d[c] / length);
    }
    const Elongation e = form.with_supports();
    const Eigen::MatrixXd unit = e.factors * e.factors.transpose();
    add_own(stiffness, &SupportColumns::stiffness, Eigen::MatrixXd(s.stiffness * unit), e.numbers);
    add_own(dampers, &SupportColumns::dampers, Eigen::MatrixXd(s.damping * unit), e.numbers);
    add_rotational_spring(s, {na[2], nb[2]});
  }
};

Builder begun(const Scene& scene, const DofMap& map) {
  const Vector zero = Vector::Zero(map.size());
  return {scene,
          map,
          {},
          {},
          {},
          zero,
          zero,
          std::vector<Vector>(scene.base_motion.size(), zero),
          std::vector<SupportColumns>(map.supports.size(), {zero, zero, zero})};
}

}  // namespace

GeometricStiffness assemble_geometric_stiffness(const Scene& scene, const DofMap& map) {
  Builder builder = begun(scene, map);
  for (std::size_t i = 0; i < map.mesh.elements.size(); ++i) builder.add_geometric(i);
  for (std::size_t i = 0; i < map.body_stiffness.size(); ++i) {
    const int turn = map.numbers_at(map.mesh.by_name.at(scene.rigid[i].centre))[2];
    builder.add(builder.stiffness, &SupportColumns::stiffness,
                Eigen::Matrix<double, 1, 1>(map.body_stiffness[i]), std::array<int, 1>{turn});
  }
  GeometricStiffness result{SparseMatrix(map.size(), map.size()), {}};
  result.matrix.setFromTriplets(builder.stiffness.begin(), builder.stiffness.end());
  for (SupportColumns& columns : builder.moving) result.moving.push_back(std::move(columns.stiffness));
  return result;
}

namespace {

/// Moves the sums of the builder into matrices.
Assembly assembled(Builder& builder) {
  const int n = builder.map.size();
  const auto sparse = [n](const Triplets& entries) {
    SparseMatrix a(n, n);
    a.setFromTriplets(entries.begin(), entries.end());
    return a;
  };
  return {sparse(builder.mass), sparse(builder.dampers), sparse(builder.stiffness),
          builder.weight,       std::move(builder.base), std::move(builder.moving)};
}

}  // namespace

Assembly assemble_restoring_springs(const Scene& scene, const DofMap& map) {
  Builder builder = begun(scene, map);
  for (std::size_t i = 0; i < scene.springs.size(); ++i)
    if (scene.springs[i].restoring) builder.add_spring(scene.springs[i], fmt::format("springs.{}", i + 1));
  return assembled(builder);
}

Assembly assemble_nodes(const Scene& scene, const DofMap& map) {
  Builder builder = begun(scene, map);
  for (std::size_t i = 0; i < map.mesh.elements.size(); ++i) builder.add_element(i);
  for (std::size_t i = 0; i < scene.masses.size(); ++i)
    builder.add_mass(scene.masses[i],
                     scene.masses[i].key.empty() ? fmt::format("masses.{}", i + 1) : scene.masses[i].key);
  for (std::size_t i = 0; i < scene.springs.size(); ++i)
    builder.add_spring(scene.springs[i], fmt::format("springs.{}", i + 1));
  builder.zero_rounding_errors();
  return assembled(builder);
}

}  // namespace signorini::assembly
