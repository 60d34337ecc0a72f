#include "engine/exact/modal/damped_motion.hpp"

#include <algorithm>
#include <cmath>

#include "base/eigen_dense.hpp"
#include "contact/friction.hpp"

namespace signorini::modal {
namespace {

/// Limit of TimeBasis::cancellation(), the amplification of rounding errors in the response of a slow mode, or of a mode near
/// resonance, to a force. Equal to the limit for works in modal_works.cpp.
constexpr double max_loss = 1e3;

}  // namespace

/// Displacement u_c that the constraints prescribe, in unconstrained modes; one column for each function of the time basis.
Eigen::MatrixXd DampedMotion::constraint_displacements(const engine::Segment& segment,
                                                       const Vector& q) const {
  const auto rigid = static_cast<Eigen::Index>(state_->rigid.size());
  Eigen::MatrixXd asked = Eigen::MatrixXd::Zero(rigid, time_.size());
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    const ContactRows& own = state_->contacts[c];
    const auto row_of = [&](int term) {
      return std::find(state_->rigid.begin(), state_->rigid.end(), term) - state_->rigid.begin();
    };
    if (own.normal.an != 0.0) asked(row_of(own.normal_term), 0) = -model_.contacts[c].gap;
    if (own.tangent.at == 0.0) continue;
    const double t = decision_->jet.t;
    TimeCoefficients surface = time_.of(model_.contacts[c].surface_motion.piece(t));
    surface[0] += basis_.tangent(c).dot(q) - segment.forcing->surface(c, t, 0);
    asked.row(row_of(own.tangent_term)) = surface.transpose();
  }
  return state_->static_shapes * asked;
}

/// Forces that do not depend on the motion: loads, and the constant or prescribed parts of contact forces. One row for each
/// unconstrained mode, one column for each function of the time basis.
Eigen::MatrixXd DampedMotion::forces() const {
  const double t = decision_->jet.t;
  Eigen::MatrixXd p = Eigen::MatrixXd::Zero(basis_.omega_squared().size(), time_.size());
  for (std::size_t i = 0; i < model_.loads.size(); ++i)
    p += basis_.load(i) * time_.of(model_.loads[i].history.piece(t)).transpose();
  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    const Contact& contact = model_.contacts[c];
    const ContactRows& own = state_->contacts[c];
    const ContactState& state = decision_->states[c];
    TimeCoefficients N = time_.constant(-own.normal.constant) -
                         own.normal.applied_normal_force * contacts_[c].applied_normal_force;
    if (own.normal.an != 0.0) N.setZero();
    N[0] -= own.normal.gap * contact.gap;
    p -= basis_.normal(c) * N.transpose();
    const Form tangent = contact::rows(contact, state).tangent;
    if (tangent.at != 0.0) continue;
    TimeCoefficients T =
        time_.constant(-tangent.constant) - tangent.N * N + tangent.ut * contacts_[c].surface;
    p -= basis_.tangent(c) * T.transpose();
  }
  return p;
}

/// Forces u_c'' + C u_c' + K u_c for the displacement u_c = held, including springs and dashpots of contacts.
Eigen::MatrixXd DampedMotion::inertia_of(const Eigen::MatrixXd& held) const {
  const Eigen::MatrixXd rate = time_.derivative(held);
  Eigen::MatrixXd p = time_.derivative(rate) + system_.decay().asDiagonal() * rate +
                      basis_.omega_squared().asDiagonal() * held;
  for (const ModalTerm& term : state_->terms)
    if (!term.rigid)
      p += term.u * (term.stiffness * term.v.transpose() * held + term.damping * term.v.transpose() * rate);
  return p;
}

