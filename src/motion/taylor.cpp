#include "motion/taylor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/law.hpp"

namespace signorini {
namespace {

constexpr int small = 40;  // unknowns up to which a dense inverse is quicker than a sparse solve

}  // namespace

double Disturbance::sign(std::size_t i) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  return ((i * 2654435761u) >> 7) & 1u ? epsilon : -epsilon;
}

Taylor::Taylor(const Model& model, const Structure& structure)
    : model_(model), structure_(structure), matrix_(model, structure) {
  const auto n = static_cast<std::size_t>(structure.size);
  std::vector<double> damping(n, 0.0);
  for (std::size_t p = 0; p < structure.row.size(); ++p)
    damping[static_cast<std::size_t>(structure.row[p])] += std::abs(structure.c[p]);
  for (std::size_t i = 0; i < n; ++i) {
    own_kinds_.push_back(!model.dofs[i].massless ? Kind::massive
                         : damping[i] > 0.0      ? Kind::damped
                                                 : Kind::algebraic);
    massless_ = massless_ || own_kinds_.back() != Kind::massive;
  }
  kinds_ = own_kinds_;
  weights_.resize(n);
  x_.resize(static_cast<std::size_t>(matrix_.size()));
  y_.resize(x_.size());
  known_u_.resize(n);
  known_v_.resize(n);
  magnitude_.resize(n);
}

void Taylor::pin(const Mode& mode) {
  pinned_.clear();
  for (std::size_t c = 0; c < mode.size(); ++c) {
    const Contact& contact = model_.contacts[c];
    if (rows_[c].normal.an != 0.0 && rows_[c].normal.N == 0.0 && contact.normal.terms.size() == 1)
      pinned_.push_back({static_cast<std::size_t>(contact.normal.terms[0].first), c,
                         contact.normal.terms[0].second, false});
    if (rows_[c].tangent.at != 0.0 && contact.tangent.terms.size() == 1)
      pinned_.push_back({static_cast<std::size_t>(contact.tangent.terms[0].first), c,
                         contact.tangent.terms[0].second, true});
  }
}

namespace {

/// Coefficient j of the slip rate.
double rate_coefficient(const Contact& contact, std::size_t c, const Series& series, Eigen::Index j) {
  const ForcingSeries& f = series.forcing;
  const double* u = series.u.col(j + 1).data();
  const double surface = f.surface[c * f.count + static_cast<std::size_t>(j) + 1];
  return static_cast<double>(j + 1) / series.scale * (contact.tangent.dot(u) - surface);
}

}  // namespace

/// Friction at the beginning of a series is a coefficient of its matrix.
void Taylor::start_friction(const Series& series) {
  for (Stribeck& friction : stribeck_) {
    const Contact& contact = model_.contacts[friction.contact];
    const double along = friction.s * rate_coefficient(contact, friction.contact, series, 0);
    friction.f.assign(1, sliding_friction(contact, along));
    friction.exponent.assign(1, -along / *contact.stribeck_velocity);
    rows_[friction.contact].tangent.N = friction.s * friction.f[0];
  }
  if (!stribeck_.empty()) matrix_.set(rows_, weights_, true);
}

/// s sum_(j = 1..k) f_j N_(k-j); with E = exp(g): k E_k = sum_j j g_j E_(k-j), f_k = (fs - fk) E_k.
double Taylor::known_friction(Stribeck& friction, int order, const Series& series) const {
  const auto k = static_cast<std::size_t>(order);
  if (k == 0) return 0.0;
  const Contact& contact = model_.contacts[friction.contact];
  const double rate = rate_coefficient(contact, friction.contact, series, order);
  friction.exponent.resize(k + 1);
  friction.f.resize(k + 1);
  friction.exponent[k] = -friction.s * rate / *contact.stribeck_velocity;
  double sum = 0.0;  // f and E differ by a factor, but for f_0
  for (std::size_t j = 1; j <= k; ++j) {
    const double f = j == k ? friction.f[0] - contact.kinetic_friction : friction.f[k - j];
    sum += static_cast<double>(j) * friction.exponent[j] * f;
  }
  friction.f[k] = sum / static_cast<double>(k);
  double known = 0.0;
  for (std::size_t j = 1; j <= k; ++j)
    known += friction.f[j] *
             series.forces(static_cast<Eigen::Index>(2 * friction.contact), static_cast<Eigen::Index>(k - j));
  return friction.s * known;
}

