#include "motion/jet.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/rounding.hpp"
#include "motion/point.hpp"

namespace signorini::motion {
namespace {

// Ratio of the noise to the difference of both computations. It is larger than one because the difference is only one sample
// of the rounding errors.
constexpr double noise_factor = rounding::many_operations / rounding::eps / DataPerturbation::max_roundings;

// Noise of a form on given data, relative to the sum of the magnitudes of its terms. It covers the largest perturbation of
// the data and the rounding of the sum.
constexpr double of_data = 2.0 * rounding::many_operations;

constexpr std::size_t known =
    MotionJet::orders + 2;  // number of derivatives of g and ut in a MotionJet, from order 0

/// Derivatives of N, T, g and ut of one contact; for g and ut also the magnitudes of their terms.
struct Derivatives {
  std::array<double, known> N{}, T{}, gap{}, ut{}, limit{}, gap_terms{}, ut_terms{};
};

/// Computes the derivatives of the friction limit F(|N|), where N follows from g or q. One order more than `last` is computed,
/// for the rate of F.
void fill_limit(const Contact& contact, std::size_t c, const Series& series, std::size_t last,
                Derivatives& d) {
  const double* applied = series.forcing.applied_normal_force.data() + c * series.forcing.count;
  const auto load = [&](std::size_t k) {
    return contact.normal_force_given() ? applied[k]
                                        : -contact.normal_stiffness * gap_coefficient(contact, series, k);
  };
  contact::LimitSeries limit(contact.friction, load(0));
  d.limit[0] = contact::friction_limit(contact.friction, load(0));
  double factorial = 1.0;
  for (std::size_t k = 1; k < last + 2; ++k) {
    factorial *= static_cast<double>(k);
    d.limit[k] = factorial * limit.take(load(k));
  }
}

/// Computes the derivatives that orders 0 .. last of a motion need from a series of scale 1: k! times the coefficients.
/// with_terms: also computes the magnitudes of their terms.
void fill(const Model& model, std::size_t c, const Series& series, std::size_t last, bool with_terms,
          Derivatives& d) {
  const Contact& contact = model.contacts[c];
  const auto n = static_cast<std::size_t>(series.u.rows()),
             forces = static_cast<std::size_t>(series.forces.rows());
  const ForcingSeries& f = series.forcing;
  double factorial = 1.0;
  for (std::size_t k = 0; k < last + 3; ++k) {
    if (k > 1) factorial *= static_cast<double>(k);
    const double* u = series.u.data() + k * n;
    d.gap[k] = factorial * gap_coefficient(contact, series, k);
    d.ut[k] = factorial * ut_coefficient(contact, c, series, k);
    if (with_terms) {
      d.gap_terms[k] = factorial * form_magnitude(model, contact.normal, u);
      d.ut_terms[k] =
          factorial * (form_magnitude(model, contact.tangent, u) + std::abs(f.surface[c * f.count + k]));
    }
    if (k > last) continue;
    d.N[k] = factorial * series.forces.data()[k * forces + model.layout.normal(c)];
    d.T[k] = factorial * series.forces.data()[k * forces + model.layout.tangent(c)];
  }
  d.gap_terms[0] += std::abs(contact.gap);
  if (contact.friction.is_load_dependent()) fill_limit(contact, c, series, last, d);
}

/// The k-th time derivative of the contact's motion. applied: coefficients of the applied normal force; factorial: k!.
ContactMotion motion_of_order(const Derivatives& d, std::size_t k, const double* applied, double factorial) {
  ContactMotion m;
  m.N = d.N[k];
  m.T = d.T[k];
  m.gap = d.gap[k];
  m.ut = d.ut[k];
  m.vn = d.gap[k + 1];
  m.vt = d.ut[k + 1];
  m.an = d.gap[k + 2];
  m.at = d.ut[k + 2];
  m.applied_normal_force = factorial * applied[k];
  m.applied_normal_force_rate = factorial * static_cast<double>(k + 1) * applied[k + 1];
  m.limit = d.limit[k];
  m.limit_rate = d.limit[k + 1];
  return m;
}

}  // namespace

JetMaker::JetMaker(StateSystems& systems)
    : model_(systems.model()),
      taylor_(systems),
      // For massless degrees of freedom u^(k) is known one or two levels later.
      levels_(taylor_.massless() ? Jet::orders + 2 : Jet::orders) {}

Jet JetMaker::expand(const StateSystemPtr& system, const Forcing& forcing, double t, const Vector& u,
                     const Vector& v) {
  taylor_.expand(system, forcing, t, u, v, levels_, 1.0, series_);
  Jet jet{t, series_.u, series_.forces, taylor_.system()};
  double factorial = 1.0;
  for (Eigen::Index k = 2; k < levels_ + 3; ++k) {
    factorial *= static_cast<double>(k);
    jet.u.col(k) *= factorial;
    if (k <= levels_) jet.forces.col(k) *= factorial;
  }
  return jet;
}

Jet JetMaker::make(const StateSystemPtr& system, const Forcing& forcing, double t, const Vector& u,
                   const Vector& v, std::vector<MotionJet>& result, const StopCriterion& enough,
                   const Forcing* second) {
  Jet jet = expand(system, forcing, t, u, v);
  const DataPerturbation disturbance{series_};
  const Forcing& again = second != nullptr ? *second : forcing;
  taylor_.begin(system, again, t, jet.u.col(0), jet.u.col(1), levels_, 1.0, perturbed_, &disturbance);
  result.resize(model_.contacts.size());
  if (enough && !taylor_.massless()) {
    expand_undecided(*jet.system, again, disturbance, enough, result);
    return jet;
  }
  taylor_.extend(again, levels_, perturbed_, &disturbance);
  for (std::size_t c = 0; c < result.size(); ++c)
    motions(*jet.system, c, 0, MotionJet::orders - 1, result[c]);
  return jet;
}

/// Computes the noise of contact motions order by order, until no contact needs a higher order.
void JetMaker::expand_undecided(const StateSystem& system, const Forcing& forcing,
                                const DataPerturbation& disturbance, const StopCriterion& enough,
                                std::vector<MotionJet>& result) {
  constexpr std::size_t last = MotionJet::orders - 1;
  taylor_.extend(forcing, 0, perturbed_, &disturbance);
  std::vector<std::size_t> open;
  for (std::size_t c = 0; c < result.size(); ++c) {
    motions(system, c, 0, 0, result[c]);
    rates(c, 1, 1, result[c]);
    if (enough(c, result[c], 1)) continue;
    open.push_back(c);
    rates(c, 2, last, result[c]);
  }
  for (std::size_t k = 1; k <= last && !open.empty(); ++k) {
    taylor_.extend(forcing, static_cast<int>(k), perturbed_, &disturbance);
    for (const std::size_t c : open) motions(system, c, k, k, result[c]);
    std::erase_if(open, [&](std::size_t c) { return enough(c, result[c], k + 1); });
  }
}

/// Sums the magnitudes of the terms in the equations of motion of the degrees of freedom on which the contact acts.
JetMaker::Balance JetMaker::balance_of(const Contact& contact, const Rows& rows, double factorial,
                                       std::size_t k) const {
  const auto terms = taylor_.terms().col(static_cast<Eigen::Index>(k));
  const auto size = [&](const Combination& form) {
    return form_magnitude_by(model_, form, [&](int dof) { return terms[dof]; });
  };
  const auto moved = [&](const Combination& form) {
    return form_magnitude_by(model_, form, [&](int dof) {
      return terms[dof] * taylor_.mobility()[static_cast<std::size_t>(dof)];
    });
  };
  const auto squared = [](const Combination& form) {
    double sum = 0.0;
    for (const auto& [dof, factor] : form.terms) sum += factor * factor;
    return sum > 0.0 ? sum : 1.0;
  };
  const Combination &n = contact.normal, &t = contact.tangent;
  return {factorial * moved(n), factorial * moved(t),
          rows.normal.an != 0.0 ? factorial * size(n) / squared(n) : 0.0,
          rows.tangent.at != 0.0 ? factorial * size(t) / squared(t) : 0.0};
}

/// Computes orders first .. last of a contact's motion, without noise.
void JetMaker::rates(std::size_t c, std::size_t first, std::size_t last, MotionJet& result) const {
  Derivatives a;
  fill(model_, c, series_, last, false, a);
  const double* applied = series_.forcing.applied_normal_force.data() + c * series_.forcing.count;
  double factorial = 1.0;
  for (std::size_t k = 0; k <= last; ++k) {
    if (k > 1) factorial *= static_cast<double>(k);
    if (k >= first) result.motion[k] = motion_of_order(a, k, applied, factorial);
  }
}

/// Computes orders first .. last of a contact's motion, with noise.
void JetMaker::motions(const StateSystem& system, std::size_t c, std::size_t first, std::size_t last,
                       MotionJet& result) const {
  // The difference of two computations can be small by chance, so the rounding error of the terms of each sum is added.
  const auto noise = [](double x, double y, double size) {
    return noise_factor * std::abs(x - y) + rounding::many_operations * size;
  };
  Derivatives a, b;
  const Rows& rows = system.rows()[c];
  fill(model_, c, series_, last, true, a);
  fill(model_, c, perturbed_, last, false, b);
  const double* applied = series_.forcing.applied_normal_force.data() + c * series_.forcing.count;
  double factorial = 1.0;
  for (std::size_t k = 0; k <= last; ++k) {
    if (k > 1) factorial *= static_cast<double>(k);
    if (k < first) continue;
    ContactMotion &m = result.motion[k], &d = result.noise[k];
    m = motion_of_order(a, k, applied, factorial);
    // The magnitudes of the terms of a contact's row bound the rounding error of the force that follows from the row.
    ContactMotion terms;
    terms.gap = a.gap_terms[k];
    terms.ut = a.ut_terms[k];
    terms.vn = a.gap_terms[k + 1];
    terms.vt = a.ut_terms[k + 1];
    terms.an = a.gap_terms[k + 2];
    terms.at = a.ut_terms[k + 2];
    terms.applied_normal_force = std::abs(m.applied_normal_force);
    terms.applied_normal_force_rate = std::abs(m.applied_normal_force_rate);
    const Balance balance = balance_of(model_.contacts[c], rows, factorial, k);
    terms.an += balance.an;
    terms.at += balance.at;
    const double N = balance.N + rows.normal.magnitude(terms) +
                     (k == 0 ? std::abs(rows.normal.constant) : 0.0) + std::abs(m.N);
    const double T = balance.T + rows.tangent.magnitude(terms) +
                     (k == 0 ? std::abs(rows.tangent.constant) : 0.0) + std::abs(m.T) +
                     std::abs(rows.tangent.N) * N;
    d.N = noise(a.N[k], b.N[k], N);
    d.T = noise(a.T[k], b.T[k], T);
    d.gap = noise(a.gap[k], b.gap[k], terms.gap);
    d.ut = noise(a.ut[k], b.ut[k], terms.ut);
    d.vn = noise(a.gap[k + 1], b.gap[k + 1], terms.vn);
    if (k == 0) {
      // u and v of degrees of freedom with mass are data. The maximum covers their rounding errors for every orientation of
      // the scene relative to the axes.
      d.gap = std::max(d.gap, of_data * terms.gap);
      d.vn = std::max(d.vn, of_data * terms.vn);
    }
    d.vt = noise(a.ut[k + 1], b.ut[k + 1], terms.vt) + (k == 0 ? series_.forcing.rounding[c] : 0.0);
    d.an = noise(a.gap[k + 2], b.gap[k + 2], terms.an);
    d.at = noise(a.ut[k + 2], b.ut[k + 2], terms.at);
    d.applied_normal_force = rounding::many_operations * terms.applied_normal_force;
    d.applied_normal_force_rate = rounding::many_operations * terms.applied_normal_force_rate;
    if (const Friction& f = model_.contacts[c].friction; f.is_load_dependent()) {
      const double slope = std::max(f.static_, f.kinetic), kn = model_.contacts[c].normal_stiffness;
      d.limit = noise(a.limit[k], b.limit[k], slope * N + std::abs(m.limit));
      d.limit_rate =
          noise(a.limit[k + 1], b.limit[k + 1],
                slope * (kn * terms.vn + terms.applied_normal_force_rate) + std::abs(m.limit_rate));
    }
  }
}

}  // namespace signorini::motion
