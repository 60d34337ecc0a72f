#include "certify/mixed_shapes.hpp"

#include <cmath>

#include "contact/constants.hpp"

namespace signorini {
namespace {

// Half of the digits: beyond this the first-order approximation C is invalid.
constexpr double most_mixed = 1e-8;

/// C; rows of shapes without mass are zero, as for infinite frequency.
Eigen::MatrixXd mixing(const std::function<double(Eigen::Index, Eigen::Index)>& coupling,
                       const Model& model) {
  const Eigen::MatrixXd& terms = model.reduction->stiffness_terms;
  const Eigen::Index size = terms.rows();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const double mass = model.mass.coeff(i, i);
    if (!(mass > 0.0)) continue;
    const double square = model.stiffness.coeff(i, i) / mass;
    for (Eigen::Index j = 0; j < size; ++j) {
      if (j == i || terms(i, j) == 0.0) continue;
      const double coupled = coupling(i, j) * terms(i, j);
      const double apart = square * model.mass.coeff(j, j) - model.stiffness.coeff(j, j);
      if (std::abs(coupled) < most_mixed * std::abs(apart)) result(i, j) = coupled / apart;
    }
  }
  return result;
}

/// f_i' = f_i + sum_j C_ij f_j. Degrees of freedom beyond the shapes are unchanged.
void mix(const Eigen::MatrixXd& c, Combination& form) {
  Vector f = Vector::Zero(c.rows());
  Combination mixed, beside;
  for (const auto& [dof, factor] : form.terms)
    if (dof < c.rows())
      f[dof] += factor;
    else
      beside.terms.emplace_back(dof, factor);
  f += c * f;
  for (Eigen::Index i = 0; i < f.size(); ++i)
    if (f[i] != 0.0) mixed.terms.emplace_back(static_cast<int>(i), f[i]);
  mixed.terms.insert(mixed.terms.end(), beside.terms.begin(), beside.terms.end());
  form = std::move(mixed);
}

}  // namespace

void mix_shapes(const std::function<double(Eigen::Index, Eigen::Index)>& coupling, Model& model) {
  const Eigen::MatrixXd c = mixing(coupling, model);
  // u = X q = X' q':  q' = q - C^T q. Gaps keep their exact values.
  const Vector u0 = model.u0;
  for (Vector* q : {&model.u0, &model.v0}) q->head(c.rows()) -= c.transpose() * q->head(c.rows()).eval();
  for (Contact& contact : model.contacts) {
    const double before = contact.normal.dot(u0);
    visit_forms(contact, [&](Combination& form) { mix(c, form); });
    if (!contact.normal_force_given()) contact.gap += before - contact.normal.dot(model.u0);
  }
  for (Load& load : model.loads) mix(c, load.direction);
  model.reduction->shapes += model.reduction->shapes * c.transpose();
}

}  // namespace signorini
