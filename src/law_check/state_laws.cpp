#include <algorithm>
#include <cmath>

#include "base/eigen_dense.hpp"
#include "base/rounding.hpp"
#include "law_check/contact_kinematics.hpp"
#include "law_check/laws.hpp"
#include "law_check/massless_laws.hpp"

namespace signorini::law_check {
namespace {

/// Constraint rows of rigid contacts, and the changes dF of their forces that satisfy these rows:  W dF = asked,
/// W_ij = row_i . column_j.
struct ConstraintRows {
  std::vector<Vector> columns;  // accelerations due to a unit force, including its friction force in slip
  std::vector<const Combination*> rows;
  // Required changes of accelerations along the rows, and their rounding errors.
  std::vector<double> asked, noise;

  /// Adds the rows of a contact in this state. removed_accelerations: accelerations that captures have removed after a
  /// guard was located; empty: none. hold: the accelerations of the contact must become zero; false: must not change.
  void add(const Contact& c, const ContactState& state, const ContactResponse& response,
           const ContactKinematics& m, const Vector& removed_accelerations, bool hold) {
    const bool tangent = c.constrains_tangent(state.state);
    double of_row = rounding::elimination * m.acceleration_size;
    if (removed_accelerations.size() > 0)
      of_row +=
          std::abs(c.normal.dot(removed_accelerations)) + std::abs(c.tangent.dot(removed_accelerations));
    if (c.takes_impulses() && !is_open(state.state)) {
      const double friction =
          tangent ? 0.0 : -slip_direction(state.state) * friction_in(c, state.state, m.dut, m.N);
      columns.push_back(-response.by_n - friction * response.by_t);
      rows.push_back(&c.normal);
      asked.push_back(hold ? -m.ddg : 0.0);
      noise.push_back(of_row);
    }
    if (!tangent) return;
    columns.push_back(-response.by_t);
    rows.push_back(&c.tangent);
    asked.push_back(hold ? -m.ddut : 0.0);
    noise.push_back(of_row);
  }
  /// True if row k is a linear combination of the other rows; the force of row k is then not unique.
  [[nodiscard]] bool is_shared(Eigen::Index k) const {
    const auto size = static_cast<Eigen::Index>(columns.size());
    Eigen::MatrixXd W(size, size);
    for (Eigen::Index i = 0; i < size; ++i)
      for (Eigen::Index j = 0; j < size; ++j)
        W(i, j) = rows[static_cast<std::size_t>(i)]->dot(columns[static_cast<std::size_t>(j)]);
    std::vector<Eigen::Index> others;
    for (Eigen::Index i = 0; i < size; ++i)
      if (i != k) others.push_back(i);
    return base::rank(W) == base::rank(W(others, Eigen::all));
  }
  struct Change {
    Eigen::VectorXd forces, unsure;
  };
  /// Solves for dF. push: other changes of accelerations; the changes due to dF are added to it.
  Change solve(Vector& push) const {
    const auto size = static_cast<Eigen::Index>(columns.size());
    if (size == 0) return {};
    Eigen::MatrixXd W(size, size);
    Eigen::VectorXd miss(size);
    for (Eigen::Index i = 0; i < size; ++i) {
      const Combination& row = *rows[static_cast<std::size_t>(i)];
      miss[i] = asked[static_cast<std::size_t>(i)] - row.dot(push);
      for (Eigen::Index j = 0; j < size; ++j) W(i, j) = row.dot(columns[static_cast<std::size_t>(j)]);
    }
    const Eigen::MatrixXd inverse = base::pseudo_inverse(W);
    Change change{inverse * miss, inverse.cwiseAbs() * Eigen::Map<const Eigen::VectorXd>(noise.data(), size)};
    for (Eigen::Index j = 0; j < size; ++j) push += change.forces[j] * columns[static_cast<std::size_t>(j)];
    return change;
  }
};

}  // namespace

double InstantLawChecker::force_noise() const {
  if (!force_noise_) force_noise_ = rounding::elimination * context_.balance_terms(record_.after);
  return *force_noise_;
}

/// Allowed error of a guard's value at this instant, in the unit of the guard.
double InstantLawChecker::zero_of(const GuardValue& guard, const Contact& c) const {
  const double noise = rounding::elimination * guard.size + tolerance_factor * guard.tolerance +
                       uncertainty_factor * record_.resolution * std::abs(guard.rate);
  const std::string_view law = guard.law;
  const bool solved = law == "tension" ? c.takes_impulses() : law == "friction" && !c.tangential_stiffness;
  return (1.0 + record_.forgiven) * (noise + (solved ? force_noise() : 0.0));
}

void InstantLawChecker::states() {
  for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
    const Contact& c = model_.contacts[k];
    if (!c.obeys_coulomb()) continue;
    const double rest = c.capture_velocity.value_or(context_.limits.capture_velocity);
    const ContactState &old = (*record_.before.mode)[k], &now = (*record_.after.mode)[k];
    if (!guards_are_satisfied(c, k, now, record_.after) ||
        !rows_are_satisfied(c, k, now, record_.after, rest))
      state_of(k);
    if (!record_.start && record_.located && !rows_are_satisfied(c, k, old, record_.before, rest))
      old_rows(k);
  }
}

