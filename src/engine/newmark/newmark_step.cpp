#include "engine/newmark/newmark_step.hpp"

#include <algorithm>
#include <cmath>

namespace signorini {
namespace {

// Two lengths (dt, and what doubling compares it with) for each of 16 modes that a cycle comes back to; in
// bytes as much as mode systems may take (motion/mode_systems.hpp).
constexpr CacheBounds most_kept{32, std::size_t{8} << 20};

}  // namespace

NewmarkStep::NewmarkStep(const Model& model, const Structure& structure)
    : model_(model),
      structure_(structure),
      own_kinds_(dof_kinds(model, structure)),
      massless_(has_massless(model)),
      in_rows_{own_kinds_, {}},
      workshop_(model, structure),
      kept_(most_kept),
      odd_(model, structure),
      weights_(static_cast<std::size_t>(structure.size)) {
  u_.setZero(structure.size);
  v_ = none_ = u_;
  x_.setZero(structure.size + 2 * static_cast<Eigen::Index>(model.contacts.size()));
  work_ = x_;
}

void NewmarkStep::set(Key key, std::vector<Rows> rows) {
  key_ = std::move(key);
  rows_ = std::move(rows);
  if (massless_) in_rows_ = kinds_in_mode(own_kinds_, model_, rows_);
  last_ = nullptr;
}

bool NewmarkStep::factor(SystemMatrix& matrix, double h, bool fresh) {
  for (std::size_t i = 0; i < weights_.size(); ++i)
    weights_[i] = in_rows_.kinds[i] == DofKind::massive  ? Weights{1.0, 0.5 * h, 0.25 * h * h}
                  : in_rows_.kinds[i] == DofKind::damped ? Weights{0.0, 1.0, 0.5 * h}
                                                         : Weights{0.0, 0.0, 1.0};
  return matrix.set(rows_, weights_, fresh, in_rows_.undamped);
}

const TriangularFactors* NewmarkStep::factors_for(double h, bool kept) {
  if (last_ != nullptr && last_h_ == h) return last_;
  last_ = nullptr;
  last_h_ = h;
  if (!kept) {
    if (odd_key_ != key_ || odd_h_ != h) {
      const bool fresh = odd_key_ != key_ || odd_h_ == 0.0;
      odd_key_ = key_;
      odd_h_ = factor(odd_, h, fresh) ? h : 0.0;
      if (odd_h_ == 0.0) return nullptr;
    }
    return last_ = &odd_.klu().factors();
  }
  const std::pair<Key, double> place(key_, h);
  last_ = kept_.find(place);
  if (last_ == nullptr && factor(workshop_, h, true)) {
    const TriangularFactors& factors = workshop_.klu().factors();
    last_ = &kept_.insert(place, factors, factors.bytes());
  }
  return last_;
}

/// What is known of the motion at the end of the step: u_ and v_.
void NewmarkStep::know_motion(const Point& from, double h) {
  const double *u0 = from.u.data(), *v0 = from.v.data(), *a0 = from.a.data();
  for (std::size_t i = 0; i < in_rows_.kinds.size(); ++i) {
    const bool massive = in_rows_.kinds[i] == DofKind::massive, damped = in_rows_.kinds[i] == DofKind::damped;
    u_.data()[i] = massive ? u0[i] + h * (v0[i] + 0.25 * h * a0[i]) : damped ? u0[i] + 0.5 * h * v0[i] : 0.0;
    v_.data()[i] = massive ? v0[i] + 0.5 * h * a0[i] : 0.0;
  }
  for (const UndampedMotion& motion : in_rows_.undamped)
    for (const auto& [dof, factor] : motion.others)
      u_.data()[dof] -= factor * (u0[motion.dof] + 0.5 * h * v0[motion.dof]);
}

void NewmarkStep::read_motion(const Point& from, double h, Point& to) const {
  for (Vector* part : {&to.u, &to.v, &to.a}) part->resize(from.u.size());
  const double *u0 = from.u.data(), *v0 = from.v.data(), *x = x_.data();
  double *u1 = to.u.data(), *v1 = to.v.data(), *a1 = to.a.data();
  for (std::size_t i = 0; i < in_rows_.kinds.size(); ++i) {
    a1[i] = 0.0;
    if (in_rows_.kinds[i] == DofKind::massive) {
      u1[i] = u_.data()[i] + 0.25 * h * h * x[i];
      v1[i] = v_.data()[i] + 0.5 * h * x[i];
      a1[i] = x[i];
    } else if (in_rows_.kinds[i] == DofKind::damped) {
      u1[i] = u_.data()[i] + 0.5 * h * x[i];
      v1[i] = x[i];
    } else {
      u1[i] = x[i];
      v1[i] = h > 0.0 ? 2.0 * (u1[i] - u0[i]) / h - v0[i] : v0[i];
    }
  }
  for (const UndampedMotion& motion : in_rows_.undamped)
    for (const auto& [dof, factor] : motion.others) {
      u1[dof] += factor * u1[motion.dof];
      v1[dof] += factor * v1[motion.dof];
    }
}

bool NewmarkStep::take(const Forcing& forcing, const Point& from, double t1, double h, bool kept, Point& to) {
  const TriangularFactors* factors = factors_for(h, kept);
  if (factors == nullptr) return false;
  const auto n = static_cast<std::size_t>(structure_.size);
  know_motion(from, h);
  // r = P - C v - K u
  x_.setZero();
  structure_.add_product(none_.data(), v_.data(), u_.data(), x_.data());
  for (std::size_t i = 0; i < n; ++i) x_.data()[i] = -x_.data()[i];
  forcing.add_load(t1, 0, x_.data());
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const Contact& contact = model_.contacts[k];
    ContactMotion m;  // as far as it is known
    set_place(contact, u_, forcing.surface(k, t1, 0), m);
    set_velocity(contact, v_, forcing.surface(k, t1, 1), m);
    m.at = -forcing.surface(k, t1, 2);
    m.pressing = forcing.pressing(k, t1, 0);
    x_.data()[n + normal_slot(k)] = -rows_[k].normal.value(m);
    x_.data()[n + tangent_slot(k)] = -rows_[k].tangent.value(m);
  }
  factors->solve(x_.data(), work_.data());
  ++solves_;

  read_motion(from, h, to);
  to.forces.resize(x_.size() - from.u.size());
  const double* x = x_.data();
  for (std::size_t i = n; i < static_cast<std::size_t>(x_.size()); ++i) to.forces.data()[i - n] = x[i];
  // The limit itself, not what the solve leaves of it: no drift.
  for (std::size_t k = 0; k < rows_.size(); ++k)
    if (const Form& tangent = rows_[k].tangent; tangent.T == 1.0 && tangent.N != 0.0)
      to.forces.data()[tangent_slot(k)] = -tangent.N * to.forces.data()[normal_slot(k)];
  return true;
}

void NewmarkStep::count(Counters& counters) const {
  counters.solves = solves_;
  counters.factorisations = odd_.klu().factorisations + workshop_.klu().factorisations;
  counters.refactorisations = odd_.klu().refactorisations;
}

}  // namespace signorini
