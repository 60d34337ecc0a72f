#include "motion/state_systems.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/rounding.hpp"
#include "contact/friction.hpp"
#include "contact/motion.hpp"

namespace signorini::motion {

void FactorisedStates::solve(double* x, double* y) const {
  if (by_mass) return by_mass->solve(x, y);
  if (!dense()) {
    sparse.solve(x, y);
    return;
  }
  const std::size_t size = unknowns.size();
  const double* column = inverse.data();
  for (std::size_t i = 0; i < size; ++i) y[i] = column[i] * x[0];
  for (std::size_t j = 1; j < size; ++j) {
    column += size;
    const double xj = x[j];
    if (xj == 0.0) continue;
    for (std::size_t i = 0; i < size; ++i) y[i] += column[i] * xj;
  }
  std::copy(y, y + size, x);
}

std::size_t FactorisedStates::bytes() const {
  return sizeof(*this) + kinds.size() * sizeof(linear::DofKind) +
         prescribed.size() * sizeof(linear::PrescribedDof) + rate_dependent.size() * sizeof(std::size_t) +
         sparse.bytes() + (by_mass ? by_mass->bytes() : 0) +
         (inverse.size() + from_u.size() + from_v.size()) * sizeof(double);
}

namespace {

/// Highest derivative of surface motions that a decision may examine.
constexpr int max_surface_derivative = 8;

/// A row of a contact that shares its force with other rows.
struct SharedRow {
  const linear::SharedForces* shared;
  Eigen::Index at;  ///< index of the row in shared->rows

