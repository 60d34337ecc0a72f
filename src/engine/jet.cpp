#include "engine/jet.hpp"

#include <cmath>
#include <limits>

namespace signorini {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
// How many times the difference of two roundings still counts as noise: the two are one sample each.
constexpr double noise_factor = 64.0;

}  // namespace

/// A fixed sequence of signs, so that runs repeat bit for bit.
struct Expander::Disturbance {
  static double sign(std::size_t i) { return ((i * 2654435761u) >> 7) & 1u ? epsilon : -epsilon; }
};

Expander::Expander(const Model& model, const Structure& structure)
    : model_(model), structure_(structure), matrix_(model, structure), levels_(orders) {
  std::vector<double> damping(static_cast<std::size_t>(structure.size), 0.0);
  for (std::size_t p = 0; p < structure.row.size(); ++p)
    damping[static_cast<std::size_t>(structure.row[p])] += std::abs(structure.c[p]);
  for (std::size_t i = 0; i < model.dofs.size(); ++i) {
    const Kind kind = !model.dofs[i].massless ? Kind::massive
                      : damping[i] > 0.0      ? Kind::damped
                                              : Kind::algebraic;
    kinds_.push_back(kind);
    weights_.push_back(kind == Kind::massive  ? Weights{1.0, 0.0, 0.0}
                       : kind == Kind::damped ? Weights{0.0, 1.0, 0.0}
                                              : Weights{0.0, 0.0, 1.0});
    if (kind != Kind::massive) levels_ = orders + 2;  // u^(k) of these is known one or two levels later
  }
}

bool Expander::set(const Mode& mode) {
  rows_ = rows_of(model_, mode);
  return matrix_.set(rows_, weights_, true);
}

void Expander::level(const Forcing& forcing, double t, int order, Jet& jet,
                     const Disturbance* disturbance) const {
  const auto k = static_cast<std::size_t>(order);
  const auto n = static_cast<std::size_t>(structure_.size);
  const std::size_t total = n + 2 * model_.contacts.size();
  Vector x = Vector::Zero(static_cast<Eigen::Index>(total));
  Vector known_u = jet.u[k], known_v = jet.u[k + 1];
  for (std::size_t i = 0; i < n; ++i) {
    if (kinds_[i] == Kind::algebraic) known_u[static_cast<Eigen::Index>(i)] = 0.0;
    if (kinds_[i] != Kind::massive) known_v[static_cast<Eigen::Index>(i)] = 0.0;
  }
  structure_.add_product(structure_.c, known_v.data(), x.data());
  structure_.add_product(structure_.k, known_u.data(), x.data());
  x = -x;
  forcing.add_load(t, order, x.data());

  Vector magnitude;
  if (disturbance != nullptr) {
    magnitude = Vector::Zero(static_cast<Eigen::Index>(n));
    for (std::size_t j = 0; j < n; ++j)
      for (auto p = static_cast<std::size_t>(structure_.column_start[j]);
           p < static_cast<std::size_t>(structure_.column_start[j + 1]); ++p)
        magnitude[structure_.row[p]] += std::abs(structure_.c[p] * known_v[static_cast<Eigen::Index>(j)]) +
                                        std::abs(structure_.k[p] * known_u[static_cast<Eigen::Index>(j)]);
    for (std::size_t i = 0; i < n; ++i) {
      const auto e = static_cast<Eigen::Index>(i);
      x[e] += Disturbance::sign(i + 31 * k) * (magnitude[e] + std::abs(x[e]));
    }
  }

  for (std::size_t c = 0; c < model_.contacts.size(); ++c) {
    const Contact& contact = model_.contacts[c];
    ContactMotion m;
    m.gap = contact.normal.dot(known_u) + (order == 0 ? contact.gap : 0.0);
    m.ut = contact.tangent.dot(known_u) - forcing.surface(c, t, order);
    m.vn = contact.normal.dot(known_v);
    m.vt = contact.tangent.dot(known_v) - forcing.surface(c, t, order + 1);
    m.at = -forcing.surface(c, t, order + 2);
    m.pressing = forcing.pressing(c, t, order);
    m.pressing_rate = forcing.pressing(c, t, order + 1);
    const auto row = static_cast<Eigen::Index>(n + 2 * c);
    x[row] = -(order == 0 ? rows_[c].normal.value(m) : rows_[c].normal.rate(m));
    x[row + 1] = -(order == 0 ? rows_[c].tangent.value(m) : rows_[c].tangent.rate(m));
  }

  matrix_.solve(x.data());
  for (std::size_t i = 0; i < n; ++i) {
    const auto e = static_cast<Eigen::Index>(i);
    jet.u[k + (kinds_[i] == Kind::massive ? 2 : kinds_[i] == Kind::damped ? 1 : 0)][e] = x[e];
  }
  jet.forces[k] = x.tail(static_cast<Eigen::Index>(total - n));
}

