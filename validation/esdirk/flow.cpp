#include "flow.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace signorini::esdirk {

Form stribeck_row(const Contact& contact, State state, double vt) {
  const int s = slip_sign(state);
  return contact::sliding_row(s, contact::sliding_friction(contact, s * vt));
}

Form stribeck_tangent(const Contact& contact, State state, double vt, double N) {
  ContactMotion m;
  m.vt = vt;
  m.N = N;
  return contact::sliding_row_tangent(contact, slip_sign(state), m);
}

ModeFlow::ModeFlow(const Model& model, const linear::SystemMatrices& structure)
    : model_(model),
      structure_(structure),
      n_(model.size()),
      mass_(model, structure),
      implicit_(model, structure),
      rhs_(static_cast<std::size_t>(mass_.size())),
      work_(static_cast<std::size_t>(n_)),
      scale_(static_cast<std::size_t>(2 * n_)) {
  for (std::size_t i = 0; i < model.dofs.size(); ++i) {
    const Dof& dof = model.dofs[i];
    if (dof.massless) throw std::runtime_error("degrees of freedom without mass are not treated here");
    scale_[i] = dof.rotation ? model.scales.rotation : model.scales.displacement;
    scale_[i + model.dofs.size()] = dof.rotation ? model.scales.angular_velocity : model.scales.velocity;
  }
}

void ModeFlow::start(const contact::ContactStates& states, double t) {
  const bool same = !states_.empty() && contact::states_of(states) == contact::states_of(states_);
  states_ = states;
  rows_ = tangents_ = linear::rows_of(model_, states);
  forcing_.emplace(model_, t, motion::Side::after);
  linear_ = true;
  for (std::size_t k = 0; k < states.size(); ++k)
    if (contact::slips_nonlinearly(model_.contacts[k], states[k].state)) {
      if (!model_.contacts[k].normal_force_given())
        throw std::runtime_error("Stribeck's friction is treated on sliders only");
      linear_ = false;
    }
  if (same) return;
  fresh_ = true;
  const std::vector<linear::Weights> accelerations(static_cast<std::size_t>(n_),
                                                   linear::Weights{1.0, 0.0, 0.0});
  if (!mass_.set(rows_, accelerations, true)) throw std::runtime_error("forces are not unique");
  ++count.factorisations;
}

ContactMotion ModeFlow::motion(std::size_t k, double t, int order, const double* u, const double* v) const {
  const Contact& contact = model_.contacts[k];
  ContactMotion m;
  m.gap = (order == 0 ? contact.gap : 0.0) + contact.normal.dot(u);
  m.ut = contact.tangent.dot(u) - forcing_->surface(k, t, order);
  m.vn = contact.normal.dot(v);
  m.vt = contact.tangent.dot(v) - forcing_->surface(k, t, order + 1);
  m.at = -forcing_->surface(k, t, order + 2);
  m.applied_normal_force = forcing_->applied_normal_force(k, t, order);
  m.applied_normal_force_rate = forcing_->applied_normal_force(k, t, order + 1);
  return m;
}

void ModeFlow::derivative(double t, int order, const double* y, double* dy) {
  ++count.derivatives;
  const double *u = y, *v = y + n_;
  std::fill(rhs_.begin(), rhs_.end(), 0.0);
  structure_.add_product(structure_.k, u, rhs_.data());
  structure_.add_product(structure_.c, v, rhs_.data());
  for (int i = 0; i < n_; ++i) rhs_[static_cast<std::size_t>(i)] *= -1.0;
  forcing_->add_load(t, order, rhs_.data());
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const ContactMotion m = motion(k, t, order, u, v);
    const auto row = static_cast<std::size_t>(n_) + 2 * k;
    const auto side = [&](const Form& form) { return order == 0 ? -form.value(m) : -form.rate(m); };
    rhs_[row] = side(rows_[k].normal);
    rhs_[row + 1] = side(rows_[k].tangent);
    // N of a slider is known, so the friction of the slip rate is a constant of its row.
    if (const State state = states_[k].state;
        order == 0 && contact::slips_nonlinearly(model_.contacts[k], state))
      rhs_[row + 1] =
          (rows_[k].tangent.N - stribeck_row(model_.contacts[k], state, m.vt).N) * -m.applied_normal_force;
  }
  mass_.solve(rhs_.data());
  std::copy(v, v + n_, dy);
  std::copy(rhs_.begin(), rhs_.begin() + n_, dy + n_);
}

