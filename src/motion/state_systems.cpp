#include "motion/state_systems.hpp"

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "contact/friction.hpp"
#include "contact/motion.hpp"

namespace signorini::motion {

void FactorisedMode::solve(double* x, double* y) const {
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

std::size_t FactorisedMode::bytes() const {
  return sizeof(*this) + kinds.size() * sizeof(linear::DofKind) + pinned.size() * sizeof(linear::Pinned) +
         by_rate.size() * sizeof(std::size_t) + sparse.bytes() + (by_mass ? by_mass->bytes() : 0) +
         (inverse.size() + from_u.size() + from_v.size()) * sizeof(double);
}

namespace {

/// Number of derivatives of surface motions that a decision examines.
constexpr int most_reported = 8;

/// True if z.s' = 0 from t on: surfaces under feet that share a motion move alike, or are at rest.
bool moves_as_one(const ForceLayout& layout, const linear::SharedForces& shared, const Eigen::VectorXd& z,
                  const Forcing& forcing, double t) {
  for (int order = 1; order <= most_reported; ++order) {
    double sum = 0.0, zero = 0.0;
    for (std::size_t i = 0; i < shared.rows.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      if (layout.is_normal(shared.rows[i]) || !linear::has_share(shared.null, at))
        continue;  // a normal row, or no participation
      const std::size_t c = layout.contact_of(shared.rows[i]);
      const double zi = z[at], rate = forcing.surface(c, t, order);
      sum += zi * rate;
      zero += std::abs(zi) *
              (rounding::of_many * std::abs(rate) + (order == 1 ? forcing.surface_rounding(c, t) : 0.0));
    }
    if (std::abs(sum) > zero) return false;
  }
  return true;
}

}  // namespace

StateSystems::StateSystems(const Model& model, const linear::SystemMatrices& structure,
                           base::CacheBounds bounds)
    : model_(model),
      structure_(structure),
      own_kinds_(linear::dof_kinds(model, structure)),
      massless_(linear::has_massless(model)),
      matrix_(model, structure),
      weights_(static_cast<std::size_t>(structure.size)),
      cache_(bounds) {
  const std::size_t unknowns = own_kinds_.size() + static_cast<std::size_t>(model.force_count());
  if (!massless_ && unknowns > most_dense) mass_ = linear::mass_factors(structure);
  for (const std::vector<std::size_t>& group : sharing())
    for (const std::size_t c : group) {
      const Contact& contact = model.contacts[c];
      if (contact.sticks_rigidly() && !contact::friction_varies(contact) &&
          contact.friction.static_ > contact.friction.kinetic)
        holdable_.push_back(c);
    }
}

/// Computing it takes no longer than a search, which compares states one by one. Null: a row contains an acceleration,
/// or friction that will change.
std::shared_ptr<const FactorisedMode> StateSystems::by_mass(const contact::ContactStates& mode,
                                                            const std::vector<Rows>& rows) {
  std::vector<linear::OwnForces> forces = mass_ ? linear::own_forces(rows) : std::vector<linear::OwnForces>{};
  if (forces.empty()) return nullptr;
  FactorisedMode made = describe(mode, rows);
  if (!made.by_rate.empty()) return nullptr;
  ++made_;
  made.by_mass.emplace(model_, mass_, std::move(forces));
  made.regular = true;
  return std::make_shared<const FactorisedMode>(std::move(made));
}

std::shared_ptr<const FactorisedMode> StateSystems::cached(const contact::ContactStates& mode,
                                                           const std::vector<Rows>& rows) {
  const std::vector<State> states = contact::states_of(mode);
  if (const auto* known = cache_.find(states)) return *known;
  FactorisedMode made = describe(mode, rows);
  factorise(rows, made);
  auto factorised = std::make_shared<const FactorisedMode>(std::move(made));
  cache_.insert(states, factorised, factorised->bytes() + states.size() * sizeof(State));
  return factorised;
}

FactorisedMode StateSystems::describe(const contact::ContactStates& mode,
                                      const std::vector<Rows>& rows) const {
  FactorisedMode result;
  result.unknowns = {own_kinds_.size(), mode.size(), model_.layout};
  result.massless = massless_;
  if (massless_) {
    linear::MotionKinds in_mode = linear::kinds_in_mode(own_kinds_, model_, rows);
    result.kinds = std::move(in_mode.kinds);
    result.undamped = std::move(in_mode.undamped);
  } else {
    result.kinds = own_kinds_;
  }
  result.pinned = linear::pinned_by(model_, rows);
  for (std::size_t c = 0; c < mode.size(); ++c)
    if (contact::slips_nonlinearly(model_.contacts[c], mode[c].state)) result.by_rate.push_back(c);
  return result;
}

void StateSystems::factorise(const std::vector<Rows>& rows, FactorisedMode& mode) {
  ++made_;
  for (std::size_t i = 0; i < weights_.size(); ++i)
    weights_[i] = mode.kinds[i] == linear::DofKind::massive  ? linear::Weights{1.0, 0.0, 0.0}
                  : mode.kinds[i] == linear::DofKind::damped ? linear::Weights{0.0, 1.0, 0.0}
                                                             : linear::Weights{0.0, 0.0, 1.0};
  mode.regular = matrix_.set(rows, weights_, true, mode.undamped);
  mode.shared = matrix_.shared();
  if (!mode.regular) return;
  if (mode.unknowns.size() <= most_dense && mode.by_rate.empty())
    invert(rows, mode);
  else
    mode.sparse = matrix_.klu().factors();
}

void StateSystems::invert(const std::vector<Rows>& rows, FactorisedMode& mode) {
  const linear::Unknowns& at = mode.unknowns;
  const std::size_t size = at.size(), n = at.dofs;
  std::vector<double> inverse(size * size, 0.0), work(size);
  for (std::size_t j = 0; j < size; ++j) {
    inverse[j * size + j] = 1.0;
    matrix_.solve(inverse.data() + j * size);
  }
  mode.inverse = std::move(inverse);
  if (massless_) return;  // u and v of massless parts are not known beforehand
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

/// Rows of the last state, updated for contacts that have changed.
std::vector<Rows> StateSystems::rows_beside(const contact::ContactStates& mode) const {
  if (!last_) return linear::rows_of(model_, mode);
  std::vector<Rows> result = last_->rows();
  for (std::size_t c = 0; c < mode.size(); ++c)
    if (mode[c] != last_->mode()[c]) result[c] = contact::rows(model_.contacts[c], mode[c]);
  return result;
}

StateSystemPtr StateSystems::of(const contact::ContactStates& mode) {
  if (last_ && last_->mode() == mode)
    return last_;  // a decision begins with the final state of the previous one
  std::vector<Rows> rows = rows_beside(mode);
  std::shared_ptr<const FactorisedMode> factorised = by_mass(mode, rows);
  if (!factorised) factorised = cached(mode, rows);
  if (!factorised->regular) return nullptr;
  return last_ = std::make_shared<const StateSystem>(mode, std::move(rows), std::move(factorised));
}

bool StateSystems::held_by_others(std::size_t c, contact::ContactStates mode, const Forcing& forcing,
                                  double t) const {
  if (!may_share(c) || !model_.contacts[c].sticks_rigidly() || mode[c].is_open()) return false;
  mode[c].state = State::stick;
  for (const linear::SharedForces& shared : matrix_.shared_rows().in_force(linear::rows_of(model_, mode))) {
    const auto at =
        std::find(shared.rows.begin(), shared.rows.end(), model_.layout.tangent(c)) - shared.rows.begin();
    if (at == static_cast<std::ptrdiff_t>(shared.rows.size()) || !linear::has_share(shared.null, at))
      continue;
    // The motion with the greatest z_c among the redundantly constrained ones.
    return moves_as_one(model_.layout, shared, shared.null * shared.null.row(at).transpose(), forcing, t);
  }
  return false;
}

void StateSystems::mark_static_limits(contact::ContactStates& mode, const Forcing& forcing, double t) const {
  for (const std::size_t c : holdable_)
    if (const int s = slip_sign(mode[c].state); s != 0) {
      const bool held = held_by_others(c, mode, forcing, t);
      mode[c].state = s > 0 ? (held ? State::static_limit_plus : State::slip_plus)
                            : (held ? State::static_limit_minus : State::slip_minus);
    }
}

StateSystemPtr StateSystems::at_friction(const StateSystem& system, std::span<const Form> tangents) {
  std::vector<Rows> rows = system.rows();
  const std::vector<std::size_t>& by_rate = system.factorised().by_rate;
  for (std::size_t i = 0; i < by_rate.size(); ++i) rows[by_rate[i]].tangent = tangents[i];
  FactorisedMode made = describe(system.mode(), rows);
  factorise(rows, made);
  if (!made.regular) return nullptr;
  return std::make_shared<const StateSystem>(system.mode(), std::move(rows),
                                             std::make_shared<const FactorisedMode>(std::move(made)));
}

namespace {

/// x += the smallest change, in the norm of M, that adds `misses` to the forms of the contacts' rows. Returns the
/// corresponding multipliers of these forms, M times a length or a velocity.
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

Eigen::VectorXd hold(const Model& model, const StateSystem& system, const Forcing& forcing, double t,
                     Vector& u, Vector& v) {
  const contact::ContactStates& mode = system.mode();
  const auto is_held = [&](std::size_t c) {
    return model.contacts[c].takes_impulses() && !mode[c].is_open();
  };
  const auto sticks = [&](std::size_t c) {
    return mode[c].state == State::stick && model.contacts[c].sticks_rigidly();
  };
  bool any = false;
  for (std::size_t c = 0; c < mode.size() && !any; ++c) any = is_held(c) || sticks(c);
  if (!any) return {};
  std::vector<double> places(model.layout.size(mode.size()), 0.0), rates(places);
  for (std::size_t c = 0; c < mode.size(); ++c) {
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
  for (std::size_t c = 0; c < mode.size(); ++c) {
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
