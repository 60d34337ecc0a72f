#include "motion/local_derivatives.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/rounding.hpp"
#include "base/simd.hpp"
#include "motion/point.hpp"

namespace signorini::motion {
namespace {

/// Number of elements added to the radius of W: each order spreads a change by one element through M^-1 and one through K.
constexpr int spread = 2 * (Jet::orders + 1);
/// Limit for the number of contacts that are expanded locally, one by one. With more contacts the whole structure is used.
/// Chosen value.
constexpr std::size_t max_local_contacts = 6;

/// True if some guard contains an acceleration, whose order 1 is not computed here.
bool accelerates(const Contact& contact, const ContactState& state) {
  for (const GuardForm& guard : contact::guards(contact, state))
    if (guard.kind != Guard::none &&
        guard.any_form([](const Form& form) { return form.an != 0.0 || form.at != 0.0; }))
      return true;
  return false;
}

/// Entries of a column of M^-1 below of_nothing_here times the largest entry are rounding errors. A column saves time only if
/// at most 1 / part_of_structure of its entries are above this limit.
constexpr double of_nothing_here = rounding::eps / 16.0;
constexpr std::size_t part_of_structure = 4;

/// Forces of order 0 that the surrounding structure exerts on the neighbourhood.
Vector from_outside(const Neighbourhood& near, const Point& now) {
  Vector P = Vector::Zero(near.model.size());
  for (const Neighbourhood::Coupling& tie : near.couplings)
    P[tie.at] -= tie.m * now.a[tie.dof] + tie.c * now.v[tie.dof] + tie.k * now.u[tie.dof];
  for (const Neighbourhood::CrossingForce& pull : near.crossing_forces)
    P[pull.at] -= pull.factor * now.forces[static_cast<Eigen::Index>(pull.force)];
  return P;
}

}  // namespace

LocalDerivatives::LocalDerivatives(StateSystems& systems, int least)
    : model_(systems.model()),
      possible_(model_.size() >= least && follows_from_motion(model_)),
      taylor_(systems) {
  if (!possible_) return;
  neighbourhoods_.emplace(systems, spread);
  for (const Contact& c : model_.contacts) {
    SpringContact soft;
    const auto take = [&](const Combination& form, double& squared) {
      soft.valid = soft.valid && form.terms.size() <= max_plane_terms;
      for (const auto& [dof, factor] : form.terms) {
        soft.valid = soft.valid && factor != 0.0 && !model_.dofs[static_cast<std::size_t>(dof)].rotation;
        squared += factor * factor;
        terms_.emplace_back(static_cast<std::size_t>(dof), factor);
      }
      return terms_.size();
    };
    soft.valid = !c.normal_force_given() && c.normal_damping == 0.0;
    soft.gap = c.gap;
    soft.first = terms_.size();
    soft.middle = take(c.normal, soft.normal_squared);
    soft.end = take(c.tangent, soft.tangent_squared);
    soft_.push_back(soft);
  }
}

/// Motion, rate and rounding of a soft contact that is not driven and whose surface is at rest. The results are bitwise those
/// of motion_of(), set_rates() and bound_rounding().
void LocalDerivatives::set_soft_motion(const Rows& rows, double surface, const Point& now,
                                       std::size_t contact, MotionJet& result) const {
  const SpringContact& c = soft_[contact];
  const double *u = now.u.data(), *v = now.v.data(), *a = now.a.data();
  ContactMotion &m = result.motion[0] = {}, &d = result.motion[1] = {}, &noise = result.noise[0] = {};
  const auto along = [&](std::size_t first, std::size_t end, double squared, double& x, double& dx,
                         double& ddx, double& size, double& dsize) {
    double xx = 0.0, dd = 0.0;
    for (std::size_t i = first; i < end; ++i) {
      const auto& [dof, factor] = terms_[i];
      x += factor * u[dof];
      dx += factor * v[dof];
      ddx += factor * a[dof];
      xx += u[dof] * u[dof];
      dd += v[dof] * v[dof];
    }
    size = std::sqrt(squared * xx);
    dsize = std::sqrt(squared * dd);
  };
  ContactMotion terms;
  along(c.first, c.middle, c.normal_squared, m.gap, m.vn, m.an, terms.gap, terms.vn);
  along(c.middle, c.end, c.tangent_squared, m.ut, m.vt, m.at, terms.ut, terms.vt);
  m.gap += c.gap;
  m.ut -= surface;
  m.N = now.N(model_.layout, contact);
  m.T = now.T(model_.layout, contact);
  d.gap = m.vn;
  d.ut = m.vt;
  d.vn = m.an;
  d.vt = m.at;
  d.N = -(rows.normal.gap * d.gap) / rows.normal.N;
  d.T = -(rows.tangent.N * d.N + rows.tangent.ut * d.ut) / rows.tangent.T;
  constexpr double once = rounding::many_operations;
  terms.gap += std::abs(c.gap);
  terms.ut += std::abs(surface);
  terms.N = std::abs(rows.normal.gap * terms.gap) + std::abs(rows.normal.constant) + std::abs(m.N);
  terms.T = std::abs(rows.tangent.N * terms.N) + std::abs(rows.tangent.ut * terms.ut) +
            std::abs(rows.tangent.constant) + std::abs(m.T);
  noise.N = 4.0 * once * terms.N;
  noise.T = 5.0 * once * terms.T;
  noise.gap = 3.0 * once * terms.gap;
  noise.ut = 3.0 * once * terms.ut;
  noise.vn = 3.0 * once * terms.vn;
  noise.vt = 3.0 * once * terms.vt;
}

/// Rate of the contact's motion, without g''' and ut'''. Rates of N and T follow from the contact's own rows.
void LocalDerivatives::set_rates(const StateSystem& system, const Forcing& forcing, std::size_t contact,
                                 MotionJet& result) const {
  const Rows& rows = system.rows()[contact];
  const ContactMotion& m = result.motion[0];
  ContactMotion& d = result.motion[1] = {};
  d.gap = m.vn;
  d.ut = m.vt;
  d.vn = m.an;
  d.vt = m.at;
  d.applied_normal_force = m.applied_normal_force_rate;
  d.applied_normal_force_rate = forcing.applied_normal_force(contact, series_.t, 2);
  d.N = -rows.normal.rate(d) / rows.normal.N;
  d.T = -rows.tangent.rate(d) / rows.tangent.T;
}

/// Upper bound of the noise that motion/jet.cpp would compute, in rounding errors of the terms of a sum: one for the sum, less
/// than one for the difference of both computations, and one for each perturbation. u and v are perturbed, for N also the
/// normal row, for T also the normal and the tangent row.
void LocalDerivatives::bound_rounding(const StateSystem& system, const Forcing& forcing, const Point& now,
                                      std::size_t contact, MotionJet& result) const {
  const Contact& c = model_.contacts[contact];
  const Rows& rows = system.rows()[contact];
  const ContactMotion& m = result.motion[0];
  ContactMotion terms, &d = result.noise[0] = {};
  terms.gap = form_magnitude(model_, c.normal, now.u) + std::abs(c.gap);
  terms.ut = form_magnitude(model_, c.tangent, now.u) + std::abs(forcing.surface(contact, series_.t, 0));
  terms.vn = form_magnitude(model_, c.normal, now.v);
  terms.vt = form_magnitude(model_, c.tangent, now.v) + std::abs(forcing.surface(contact, series_.t, 1));
  terms.applied_normal_force = std::abs(m.applied_normal_force);
  terms.applied_normal_force_rate = std::abs(m.applied_normal_force_rate);
  constexpr double once = rounding::many_operations;
  terms.N = rows.normal.magnitude(terms) + std::abs(rows.normal.constant) + std::abs(m.N);
  terms.T = rows.tangent.magnitude(terms) + std::abs(rows.tangent.constant) + std::abs(m.T);
  d.N = 4.0 * once * terms.N;
  d.T = 5.0 * once * terms.T;
  d.gap = 3.0 * once * terms.gap;
  d.ut = 3.0 * once * terms.ut;
  d.vn = 3.0 * once * terms.vn;
  d.vt = 3.0 * once * terms.vt + forcing.surface_rounding(contact, series_.t);
  d.applied_normal_force = once * terms.applied_normal_force;
  d.applied_normal_force_rate = once * terms.applied_normal_force_rate;
}

/// Computes the contact's motion on a neighbourhood. False: the neighbourhood does not decide the contact's state.
bool LocalDerivatives::compute_locally(const StateSystemPtr& system, const Forcing& forcing, const Point& now,
                                       std::size_t contact, const JetMaker::StopCriterion& enough,
                                       MotionJet& motion) {
  Neighbourhood* near = neighbourhoods_->around(contact, *system);
  if (near == nullptr) {
    possible_ = !neighbourhoods_->found_none();
    return false;
  }
  const StateSystemPtr own = near->systems.system_of(near->local_states(system->states()));
  if (!own) return false;
  const auto at = static_cast<std::size_t>(
      std::lower_bound(near->contacts.begin(), near->contacts.end(), contact) - near->contacts.begin());
  while (work_.size() < neighbourhoods_->size()) work_.emplace_back();
  std::unique_ptr<Work>& work = work_[near->number];
  if (!work) work = std::make_unique<Work>(near->systems);
  const Vector outside = from_outside(*near, now);
  const auto with = [&](const Vector& more) {
    return forcing.on_part(near->model, near->dofs, near->loads, near->contacts, more);
  };
  const Forcing given = with(outside), alone = with(Vector::Zero(outside.size()));
  bool is_enough = false;
  (void)work->jets.make(
      own, given, series_.t, now.u(near->dofs), now.v(near->dofs), work->motions,
      [&](std::size_t c, const MotionJet& jet, std::size_t orders) {
        if (c != at) return true;
        const bool suffices = enough(contact, jet, orders);
        is_enough = suffices && orders < MotionJet::orders;
        return suffices;
      },
      &alone);
  motion = work->motions[at];
  return is_enough;
}

/// True if order 0 decided the contact before and its motion is bitwise unchanged. Forces follow from the contact's own rows,
/// displacements and velocities, so only states and accelerations are compared.
bool LocalDerivatives::is_unchanged(std::size_t contact, const Jet& jet, const PreviousJet& previous) const {
  if (jet.system->states()[contact] != previous.jet.system->states()[contact] ||
      std::binary_search(previous.open.begin(), previous.open.end(), contact))
    return false;
  const auto same = [&](const auto& term) { return jet.u(term.first, 2) == previous.jet.u(term.first, 2); };
  const Contact& c = model_.contacts[contact];
  return std::all_of(c.normal.terms.begin(), c.normal.terms.end(), same) &&
         std::all_of(c.tangent.terms.begin(), c.tangent.terms.end(), same);
}

/// Orders 0 to 2 of u in the whole structure, order 0 of forces; the caller computes rates of forces.
Jet LocalDerivatives::expand(const StateSystemPtr& system, const Forcing& forcing, double t, const Vector& u,
                             const Vector& v) {
  taylor_.begin(system, forcing, t, u, v, 0, 1.0, series_);
  taylor_.extend(forcing, 0, series_);
  Jet jet{t, series_.u, Eigen::MatrixXd(series_.forces.rows(), 2), system};
  jet.u.col(2) *= 2.0;
  jet.forces.col(0) = series_.forces.col(0);
  return jet;
}

/// Columns M^-1 n and M^-1 t of a contact. system: the system of any contact state.
const LocalDerivatives::Columns& LocalDerivatives::columns_of(std::size_t contact,
                                                              const StateSystem& system) {
  columns_.resize(model_.contacts.size());
  Columns& columns = columns_[contact];
  if (std::exchange(columns.known, true)) return columns;
  const auto n = static_cast<std::size_t>(model_.size());
  column_.resize(system.unknowns().size());
  scratch_.resize(column_.size());
  const auto solve = [&](const Combination& form, std::vector<std::pair<Eigen::Index, double>>& column) {
    std::fill(column_.begin(), column_.end(), 0.0);
    form.add_to(column_, 1.0);
    system.solve(column_.data(), scratch_.data());
    const auto weighted = [&](std::size_t i) {
      const auto at = static_cast<Eigen::Index>(i);
      return column_[i] * column_[i] * model_.mass.coeff(at, at);
    };
    double most = 0.0;
    for (std::size_t i = 0; i < n; ++i) most = std::max(most, weighted(i));
    for (std::size_t i = 0; i < n; ++i)
      if (weighted(i) > of_nothing_here * of_nothing_here * most)
        column.emplace_back(static_cast<Eigen::Index>(i), column_[i]);
    column.shrink_to_fit();
    return part_of_structure * column.size() <= n;
  };
  const Contact& c = model_.contacts[contact];
  columns.few = solve(c.normal, columns.by_N) && solve(c.tangent, columns.by_T);
  if (!columns.few) columns.by_N = columns.by_T = {};
  return columns;
}

/// Same result as expand(), computed from a known jet in other states: adds the effect of the contacts whose states differ.
/// nullopt: too many states differ, or their effect covers a large part of the structure.
std::optional<Jet> LocalDerivatives::update(const StateSystemPtr& system, const Forcing& forcing, double t,
                                            const PreviousJet& previous) {
  const contact::ContactStates &states = system->states(), &before = previous.jet.system->states();
  std::vector<std::size_t> others;
  for (std::size_t c = 0; c < states.size(); ++c)
    if (states[c] != before[c]) others.push_back(c);
  if (others.size() > max_local_contacts) return std::nullopt;
  for (const std::size_t c : others)
    if (!columns_of(c, *system).few) return std::nullopt;
  Jet jet{t, previous.jet.u, previous.jet.forces, system};
  series_.t = t;
  for (const std::size_t c : others) {
    const Contact& contact = model_.contacts[c];
    const Rows& rows = system->rows()[c];
    ContactMotion m;  // motion without forces
    contact::set_displacement(contact, jet.u.col(0), forcing.surface(c, t, 0), m);
    contact::set_velocity(contact, jet.u.col(1), forcing.surface(c, t, 1), m);
    m.applied_normal_force = forcing.applied_normal_force(c, t, 0);
    const double N = -rows.normal.value(m) / rows.normal.N,
                 T = -(rows.tangent.value(m) + rows.tangent.N * N) / rows.tangent.T;
    const Columns& columns = columns_[c];
    const auto change = [&](std::size_t slot, double force, const auto& column) {
      double& old = jet.forces(static_cast<Eigen::Index>(slot), 0);
      const double by = force - std::exchange(old, force);
      for (const auto& [dof, x] : column) jet.u(dof, 2) -= by * x;
    };
    change(model_.layout.normal(c), N, columns.by_N);
    change(model_.layout.tangent(c), T, columns.by_T);
  }
  return jet;
}

std::optional<LocalDerivatives::LocalJet> LocalDerivatives::make(const StateSystemPtr& system,
                                                                 const Forcing& forcing, double t,
                                                                 const Vector& u, const Vector& v,
                                                                 std::vector<MotionJet>& motions,
                                                                 const JetMaker::StopCriterion& enough,
                                                                 const std::optional<PreviousJet>& previous) {
  if (!possible_ || !system->factorised().by_mass) return std::nullopt;
  std::optional<Jet> followed = previous ? update(system, forcing, t, *previous) : std::nullopt;
  Jet jet = followed ? *std::move(followed) : expand(system, forcing, t, u, v);
  const std::size_t count = model_.contacts.size();
  const Point now{u, v, jet.forces.col(0), jet.u.col(2)};
  motions.resize(count);
  std::vector<std::size_t> open;
  for (std::size_t c = 0; c < count; ++c) {
    MotionJet& motion = motions[c];
    const bool known = previous && is_unchanged(c, jet, *previous),
               soft = soft_[c].valid && !forcing.is_driven(c);
    if (!known && soft) {
      set_soft_motion(system->rows()[c], forcing.surface(c, t, 0), now, c, motion);
    } else if (!known) {
      motion.motion[0] = motion_of(model_.contacts[c], c, forcing, t, now);
      set_rates(*system, forcing, c, motion);
      bound_rounding(*system, forcing, now, c, motion);
    }
    jet.forces(static_cast<Eigen::Index>(model_.layout.normal(c)), 1) = motion.motion[1].N;
    jet.forces(static_cast<Eigen::Index>(model_.layout.tangent(c)), 1) = motion.motion[1].T;
    if (known || ((soft || !accelerates(model_.contacts[c], system->states()[c])) && enough(c, motion, 1)))
      continue;
    open.push_back(c);
    if (open.size() > max_local_contacts) return std::nullopt;
  }
  for (const std::size_t c : open)
    if (!compute_locally(system, forcing, now, c, enough, motions[c])) return std::nullopt;
  return LocalJet{std::move(jet), std::move(open)};
}

namespace {

/// Arguments of fused_products().
struct Columns {
  const double *a, *b;
  std::size_t rows, columns;
  const double *u, *w;
  double factor;
};

/// Computes rows i to i + count * lanes of the products.
template <class T, std::size_t count>
[[gnu::always_inline]] inline void sum_rows(const Columns& c, std::size_t i, double* y) {
  constexpr std::size_t lanes = sizeof(T) / sizeof(double);
  T sum[count] = {};
  const double *a = c.a + i, *b = c.b + i;
  for (std::size_t j = 0; j < c.columns; ++j, a += c.rows, b += c.rows) {
    const double u = c.u[j], v = c.factor * c.w[j];
    for (std::size_t k = 0; k < count; ++k)
      sum[k] += base::lanes_at<T>(a + k * lanes).v * u + base::lanes_at<T>(b + k * lanes).v * v;
  }
  for (std::size_t k = 0; k < count; ++k) base::lanes_at<T>(y + i + k * lanes).v = sum[k];
}

}  // namespace

SIGNORINI_WIDE_LANES void fused_products(const double* a, const double* b, std::size_t rows,
                                         std::size_t columns, const double* u, const double* w, double factor,
                                         double* y) {
  const Columns c{a, b, rows, columns, u, w, factor};
  std::size_t i = 0;
  for (; i + 16 <= rows; i += 16) sum_rows<base::Double4, 4>(c, i, y);
  if (i + 8 <= rows) {
    sum_rows<base::Double4, 2>(c, i, y);
    i += 8;
  }
  if (i + 4 <= rows) {
    sum_rows<base::Double4, 1>(c, i, y);
    i += 4;
  }
  for (; i < rows; ++i) sum_rows<double, 1>(c, i, y);
}

}  // namespace signorini::motion
