// Laws that relate the two ends of a stretch of motion, without the motion between.
//
//   states+ of one instant = states- of the next            s (p- - p+) >= 0 for sliding contacts,  p = ut - T/kt
//   ut- = ut+ for rigid stick,  g- = g+ for rigid closed contacts        unless a tolerance lets them drift
//   M a + C v + K u + sum ( n N + t T + t (-N - N_carried) ut / R ) = P         just after; R: of a pendulum
#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "witness/laws.hpp"

namespace signorini {
namespace {

/// The two ends of a stretch, for one contact.
struct StretchEnds {
  Sight from, to;
  [[nodiscard]] double place() const { return from.place + to.place; }
};

/// Displacement of the sliding point.
double slid(const Contact& c, const StretchEnds& ends) {
  const double by_force = c.tangential_stiffness ? (ends.to.T - ends.from.T) / *c.tangential_stiffness : 0.0;
  return ends.to.ut - ends.from.ut - by_force;
}

/// Uncertainty of slid() by rounding and tolerances. A fixed point moves by the rounding of the scene's displacements.
double slid_noise(const Contact& c, const StretchEnds& ends, const WitnessLimits& tol, double scale) {
  const double by_force =
      c.tangential_stiffness ? (std::abs(ends.to.T) + std::abs(ends.from.T)) / *c.tangential_stiffness : 0.0;
  return rounding::of_elimination * (ends.place() + scale + by_force) +
         of_tolerance * (tol.rtol * (ends.place() + by_force) + 2.0 * tol.displacement);
}

class RowSums {
 public:
  explicit RowSums(int size) : sum(Vector::Zero(size)), terms(sum) {}
  /// size: of x, or the size that its rounding is relative to.
  void add(const SparseMatrix& matrix, const Vector& x, const std::array<double, 2>& reach,
           const Model& model) {
    for (int j = 0; j < matrix.outerSize(); ++j) {
      const double size = std::max(std::abs(x[j]), reach[model.dofs[static_cast<std::size_t>(j)].rotation]);
      for (SparseMatrix::InnerIterator it(matrix, j); it; ++it) {
        sum[it.row()] += it.value() * x[j];
        terms[it.row()] += std::abs(it.value()) * size;
      }
    }
  }
  void add(const Combination& form, double force, double size) {
    for (const auto& [dof, factor] : form.terms) {
      sum[dof] += factor * force;
      terms[dof] += std::abs(factor) * size;
    }
  }
  Vector sum, terms;
};

}  // namespace

std::vector<Violation> stretch_laws(const Bench& bench, double t, const WitnessedSide& from,
                                    const WitnessedSide& to) {
  std::vector<Violation> found;
  const Model& model = bench.model;
  const bool drifts = bench.limits.rtol > 0.0 || bench.limits.step > 0.0;
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact& c = model.contacts[k];
    const auto add = [&](const char* law, double value, double limit, const Unit& unit) {
      if (value > limit) found.push_back({t, "between", static_cast<int>(k), law, value, limit, unit, false});
    };
    const ContactState &old = (*from.mode)[k], &now = (*to.mode)[k];
    if (!(old == now)) {
      add("unbroken state", 1.0, 0.0, {});
      continue;
    }
    if (!c.obeys_coulomb() || c.sliding_point()) continue;
    const StretchEnds ends{see(c, k, from), see(c, k, to)};
    const double noise = slid_noise(c, ends, bench.limits, model.scales.displacement);
    const int s = is_held(now.state) || held_beside(model, k) ? 0 : sign_of_slip(now.state);
    if (s != 0) add("way of slip", -s * slid(c, ends), noise, seen::length);
    if (drifts) continue;
    if (kind_of(now.state) == State::stick && !c.tangential_stiffness)
      add("unbroken rest", std::abs(slid(c, ends)), noise, seen::length);
    if (c.takes_impulses() && !is_open(now.state))
      add("unbroken rest", std::abs(ends.to.g - ends.from.g), noise, seen::length);
  }
  return found;
}

std::vector<Violation> equilibrium_law(const Bench& bench, double t, const WitnessedSide& side,
                                       const Vector& load) {
  const Model& model = bench.model;
  RowSums rows(model.size());
  rows.add(model.mass, *side.a, side.a_reach, model);
  rows.add(model.damping, *side.v, side.v_reach, model);
  rows.add(model.stiffness, *side.u, side.u_reach, model);
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact& c = model.contacts[k];
    const Sight m = see(c, k, side);
    const double size =
        std::abs(m.N) + std::abs(m.T) + size_of_normal(c, m) + c.tangential_stiffness.value_or(0.0) * m.place;
    rows.add(c.normal, m.N, size);
    rows.add(c.tangent, m.T, size);
    const Bowl* bowl = c.curved_surface();
    if (bowl == nullptr) continue;
    // The curved surface of a pendulum acts by N minus the weight that K contains.
    const double slope = (c.body_tangent().dot(*side.u) - side.driven[k].s) / bowl->radius;
    rows.add(c.body_tangent(), (-m.N - bowl->carried) * slope,
             (size + bowl->carried) * m.place / bowl->radius);
  }
  rows.sum -= load;
  rows.terms += load.cwiseAbs();
  // Residuals of solves are relative to the largest row, separately for forces and for moments.
  const std::array<double, 2> greatest = bench.greatest(rows.terms);
  std::optional<Violation> worst;
  for (int i = 0; i < model.size(); ++i) {
    const bool turns = model.dofs[static_cast<std::size_t>(i)].rotation;
    const double limit = rounding::of_elimination * std::max(rows.terms[i], greatest[turns]);
    const double off = std::abs(rows.sum[i]);
    if (!bench.has_mass(i) || off <= limit || (worst && off / limit <= worst->value / worst->limit)) continue;
    worst = Violation{t, "", -1, "equilibrium", off, limit, turns ? Unit{1, 1, 0} : seen::force, false};
  }
  if (!worst) return {};
  return {*worst};
}

}  // namespace signorini
