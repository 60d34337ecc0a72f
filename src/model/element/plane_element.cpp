#include "model/element/plane_element.hpp"

#include <Eigen/LU>  // determinants and inverses of small matrices

namespace signorini::element {
namespace {

/// Sets the rows for the strains (e_x, e_y, g_xy) from the derivatives of the shape functions with respect to x and y.
template <class Rows, class Slopes>
void fill_strains(const Slopes& slopes, Rows& rows) {
  for (Eigen::Index k = 0; k < slopes.rows(); ++k) {
    rows.col(2 * k) << slopes(k, 0), 0.0, slopes(k, 1);
    rows.col(2 * k + 1) << 0.0, slopes(k, 1), slopes(k, 0);
  }
}

}  // namespace

Eigen::Matrix3d PlaneMaterial::elasticity_matrix() const {
  const double across =
      plane_strain ? nu / (1.0 - nu) : nu;  // plane strain: nu and E of the equivalent plane stress
  const double modulus = plane_strain ? E / (1.0 - nu * nu) : E;
  return modulus / (1.0 - across * across) *
         Eigen::Matrix3d{{1.0, across, 0.0}, {across, 1.0, 0.0}, {0.0, 0.0, 0.5 * (1.0 - across)}};
}

Eigen::Vector3d PlaneMaterial::thermal_strain() const {
  const double e = plane_strain ? 1.0 + nu : 1.0;
  return {e, e, 0.0};
}

PlaneElement::PlaneElement(std::vector<int> nodes, int member, PlaneShape shape, std::vector<PlaneVector> at,
                           const PlaneMaterial& material, MassKind mass)
    : FiniteElement(std::move(nodes), member),
      shape_(shape),
      at_(std::move(at)),
      material_(material),
      mass_(mass) {
  for (const mesh::IntegrationPoint& p : mesh::integration_points(shape_))
    area_ += p.weight * at_point(p.a, p.b).det;
}

std::vector<ElementUnknown> PlaneElement::unknowns() const {
  std::vector<ElementUnknown> all;
  for (std::size_t k = 0; k < at_.size(); ++k)
    for (const std::size_t c : {0U, 1U}) all.push_back({k, c});
  return all;
}

Eigen::Matrix2d PlaneElement::jacobian(const Eigen::MatrixX2d& slopes) const {
  Eigen::Matrix2d j = Eigen::Matrix2d::Zero();  // d(x, y) / d(a, b)
  for (std::size_t k = 0; k < at_.size(); ++k)
    j += Eigen::Vector2d(at_[k][0], at_[k][1]) * slopes.row(static_cast<Eigen::Index>(k));
  return j;
}

PlaneElement::PointShapes PlaneElement::at_point(double a, double b) const {
  mesh::ShapeValues shapes = mesh::shape_functions(shape_, a, b);
  const Eigen::Matrix2d j = jacobian(shapes.gradients);
  return {std::move(shapes.values), shapes.gradients * j.inverse(), j.determinant()};
}

Eigen::MatrixXd PlaneElement::strain_rows(const PointShapes& place) const {
  Eigen::MatrixXd rows(3, 2 * place.slopes.rows());
  fill_strains(place.slopes, rows);
  return rows;
}

/// Strains of the four incompatible modes of q4.
Eigen::Matrix<double, 3, 4> PlaneElement::incompatible_rows(double a, double b, double det) const {
  const Eigen::Matrix2d middle = jacobian(mesh::shape_functions(shape_, 0.0, 0.0).gradients);
  const Eigen::Matrix2d by_point{{-2.0 * a, 0.0}, {0.0, -2.0 * b}};
  const Eigen::Matrix2d slopes = middle.determinant() / det * by_point * middle.inverse();
  Eigen::Matrix<double, 3, 4> rows;
  fill_strains(slopes, rows);
  return rows;
}

/// Amplitudes of the incompatible modes per unit of each unknown: 4 x unknowns. Only for q4.
Eigen::MatrixXd PlaneElement::incompatible_motion() const {
  const Eigen::Matrix3d D = material_.elasticity_matrix();
  Eigen::Matrix4d inner = Eigen::Matrix4d::Zero();
  Eigen::Matrix<double, 4, 8> mixed = Eigen::Matrix<double, 4, 8>::Zero();
  for (const mesh::IntegrationPoint& p : mesh::integration_points(shape_)) {
    const PointShapes place = at_point(p.a, p.b);
    const auto rows = incompatible_rows(p.a, p.b, place.det);
    inner += p.weight * place.det * rows.transpose() * D * rows;
    mixed += p.weight * place.det * rows.transpose() * D * strain_rows(place);
  }
  return -inner.inverse() * mixed;
}

ElementMatrix PlaneElement::stiffness() const {
  const auto n = static_cast<Eigen::Index>(2 * at_.size());
  const bool inner = shape_ == PlaneShape::q4;
  const Eigen::MatrixXd modes = inner ? incompatible_motion() : Eigen::MatrixXd();
  const Eigen::Matrix3d D = material_.elasticity_matrix();
  ElementMatrix k = ElementMatrix::Zero(n, n);
  for (const mesh::IntegrationPoint& p : mesh::integration_points(shape_)) {
    const PointShapes place = at_point(p.a, p.b);
    Eigen::MatrixXd rows = strain_rows(place);
    if (inner) rows += incompatible_rows(p.a, p.b, place.det) * modes;
    k += p.weight * place.det * material_.thickness * rows.transpose() * D * rows;
  }
  return 0.5 * (k + k.transpose());
}

/// Mass matrix of the motions in one direction, x or y: nodes x nodes.
Eigen::MatrixXd PlaneElement::mass_of_nodes() const {
  const auto n = static_cast<Eigen::Index>(at_.size());
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(n, n);
  for (const mesh::IntegrationPoint& p : mesh::integration_points(shape_)) {
    const PointShapes place = at_point(p.a, p.b);
    m += p.weight * place.det * density() * place.values * place.values.transpose();
  }
  if (mass_ == MassKind::consistent) return m;
  Eigen::VectorXd lumped = m.rowwise().sum();
  if (mesh::has_midside_nodes(shape_)) lumped = m.diagonal() * (density() * area_ / m.trace());
  return lumped.asDiagonal();
}

ElementMatrix PlaneElement::mass() const {
  const Eigen::MatrixXd nodes = mass_of_nodes();
  const Eigen::Index n = nodes.rows();
  ElementMatrix m = ElementMatrix::Zero(2 * n, 2 * n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      m(2 * i, 2 * j) = m(2 * i + 1, 2 * j + 1) = 0.5 * (nodes(i, j) + nodes(j, i));
  return m;
}

ElementVector PlaneElement::load_vector(const PlaneVector& load) const {
  ElementVector forces = ElementVector::Zero(static_cast<Eigen::Index>(2 * at_.size()));
  for (const mesh::IntegrationPoint& p : mesh::integration_points(shape_)) {
    const PointShapes place = at_point(p.a, p.b);
    for (Eigen::Index k = 0; k < place.values.size(); ++k)
      for (const Eigen::Index c : {0, 1})
        forces[2 * k + c] += p.weight * place.det * place.values[k] * load[static_cast<std::size_t>(c)];
  }
  return forces;
}

/// Incompatible modes are omitted, because they do no work in a constant stress.
double PlaneElement::strain_work(const ElementVector& motion) const {
  const Eigen::Vector3d stress = material_.elasticity_matrix() * material_.thermal_strain();
  double work = 0.0;
  for (const mesh::IntegrationPoint& p : mesh::integration_points(shape_)) {
    const PointShapes place = at_point(p.a, p.b);
    work += p.weight * place.det * material_.thickness * stress.dot(strain_rows(place) * motion);
  }
  return work;
}

Eigen::MatrixXd PlaneElement::stress_rows(double a, double b) const {
  const PointShapes place = at_point(a, b);
  Eigen::MatrixXd rows = strain_rows(place);
  if (shape_ == PlaneShape::q4) rows += incompatible_rows(a, b, place.det) * incompatible_motion();
  return material_.elasticity_matrix() * rows;
}

std::vector<PlaneElement::StressSample> PlaneElement::stress_samples() const {
  static constexpr std::array<mesh::StressPoint, 1> middle{};
  std::vector<StressSample> samples;
  for (const auto& [a, b] :
       shape_ == PlaneShape::q4 ? std::span<const mesh::StressPoint>(middle) : mesh::stress_points(shape_)) {
    StressSample sample{{0.0, 0.0}, stress_rows(a, b)};
    const Eigen::VectorXd values = mesh::shape_functions(shape_, a, b).values;
    for (std::size_t k = 0; k < at_.size(); ++k)
      for (const std::size_t c : {0U, 1U}) sample.at[c] += values[static_cast<Eigen::Index>(k)] * at_[k][c];
    samples.push_back(std::move(sample));
  }
  return samples;
}

Eigen::MatrixXd PlaneElement::nodal_stress_rows() const {
  const auto n = static_cast<Eigen::Index>(at_.size());
  const bool inner = shape_ == PlaneShape::q4;
  const Eigen::MatrixXd modes = inner ? incompatible_motion() : Eigen::MatrixXd();
  const Eigen::Matrix3d D = material_.elasticity_matrix();
  const std::span<const mesh::StressPoint> points = mesh::stress_points(shape_);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(3 * n, 2 * n);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const auto [a, b] = points[p];
    const PointShapes place = at_point(a, b);
    Eigen::MatrixXd rows = strain_rows(place);
    if (inner) rows += incompatible_rows(a, b, place.det) * modes;
    rows = D * rows;
    for (Eigen::Index k = 0; k < n; ++k)
      all.middleRows<3>(3 * k) += mesh::extrapolation_weight(shape_, p, static_cast<std::size_t>(k)) * rows;
  }
  return all;
}

std::vector<ElementLine> PlaneElement::lines() const {
  const std::size_t corners = mesh::corner_count(shape_);
  std::vector<ElementLine> all;
  for (std::size_t i = 0; i < corners; ++i) {
    const std::size_t next = (i + 1) % corners;
    if (mesh::has_midside_nodes(shape_)) {
      all.push_back({i, corners + i});
      all.push_back({corners + i, next});
    } else {
      all.push_back({i, next});
    }
  }
  return all;
}

}  // namespace signorini::element