/// Checks that N and T just before the instant satisfy the rows of the old state, as far as u and v determine N and T.
void InstantLawChecker::old_rows(std::size_t k) {
  const Contact& c = model_.contacts[k];
  const ContactState& state = (*record_.before.mode)[k];
  const ContactKinematics m = kinematics(c, k, record_.before);
  const LawLimits& tol = context_.limits;
  const double kn = c.normal_stiffness, cn = c.normal_damping, kt = c.tangential_stiffness.value_or(0.0);
  const double held = c.takes_impulses() ? force_noise() : 0.0;
  // In modes, forces and displacements are two different sums over modes with independent errors; hence the factor 2.
  const double limit =
      rounding::elimination *
          (2.0 * (normal_force_size(c, m) + kt * (m.displacement_size + std::abs(state.anchor))) +
           std::abs(m.N) + std::abs(m.T)) +
      tolerance_factor * ((kn + kt) * (tol.rtol * m.displacement_size + tol.displacement) +
                          cn * (tol.rtol * m.velocity_size + tol.velocity) +
                          tol.rtol * (std::abs(m.N) + std::abs(m.T)) + tol.force) +
      held;
  const auto check = [&](const char* law, double off) {
    if (std::abs(off) > limit) add(static_cast<int>(k), law, std::abs(off), limit, seen::force, false);
  };
  const int s = slip_direction(state.state);
  if (c.normal_force_given())
    check("normal force", m.N + m.q);
  else if (is_open(state.state))
    check("normal force", m.N);
  else if (c.normal_spring())
    check("normal force", m.N - kn * m.g - cn * m.dg);
  if (is_open(state.state) && !c.normal_force_given())
    check("friction force", m.T);
  else if (s != 0 && !c.sliding_point())
    check("friction force", m.T + s * friction_in(c, state.state, m.dut, m.N) * m.N);
  else if (kind_of(state.state) == State::stick && c.tangential_stiffness)
    check("friction force", m.T - kt * (m.ut - state.anchor));
}

/// Checks the guards and rows of the new state of contact k.
void InstantLawChecker::state_of(std::size_t k) {
  const Contact& c = model_.contacts[k];
  const ContactState& state = (*record_.after.mode)[k];
  const ContactKinematics m = kinematics(c, k, record_.after);
  const int contact = static_cast<int>(k);
  for (const GuardValue& guard : guards_of(c, state, m, context_.limits)) {
    // An engine that decides states only at the ends of steps uses the slip over the whole step, not the slip rate.
    if (std::string_view(guard.law) == "slip direction" && (c.sliding_point() || !record_.located)) continue;
    // If the slip reverses, an engine that decides states only at the ends of steps stops the contact for one step.
    if (std::string_view(guard.law) == "friction" && !c.tangential_stiffness && !record_.located) continue;
    double zero = zero_of(guard, c);
    // The slip rate of a contact that other contacts hold at rest is the rounding of their constraints.
    const bool of_slip = std::string_view(guard.law) == "slip direction";
    if (std::string_view(guard.law) == "rest" || (of_slip && may_be_held_by_neighbour(model_, k)))
      zero += context_.rest_speed(record_, k);
    if (guard.value < -zero && of_slip)
      zero += (1.0 + record_.forgiven) * slip_rate_noise(context_, record_.after, k);
    if (guard.value < -zero)
      add(contact, guard.law, -guard.value, zero, guard.unit(), -guard.value > grave_fraction * guard.size);
  }
  double asked = 0.0, size = std::abs(m.N);
  if (c.normal_force_given()) {
    asked = -m.q;
    size += std::abs(m.q);
  } else if (!is_open(state.state)) {
    if (!c.normal_spring()) {
      friction_of(k, m);
      return;
    }
    asked = c.normal_stiffness * m.g + c.normal_damping * m.dg;
    size += normal_force_size(c, m);
  }
  const double limit = rounding::elimination * size;
  if (const double off = std::abs(m.N - asked); off > limit)
    add(contact, "normal force", off, limit, seen::force, false);
  friction_of(k, m);
}

