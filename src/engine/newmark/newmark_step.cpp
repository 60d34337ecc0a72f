#include "engine/newmark/newmark_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/rounding.hpp"
#include "decide/guard_signs.hpp"
#include "linear/mass_factors.hpp"

namespace signorini::newmark {
namespace {

// Limits of the number and the memory of cached factors: two step lengths (dt, and 2 dt for step doubling) for each of 16
// contact states of a cycle. The memory limit is the same as for state systems (motion/state_systems.hpp).
constexpr base::CacheLimits max_kept{32, std::size_t{8} << 20};

// Time of a factorisation divided by the time of a solve. Measured for a banded matrix with 3000 unknowns: factorisation
// 0.64 ms, plus 0.3 ms for the preparation of the factors; solve 0.045 ms.
constexpr double solves_a_factorisation = 20.0;
constexpr double bytes_a_number = 12.0;  // memory of one entry of KLU's factors, in bytes
// Iterative refinement continues while each round reduces the correction at least to a tenth. Eight rounds take as long as a
// factorisation.
constexpr double least_gain = 0.1;
constexpr int most_rounds = 8;
constexpr double left_of_rounding = rounding::eps / 16.0;  // admissible relative error of a refined solution

}  // namespace

NewmarkStep::NewmarkStep(const Model& model, const linear::SystemMatrices& structure, std::size_t widest_band)
    : model_(model),
      structure_(structure),
      own_kinds_(linear::dof_kinds(model, structure)),
      massless_(linear::has_massless(model)),
      kinds_in_states_{own_kinds_, {}},
      workspace_(model, structure),
      kept_(max_kept),
      irregular_(model, structure),
      saves_factorisations_(linear::saves_factorisations(model, structure, irregular_.redundant_rows())),
      weights_(static_cast<std::size_t>(structure.size)) {
  u_.setZero(structure.size);
  v_ = u_;
  x_.setZero(structure.size + model.force_count());
  work_ = x_;
  if (saves_factorisations_) condensed_ = linear::CondensedRows::create(model, structure, widest_band);
  if (!condensed_) return;
  kept_band_.emplace(*condensed_);
  irregular_band_.emplace(*condensed_);
  local_step_.emplace(model, *condensed_);
}

void NewmarkStep::set(Key key, std::vector<Rows> rows) {
  own_rows_ = std::make_shared<std::vector<Rows>>(std::move(rows));
  set(std::move(key), std::shared_ptr<const std::vector<Rows>>(own_rows_));
}

void NewmarkStep::set(Key key, std::shared_ptr<const std::vector<Rows>> rows) {
  rows_ = std::move(rows);
  if (condensed_) {
    const bool beside = key.size() == key_.size() && key.size() == rows_->size();
    for (std::size_t k = 0; k < rows_->size(); ++k)
      if (!beside || key[k] != key_[k]) condensed_->set_rows(k, (*rows_)[k]);
  }
  key_ = std::move(key);
  if (massless_) kinds_in_states_ = linear::kinds_in_states(own_kinds_, model_, *rows_);
  last_ = nullptr;
  updates_valid_ = false;
  spent_ = 0.0;
}

void NewmarkStep::set_weights(double h) {
  for (std::size_t i = 0; i < weights_.size(); ++i)
    weights_[i] = kinds_in_states_.kinds[i] == linear::DofKind::massive
                      ? linear::Weights{1.0, 0.5 * h, 0.25 * h * h}
                  : kinds_in_states_.kinds[i] == linear::DofKind::damped ? linear::Weights{0.0, 1.0, 0.5 * h}
                                                                         : linear::Weights{0.0, 0.0, 1.0};
}

/// Factorises the matrix. fresh: choose new pivots, unless each contact force is the pivot of its own row: then the pivots of
/// other contact states are reused.
bool NewmarkStep::factor(linear::SystemMatrix& matrix, double h, bool fresh) {
  set_weights(h);
  return matrix.set(*rows_, weights_,
                    fresh && !(saves_factorisations_ && !linear::contact_force_blocks(*rows_).empty()),
                    kinds_in_states_.undamped);
}

/// Differences between the current rows and base_rows_, as rows of the matrix for the step length base_h_.
std::vector<linear::ChangedRow> NewmarkStep::changed_rows() const {
  std::vector<linear::ChangedRow> changed;
  const auto n = static_cast<std::size_t>(structure_.size);
  const auto difference = [](const Form& a, const Form& b) {
    return Form{a.N - b.N,   a.T - b.T,   a.gap - b.gap, a.ut - b.ut,
                a.vn - b.vn, a.vt - b.vt, a.an - b.an,   a.at - b.at};
  };
  const std::vector<Rows>& rows = *rows_;
  for (std::size_t k = 0; k < rows.size() && changed.size() <= linear::WoodburyFactors::max_rows; ++k)
    for (const bool normal : {true, false}) {
      const Form d = normal ? difference(rows[k].normal, base_rows_[k].normal)
                            : difference(rows[k].tangent, base_rows_[k].tangent);
      if (d == Form{}) continue;
      linear::ChangedRow row{n + (normal ? model_.layout.normal(k) : model_.layout.tangent(k)), {}};
      for (const auto& [dof, factor] : model_.contacts[k].normal.terms)
        row.entries.emplace_back(dof,
                                 linear::entry_of(d, factor, 0.0, weights_[static_cast<std::size_t>(dof)]));
      for (const auto& [dof, factor] : model_.contacts[k].tangent.terms)
        row.entries.emplace_back(dof,
                                 linear::entry_of(d, 0.0, factor, weights_[static_cast<std::size_t>(dof)]));
      row.entries.emplace_back(n + model_.layout.normal(k), d.N);
      row.entries.emplace_back(n + model_.layout.tangent(k), d.T);
      changed.push_back(std::move(row));
    }
  return changed;
}

/// Updates the base factors to the current rows. False: a new factorisation is needed, or is faster.
bool NewmarkStep::update(double h) {
  if (!saves_factorisations_ || updated_.base() == nullptr || base_h_ != h) return false;
  if (!updates_valid_) {
    set_weights(h);
    updates_valid_ = updated_.set(changed_rows());
  }
  spent_ += static_cast<double>(updated_.numbers());
  const double factorisation =
      solves_a_factorisation * static_cast<double>(updated_.base()->bytes()) / bytes_a_number;
  return updates_valid_ = updates_valid_ && spent_ <= factorisation;
}

/// Solves x_ := A^-1 x_ with the factors of the band matrix. False: there is no band matrix, or its elimination loses digits;
/// x_ is then unchanged.
bool NewmarkStep::solve_condensed(double h, bool kept) {
  if (!condensed_) return false;
  const linear::Weights weights{1.0, 0.5 * h, 0.25 * h * h};
  linear::CondensedMatrix& band =
      kept_band_->is_factored_at(weights) || (kept && !irregular_band_->is_factored_at(weights))
          ? *kept_band_
          : *irregular_band_;
  if (!band.set(weights)) return false;
  band.solve(x_.data());
  ++solves_;
  return true;
}

const motion::Point* NewmarkStep::local_end(std::size_t contact, const motion::Forcing& forcing,
                                            const motion::Point& from, double t1, double h,
                                            const motion::Point& whole, double longer) {
  if (!local_step_ || !condensed_->is_determined()) return nullptr;
  return local_step_->end(contact, forcing, *rows_, from, t1, h, whole, longer);
}

void NewmarkStep::double_radius() {
  if (local_step_) local_step_->double_radius();
}

/// Solves x_ := A^-1 x_ for a step length that will recur. False: the matrix is singular.
bool NewmarkStep::solve_kept(double h) {
  if (last_ == nullptr || last_h_ != h) {
    last_h_ = h;
    const std::pair<Key, double> place(key_, h);
    const Factors* known = updates_valid_ && base_h_ == h ? nullptr : kept_.find(place);
    last_ = known != nullptr ? *known : nullptr;
    if (last_ == nullptr && update(h)) {
      updated_.solve(x_.data(), work_.data());
      ++solves_;
      return true;
    }
    if (last_ == nullptr) {
      if (!factor(workspace_, h, true)) return false;
      last_ = std::make_shared<const linear::TriangularFactors>(workspace_.klu().factors());
      kept_.insert(place, last_, last_->bytes());
      if (saves_factorisations_) {
        updated_.set_base(last_);
        base_rows_ = *rows_;
        base_h_ = h;
        updates_valid_ = false;
      }
    }
  }
  last_->solve(x_.data(), work_.data());
  ++solves_;
  return true;
}

/// Sets rest_ := b - A x for the step length h. Requires mass on all degrees of freedom.
void NewmarkStep::set_residual(const Vector& b, const Vector& x, double h) {
  const Eigen::Index n = structure_.size;
  u_.noalias() = 0.25 * h * h * x.head(n);
  v_.noalias() = 0.5 * h * x.head(n);
  product_.setZero(x.size());
  structure_.add_product(x.data(), v_.data(), u_.data(), product_.data());
  for (std::size_t k = 0; k < rows_->size(); ++k) {
    const Contact& contact = model_.contacts[k];
    const Form &normal = (*rows_)[k].normal, &tangent = (*rows_)[k].tangent;
    const Eigen::Index N = n + static_cast<Eigen::Index>(model_.layout.normal(k)),
                       T = n + static_cast<Eigen::Index>(model_.layout.tangent(k));
    ContactMotion m;
    m.N = x[N];
    m.T = x[T];
    m.gap = contact.normal.dot(u_);
    m.ut = contact.tangent.dot(u_);
    contact::set_velocity(contact, v_, 0.0, m);
    contact::set_acceleration(contact, x, 0.0, m);
    for (const auto& [dof, factor] : contact.normal.terms) product_[dof] += factor * m.N;
    for (const auto& [dof, factor] : contact.tangent.terms) product_[dof] += factor * m.T;
    product_[N] += normal.rate(m);
    product_[T] += tangent.rate(m);
  }
  rest_.noalias() = b - product_;
}

/// Solves x_ := A^-1 x_ for the step length h by iterative refinement. Factors and initial solution are those of the last
/// irregular step length. False: the convergence is too slow; x_ is then unchanged.
bool NewmarkStep::refine(double h) {
  const Eigen::Index n = structure_.size, m = x_.size() - n;
  const auto greatest = [](const auto& of) { return of.size() > 0 ? of.cwiseAbs().maxCoeff() : 0.0; };
  const auto ratio = [](double of, double whole) { return whole > 0.0 ? of / whole : of; };
  const auto part = [&](const Vector& of, const Vector& whole) {
    return std::max(ratio(greatest(of.head(n)), greatest(whole.head(n))),
                    ratio(greatest(of.tail(m)), greatest(whole.tail(m))));
  };
  Vector x = irregular_x_;
  double before = std::numeric_limits<double>::infinity();
  for (int round = 0; round < most_rounds; ++round) {
    set_residual(x_, x, h);
    irregular_.klu().factors().solve(rest_.data(), work_.data());
    ++solves_;
    x += rest_;
    const double change = part(rest_, x),
                 gain = round == 0 ? least_gain : std::min(least_gain, change / before);
    if (change * gain <= left_of_rounding) {
      x_ = x;
      return true;
    }
    if (!(change <= least_gain * before)) {
      if (!(change <= rounding::few_operations)) return false;
      x_ = x;
      return true;
    }
    before = change;
  }
  return false;
}

/// Solves x_ := A^-1 x_ for a step length that will probably not recur. False: the matrix is singular.
bool NewmarkStep::solve_irregular(double h) {
  const bool same_rows = irregular_key_ == key_ && irregular_h_ != 0.0;
  if (!(same_rows && irregular_h_ == h)) {
    if (saves_factorisations_ && same_rows && irregular_x_.size() > 0 && refine(h)) return true;
    irregular_key_ = key_;
    irregular_h_ = factor(irregular_, h, !same_rows) ? h : 0.0;
    if (irregular_h_ == 0.0) return false;
  }
  irregular_.klu().factors().solve(x_.data(), work_.data());
  ++solves_;
  return true;
}

/// Sets u_ and v_ to the parts of u1 and v1 that do not depend on the unknowns of the step.
void NewmarkStep::predict(const motion::Point& from, double h) {
  const double *u0 = from.u.data(), *v0 = from.v.data(), *a0 = from.a.data();
  for (std::size_t i = 0; i < kinds_in_states_.kinds.size(); ++i) {
    const bool massive = kinds_in_states_.kinds[i] == linear::DofKind::massive,
               damped = kinds_in_states_.kinds[i] == linear::DofKind::damped;
    u_.data()[i] = massive ? u0[i] + h * (v0[i] + 0.25 * h * a0[i]) : damped ? u0[i] + 0.5 * h * v0[i] : 0.0;
    v_.data()[i] = massive ? v0[i] + 0.5 * h * a0[i] : 0.0;
  }
  for (const linear::UndampedMotion& motion : kinds_in_states_.undamped)
    for (const auto& [dof, factor] : motion.others)
      u_.data()[dof] -= factor * (u0[motion.dof] + 0.5 * h * v0[motion.dof]);
}

void NewmarkStep::read_motion(const motion::Point& from, double h, motion::Point& to) const {
  for (Vector* part : {&to.u, &to.v, &to.a}) part->resize(from.u.size());
  const double *u0 = from.u.data(), *v0 = from.v.data(), *x = x_.data();
  double *u1 = to.u.data(), *v1 = to.v.data(), *a1 = to.a.data();
  for (std::size_t i = 0; i < kinds_in_states_.kinds.size(); ++i) {
    a1[i] = 0.0;
    if (kinds_in_states_.kinds[i] == linear::DofKind::massive) {
      u1[i] = u_.data()[i] + 0.25 * h * h * x[i];
      v1[i] = v_.data()[i] + 0.5 * h * x[i];
      a1[i] = x[i];
    } else if (kinds_in_states_.kinds[i] == linear::DofKind::damped) {
      u1[i] = u_.data()[i] + 0.5 * h * x[i];
      v1[i] = x[i];
    } else {
      u1[i] = x[i];
      v1[i] = h > 0.0 ? 2.0 * (u1[i] - u0[i]) / h - v0[i] : v0[i];
    }
  }
  for (const linear::UndampedMotion& motion : kinds_in_states_.undamped)
    for (const auto& [dof, factor] : motion.others) {
      u1[dof] += factor * u1[motion.dof];
      v1[dof] += factor * v1[motion.dof];
    }
}

bool NewmarkStep::take(const motion::Forcing& forcing, const motion::Point& from, double t1, double h,
                       bool kept, motion::Point& to) {
  const auto n = static_cast<std::size_t>(structure_.size);
  predict(from, h);
  // r = P - C v - K u
  x_.setZero();
  structure_.subtract_forces(v_.data(), u_.data(), x_.data());
  forcing.add_load(t1, 0, x_.data());
  const std::vector<Rows>& rows = *rows_;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Contact& contact = model_.contacts[k];
    ContactMotion m;  // the part of the contact's motion that does not depend on the unknowns
    contact::set_displacement(contact, u_, forcing.surface(k, t1, 0), m);
    contact::set_velocity(contact, v_, forcing.surface(k, t1, 1), m);
    m.at = -forcing.surface(k, t1, 2);
    m.applied_normal_force = forcing.applied_normal_force(k, t1, 0);
    x_.data()[n + model_.layout.normal(k)] = -decide::QuickForm(rows[k].normal).value(m);
    x_.data()[n + model_.layout.tangent(k)] = -decide::QuickForm(rows[k].tangent).value(m);
  }
  if (!solve_condensed(h, kept)) {
    if (!(kept ? solve_kept(h) : solve_irregular(h))) return false;
    if (saves_factorisations_) {
      if (!kept) irregular_x_ = x_;
      predict(from, h);  // again, because the refinement has overwritten u_ and v_
    }
  }

