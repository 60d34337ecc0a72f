#include "model/statics/quasi_static_rates.hpp"

#include <algorithm>
#include <cmath>

#include "base/eigen_dense.hpp"
#include "base/lcp.hpp"
#include "base/rounding.hpp"
#include "contact/friction.hpp"

namespace signorini::statics {
namespace {

// Rates that differ less, relative to the largest one, are equal up to the errors of dense solves. Chosen value.
constexpr double same_z = 1e-9;

/// Unknowns that are nonzero in one alternative of a contact; their conditions are zero. free: the last one may have any sign.
struct ContactRateState {
  std::vector<Eigen::Index> active;
  bool free = false;
};

/// Unknowns of one contact, and its alternatives (`ways`): stick, slip, open.
struct RateUnknowns {
  std::vector<Eigen::Index> unknowns;
  std::vector<ContactRateState> ways{ContactRateState{}};
};

std::vector<RateUnknowns> rate_unknowns_of(const std::vector<Unknown>& unknowns) {
  std::vector<RateUnknowns> all;
  for (std::size_t j = 0; j < unknowns.size(); ++j) {
    if (j == 0 || unknowns[j].contact != unknowns[j - 1].contact) all.emplace_back();
    all.back().unknowns.push_back(static_cast<Eigen::Index>(j));
  }
  for (RateUnknowns& contact : all) {
    std::vector<Eigen::Index> slips;
    std::optional<Eigen::Index> opening;
    for (const Eigen::Index j : contact.unknowns)
      if (unknowns[static_cast<std::size_t>(j)].kind == Unknown::Kind::opening)
        opening = j;
      else
        slips.push_back(j);
    for (const Eigen::Index slip : slips) contact.ways.push_back({{slip}});
    if (opening && slips.empty()) contact.ways.push_back({{*opening}});
    if (opening && !slips.empty()) contact.ways.push_back({{*opening, slips.front()}, true});
  }
  return all;
}

/// Returns z for one choice of alternatives; nullopt if z is not unique, or does not satisfy the conditions.
std::optional<Eigen::VectorXd> rates_with(const Eigen::MatrixXd& m, const Eigen::VectorXd& q,
                                          const std::vector<RateUnknowns>& contacts,
                                          const std::vector<std::size_t>& choice) {
  std::vector<Eigen::Index> active;
  for (std::size_t c = 0; c < contacts.size(); ++c)
    for (const Eigen::Index j : contacts[c].ways[choice[c]].active) active.push_back(j);
  Eigen::VectorXd z = Eigen::VectorXd::Zero(q.size());
  if (!active.empty()) {
    const auto values = base::solve_regular(m(active, active), -q(active));
    if (!values) return std::nullopt;
    for (std::size_t i = 0; i < active.size(); ++i) z[active[i]] = (*values)[static_cast<Eigen::Index>(i)];
  }
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const ContactRateState& way = contacts[c].ways[choice[c]];
    if (!way.free || z[way.active.back()] >= 0.0) continue;
    z[contacts[c].unknowns.back()] = -z[way.active.back()];  // slip in the opposite direction
    z[way.active.back()] = 0.0;
  }
  const double rounded = rounding::many_operations * std::max(1.0, z.cwiseAbs().maxCoeff());
  const Eigen::VectorXd w = q + m * z;
  const Eigen::VectorXd size = Eigen::VectorXd::Ones(q.size()) + m.cwiseAbs() * z.cwiseAbs();
  if (z.minCoeff() < -rounded || (w + rounding::many_operations * size).minCoeff() < 0.0) return std::nullopt;
  return Eigen::VectorXd(z.cwiseMax(0.0));
}

/// Advances to the next combination, like a counter. Returns false after the last combination.
bool next(const std::vector<RateUnknowns>& contacts, std::vector<std::size_t>& choice) {
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (++choice[c] < contacts[c].ways.size()) return true;
    choice[c] = 0;
  }
  return false;
}

}  // namespace

std::optional<QuasiStaticRates> quasi_static_rates(const Eigen::MatrixXd& m, const Eigen::VectorXd& q,
                                                   const std::vector<Unknown>& unknowns) {
  if (auto z = base::solve_lcp(m, q)) return QuasiStaticRates{std::move(*z)};
  const std::vector<RateUnknowns> contacts = rate_unknowns_of(unknowns);
  double combinations = 1.0;
  for (const RateUnknowns& contact : contacts) combinations *= static_cast<double>(contact.ways.size());
  if (combinations > static_cast<double>(max_combinations)) return std::nullopt;
  std::optional<QuasiStaticRates> least;
  std::vector<std::size_t> choice(contacts.size(), 0);
  do {
    auto z = rates_with(m, q, contacts, choice);
    if (!z) continue;
    if (!least) {
      least = QuasiStaticRates{std::move(*z)};
      continue;
    }
    const double size = std::max(z->cwiseAbs().maxCoeff(), least->z.cwiseAbs().maxCoeff());
    if ((*z - least->z).cwiseAbs().maxCoeff() <= same_z * size) continue;
    least->ambiguous = true;
    if (z->norm() < least->z.norm()) least->z = std::move(*z);
  } while (next(contacts, choice));
  return least;
}

namespace {

// Forces that differ less, relative to the largest force so far, are equal up to the errors of some thousand solves and events.
// Chosen value.
constexpr double same_force = 1e-11;

}  // namespace

LimitMargin undeformed(const Contact& contact) {
  LimitMargin s;
  const State pressed = contact.has_friction() ? State::stick : State::closed;
  if (contact.normal_force_given()) {
    s.N = -contact.normal_force.value(0.0);
    s.state = s.N == 0.0 ? State::open : pressed;
  } else {
    s.gap = std::max(0.0, contact.gap);
    s.state = s.gap > 0.0 ? State::open : pressed;
  }
  return s;
}

double friction_of(const Contact& contact, const LimitMargin& standing) {
  return slip_sign(standing.state) != 0 ? contact::kinetic_friction(contact)
                                        : contact::static_friction(contact);
}

double margin_of(const Contact& contact, const LimitMargin& standing, int s) {
  return friction_of(contact, standing) * std::abs(standing.N) - s * standing.T;
}

double force_tolerance(double greatest) { return same_force * greatest; }

bool touching(const Contact& contact, const LimitMargin& standing, double zero, double travelled) {
  if (contact.normal_force_given() || std::abs(standing.N) > zero) return false;
  if (!is_open(standing.state)) return true;
  const double rounded = rounding::many_operations * (contact.gap + travelled);
  return standing.gap <=
         (contact.takes_impulses() ? same_force * travelled : zero / contact.normal_stiffness) + rounded;
}

}  // namespace signorini::statics
