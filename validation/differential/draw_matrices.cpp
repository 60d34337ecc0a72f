#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "differential/families.hpp"
#include "differential/scene_text.hpp"

namespace signorini::differential {
namespace {

using Form = std::vector<double>;
using Matrix = std::vector<Form>;

Matrix square(std::size_t n) { return Matrix(n, Form(n, 0.0)); }

double dot(const Form& a, const Form& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// factor L L^T of the given rank.
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

Form unit(std::size_t n, std::size_t i) {
  Form e(n, 0.0);
  e[i % n] = 1.0;
  return e;
}

Form normal_form(Random& draw, std::size_t n, std::size_t k) {
  Form f = sparse_form(draw, n);
  return greatest(f) < 0.3 ? unit(n, k) : f;
}

/// More often than not one along which a normal impulse does no work: Painleve's paradox is rare then.
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

}  // namespace

std::string matrices_scene(Random& draw) {
  const bool floor = draw.chance(0.3);
  const int half = draw.integer(1, 3);
  const auto n = static_cast<std::size_t>(floor ? 2 * half : draw.integer(2, 6));
  const auto count = static_cast<std::size_t>(draw.integer(1, std::min(static_cast<int>(n) / 2, 3)));
  const double t_end = draw.one_of({0.5, 1.0, 2.0});
  const Matrix mass = mass_matrix(draw, n);
  const auto rank = static_cast<std::size_t>(draw.integer(0, static_cast<int>(n)));
  const Matrix stiffness = gram(draw, n, rank, draw.one_of({1.0, 10.0, 100.0, 1000.0}));
  const Matrix damping = damping_matrix(draw, mass, stiffness);

  std::string contacts, loads;
  Form press(n, 0.0);  // pushes every contact closed
  for (std::size_t k = 0; k < count; ++k) {
    const std::string law = draw.one_of<const char*>({"rigid", "rigid", "compliant", "slider"});
    const Form normal = floor ? unit(n, 2 * k + 1) : normal_form(draw, n, k);
    const Form tangent = floor ? unit(n, 2 * k) : tangent_form(draw, mass, normal, k);
    Keys contact = Keys().name("name", fmt::format("c{}", k)).name("law", law).set("tangent", form(tangent));
    if (law != "slider") {
      contact.set("normal", form(normal)).set("gap", draw.one_of({0.0, 0.0, draw.rounded(0.001, 0.3, 3)}));
      const double force = draw.one_of({1.0, 5.0, 10.0});
      for (std::size_t i = 0; i < n; ++i) press[i] = rounded(press[i] - force * normal[i], 3);
    }
    contacts += table("[[contacts]]", contact.add(contact_laws(draw, {law, 5.0, 1e4, n <= 4})));
  }
  if (greatest(press) > 0.0)
    loads += table("[[loads]]", Keys().set("direction", form(press)).set("amplitude", 1.0));
  for (int i = draw.integer(0, 2); i > 0; --i) {
    Form d = sparse_form(draw, n);
    if (greatest(d) == 0.0) d[0] = 1.0;
    loads += table("[[loads]]", Keys().set("direction", form(d)).add(load_course(draw, 30.0, t_end)));
  }
  Form v(n, 0.0);
  if (draw.chance(0.6))
    for (double& x : v) x = draw.rounded(-1.0, 1.0, 2);
  const std::string initial = Keys().set("u", list(Form(n, 0.0))).set("v", list(v)).braced();
  return run_table(t_end) + Keys().set("initial", initial).lines() +
         table(
             "[matrices]",
             Keys().set("mass", rows(mass)).set("stiffness", rows(stiffness)).set("damping", rows(damping))) +
         contacts + loads;
}

}  // namespace signorini::differential