  /// The redundantly constrained motion z with the largest component of this row.
  [[nodiscard]] Eigen::VectorXd motion() const { return shared->null * shared->null.row(at).transpose(); }
};

/// The first of these groups to which the row at `place` belongs.
std::optional<SharedRow> find_shared_row(const std::vector<linear::SharedForces>& groups, std::size_t place) {
  for (const linear::SharedForces& shared : groups) {
    const auto at = std::find(shared.rows.begin(), shared.rows.end(), place) - shared.rows.begin();
    if (at < static_cast<std::ptrdiff_t>(shared.rows.size()) && linear::participates_in(shared.null, at))
      return SharedRow{&shared, at};
  }
  return std::nullopt;
}

/// True if z.s' = 0 from t on: the surfaces of the contacts that constrain a common motion do not move relative to each other.
bool surfaces_move_alike(const ForceLayout& layout, const SharedRow& row, const Forcing& forcing, double t) {
  const linear::SharedForces& shared = *row.shared;
  const Eigen::VectorXd z = row.motion();
  for (int order = 1; order <= max_surface_derivative; ++order) {
    double sum = 0.0, zero = 0.0;
    for (std::size_t i = 0; i < shared.rows.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      if (layout.is_normal(shared.rows[i]) || !linear::participates_in(shared.null, at))
        continue;  // only tangential rows that participate
      const std::size_t c = layout.contact_of(shared.rows[i]);
      const double zi = z[at], rate = forcing.surface(c, t, order);
      sum += zi * rate;
      zero += std::abs(zi) * (rounding::many_operations * std::abs(rate) +
                              (order == 1 ? forcing.surface_rounding(c, t) : 0.0));
    }
    if (std::abs(sum) > zero) return false;
  }
  return true;
}

}  // namespace

StateSystems::StateSystems(const Model& model, const linear::SystemMatrices& structure,
                           base::CacheLimits bounds)
    : model_(model),
      structure_(structure),
      own_kinds_(linear::dof_kinds(model, structure)),
      massless_(linear::has_massless(model)),
      matrix_(model, structure),
      weights_(static_cast<std::size_t>(structure.size)),
      cache_(bounds) {
  const std::size_t unknowns = own_kinds_.size() + static_cast<std::size_t>(model.force_count());
  if (!massless_ && unknowns > max_dense_size) mass_ = linear::mass_factors(structure);
  for (const std::vector<std::size_t>& group : sharing())
    for (const std::size_t c : group) {
      const Contact& contact = model.contacts[c];
      if (contact.sticks_rigidly() && !contact::friction_varies(contact) &&
          contact.friction.static_ > contact.friction.kinetic)
        static_limit_contacts_.push_back(c);
    }
}

/// System that uses the factors of M. It is computed as fast as a search in the cache, which compares states one by one.
/// nullptr: some row contains an acceleration or friction with a varying coefficient.
std::shared_ptr<const FactorisedStates> StateSystems::by_mass(const contact::ContactStates& contact_states,
                                                              const std::vector<Rows>& rows) {
  std::vector<linear::ContactForceBlock> forces =
      mass_ ? linear::contact_force_blocks(rows) : std::vector<linear::ContactForceBlock>{};
  if (forces.empty()) return nullptr;
  FactorisedStates made = describe(contact_states, rows);
  if (!made.rate_dependent.empty()) return nullptr;
  ++made_;
  made.by_mass.emplace(model_, mass_, std::move(forces));
  made.regular = true;
  return std::make_shared<const FactorisedStates>(std::move(made));
}

std::shared_ptr<const FactorisedStates> StateSystems::cached(const contact::ContactStates& contact_states,
                                                             const std::vector<Rows>& rows) {
  const std::vector<State> states = contact::states_of(contact_states);
  if (const auto* known = cache_.find(states)) return *known;
  FactorisedStates made = describe(contact_states, rows);
  factorise(rows, made);
  auto factorised = std::make_shared<const FactorisedStates>(std::move(made));
  cache_.insert(states, factorised, factorised->bytes() + states.size() * sizeof(State));
  return factorised;
}

FactorisedStates StateSystems::describe(const contact::ContactStates& contact_states,
                                        const std::vector<Rows>& rows) const {
  FactorisedStates result;
  result.unknowns = {own_kinds_.size(), model_.layout};
  result.massless = massless_;
  if (massless_) {
    linear::MotionKinds in_mode = linear::kinds_in_states(own_kinds_, model_, rows);
    result.kinds = std::move(in_mode.kinds);
    result.undamped = std::move(in_mode.undamped);
  } else {
    result.kinds = own_kinds_;
  }
  result.prescribed = linear::prescribed_dofs(model_, rows);
  for (std::size_t c = 0; c < contact_states.size(); ++c)
    if (contact::slips_nonlinearly(model_.contacts[c], contact_states[c].state))
      result.rate_dependent.push_back(c);
  return result;
}

void StateSystems::factorise(const std::vector<Rows>& rows, FactorisedStates& mode) {
  ++made_;
  for (std::size_t i = 0; i < weights_.size(); ++i)
    weights_[i] = mode.kinds[i] == linear::DofKind::massive  ? linear::Weights{1.0, 0.0, 0.0}
                  : mode.kinds[i] == linear::DofKind::damped ? linear::Weights{0.0, 1.0, 0.0}
                                                             : linear::Weights{0.0, 0.0, 1.0};
  mode.regular = matrix_.set(rows, weights_, true, mode.undamped);
  mode.shared = matrix_.shared_forces();
  if (!mode.regular) return;
  if (mode.unknowns.size() <= max_dense_size && mode.rate_dependent.empty())
    invert(rows, mode);
  else
    mode.sparse = matrix_.klu().factors();
}

void StateSystems::invert(const std::vector<Rows>& rows, FactorisedStates& mode) {
  const linear::Unknowns& at = mode.unknowns;
  const std::size_t size = at.size(), n = at.dofs;
  std::vector<double> inverse(size * size, 0.0), work(size);
  for (std::size_t j = 0; j < size; ++j) {
    inverse[j * size + j] = 1.0;
    matrix_.solve(inverse.data() + j * size);
  }
  mode.inverse = std::move(inverse);
  if (massless_) return;  // u and v of massless parts are unknowns
  mode.from_u.assign(size * n, 0.0);
  mode.from_v.assign(size * n, 0.0);
  for (std::size_t j = 0; j < n; ++j) {
    double *u = mode.from_u.data() + j * size, *v = mode.from_v.data() + j * size;
    for (auto p = static_cast<std::size_t>(structure_.column_start[j]);
         p < static_cast<std::size_t>(structure_.column_start[j + 1]); ++p) {
      u[structure_.row[p]] -= structure_.k[p];
      v[structure_.row[p]] -= structure_.c[p];
    }
    for (std::size_t c = 0; c < rows.size(); ++c) {
      const double normal = linear::component(model_.contacts[c].normal, static_cast<int>(j));
      const double tangent = linear::component(model_.contacts[c].tangent, static_cast<int>(j));
      u[at.normal(c)] -= rows[c].normal.gap * normal;
      v[at.normal(c)] -= rows[c].normal.vn * normal;
      u[at.tangent(c)] -= rows[c].tangent.ut * tangent;
      v[at.tangent(c)] -= rows[c].tangent.vt * tangent;
    }
    mode.solve(u, work.data());
    mode.solve(v, work.data());
  }
}

/// Rows of all contacts in these states. Only rows of contacts whose states differ from those of last_ are computed.
std::vector<Rows> StateSystems::rows_beside(const contact::ContactStates& contact_states) const {
  if (!last_) return linear::rows_of(model_, contact_states);
  std::vector<Rows> result = last_->rows();
  for (std::size_t c = 0; c < contact_states.size(); ++c)
    if (contact_states[c] != last_->states()[c])
      result[c] = contact::rows(model_.contacts[c], contact_states[c]);
  return result;
}

StateSystemPtr StateSystems::system_of(const contact::ContactStates& contact_states) {
  if (last_ && last_->states() == contact_states)
    return last_;  // frequent, because a decision begins with the states in which the last decision ended
  std::vector<Rows> rows = rows_beside(contact_states);
  std::shared_ptr<const FactorisedStates> factorised = by_mass(contact_states, rows);
  if (!factorised) factorised = cached(contact_states, rows);
  if (!factorised->regular) return nullptr;
  return last_ = std::make_shared<const StateSystem>(contact_states, std::move(rows), std::move(factorised));
}

bool StateSystems::holds_as_one(std::size_t c, const StateSystem& system, const Forcing& forcing,
                                double t) const {
  const auto row = find_shared_row(system.factorised().shared, model_.layout.tangent(c));
  return !row || surfaces_move_alike(model_.layout, *row, forcing, t);
}

bool StateSystems::gap_held_by_others(std::size_t c, contact::ContactStates contact_states) const {
  const Contact& contact = model_.contacts[c];
  if (!may_share(c) || !contact.takes_impulses()) return false;
  contact_states[c].state =
      contact.has_friction() ? State::slip_plus : State::closed;  // its normal row alone
  const auto groups = matrix_.redundant_rows().in_force(linear::rows_of(model_, contact_states));
  return find_shared_row(groups, model_.layout.normal(c)).has_value();
}

bool StateSystems::held_by_others(std::size_t c, contact::ContactStates contact_states,
                                  const Forcing& forcing, double t) const {
  if (!may_share(c) || !model_.contacts[c].sticks_rigidly() || contact_states[c].is_open()) return false;
  contact_states[c].state = State::stick;
  const auto groups = matrix_.redundant_rows().in_force(linear::rows_of(model_, contact_states));
  const auto row = find_shared_row(groups, model_.layout.tangent(c));
  return row && surfaces_move_alike(model_.layout, *row, forcing, t);
}

void StateSystems::mark_static_limits(contact::ContactStates& contact_states, const Forcing& forcing,
                                      double t) const {
  for (const std::size_t c : static_limit_contacts_)
    if (const int s = slip_sign(contact_states[c].state); s != 0) {
      const bool held = held_by_others(c, contact_states, forcing, t);
      contact_states[c].state = s > 0 ? (held ? State::static_limit_plus : State::slip_plus)
                                      : (held ? State::static_limit_minus : State::slip_minus);
    }
}

StateSystemPtr StateSystems::with_friction(const StateSystem& system, std::span<const Form> tangents) {
  std::vector<Rows> rows = system.rows();
  const std::vector<std::size_t>& by_rate = system.factorised().rate_dependent;
  for (std::size_t i = 0; i < by_rate.size(); ++i) rows[by_rate[i]].tangent = tangents[i];
  FactorisedStates made = describe(system.states(), rows);
  factorise(rows, made);
  if (!made.regular) return nullptr;
  return std::make_shared<const StateSystem>(system.states(), std::move(rows),
                                             std::make_shared<const FactorisedStates>(std::move(made)));
}

namespace {

/// Changes x as little as possible in the norm of M so that the forms of the contacts' rows grow by `misses`. Returns the
/// multipliers of these forms, with the unit of M times x; empty: all `misses` are zero.
Eigen::VectorXd correct(const StateSystem& system, const std::vector<double>& misses, Vector& x) {
  if (std::all_of(misses.begin(), misses.end(), [](double miss) { return miss == 0.0; })) return {};
  const std::size_t n = system.unknowns().dofs, size = system.unknowns().size();
  std::vector<double> change(size, 0.0), work(size);
  std::copy(misses.begin(), misses.end(), change.begin() + static_cast<std::ptrdiff_t>(n));
  system.solve(change.data(), work.data());
  for (std::size_t i = 0; i < n; ++i)
    if (system.kinds()[i] == linear::DofKind::massive) x[static_cast<Eigen::Index>(i)] += change[i];
  return -Eigen::Map<const Eigen::VectorXd>(change.data() + n, static_cast<Eigen::Index>(misses.size()));
}

}  // namespace

Eigen::VectorXd project_constraints(const Model& model, const StateSystem& system, const Forcing& forcing,
                                    double t, Vector& u, Vector& v) {
  const contact::ContactStates& contact_states = system.states();
  const auto is_held = [&](std::size_t c) {
    return model.contacts[c].takes_impulses() && !contact_states[c].is_open();
  };
  const auto sticks = [&](std::size_t c) {
    return contact_states[c].state == State::stick && model.contacts[c].sticks_rigidly();
  };
  bool any = false;
  for (std::size_t c = 0; c < contact_states.size() && !any; ++c) any = is_held(c) || sticks(c);
  if (!any) return {};
  std::vector<double> places(model.layout.size(), 0.0), rates(places);
  for (std::size_t c = 0; c < contact_states.size(); ++c) {
    const Contact& contact = model.contacts[c];
    if (is_held(c)) {
      places[model.layout.normal(c)] = -contact.gap_at(u);
      rates[model.layout.normal(c)] = -contact::gap_rate(contact, v);
    }
    if (sticks(c))
      rates[model.layout.tangent(c)] = -contact::along_surface(contact, v, forcing.surface(c, t, 1));
  }
  correct(system, places, u);
  Eigen::VectorXd impulses = correct(system, rates, v);
  for (std::size_t c = 0; c < contact_states.size(); ++c) {
    const Contact& contact = model.contacts[c];
    const bool held = is_held(c), still = sticks(c);
    const double surface = still ? forcing.surface(c, t, 1) : 0.0;
    if (held) linear::set_exactly(contact.normal, -contact.gap, u);
    if (held && still) {
      linear::set_exactly(contact.normal, 0.0, contact.tangent, surface, v);
    } else {
      if (held) linear::set_exactly(contact.normal, 0.0, v);
      if (still) linear::set_exactly(contact.tangent, surface, v);
    }
  }
  return impulses;
}

}  // namespace signorini::motion