double Taylor::pinned_value(const Pinned& p, int order, const Series& series) const {
  if (!p.tangent) return 0.0;
  const ForcingSeries& f = series.forcing;
  const double second = static_cast<double>((order + 1) * (order + 2)) / (series.scale * series.scale);
  return second * f.surface[p.contact * f.count + static_cast<std::size_t>(order) + 2] / p.factor;
}

bool Taylor::set(const Mode& mode) {
  rows_.resize(mode.size());
  for (std::size_t k = 0; k < mode.size(); ++k) rows_[k] = signorini::rows(model_.contacts[k], mode[k]);
  if (massless_) {  // the dashpot of a closed contact damps what it presses
    kinds_ = own_kinds_;
    for (std::size_t k = 0; k < mode.size(); ++k)
      if (rows_[k].normal.vn != 0.0)
        for (const auto& [dof, factor] : model_.contacts[k].normal.terms)
          if (Kind& kind = kinds_[static_cast<std::size_t>(dof)]; kind == Kind::algebraic && factor != 0.0)
            kind = Kind::damped;
  }
  for (std::size_t i = 0; i < kinds_.size(); ++i)
    weights_[i] = kinds_[i] == Kind::massive  ? Weights{1.0, 0.0, 0.0}
                  : kinds_[i] == Kind::damped ? Weights{0.0, 1.0, 0.0}
                                              : Weights{0.0, 0.0, 1.0};
  pin(mode);
  stribeck_.clear();
  for (std::size_t c = 0; c < mode.size(); ++c)
    if (model_.contacts[c].stribeck_velocity && slip_sign(mode[c].state) != 0)
      stribeck_.push_back({c, slip_sign(mode[c].state), {}, {}});
  small_ = nullptr;
  if (matrix_.size() > small || !stribeck_.empty()) return matrix_.set(rows_, weights_, true);
  const std::vector<State> states = states_of(mode);
  const auto known = smalls_.find(states);
  if (known != smalls_.end()) {
    small_ = &known->second;
    return !small_->inverse.empty();
  }
  Small& made = smalls_[states];  // empty: singular
  small_ = &made;
  if (!matrix_.set(rows_, weights_, true)) return false;
  const std::size_t size = x_.size(), n = known_u_.size();
  made.inverse.assign(size * size, 0.0);
  for (std::size_t j = 0; j < size; ++j) {
    made.inverse[j * size + j] = 1.0;
    matrix_.solve(made.inverse.data() + j * size);
  }
  // What a unit of u_k or v_k asks of the unknowns; massless parts know neither beforehand.
  made.from_u.assign(size * n, 0.0);
  made.from_v.assign(size * n, 0.0);
  for (std::size_t j = 0; j < n && !massless_; ++j) {
    double *u = made.from_u.data() + j * size, *v = made.from_v.data() + j * size;
    for (auto p = static_cast<std::size_t>(structure_.column_start[j]);
         p < static_cast<std::size_t>(structure_.column_start[j + 1]); ++p) {
      u[structure_.row[p]] -= structure_.k[p];
      v[structure_.row[p]] -= structure_.c[p];
    }
    for (std::size_t c = 0; c < mode.size(); ++c) {
      const Contact& contact = model_.contacts[c];
      double normal = 0.0, tangent = 0.0;
      for (const auto& [dof, factor] : contact.normal.terms)
        if (dof == static_cast<int>(j)) normal += factor;
      for (const auto& [dof, factor] : contact.tangent.terms)
        if (dof == static_cast<int>(j)) tangent += factor;
      u[n + 2 * c] -= rows_[c].normal.gap * normal;
      v[n + 2 * c] -= rows_[c].normal.vn * normal;
      u[n + 2 * c + 1] -= rows_[c].tangent.ut * tangent;
      v[n + 2 * c + 1] -= rows_[c].tangent.vt * tangent;
    }
    solve(u);
    solve(v);
  }
  return true;
}

