#include "decide/delassus.hpp"

#include <Eigen/QR>
#include <algorithm>

namespace signorini {

Delassus delassus(const Model& model, const Expander& expander, const std::vector<std::size_t>& contacts) {
  const auto n = static_cast<Eigen::Index>(model.size());
  const auto m = static_cast<Eigen::Index>(contacts.size());
  Delassus d{Eigen::MatrixXd(n, 2 * m), Eigen::MatrixXd(2 * m, 2 * m)};
  Vector x(n + 2 * static_cast<Eigen::Index>(model.contacts.size()));
  for (Eigen::Index j = 0; j < 2 * m; ++j) {
    const Contact& contact = model.contacts[contacts[static_cast<std::size_t>(j / 2)]];
    x.setZero();
    (j % 2 == 0 ? contact.normal : contact.tangent).add_to(x, 1.0);
    expander.taylor().solve(x.data());
    for (Eigen::Index i = 0; i < n; ++i)
      d.effect(i, j) =
          expander.taylor().kinds()[static_cast<std::size_t>(i)] == Taylor::Kind::massive ? x[i] : 0.0;
    for (Eigen::Index i = 0; i < m; ++i) {
      const Contact& other = model.contacts[contacts[static_cast<std::size_t>(i)]];
      d.W(2 * i, j) = other.normal.dot(d.effect.col(j));
      d.W(2 * i + 1, j) = other.tangent.dot(d.effect.col(j));
    }
  }
  return d;
}

bool settled(const std::vector<Fixed>& fixed, const Vector& v) {
  return std::all_of(fixed.begin(), fixed.end(),
                     [&](const Fixed& f) { return f.value - f.form->dot(v) == 0.0; });
}

void settle(const Delassus& d, const std::vector<Fixed>& fixed, Vector& v) {
  if (settled(fixed, v)) return;
  const auto count = static_cast<Eigen::Index>(fixed.size());
  std::vector<Eigen::Index> rows;
  for (const Fixed& f : fixed) rows.push_back(f.row);
  const Eigen::MatrixXd W = d.W(rows, rows), effect = d.effect(Eigen::all, rows);
  Eigen::VectorXd miss(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Fixed& f = fixed[static_cast<std::size_t>(i)];
    miss[i] = f.value - f.form->dot(v);
  }
  v += effect * W.completeOrthogonalDecomposition().solve(miss);
  for (const Fixed& f : fixed)  // one degree of freedom: exact
    if (f.form->terms.size() == 1) v[f.form->terms[0].first] = f.value / f.form->terms[0].second;
}

}  // namespace signorini