  read_motion(from, h, to);
  to.forces.resize(x_.size() - from.u.size());
  const double* x = x_.data();
  for (std::size_t i = n; i < static_cast<std::size_t>(x_.size()); ++i) to.forces.data()[i - n] = x[i];
  // T of a slipping contact is computed from N instead of taken from the solution, so that T cannot drift by rounding errors.
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (const Form& tangent = rows[k].tangent; tangent.T == 1.0 && tangent.N != 0.0)
      to.forces.data()[model_.layout.tangent(k)] = -tangent.N * to.forces.data()[model_.layout.normal(k)];
  return true;
}

void NewmarkStep::count(Counters& counters) const {
  counters.solves = solves_ + updated_.solves();
  counters.factorisations = irregular_.klu().factorisations + workspace_.klu().factorisations +
                            (condensed_ ? kept_band_->factorisations + irregular_band_->factorisations : 0);
  counters.refactorisations = irregular_.klu().refactorisations + workspace_.klu().refactorisations;
}

void NewmarkWorkIntegrals::add(const motion::Forcing& forcing, const contact::ContactStates& states,
                               const motion::Point& a, double t0, const motion::Point& b, double t1,
                               double factor, motion::WorkIntegrals& works) {
  const double h = t1 - t0;
  if (!(h > 0.0)) return;
  du_ = b.u - a.u;
  v_ = 0.5 * (a.v + b.v);
  if (forcing.has_loads())
    works.loads += 0.5 * factor * (forcing.power(t0, du_.data()) + forcing.power(t1, du_.data()));
  works.damping += factor * h * structure_.damping_power(v_.data());
  const ForceLayout& layout = model_.layout;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const Contact& contact = model_.contacts[k];
    const State state = states[k].state;
    const double surface = forcing.surface(k, t1, 0) - forcing.surface(k, t0, 0);
    const double slip =
        contact::slip_of(contact, contact.tangent.dot(du_) - surface, b.T(layout, k) - a.T(layout, k));
    const ContactIncrement path{slip, surface, contact.normal.dot(du_), contact.normal.dot(v_), h};
    works.add(k,
              contact::work_on(contact, state, 0.5 * (a.N(layout, k) + b.N(layout, k)),
                               0.5 * (a.T(layout, k) + b.T(layout, k)), path),
              factor);
    if (state == State::inside)
      works.damping +=
          factor * contact::dashpot_loss_inside(contact, state, contact.gap_at(a.u), contact.gap_at(b.u));
  }
}