/// Checks that T satisfies the row of the new state.
void InstantLawChecker::friction_of(std::size_t k, const ContactKinematics& m) {
  const Contact& c = model_.contacts[k];
  const ContactState& state = (*record_.after.mode)[k];
  const int s = slip_direction(state.state);
  double asked = 0.0, size = std::abs(m.T);
  if (s != 0) {
    if (c.friction.is_rate_dependent() && c.sliding_point())
      return;  // the rate of the sliding point follows from T, so T cannot be checked with this rate
    const double f = friction_in(c, state.state, m.dut, m.N);
    asked = -s * f * m.N;
    size += std::abs(asked) + f * normal_force_size(c, m);
  } else if (kind_of(state.state) == State::stick) {
    if (c.constrains_tangent(state.state) || c.sliding_point()) {
      const double zero = context_.rest_speed(record_, k);
      if (std::abs(m.dut) > zero)
        add(static_cast<int>(k), "rest", std::abs(m.dut), zero, seen::velocity, false);
      return;
    }
    asked = *c.tangential_stiffness * (m.ut - state.anchor);
    size += *c.tangential_stiffness * (m.displacement_size + std::abs(state.anchor));
  }
  const double limit = rounding::elimination * size + (c.takes_impulses() ? force_noise() : 0.0);
  if (const double off = std::abs(m.T - asked); off > limit)
    add(static_cast<int>(k), "friction force", off, limit, seen::force, false);
}

/// True if the contact acts on massless degrees of freedom, whose velocities jump to those of the new state.
bool InstantLawChecker::moves_instantaneously(std::size_t k) const {
  return context_.contact_response(k) == nullptr;
}

/// Motion and forces that contact k would have in its old state, with u, v+ and the new states of all other contacts.
/// nullopt: the old rows of contact k do not determine its forces.
std::optional<InstantLawChecker::OldStateMotion> InstantLawChecker::motion_in_old_state(std::size_t k) const {
  const Contact& c = model_.contacts[k];
  const ContactState& old = (*record_.before.mode)[k];
  const ContactResponse* own = context_.contact_response(k);
  if (own == nullptr) return std::nullopt;
  OldStateMotion result{kinematics(c, k, record_.after)};
  ContactKinematics& m = result.m;
  const bool solved_N = c.takes_impulses() && !is_open(old.state), solved_T = c.constrains_tangent(old.state);
  const double N = m.N, T = m.T;
  const auto sliding = [&] {
    return -slip_direction(old.state) * friction_in(c, old.state, m.dut, m.N) * m.N;
  };
  // Forces that the old rows give directly, and their effect on accelerations.
  if (!solved_N)
    m.N = c.normal_force_given() ? -m.q
          : is_open(old.state)   ? 0.0
                                 : c.normal_stiffness * m.g + c.normal_damping * m.dg;
  if (!solved_T)
    m.T = kind_of(old.state) == State::stick && !c.sliding_point()
              ? *c.tangential_stiffness * (m.ut - old.anchor)
              : sliding();
  Vector push = -(m.N - N) * own->by_n;
  if (!solved_T) push -= (m.T - T) * own->by_t;
  ConstraintRows held;
  const Vector removed_accelerations = context_.capture_accelerations(record_);
  held.add(c, old, *own, m, removed_accelerations, true);
  for (std::size_t j = 0; j < model_.contacts.size(); ++j) {
    const Contact& other = model_.contacts[j];
    const ContactState& state = (*record_.after.mode)[j];
    const bool rigid = other.takes_impulses() || other.constrains_tangent(state.state);
    if (j == k || !other.obeys_coulomb() || is_open(state.state) || !rigid) continue;
    const ContactResponse* response = context_.contact_response(j);
    if (response == nullptr) return std::nullopt;
    held.add(other, state, *response, kinematics(other, j, record_.after), removed_accelerations, false);
  }
  if (solved_T && held.is_shared(solved_N ? 1 : 0)) return std::nullopt;
  const ConstraintRows::Change change = held.solve(push);
  if (solved_N) {
    m.N = N + change.forces[0];
    result.uncertainty_N = change.unsure[0];
  }
  if (solved_T) {
    m.T = T + change.forces[solved_N ? 1 : 0];
    result.uncertainty_T = change.unsure[solved_N ? 1 : 0];
  }
  if (solved_N && !solved_T) m.T = sliding();
  m.ddg += c.normal.dot(push);
  m.ddut += c.tangent.dot(push);
  return result;
}

