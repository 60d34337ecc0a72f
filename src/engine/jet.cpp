#include "engine/jet.hpp"

#include <cmath>
#include <limits>

namespace signorini {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
// How many times the difference of two roundings still counts as noise: the two are one sample each.
constexpr double noise_factor = 64.0;

}  // namespace

Expander::Expander(const Model& model, const Structure& structure)
    : model_(model),
      taylor_(model, structure),
      // u^(k) of massless degrees of freedom is known one or two levels later
      levels_(taylor_.massless() ? orders + 2 : orders) {}

Jet Expander::expand(const Forcing& forcing, double t, const Vector& u, const Vector& v, int levels,
                     const Disturbance* disturbance) const {
  taylor_.expand(forcing, t, u, v, levels, 1.0, series_, disturbance);
  Jet jet;
  jet.t = t;
  jet.u = series_.u;
  jet.forces = series_.forces;
  double factorial = 1.0;
  for (Eigen::Index k = 2; k < levels + 3; ++k) {
    factorial *= static_cast<double>(k);
    jet.u.col(k) *= factorial;
    if (k <= levels) jet.forces.col(k) *= factorial;
  }
  return jet;
}

Jet Expander::expand(const Forcing& forcing, double t, const Vector& u, const Vector& v) const {
  return expand(forcing, t, u, v, levels_, nullptr);
}

ContactMotion Expander::motion(const Forcing& forcing, const Jet& jet, std::size_t c, std::size_t k) const {
  const Contact& contact = model_.contacts[c];
  const int order = static_cast<int>(k);
  ContactMotion m;
  m.N = jet.forces(static_cast<Eigen::Index>(2 * c), static_cast<Eigen::Index>(k));
  m.T = jet.forces(static_cast<Eigen::Index>(2 * c + 1), static_cast<Eigen::Index>(k));
  m.gap = contact.normal.dot(jet.u.col(static_cast<Eigen::Index>(k))) + (k == 0 ? contact.gap : 0.0);
  m.ut = contact.tangent.dot(jet.u.col(static_cast<Eigen::Index>(k))) - forcing.surface(c, jet.t, order);
  m.vn = contact.normal.dot(jet.u.col(static_cast<Eigen::Index>(k + 1)));
  m.vt =
      contact.tangent.dot(jet.u.col(static_cast<Eigen::Index>(k + 1))) - forcing.surface(c, jet.t, order + 1);
  m.an = contact.normal.dot(jet.u.col(static_cast<Eigen::Index>(k + 2)));
  m.at =
      contact.tangent.dot(jet.u.col(static_cast<Eigen::Index>(k + 2))) - forcing.surface(c, jet.t, order + 2);
  m.pressing = forcing.pressing(c, jet.t, order);
  m.pressing_rate = forcing.pressing(c, jet.t, order + 1);
  return m;
}

ContactMotion Expander::magnitude(const Forcing& forcing, const Jet& jet, std::size_t c,
                                  std::size_t k) const {
  const Contact& contact = model_.contacts[c];
  const int order = static_cast<int>(k);
  const auto sum = [](const Combination& form, const auto& x) {
    double total = 0.0;
    for (const auto& [dof, factor] : form.terms) total += std::abs(factor * x[dof]);
    return total;
  };
  ContactMotion m;
  m.gap =
      sum(contact.normal, jet.u.col(static_cast<Eigen::Index>(k))) + (k == 0 ? std::abs(contact.gap) : 0.0);
  m.ut = sum(contact.tangent, jet.u.col(static_cast<Eigen::Index>(k))) +
         std::abs(forcing.surface(c, jet.t, order));
  m.vn = sum(contact.normal, jet.u.col(static_cast<Eigen::Index>(k + 1)));
  m.vt = sum(contact.tangent, jet.u.col(static_cast<Eigen::Index>(k + 1))) +
         std::abs(forcing.surface(c, jet.t, order + 1));
  m.an = sum(contact.normal, jet.u.col(static_cast<Eigen::Index>(k + 2)));
  m.at = sum(contact.tangent, jet.u.col(static_cast<Eigen::Index>(k + 2))) +
         std::abs(forcing.surface(c, jet.t, order + 2));
  m.pressing = std::abs(forcing.pressing(c, jet.t, order));
  m.pressing_rate = std::abs(forcing.pressing(c, jet.t, order + 1));
  const auto force = [&](const Form& row, double value) {
    return row.magnitude(m) + (k == 0 ? std::abs(row.constant) : 0.0) + std::abs(value);
  };
  // Rows are read for N and T before these are filled in, so each sees the terms of its own law.
  const double N = force(taylor_.rows()[c].normal,
                         jet.forces(static_cast<Eigen::Index>(2 * c), static_cast<Eigen::Index>(k)));
  const double T = force(taylor_.rows()[c].tangent,
                         jet.forces(static_cast<Eigen::Index>(2 * c) + 1, static_cast<Eigen::Index>(k)));
  m.N = N;
  m.T = T + std::abs(taylor_.rows()[c].tangent.N) * N;
  return m;
}

std::vector<MotionJet> Expander::motions(const Forcing& forcing, const Jet& jet) const {
  const Disturbance disturbance;
  const Jet other = expand(forcing, jet.t, jet.u.col(0), jet.u.col(1), levels_, &disturbance);
  std::vector<MotionJet> result(model_.contacts.size());
  for (std::size_t c = 0; c < result.size(); ++c) {
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
      result[c].motion[k] = a;
      result[c].noise[k] = d;
    }
  }
  return result;
}

void Expander::consistent(const Forcing& forcing, double t, Point& point) const {
  const bool massless = levels_ > orders;
  const Jet jet = expand(forcing, t, point.u, point.v, massless ? 1 : 0, nullptr);
  point = {jet.u.col(0), jet.u.col(1), jet.forces.col(0), jet.u.col(2)};
}

void Expander::hold(const Forcing& forcing, double t, const Mode& mode, Vector& v) const {
  const Eigen::Index n = v.size();
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
  taylor_.solve(x.data());
  for (Eigen::Index i = 0; i < n; ++i)
    if (taylor_.kinds()[static_cast<std::size_t>(i)] == Taylor::Kind::massive) v[i] += x[i];
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