void Taylor::solve(double* x) {
  if (small_ == nullptr) {
    matrix_.solve(x);
    return;
  }
  const std::size_t size = x_.size();
  double* y = y_.data();
  const double* column = small_->inverse.data();
  for (std::size_t i = 0; i < size; ++i) y[i] = column[i] * x[0];
  for (std::size_t j = 1; j < size; ++j) {
    column += size;
    const double xj = x[j];
    if (xj == 0.0) continue;
    for (std::size_t i = 0; i < size; ++i) y[i] += column[i] * xj;
  }
  for (std::size_t i = 0; i < size; ++i) x[i] = y[i];
}

/// What rows of contact c know beforehand of forcing and constants at order k: pressing, surface, gap.
void Taylor::known_of_rows(std::size_t c, int order, const Series& series, double& r, double& q) const {
  const Form &normal = rows_[c].normal, &tangent = rows_[c].tangent;
  const ForcingSeries& f = series.forcing;
  const double to_velocity = (order + 1) / series.scale;
  const double* surface = f.surface.data() + c * f.count + static_cast<std::size_t>(order);
  const double* pressing = f.pressing.data() + c * f.count + static_cast<std::size_t>(order);
  r = normal.pressing * pressing[0];
  q = -tangent.ut * surface[0] - tangent.vt * to_velocity * surface[1] -
      tangent.at * to_velocity * (order + 2) / series.scale * surface[2];
  if (order > 0) return;
  r += normal.constant + normal.gap * model_.contacts[c].gap;
  q += tangent.constant;
}

/// Sizes known to the compiler (0: not known) let it unroll the loops over one or two masses.
template <std::size_t fixed_n, std::size_t fixed_size>
void Taylor::level_small(const Forcing& forcing, int order, Series& series) {
  const std::size_t n = fixed_n > 0 ? fixed_n : known_u_.size();
  const std::size_t size = fixed_size > 0 ? fixed_size : x_.size();
  const double to_velocity = (order + 1) / series.scale;
  const double to_acceleration = to_velocity * (order + 2) / series.scale;
  const double* u_k = series.u.data() + static_cast<std::size_t>(order) * n;
  const double* u_k1 = u_k + n;
  double* u_k2 = series.u.data() + static_cast<std::size_t>(order + 2) * n;
  double *x = x_.data(), *y = y_.data();
  const double *from_u = small_->from_u.data(), *from_v = small_->from_v.data();
  for (std::size_t i = 0; i < size; ++i) y[i] = 0.0;
  for (std::size_t j = 0; j < n; ++j, from_u += size, from_v += size) {
    const double u = u_k[j], v = to_velocity * u_k1[j];
    for (std::size_t i = 0; i < size; ++i) y[i] += from_u[i] * u + from_v[i] * v;
  }
  if (order == 0 || forcing.varies()) {
    for (std::size_t i = 0; i < size; ++i) x[i] = 0.0;
    forcing.add_load(series.forcing, static_cast<std::size_t>(order), x);
    for (std::size_t c = 0; c < rows_.size(); ++c) {
      if (order > 0 && !forcing.drives(c)) continue;
      double r = 0.0, q = 0.0;
      known_of_rows(c, order, series, r, q);
      x[n + 2 * c] = -r;
      x[n + 2 * c + 1] = -q;
    }
    const double* column = small_->inverse.data();
    for (std::size_t j = 0; j < size; ++j, column += size) {
      const double xj = x[j];
      if (xj == 0.0) continue;
      for (std::size_t i = 0; i < size; ++i) y[i] += column[i] * xj;
    }
  }
  for (const Pinned& p : pinned_) y[p.dof] = pinned_value(p, order, series);
  const double to_u = 1.0 / to_acceleration;
  for (std::size_t i = 0; i < n; ++i) u_k2[i] = y[i] * to_u;
  double* forces = series.forces.data() + static_cast<std::size_t>(order) * (size - n);
  for (std::size_t i = n; i < size; ++i) forces[i - n] = y[i];
}