/// True if g', ut' or N of contact k jumps: the guard after the jump then does not follow from the motion before.
bool InstantLawChecker::jumps(std::size_t k) const {
  const Contact& c = model_.contacts[k];
  const ContactKinematics b = kinematics(c, k, record_.before), a = kinematics(c, k, record_.after);
  const double speed = rounding::elimination * a.velocity_size + tolerance_factor * context_.limits.velocity;
  const double force =
      rounding::elimination * (normal_force_size(c, a) + std::abs(a.N) + std::abs(b.N)) +
      tolerance_factor * (context_.limits.force + c.normal_stiffness * context_.limits.displacement);
  // With a normal spring and no dashpot, N = kn g is continuous, because u is continuous.
  const bool may_jump = !c.normal_spring() || c.normal_damping > 0.0;
  return std::abs(a.dg - b.dg) > speed || std::abs(a.dut - b.dut) > speed ||
         (may_jump && std::abs(a.N - b.N) > force);
}

void InstantLawChecker::transitions() {
  for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
    const ContactState &old = (*record_.before.mode)[k], &now = (*record_.after.mode)[k];
    const RecordedEvent* event = event_of(k);
    if (old.state == now.state && event == nullptr) continue;
    const auto plain = [](State s) {
      return s == State::inside ? State::open : is_at_static_limit(s) ? kind_of(s) : s;
    };
    if (plain(old.state) != plain(now.state) && !record_.start &&
        (event == nullptr || event->from != plain(old.state) || event->to != plain(now.state)))
      add(static_cast<int>(k), "record", 1.0, 0.0, {}, true);
    if (!model_.contacts[k].obeys_coulomb() || (record_.start && !record_.continues) || !record_.located)
      continue;
    if (old.state != now.state) necessity(k);
    if (event != nullptr && event->t_uncertainty >= 0.0 && !record_.breakpoint && !record_.start && !jumps(k))
      guard_of(*event);
  }
}

/// True if a rigidly sticking contact slides after the instant, even slowly, because its friction impulse was at the
/// limit |Pt| = fk Pn.
bool InstantLawChecker::is_pushed_off(std::size_t k, const ContactState& old,
                                      const ContactKinematics& after) const {
  const Contact& c = model_.contacts[k];
  if (kind_of(old.state) != State::stick || c.tangential_stiffness) return false;
  if (std::abs(after.dut) > rounding::elimination * after.velocity_size) return true;
  if (record_.impulses.empty() || after.dut == 0.0) return false;
  for (const RecordedImpulse& p : record_.impulses) {
    if (p.contact != k) continue;
    double greatest = 0.0;
    for (const RecordedImpulse& other : record_.impulses)
      greatest = std::max({greatest, std::abs(other.normal), std::abs(other.tangent)});
    return std::abs(p.tangent) >= c.friction.kinetic * p.normal - rounding::elimination * greatest;
  }
  return true;  // the contact is a slider, which has no impulse
}

namespace {

/// True if N jumps. With a dashpot, the jump of g' is tested as well: it has a smaller rounding error than N, which
/// contains kn u.
bool force_jumps(const Contact& c, const ContactKinematics& before, const ContactKinematics& after) {
  const double of_N =
      rounding::many_operations * (std::abs(before.N) + std::abs(after.N) + normal_force_size(c, after));
  const double of_rate = rounding::many_operations * (before.velocity_size + after.velocity_size);
  return std::abs(after.N - before.N) > of_N ||
         (c.normal_damping > 0.0 && std::abs(after.dg - before.dg) > of_rate);
}

}  // namespace

