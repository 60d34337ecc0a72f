#include "engine/newmark/newmark_step.hpp"

#include <algorithm>
#include <cmath>

namespace signorini {
namespace {

constexpr std::size_t most_kept = 32;  // factorisations: modes that a run comes back to

}  // namespace

NewmarkStep::NewmarkStep(const Model& model, const Structure& structure)
    : model_(model), structure_(structure), weights_(static_cast<std::size_t>(structure.size)) {
  u_.setZero(structure.size);
  v_ = none_ = u_;
  x_.setZero(structure.size + 2 * static_cast<Eigen::Index>(model.contacts.size()));
  kept_.reserve(most_kept);
  odd_.matrix = std::make_unique<SystemMatrix>(model, structure);
}

void NewmarkStep::set(Key key, std::vector<Rows> rows, const std::vector<Taylor::Kind>& kinds) {
  key_ = std::move(key);
  rows_ = std::move(rows);
  kinds_ = kinds;
  last_ = nullptr;
}

bool NewmarkStep::factor(Factored& place, double h) {
  for (std::size_t i = 0; i < weights_.size(); ++i)
    weights_[i] = kinds_[i] == Taylor::Kind::massive  ? Weights{1.0, 0.5 * h, 0.25 * h * h}
                  : kinds_[i] == Taylor::Kind::damped ? Weights{0.0, 1.0, 0.5 * h}
                                                      : Weights{0.0, 0.0, 1.0};
  const bool fresh = place.key != key_ || place.h == 0.0;
  place.key = key_;
  place.h = h;
  if (place.matrix->set(rows_, weights_, fresh)) return true;
  place.h = 0.0;  // holds nothing
  return false;
}

SystemMatrix* NewmarkStep::matrix_for(double h, bool kept) {
  if (last_ != nullptr && last_->h == h) return last_->matrix.get();
  last_ = nullptr;
  ++clock_;
  if (!kept) {
    if ((odd_.key != key_ || odd_.h != h) && !factor(odd_, h)) return nullptr;
    last_ = &odd_;
    return odd_.matrix.get();
  }
  for (Factored& f : kept_)
    if (f.h == h && f.key == key_) {
      last_ = &f;
      f.used = clock_;
      return f.matrix.get();
    }
  if (kept_.size() < most_kept) {
    kept_.push_back({{}, 0.0, 0, std::make_unique<SystemMatrix>(model_, structure_)});
    last_ = &kept_.back();
  } else {
    last_ = &*std::min_element(kept_.begin(), kept_.end(),
                               [](const Factored& a, const Factored& b) { return a.used < b.used; });
  }
  last_->used = clock_;
  if (factor(*last_, h)) return last_->matrix.get();
  last_ = nullptr;
  return nullptr;
}

bool NewmarkStep::take(const Forcing& forcing, const Point& from, double t1, double h, bool kept, Point& to) {
  SystemMatrix* matrix = matrix_for(h, kept);
  if (matrix == nullptr) return false;
  const auto n = static_cast<std::size_t>(structure_.size);
  const double *u0 = from.u.data(), *v0 = from.v.data(), *a0 = from.a.data();
  for (std::size_t i = 0; i < n; ++i) {  // what is known of the motion at t1
    const bool massive = kinds_[i] == Taylor::Kind::massive, damped = kinds_[i] == Taylor::Kind::damped;
    u_.data()[i] = massive ? u0[i] + h * (v0[i] + 0.25 * h * a0[i]) : damped ? u0[i] + 0.5 * h * v0[i] : 0.0;
    v_.data()[i] = massive ? v0[i] + 0.5 * h * a0[i] : 0.0;
  }
  // r = P - C v - K u
  x_.setZero();
  structure_.add_product(none_.data(), v_.data(), u_.data(), x_.data());
  for (std::size_t i = 0; i < n; ++i) x_.data()[i] = -x_.data()[i];
  forcing.add_load(t1, 0, x_.data());
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const Contact& contact = model_.contacts[k];
    const Form &normal = rows_[k].normal, &tangent = rows_[k].tangent;
    double r = normal.constant, q = tangent.constant;
    if (normal.pressing != 0.0) r += normal.pressing * forcing.pressing(k, t1, 0);
    if (normal.gap != 0.0) r += normal.gap * (contact.gap + contact.normal.dot(u_));
    if (normal.vn != 0.0) r += normal.vn * contact.normal.dot(v_);
    if (tangent.ut != 0.0) q += tangent.ut * (contact.tangent.dot(u_) - forcing.surface(k, t1, 0));
    if (tangent.vt != 0.0) q += tangent.vt * (contact.tangent.dot(v_) - forcing.surface(k, t1, 1));
    if (tangent.at != 0.0) q -= tangent.at * forcing.surface(k, t1, 2);
    x_.data()[n + 2 * k] = -r;
    x_.data()[n + 2 * k + 1] = -q;
  }
  matrix->solve(x_.data());
  ++solves_;

  to.u.resize(from.u.size());
  to.v.resize(from.u.size());
  to.a.resize(from.u.size());
  to.forces.resize(x_.size() - from.u.size());
  double *u1 = to.u.data(), *v1 = to.v.data(), *a1 = to.a.data();
  const double* x = x_.data();
  for (std::size_t i = 0; i < n; ++i) {
    a1[i] = 0.0;
    if (kinds_[i] == Taylor::Kind::massive) {
      u1[i] = u_.data()[i] + 0.25 * h * h * x[i];
      v1[i] = v_.data()[i] + 0.5 * h * x[i];
      a1[i] = x[i];
    } else if (kinds_[i] == Taylor::Kind::damped) {
      u1[i] = u_.data()[i] + 0.5 * h * x[i];
      v1[i] = x[i];
    } else {
      u1[i] = x[i];
      v1[i] = h > 0.0 ? 2.0 * (u1[i] - u0[i]) / h - v0[i] : v0[i];
    }
  }
  for (std::size_t i = n; i < static_cast<std::size_t>(x_.size()); ++i) to.forces.data()[i - n] = x[i];
  // The limit itself, not what the solve leaves of it: no drift.
  for (std::size_t k = 0; k < rows_.size(); ++k)
    if (const Form& tangent = rows_[k].tangent; tangent.T == 1.0 && tangent.N != 0.0)
      to.forces.data()[2 * k + 1] = -tangent.N * to.forces.data()[2 * k];
  return true;
}

double NewmarkStep::residual(const Forcing& forcing, double t, const Point& point) {
  Vector& r = u_;
  r.setZero();
  forcing.add_load(t, 0, r.data());
  r = -r;
  structure_.add_product(point.a.data(), point.v.data(), point.u.data(), r.data());
  for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
    model_.contacts[k].normal.add_to(r, point.forces[static_cast<Eigen::Index>(2 * k)]);
    model_.contacts[k].tangent.add_to(r, point.forces[static_cast<Eigen::Index>(2 * k) + 1]);
  }
  return r.size() > 0 ? r.cwiseAbs().maxCoeff() : 0.0;
}

void NewmarkStep::count(Counters& counters) const {
  counters.solves = solves_;
  counters.factorisations = odd_.matrix->klu().factorisations;
  counters.refactorisations = odd_.matrix->klu().refactorisations;
  for (const Factored& f : kept_) {
    counters.factorisations += f.matrix->klu().factorisations;
    counters.refactorisations += f.matrix->klu().refactorisations;
  }
}

}  // namespace signorini