void Taylor::level(const Forcing& forcing, int order, Series& series, const Disturbance* disturbance) {
  if (small_ != nullptr && !massless_ && disturbance == nullptr) {
    const std::size_t masses = known_u_.size(), unknowns = x_.size();
    if (masses == 1 && unknowns == 3) return level_small<1, 3>(forcing, order, series);
    if (masses == 2 && unknowns == 4) return level_small<2, 4>(forcing, order, series);
    if (masses == 2 && unknowns == 6) return level_small<2, 6>(forcing, order, series);
    return level_small<0, 0>(forcing, order, series);
  }
  const auto k = static_cast<std::size_t>(order);
  const auto n = static_cast<std::size_t>(structure_.size);
  const double to_velocity = (order + 1) / series.scale;
  const double to_acceleration = to_velocity * (order + 2) / series.scale;
  double* u_k = series.u.col(order).data();
  double* u_k1 = series.u.col(order + 1).data();
  double* u_k2 = series.u.col(order + 2).data();
  if (massless_) {
    for (std::size_t i = 0; i < n; ++i) {
      known_u_[i] = kinds_[i] == Kind::algebraic ? 0.0 : u_k[i];
      known_v_[i] = kinds_[i] == Kind::massive ? to_velocity * u_k1[i] : 0.0;
    }
  } else {
    for (std::size_t i = 0; i < n; ++i) {
      known_u_[i] = u_k[i];
      known_v_[i] = to_velocity * u_k1[i];
    }
  }
  std::fill(x_.begin(), x_.begin() + static_cast<std::ptrdiff_t>(n), 0.0);
  forcing.add_load(series.forcing, k, x_.data());
  for (std::size_t j = 0; j < n; ++j) {
    const double uj = known_u_[j], vj = known_v_[j];
    const auto end = static_cast<std::size_t>(structure_.column_start[j + 1]);
    for (auto p = static_cast<std::size_t>(structure_.column_start[j]); p < end; ++p)
      x_[static_cast<std::size_t>(structure_.row[p])] -= structure_.c[p] * vj + structure_.k[p] * uj;
  }

  if (disturbance != nullptr) {
    std::fill(magnitude_.begin(), magnitude_.end(), 0.0);
    for (std::size_t j = 0; j < n; ++j)
      for (auto p = static_cast<std::size_t>(structure_.column_start[j]);
           p < static_cast<std::size_t>(structure_.column_start[j + 1]); ++p)
        magnitude_[static_cast<std::size_t>(structure_.row[p])] +=
            std::abs(structure_.c[p] * known_v_[j]) + std::abs(structure_.k[p] * known_u_[j]);
    for (std::size_t i = 0; i < n; ++i)
      x_[i] += Disturbance::sign(i + 31 * k) * (magnitude_[i] + std::abs(x_[i]));
  }

  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    const Contact& contact = model_.contacts[c];
    const Form &normal = rows_[c].normal, &tangent = rows_[c].tangent;
    double r = 0.0, q = 0.0;
    known_of_rows(c, order, series, r, q);
    if (normal.gap != 0.0) r += normal.gap * contact.normal.dot(known_u_);
    if (normal.vn != 0.0) r += normal.vn * contact.normal.dot(known_v_);
    if (tangent.ut != 0.0) q += tangent.ut * contact.tangent.dot(known_u_);
    if (tangent.vt != 0.0) q += tangent.vt * contact.tangent.dot(known_v_);
    x_[n + 2 * c] = -r;
    x_[n + 2 * c + 1] = -q;
    if (disturbance == nullptr) continue;
    // kn g is a difference of great numbers: its rounding is that of its terms.
    double r_terms = std::abs(r), q_terms = std::abs(q);
    if (order == 0) {
      r_terms += std::abs(normal.constant) + std::abs(normal.gap * contact.gap);
      q_terms += std::abs(tangent.constant) +
                 std::abs(tangent.ut * series.forcing.surface[c * series.forcing.count]);
    }
    for (const auto& [dof, factor] : contact.normal.terms) {
      const auto i = static_cast<std::size_t>(dof);
      r_terms += std::abs(normal.gap * factor * known_u_[i]) + std::abs(normal.vn * factor * known_v_[i]);
    }
    for (const auto& [dof, factor] : contact.tangent.terms) {
      const auto i = static_cast<std::size_t>(dof);
      q_terms += std::abs(tangent.ut * factor * known_u_[i]) + std::abs(tangent.vt * factor * known_v_[i]);
    }
    x_[n + 2 * c] += Disturbance::sign(c + 17 * k) * r_terms;
    x_[n + 2 * c + 1] += Disturbance::sign(c + 17 * k + 3) * q_terms;
  }

  for (Stribeck& friction : stribeck_)
    x_[n + 2 * friction.contact + 1] -= known_friction(friction, order, series);

  solve(x_.data());
  if (disturbance == nullptr)
    for (const Pinned& p : pinned_)
      if (kinds_[p.dof] == Kind::massive) x_[p.dof] = pinned_value(p, order, series);
  for (std::size_t i = 0; i < n; ++i) {
    if (kinds_[i] == Kind::massive)
      u_k2[i] = x_[i] / to_acceleration;
    else if (kinds_[i] == Kind::damped)
      u_k1[i] = x_[i] / to_velocity;
    else
      u_k[i] = x_[i];
  }
  double* forces = series.forces.col(order).data();
  std::copy(x_.begin() + static_cast<std::ptrdiff_t>(n), x_.end(), forces);
}

