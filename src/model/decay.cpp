#include "model/decay.hpp"

#include <algorithm>
#include <cmath>

namespace signorini {

double diagonal_decay(const Vector& mass, const Vector& damping, const Vector& stiffness) {
  double rate = 0.0;
  for (Eigen::Index i = 0; i < mass.size(); ++i) {
    if (mass[i] > 0.0)
      rate = std::max(rate, damping[i] / mass[i]);
    else if (damping[i] > 0.0)
      rate = std::max(rate, stiffness[i] / damping[i]);
  }
  return rate;
}

double fastest_decay(const Model& model) {
  Vector c = model.damping.diagonal(), k = model.stiffness.diagonal();
  for (const Contact& contact : model.contacts) {
    for (const auto& [dof, n] : contact.normal.terms) {
      c[dof] += n * n * contact.normal_damping;
      k[dof] += n * n * contact.normal_stiffness;
    }
    for (const auto& [dof, t] : contact.tangent.terms)
      k[dof] += t * t * contact.tangential_stiffness.value_or(0.0);
  }
  const double rayleigh = model.alpha + model.beta * model.omega_max * model.omega_max;
  return std::max(rayleigh, diagonal_decay(model.mass.diagonal(), c, k));
}

double least_damping_ratio(const Model& model) {
  if (!(model.omega_max > 0.0)) return 0.0;
  double beta = model.beta;
  for (const Contact& contact : model.contacts)
    if (contact.normal_stiffness > 0.0 || contact.tangential_stiffness) beta = 0.0;
  // (alpha / omega + beta omega) / 2 is least at sqrt(alpha / beta).
  const double alpha = model.alpha, omega_max = model.omega_max;
  if (alpha < beta * omega_max * omega_max) return std::sqrt(alpha * beta);
  return 0.5 * (alpha / omega_max + beta * omega_max);
}

}  // namespace signorini