/// Checks that contact k had to change its state: reports a violation if, with v+, every guard of the old state is positive
/// beyond rounding.
void InstantLawChecker::necessity(std::size_t k) {
  const Contact& c = model_.contacts[k];
  const ContactState &old = (*record_.before.mode)[k], &now = (*record_.after.mode)[k];
  if (!c.forces_follow_motion() || (moves_instantaneously(k) && record_.breakpoint)) return;
  const ContactKinematics before = kinematics(c, k, record_.before), after = kinematics(c, k, record_.after);
  if (c.normal_force_given() && (is_open(old.state) || is_open(now.state)))
    return;  // the sign of the prescribed normal force decides the state
  const double rest = rounding::elimination * after.velocity_size;
  if (is_pushed_off(k, old, after)) return;
  // A rigid contact with a velocity g' has separated; after a hit even a very slow g' > 0 is a separation.
  if (c.takes_impulses() && !is_open(old.state) &&
      (std::abs(after.dg) > rest || (!record_.impulses.empty() && after.dg > 0.0)))
    return;
  // If N jumps, T stays the same: a contact that slid sticks until T reaches the new limit. A jump anywhere in the
  // structure may cause a small jump of N.
  if (c.tangential_stiffness && slip_direction(old.state) != 0 && force_jumps(c, before, after)) return;
  if (old_guard_is_zero(k, old, before)) return;
  const std::optional<OldStateMotion> before_it = motion_in_old_state(k);
  if (!before_it) return;
  const GuardValues guards = guards_of(c, old, before_it->m, context_.limits);
  const RecordedEvent* event = event_of(k);
  const GuardValue* nearest = nullptr;
  double limit = 0.0;
  for (const GuardValue& guard : guards) {
    double zero = zero_of(guard, c);
    if (guard.law != std::string_view("slip direction") && guard.law != std::string_view("penetration"))
      zero += (1.0 + c.friction.static_) * before_it->uncertainty_N + before_it->uncertainty_T;
    if (event != nullptr && event->t_uncertainty >= 0.0)
      zero += uncertainty_factor * event->t_uncertainty *
              std::max(std::abs(event->guard_rate), std::abs(guard.rate));
    if (guard.value <= zero) return;
    // If the contact opens or closes, report the first guard, otherwise the last.
    const bool leaves = is_open(old.state) || is_open(now.state);
    if (nearest != nullptr && leaves) continue;
    nearest = &guard;
    limit = zero;
  }
  if (nearest == nullptr) return;
  add(static_cast<int>(k), "necessity", nearest->value, limit, nearest->unit(),
      nearest->value > grave_fraction * nearest->size);
}

/// True if a guard of contact k was zero just before the instant, although with the new states of other contacts it would
/// be positive.
bool InstantLawChecker::old_guard_is_zero(std::size_t k, const ContactState& old,
                                          const ContactKinematics& before) const {
  const Contact& c = model_.contacts[k];
  const RecordedEvent* event = event_of(k);
  const double off = event != nullptr && event->t_uncertainty >= 0.0 ? event->t_uncertainty : 0.0;
  for (const GuardValue& guard : guards_of(c, old, before, context_.limits))
    if (guard.value <= zero_of(guard, c) + uncertainty_factor * off * std::abs(guard.rate)) return true;
  return false;
}

/// Checks that a guard of the old state is zero at the time of the event, in the motion just before.
void InstantLawChecker::guard_of(const RecordedEvent& event) {
  const std::size_t k = event.contact;
  const Contact& c = model_.contacts[k];
  if (!c.forces_follow_motion()) return;
  const ContactState& old = (*record_.before.mode)[k];
  if (slip_direction(old.state) != 0 && c.normal_damping > 0.0 && record_.before.a == nullptr) return;
  const ContactKinematics m = kinematics(c, k, record_.before);
  double least = std::numeric_limits<double>::infinity(), limit = 0.0;
  const GuardValue* which = nullptr;
  const GuardValues guards = guards_of(c, old, m, context_.limits);
  for (const GuardValue& guard : guards) {
    // The engine located the zero with the same u and v, so its tolerances are not added.
    const double zero = zero_of(guard, c) - tolerance_factor * guard.tolerance +
                        uncertainty_factor * event.t_uncertainty * std::abs(event.guard_rate);
    if (which != nullptr && std::abs(guard.value) / zero >= std::abs(least) / limit) continue;
    least = guard.value;
    limit = zero;
    which = &guard;
  }
  if (which != nullptr && std::abs(least) > limit)
    add(static_cast<int>(k), "time of the event", std::abs(least), limit, which->unit(), false);
}

}  // namespace signorini::law_check