void Taylor::expand(const Forcing& forcing, double t, const Vector& u, const Vector& v, int levels,
                    double scale, Series& out, const Disturbance* disturbance) {
  begin(forcing, t, u, v, levels, scale, out, disturbance);
  for (int k = 0; k <= levels; ++k) level(forcing, k, out, disturbance);
  out.levels = levels;
}

void Taylor::begin(const Forcing& forcing, double t, const Vector& u, const Vector& v, int levels,
                   double scale, Series& out, const Disturbance* disturbance) {
  out.t = t;
  out.scale = scale;
  out.levels = -1;
  out.u.setZero(u.size(), levels + 3);
  out.forces.resize(static_cast<Eigen::Index>(2 * model_.contacts.size()), levels + 1);
  forcing.expand(t, scale, static_cast<std::size_t>(levels) + 3, out.forcing);
  out.u.col(0) = u;
  for (Eigen::Index i = 0; i < u.size(); ++i)
    if (kinds_[static_cast<std::size_t>(i)] == Kind::massive) out.u(i, 1) = scale * v[i];
  if (disturbance != nullptr)
    for (Eigen::Index i = 0; i < u.size(); ++i) {
      out.u(i, 0) *= 1.0 + Disturbance::sign(static_cast<std::size_t>(i) + 7);
      out.u(i, 1) *= 1.0 + Disturbance::sign(static_cast<std::size_t>(i) + 13);
    }
  start_friction(out);
}

void Taylor::extend(const Forcing& forcing, int levels, Series& out) {
  for (int k = out.levels + 1; k <= levels; ++k) level(forcing, k, out, nullptr);
  out.levels = std::max(out.levels, levels);
}

}  // namespace signorini