Jet Expander::expand(const Forcing& forcing, double t, const Vector& u, const Vector& v, int levels,
                     const Disturbance* disturbance) const {
  Jet jet;
  jet.t = t;
  jet.u.assign(static_cast<std::size_t>(levels) + 3, Vector::Zero(u.size()));
  jet.forces.assign(static_cast<std::size_t>(levels) + 1, Vector());
  jet.u[0] = u;
  for (Eigen::Index i = 0; i < u.size(); ++i)
    if (kinds_[static_cast<std::size_t>(i)] == Kind::massive) jet.u[1][i] = v[i];
  if (disturbance != nullptr)
    for (Eigen::Index i = 0; i < u.size(); ++i) {
      jet.u[0][i] *= 1.0 + Disturbance::sign(static_cast<std::size_t>(i) + 7);
      jet.u[1][i] *= 1.0 + Disturbance::sign(static_cast<std::size_t>(i) + 13);
    }
  for (int k = 0; k <= levels; ++k) level(forcing, t, k, jet, disturbance);
  return jet;
}

Jet Expander::expand(const Forcing& forcing, double t, const Vector& u, const Vector& v) const {
  return expand(forcing, t, u, v, levels_, nullptr);
}

ContactMotion Expander::motion(const Forcing& forcing, const Jet& jet, std::size_t c, std::size_t k) const {
  const Contact& contact = model_.contacts[c];
  const int order = static_cast<int>(k);
  ContactMotion m;
  m.N = jet.forces[k][static_cast<Eigen::Index>(2 * c)];
  m.T = jet.forces[k][static_cast<Eigen::Index>(2 * c + 1)];
  m.gap = contact.normal.dot(jet.u[k]) + (k == 0 ? contact.gap : 0.0);
  m.ut = contact.tangent.dot(jet.u[k]) - forcing.surface(c, jet.t, order);
  m.vn = contact.normal.dot(jet.u[k + 1]);
  m.vt = contact.tangent.dot(jet.u[k + 1]) - forcing.surface(c, jet.t, order + 1);
  m.an = contact.normal.dot(jet.u[k + 2]);
  m.at = contact.tangent.dot(jet.u[k + 2]) - forcing.surface(c, jet.t, order + 2);
  m.pressing = forcing.pressing(c, jet.t, order);
  m.pressing_rate = forcing.pressing(c, jet.t, order + 1);
  return m;
}

ContactMotion Expander::magnitude(const Forcing& forcing, const Jet& jet, std::size_t c,
                                  std::size_t k) const {
  const Contact& contact = model_.contacts[c];
  const int order = static_cast<int>(k);
  const auto sum = [](const Combination& form, const Vector& x) {
    double total = 0.0;
    for (const auto& [dof, factor] : form.terms) total += std::abs(factor * x[dof]);
    return total;
  };
  ContactMotion m;
  m.gap = sum(contact.normal, jet.u[k]) + (k == 0 ? std::abs(contact.gap) : 0.0);
  m.ut = sum(contact.tangent, jet.u[k]) + std::abs(forcing.surface(c, jet.t, order));
  m.vn = sum(contact.normal, jet.u[k + 1]);
  m.vt = sum(contact.tangent, jet.u[k + 1]) + std::abs(forcing.surface(c, jet.t, order + 1));
  m.an = sum(contact.normal, jet.u[k + 2]);
  m.at = sum(contact.tangent, jet.u[k + 2]) + std::abs(forcing.surface(c, jet.t, order + 2));
  m.pressing = std::abs(forcing.pressing(c, jet.t, order));
  m.pressing_rate = std::abs(forcing.pressing(c, jet.t, order + 1));
  const auto force = [&](const Form& row, double value) {
    return row.magnitude(m) + (k == 0 ? std::abs(row.constant) : 0.0) + std::abs(value);
  };
  // Rows are read for N and T before these are filled in, so each sees the terms of its own law.
  const double N = force(rows_[c].normal, jet.forces[k][static_cast<Eigen::Index>(2 * c)]);
  const double T = force(rows_[c].tangent, jet.forces[k][static_cast<Eigen::Index>(2 * c) + 1]);
  m.N = N;
  m.T = T + std::abs(rows_[c].tangent.N) * N;
  return m;
}