std::string DampedMotion::start(const engine::Segment& segment, const Vector& q, const Vector& rate,
                                ModalPoint& now) {
  decision_ = segment.decision;
  state_ = system_.state(decision_->states);
  const DampedModes& modes = state_->modes;
  if (!modes.failure.empty()) return modes.failure;
  lengths_ = modes.shape.colwise().norm();
  const Eigen::VectorXd omega = basis_.omega_squared().cwiseMax(0.0).cwiseSqrt();
  omega_shape_norms_ = (omega.asDiagonal() * modes.shape).colwise().norm().transpose();
  const double t = decision_->jet.t;
  time_ = TimeBasis(model_, t);
  for (Eigen::Index k = 0; k < modes.root.size(); ++k)
    if (!(time_.cancellation(modes.root[k], t_end_) < max_loss))
      return "a decay rate is neither zero nor fast compared with the run, or a load is in resonance";
  time_.reserve_slow_roots(modes.root, segment.end - t);
  contacts_.resize(model_.contacts.size());
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    contacts_[c].surface = time_.of(model_.contacts[c].surface_motion.piece(t));
    contacts_[c].applied_normal_force = time_.of(model_.contacts[c].normal_force.piece(t));
  }
  forced_response_ = Eigen::MatrixXd::Zero(q.size(), time_.size());
  if (!state_->rigid.empty()) forced_response_ = constraint_displacements(segment, q);
  Eigen::MatrixXd p = forces();
  if (!state_->rigid.empty()) p -= inertia_of(forced_response_);
  const Eigen::MatrixXcd pressed = base::complex_product(modes.from_rate, p.cast<std::complex<double>>());
  Eigen::MatrixXcd answers(modes.root.size(), time_.size());
  for (Eigen::Index k = 0; k < modes.root.size(); ++k)
    answers.row(k) = time_.response(modes.root[k], pressed.row(k).transpose()).transpose();
  const Eigen::VectorXd b = time_.at(0.0);
  now.y = modes.from_q * (q - forced_response_ * b) +
          modes.from_rate * (rate - time_.derivative(forced_response_) * b) - answers * b;
  now.time = 0.0;
  forced_response_ += base::complex_product(modes.shape, answers).real();
  forced_response_rate_ = time_.derivative(forced_response_);
  change_ = time_.derivative(forced_response_rate_);
  response_norms_ = forced_response_.colwise().norm().transpose();
  response_rate_norms_ = forced_response_rate_.colwise().norm().transpose();
  response_omega_norms_ = (omega.asDiagonal() * forced_response_).colwise().norm().transpose();
  find_contacts(p, answers);
  return {};
}

void DampedMotion::find_contacts(const Eigen::MatrixXd& forces, const Eigen::MatrixXcd& answers) {
  const DampedModes& modes = state_->modes;
  const auto constraint_force = [&](int term) {
    const Eigen::Index row =
        std::find(state_->rigid.begin(), state_->rigid.end(), term) - state_->rigid.begin();
    const Eigen::VectorXcd own = modes.force.row(term).transpose();
    return ModalQuantity{
        own, (answers.transpose() * own).real() + (state_->from_forces.row(row) * forces).transpose()};
  };
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const Contact& contact = model_.contacts[c];
    const ContactRows& own = state_->contacts[c];
    ContactQuantities& out = contacts_[c];
    out.gap = {own.gap, forced_response_.transpose() * basis_.normal(c)};
    out.ut = {own.slide, forced_response_.transpose() * basis_.tangent(c) - out.surface};
    out.gap.time_coefficients[0] += contact.gap;
    if (own.normal.an != 0.0) {
      out.gap.time_coefficients.setZero();
      out.N = constraint_force(own.normal_term);
    } else {
      out.N = -own.normal.gap * out.gap;
      if (own.normal.vn != 0.0) out.N += -own.normal.vn * derivative(out.gap);
      out.N.time_coefficients[0] -= own.normal.constant;
      out.N.time_coefficients -= own.normal.applied_normal_force * out.applied_normal_force;
    }
    const Form tangent = contact::rows(contact, decision_->states[c]).tangent;
    if (tangent.at != 0.0) {
      out.T = constraint_force(own.tangent_term);
      continue;
    }
    out.T = -tangent.ut * out.ut;
    if (tangent.N != 0.0) out.T += -tangent.N * out.N;
    out.T.time_coefficients[0] -= tangent.constant;
  }
}

