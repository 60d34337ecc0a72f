#include "differential/matrix_forms.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace signorini::differential {
namespace {

double dot(const Form& a, const Form& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// M^-1 n.
Form solved(const Matrix& m, const Form& n) {
  const auto size = static_cast<Eigen::Index>(n.size());
  Eigen::MatrixXd a(size, size);
  for (Eigen::Index i = 0; i < size; ++i)
    for (Eigen::Index j = 0; j < size; ++j)
      a(i, j) = m[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  const Eigen::VectorXd x = a.ldlt().solve(Eigen::Map<const Eigen::VectorXd>(n.data(), size));
  return {x.data(), x.data() + size};
}

}  // namespace

Matrix square(std::size_t n) { return Matrix(n, Form(n, 0.0)); }

Matrix gram(Random& draw, std::size_t n, std::size_t rank, double factor) {
  Matrix l = square(n), a = square(n);
  for (Form& row : l)
    for (std::size_t j = 0; j < rank; ++j) row[j] = draw.normal();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) a[i][j] = rounded(factor * dot(l[i], l[j]), 5);
  return a;
}

Form sparse_form(Random& draw, std::size_t n) {
  Form f(n, 0.0);
  for (double& x : f)
    if (draw.chance(0.7)) x = rounded(draw.normal(), 2);
  return f;
}

double greatest(const Form& f) {
  double most = 0.0;
  for (const double x : f) most = std::max(most, std::abs(x));
  return most;
}

Form unit(std::size_t n, std::size_t i) {
  Form e(n, 0.0);
  e[i % n] = 1.0;
  return e;
}

Form normal_form(Random& draw, std::size_t n, std::size_t k) {
  Form f = sparse_form(draw, n);
  return greatest(f) < 0.3 ? unit(n, k) : f;
}

Form tangent_form(Random& draw, const Matrix& mass, const Form& normal, std::size_t k) {
  Form f = sparse_form(draw, normal.size());
  if (draw.chance(0.6)) {
    const Form w = solved(mass, normal);
    const double share = dot(f, w) / dot(normal, w);
    for (std::size_t i = 0; i < w.size(); ++i) f[i] = rounded(f[i] - share * normal[i], 5);
  }
  return greatest(f) < 0.2 ? unit(normal.size(), k + 1) : f;
}

Matrix mass_matrix(Random& draw, std::size_t n) {
  Matrix mass = draw.chance(0.5) ? square(n) : gram(draw, n, n, draw.one_of({0.05, 0.3}));
  for (std::size_t i = 0; i < n; ++i) mass[i][i] = rounded(mass[i][i] + draw.real(0.4, 2.0), 3);
  return mass;
}

Matrix damping_matrix(Random& draw, const Matrix& mass, const Matrix& stiffness) {
  Matrix damping = square(mass.size());
  const double alpha = draw.one_of({0.0, 0.0, 0.2, 0.5});
  const double beta = draw.one_of({0.0, 0.0, 1e-3});
  for (std::size_t i = 0; i < mass.size(); ++i)
    for (std::size_t j = 0; j < mass.size(); ++j)
      damping[i][j] = rounded(alpha * mass[i][j] + beta * stiffness[i][j], 9);
  return damping;
}

}  // namespace signorini::differential
