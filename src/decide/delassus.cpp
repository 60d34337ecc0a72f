#include "decide/delassus.hpp"

#include <algorithm>

#include "base/eigen_dense.hpp"
#include "decide/places.hpp"

namespace signorini {

Delassus delassus(const Model& model, const ModeSystem& system, const std::vector<std::size_t>& contacts) {
  const auto n = static_cast<Eigen::Index>(model.size());
  const Eigen::Index m = place_count(contacts.size());
  Delassus d{Eigen::MatrixXd(n, m), Eigen::MatrixXd(m, m)};
  Vector x(static_cast<Eigen::Index>(system.unknowns().size())), work(x.size());
  for (Eigen::Index j = 0; j < m; ++j) {
    const Contact& contact = model.contacts[contacts[contact_of_place(j)]];
    x.setZero();
    (is_normal_place(j) ? contact.normal : contact.tangent).add_to(x, 1.0);
    system.solve(x.data(), work.data());
    for (Eigen::Index i = 0; i < n; ++i)
      d.effect(i, j) = system.kinds()[static_cast<std::size_t>(i)] == DofKind::massive ? x[i] : 0.0;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const Contact& other = model.contacts[contacts[i]];
      d.W(normal_place(i), j) = other.normal.dot(d.effect.col(j));
      d.W(tangent_place(i), j) = other.tangent.dot(d.effect.col(j));
    }
  }
  return d;
}

Eigen::VectorXd with_reactions(const Model& model, const ModeSystem& system,
                               const std::vector<std::size_t>& contacts, const Eigen::VectorXd& impulses) {
  if (impulses.size() == 0) return {};
  Vector x = Vector::Zero(static_cast<Eigen::Index>(system.unknowns().size())), work(x.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    model.contacts[contacts[i]].normal.add_to(x, impulses[normal_place(i)]);
    model.contacts[contacts[i]].tangent.add_to(x, impulses[tangent_place(i)]);
  }
  system.solve(x.data(), work.data());
  Eigen::VectorXd all = -x.tail(model.force_count());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    all.data()[model.layout.normal(contacts[i])] += impulses[normal_place(i)];
    all.data()[model.layout.tangent(contacts[i])] += impulses[tangent_place(i)];
  }
  return all;
}

bool settled(const std::vector<Fixed>& fixed, const Vector& v) {
  return std::all_of(fixed.begin(), fixed.end(),
                     [&](const Fixed& f) { return f.value - f.form->dot(v) == 0.0; });
}

Eigen::VectorXd settle(const Delassus& d, const std::vector<Fixed>& fixed, Vector& v) {
  if (settled(fixed, v)) return {};
  const auto count = static_cast<Eigen::Index>(fixed.size());
  std::vector<Eigen::Index> rows;
  for (const Fixed& f : fixed) rows.push_back(f.row);
  const Eigen::MatrixXd W = d.W(rows, rows), effect = d.effect(Eigen::all, rows);
  Eigen::VectorXd miss(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Fixed& f = fixed[static_cast<std::size_t>(i)];
    miss[i] = f.value - f.form->dot(v);
  }
  Eigen::VectorXd impulses = Eigen::VectorXd::Zero(d.W.rows());
  impulses(rows) = least_squares(W, miss);
  v += effect * impulses(rows);
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    const Fixed& f = fixed[i];
    const bool both = i + 1 < fixed.size() && is_normal_place(f.row) &&
                      fixed[i + 1].row == tangent_place(contact_of_place(f.row));
    if (both)
      set_exactly(*f.form, f.value, *fixed[i + 1].form, fixed[i + 1].value, v);
    else
      set_exactly(*f.form, f.value, v);
  }
  return impulses;
}

}  // namespace signorini