ModalQuantity DampedMotion::quantity_of(const Form& form, std::size_t c) const {
  const ContactQuantities& own = contacts_[c];
  ModalQuantity sum{Eigen::VectorXcd::Zero(root().size()), time_.constant(form.constant)};
  const auto add = [&](double factor, const auto& quantity) {
    if (factor != 0.0) sum += factor * quantity();
  };
  add(form.N, [&] { return own.N; });
  add(form.T, [&] { return own.T; });
  add(form.gap, [&] { return own.gap; });
  add(form.ut, [&] { return own.ut; });
  add(form.vn, [&] { return derivative(own.gap); });
  add(form.vt, [&] { return derivative(own.ut); });
  add(form.an, [&] { return derivative(derivative(own.gap)); });
  add(form.at, [&] { return derivative(derivative(own.ut)); });
  sum.time_coefficients += form.applied_normal_force * own.applied_normal_force +
                           form.applied_normal_force_rate * time_.derivative(own.applied_normal_force);
  return sum;
}

engine::FastModeBound DampedMotion::fast_mode_bound(const ModalPoint& from, double time, double omega) const {
  const auto count = model_.force_count();
  engine::FastModeBound r{0.0, 0.0, 0.0, Eigen::VectorXd::Zero(count)};
  SumOfModes u(eigenvector_condition()), v(eigenvector_condition()), a(eigenvector_condition());
  for (Eigen::Index k = 0; k < root().size(); ++k) {
    const double rate = std::abs(root()[k]);
    if (!(rate > omega)) continue;
    const double y = std::abs(from.y[k]) * std::exp(std::max(0.0, root()[k].real()) * time);
    u.add(lengths_[k] * y);
    v.add(lengths_[k] * y * rate);
    a.add(lengths_[k] * y * rate * rate);
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      r.forces[static_cast<Eigen::Index>(model_.layout.normal(c))] += std::abs(contacts_[c].N.row[k]) * y;
      r.forces[static_cast<Eigen::Index>(model_.layout.tangent(c))] += std::abs(contacts_[c].T.row[k]) * y;
    }
  }
  r.u = u.value();
  r.v = v.value();
  r.a = a.value();
  return r;
}

SumTerms DampedMotion::terms(const ModalPoint& at) const {
  const Eigen::VectorXd y = at.y.cwiseAbs(), b = time_.at(at.time).cwiseAbs();
  return {lengths_.dot(y) + response_norms_.dot(b),
          lengths_.cwiseProduct(root().cwiseAbs()).dot(y) + response_rate_norms_.dot(b),
          omega_shape_norms_.dot(y) + response_omega_norms_.dot(b)};
}

void DampedMotion::advance(const ModalPoint& from, double time, ModalPoint& to) const {
  const Eigen::VectorXcd& l = root();
  to.y.resize(l.size());
  for (Eigen::Index k = 0; k < l.size(); ++k) {
    const double size = std::exp(l[k].real() * time), turned = l[k].imag() * time;
    to.y[k] = from.y[k] * std::complex<double>(size * std::cos(turned), size * std::sin(turned));
  }
  to.time = from.time + time;
}

void DampedMotion::motion(const ModalPoint& at, Vector& q, Vector& rate, Vector* change) const {
  const Eigen::VectorXd b = time_.at(at.time);
  const Eigen::MatrixXcd& shape = state_->modes.shape;
  const Eigen::VectorXcd first = root().cwiseProduct(at.y);
  q = (shape * at.y).real() + forced_response_ * b;
  rate = (shape * first).real() + forced_response_rate_ * b;
  if (change) *change = (shape * root().cwiseProduct(first)).real() + change_ * b;
}

}  // namespace signorini::modal