void ModeFlow::linearise(double t, const double* y) {
  if (linear_) return;
  for (std::size_t k = 0; k < rows_.size(); ++k)
    if (contact::slips_nonlinearly(model_.contacts[k], states_[k].state)) {
      const ContactMotion m = motion(k, t, 0, y, y + n_);
      tangents_[k].tangent =
          stribeck_tangent(model_.contacts[k], states_[k].state, m.vt, -m.applied_normal_force);
    }
}

bool ModeFlow::factor(double g) {
  ++count.factorisations;
  g_ = g;
  const std::vector<linear::Weights> weights(static_cast<std::size_t>(n_), linear::Weights{1.0, g, g * g});
  const bool ok = implicit_.set(tangents_, weights, fresh_);
  fresh_ = !ok;
  return ok;
}

void ModeFlow::solve(const double* b, double* x) {
  ++count.solves;
  const double *bu = b, *bv = b + n_;
  std::fill(rhs_.begin(), rhs_.end(), 0.0);
  for (int i = 0; i < n_; ++i) work_[static_cast<std::size_t>(i)] = -g_ * bu[i];
  structure_.add_product(structure_.m, bv, rhs_.data());
  structure_.add_product(structure_.k, work_.data(), rhs_.data());
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const Contact& contact = model_.contacts[k];
    const double gap = contact.normal.dot(work_.data()), ut = contact.tangent.dot(work_.data());
    const double an = contact.normal.dot(bv), at = contact.tangent.dot(bv);
    const auto row = static_cast<std::size_t>(n_) + 2 * k;
    const auto side = [&](const Form& f) { return f.gap * gap + f.ut * ut + f.an * an + f.at * at; };
    rhs_[row] = side(tangents_[k].normal);
    rhs_[row + 1] = side(tangents_[k].tangent);
  }
  implicit_.solve(rhs_.data());
  for (int i = 0; i < n_; ++i) {
    const double xv = rhs_[static_cast<std::size_t>(i)], xu = bu[i] + g_ * xv;
    x[i] = xu;
    x[n_ + i] = xv;
  }
}

void ModeFlow::weights(const double* y, double* w) const {
  for (std::size_t i = 0; i < scale_.size(); ++i) w[i] = 1.0 / (rtol_ * (std::abs(y[i]) + scale_[i]));
}

double ModeFlow::distance(const double* y, const Vector& u, const Vector& v) const {
  double sum = 0.0;
  for (int i = 0; i < n_; ++i) {
    const double du = (y[i] - u[i]) / scale_[static_cast<std::size_t>(i)];
    const double dv = (y[n_ + i] - v[i]) / scale_[static_cast<std::size_t>(n_ + i)];
    sum += du * du + dv * dv;
  }
  return std::sqrt(sum / (2.0 * n_));
}

double ModeFlow::value(const Form& form, std::size_t k, double t, const double* y) {
  std::vector<double> dy(static_cast<std::size_t>(2 * n_));
  derivative(t, 0, y, dy.data());
  ContactMotion m = motion(k, t, 0, y, y + n_);
  m.N = force(k, 0);
  m.T = force(k, 1);
  m.an = model_.contacts[k].normal.dot(dy.data() + n_);
  m.at += model_.contacts[k].tangent.dot(dy.data() + n_);
  return form.value(m);
}

}  // namespace signorini::esdirk