std::vector<MotionJet> Expander::motions(const Forcing& forcing, const Jet& jet) const {
  const Disturbance disturbance;
  const Jet other = expand(forcing, jet.t, jet.u[0], jet.u[1], levels_, &disturbance);
  std::vector<MotionJet> result(model_.contacts.size());
  for (std::size_t c = 0; c < result.size(); ++c)
    for (std::size_t k = 0; k <= static_cast<std::size_t>(orders); ++k) {
      const ContactMotion a = motion(forcing, jet, c, k), b = motion(forcing, other, c, k);
      // One sample of rounding can be small by chance, so the terms of each sum count as well.
      const ContactMotion terms = magnitude(forcing, jet, c, k);
      const auto noise = [](double x, double y, double size) {
        return noise_factor * (std::abs(x - y) + epsilon * size);
      };
      ContactMotion d;
      d.N = noise(a.N, b.N, terms.N);
      d.T = noise(a.T, b.T, terms.T);
      d.gap = noise(a.gap, b.gap, terms.gap);
      d.ut = noise(a.ut, b.ut, terms.ut);
      d.vn = noise(a.vn, b.vn, terms.vn);
      d.vt = noise(a.vt, b.vt, terms.vt);
      d.an = noise(a.an, b.an, terms.an);
      d.at = noise(a.at, b.at, terms.at);
      d.pressing = noise_factor * epsilon * terms.pressing;
      d.pressing_rate = noise_factor * epsilon * terms.pressing_rate;
      result[c].motion.push_back(a);
      result[c].noise.push_back(d);
    }
  return result;
}

void Expander::consistent(const Forcing& forcing, double t, Point& point) const {
  const bool massless = levels_ > orders;
  Jet jet = expand(forcing, t, point.u, point.v, massless ? 1 : 0, nullptr);
  point = {std::move(jet.u[0]), std::move(jet.u[1]), std::move(jet.forces[0]), std::move(jet.u[2])};
}

void Expander::hold(const Forcing& forcing, double t, const Mode& mode, Vector& v) const {
  const auto n = static_cast<Eigen::Index>(structure_.size);
  Vector x = Vector::Zero(n + 2 * static_cast<Eigen::Index>(mode.size()));
  bool any = false;
  for (std::size_t c = 0; c < mode.size(); ++c) {
    const Contact& contact = model_.contacts[c];
    if (mode[c].state != State::stick || contact.tangential_stiffness || contact.shear) continue;
    const double miss = forcing.surface(c, t, 1) - contact.tangent.dot(v);
    if (miss == 0.0) continue;
    x[n + 2 * static_cast<Eigen::Index>(c) + 1] = miss;
    any = true;
  }
  if (!any) return;
  matrix_.solve(x.data());
  for (Eigen::Index i = 0; i < n; ++i)
    if (kinds_[static_cast<std::size_t>(i)] == Kind::massive) v[i] += x[i];
  for (std::size_t c = 0; c < mode.size(); ++c) {  // one degree of freedom: exact, not to roundoff
    const Contact& contact = model_.contacts[c];
    if (mode[c].state == State::stick && !contact.tangential_stiffness && !contact.shear &&
        contact.tangent.terms.size() == 1) {
      const auto& [dof, factor] = contact.tangent.terms[0];
      v[dof] = forcing.surface(c, t, 1) / factor;
    }
  }
}

}  // namespace signorini