namespace {

// Largest number of parts of a segment. The impulse T(1024) of a half wave has a relative error of pi^2 / 12 / 1024^2.
constexpr std::size_t finest = 1024;
// Largest error of an impulse for steps of length dt, relative to int |f|. The error is smaller for four steps over a half
// sine, and larger for three steps.
constexpr double lost = 1.0 / 16.0;
constexpr double passed = 1e-4;  // largest error of an impulse for shorter steps, relative to int |f|

using Values = std::array<double, finest + 1>;

/// True if the polynomial with the coefficients c has degree 2 or higher.
bool curves(const std::vector<double>& c) {
  return std::any_of(c.begin() + std::min<std::ptrdiff_t>(2, std::ssize(c)), c.end(),
                     [](double x) { return x != 0.0; });
}

/// True if the piece is not a straight line.
bool bends(const Piece& piece) {
  return piece.function || piece.amplitude != 0.0 || curves(piece.coefficients);
}

/// Mean of f over the segment by the trapezoidal rule on every stride-th value.
double trapezoid(const Values& f, std::size_t stride) {
  double sum = 0.5 * (f.front() + f.back());
  for (std::size_t i = stride; i < finest; i += stride) sum += f[i];
  return sum * static_cast<double>(stride) / static_cast<double>(finest);
}

/// Mean of f over the segment by the trapezoidal rule on steps of length dt and a shorter last step.
double trapezoid_by_dt(const Piece& piece, double begin, double end, double dt) {
  double sum = 0.0, from = begin, before = piece.value(begin);
  for (int i = 1; from < end; ++i) {
    const double next = begin + i * dt, to = end - next <= length_tolerance * dt ? end : next;
    const double after = piece.value(to);
    sum += 0.5 * (to - from) * (before + after);
    from = to;
    before = after;
  }
  return sum / (end - begin);
}

/// True if f is a cubic that stays between its values at both ends, like the cubic between two rows of a table.
bool between_rows(const Piece& piece, double begin, double end) {
  // Number of sample intervals. A cubic with an interior extreme exceeds its end values at several samples.
  constexpr int looks = 16;
  if (piece.function || piece.amplitude != 0.0 || piece.coefficients.size() != 4) return false;
  const auto [least, greatest] = std::minmax({piece.value(begin), piece.value(end)});
  for (int i = 1; i < looks; ++i)
    if (const double f = piece.value(begin + (end - begin) * i / looks); f < least || f > greatest)
      return false;
  return true;
}

/// True if an estimate without the integral of |f| proves that dt is short enough: for a sine plus a straight line, steps of
/// length h have an error of at most h^2/12 |f''|, and int |f| >= |J|.
bool dt_clearly_suffices(const Piece& piece, double begin, double end, double dt) {
  if (piece.function || curves(piece.coefficients)) return false;
  const double turn = piece.omega * std::min(dt, end - begin);
  const double error = turn * turn / 12.0 * std::abs(piece.amplitude);
  return error <= lost * (std::abs(trapezoid_by_dt(piece, begin, end, dt)) - error);
}

/// Number of equal steps that a piece of a history needs between `begin` and `end`. 1: dt is short enough.
std::size_t parts_for(const Piece& piece, double begin, double end, double dt) {
  if (between_rows(piece, begin, end) || dt_clearly_suffices(piece, begin, end, dt)) return 1;
  Values f, size;
  for (std::size_t i = 0; i <= finest; ++i) {
    f[i] = piece.value(
        i == finest ? end : begin + (end - begin) * static_cast<double>(i) / static_cast<double>(finest));
    size[i] = std::abs(f[i]);
  }
  const double impulse = trapezoid(f, 1), whole = trapezoid(size, 1);
  if (std::abs(trapezoid_by_dt(piece, begin, end, dt) - impulse) <= lost * whole) return 1;
  std::size_t parts = 2;
  const auto too_few = [&] {
    return end - begin > dt * static_cast<double>(parts) ||
           std::abs(trapezoid(f, finest / parts) - impulse) > passed * whole;
  };
  while (parts < finest && too_few()) parts *= 2;
  return parts;
}

}  // namespace

double segment_step_length(const Model& model, double begin, double end, double dt) {
  if (!(end - begin < short_segment_steps * dt)) return dt;
  const double middle = 0.5 * (begin + end);
  std::size_t parts = 1;
  const auto consider = [&](const History& history) {
    if (const Piece& piece = history.piece(middle); bends(piece))
      parts = std::max(parts, parts_for(piece, begin, end, dt));
  };
  for (const Load& load : model.loads) consider(load.history);
  for (const Contact& contact : model.contacts) consider(contact.normal_force);
  while (parts > 1 && (end - begin) / static_cast<double>(parts) < rounding::few_operations * std::abs(end))
    parts /= 2;
  return parts > 1 ? std::min(dt, (end - begin) / static_cast<double>(parts)) : dt;
}

}  // namespace signorini::newmark
