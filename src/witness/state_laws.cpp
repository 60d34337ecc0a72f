#include <algorithm>
#include <cmath>

#include "base/eigen_dense.hpp"
#include "base/rounding.hpp"
#include "witness/laws.hpp"

namespace signorini {
namespace {

const Unit& unit_of(const SeenGuard& guard) {
  const std::string_view law = guard.law;
  return law == "penetration" || law == "lasting gap" ? seen::length
         : law == "slip direction"                    ? seen::velocity
                                                      : seen::force;
}

/// Rows of rigid contacts, and the changes of their forces that hold them:  W dF = asked,  W_ij = row_i . column_j.
struct HeldRows {
  std::vector<Vector> columns;  // accelerations by a unit force; of what slides with its friction
  std::vector<const Combination*> rows;
  std::vector<double> asked;

  void add(const Contact& c, const ContactState& state, const OwnResponse& response, double an, double at) {
    const bool tangent = holds_tangent(c, state.state);
    if (c.takes_impulses() && !is_open(state.state)) {
      const double friction = tangent ? 0.0 : -sign_of_slip(state.state) * c.friction.kinetic;
      columns.push_back(-response.by_n - friction * response.by_t);
      rows.push_back(&c.normal);
      asked.push_back(an);
    }
    if (!tangent) return;
    columns.push_back(-response.by_t);
    rows.push_back(&c.tangent);
    asked.push_back(at);
  }
  static bool holds_tangent(const Contact& c, State state) {
    return kind_of(state) == State::stick && !c.tangential_stiffness && !c.shear;
  }
  /// dF; push: accelerations that change besides, to which those by dF are added.
  Eigen::VectorXd solve(Vector& push) const {
    const auto size = static_cast<Eigen::Index>(columns.size());
    if (size == 0) return {};
    Eigen::MatrixXd W(size, size);
    Eigen::VectorXd miss(size);
    for (Eigen::Index i = 0; i < size; ++i) {
      const Combination& row = *rows[static_cast<std::size_t>(i)];
      miss[i] = asked[static_cast<std::size_t>(i)] - row.dot(push);
      for (Eigen::Index j = 0; j < size; ++j) W(i, j) = row.dot(columns[static_cast<std::size_t>(j)]);
    }
    Eigen::VectorXd change = least_squares(W, miss);
    for (Eigen::Index j = 0; j < size; ++j) push += change[j] * columns[static_cast<std::size_t>(j)];
    return change;
  }
};

}  // namespace

double Finder::force_noise() const {
  if (!force_noise_) force_noise_ = rounding::of_elimination * bench_.balance(record_.after);
  return *force_noise_;
}

/// How far a guard of this instant may be from its zero.
double Finder::zero_of(const SeenGuard& guard, const Contact& c) const {
  const double noise = rounding::of_elimination * guard.size + of_tolerance * guard.tolerance +
                       of_uncertainty * record_.resolution * std::abs(guard.rate);
  const std::string_view law = guard.law;
  const bool solved = law == "tension" ? c.takes_impulses() : law == "friction" && !c.tangential_stiffness;
  return (1.0 + record_.forgiven) * (noise + (solved ? force_noise() : 0.0));
}

void Finder::states() {
  for (std::size_t k = 0; k < model_.contacts.size(); ++k)
    if (!model_.contacts[k].own) state_of(k);
}

/// Guards of the new state, and its rows.
void Finder::state_of(std::size_t k) {
  const Contact& c = model_.contacts[k];
  const ContactState& state = (*record_.after.mode)[k];
  const Sight m = see(c, k, record_.after);
  const int contact = static_cast<int>(k);
  for (const SeenGuard& guard : guards_of(c, state, m, bench_.limits)) {
    if (std::string_view(guard.law) == "slip direction" && c.shear) continue;
    const double zero = zero_of(guard, c);
    if (guard.value < -zero) add(contact, guard.law, -guard.value, zero, unit_of(guard), false);
  }
  double asked = 0.0, size = std::abs(m.N);
  if (c.is_pressed()) {
    asked = -m.q;
    size += std::abs(m.q);
  } else if (!is_open(state.state)) {
    if (!c.has_spring()) {
      friction_of(k, m);
      return;
    }
    asked = c.normal_stiffness * m.g + c.normal_damping * m.dg;
    size += size_of_normal(c, m);
  }
  const double limit = rounding::of_elimination * size;
  if (const double off = std::abs(m.N - asked); off > limit)
    add(contact, "normal force", off, limit, seen::force, false);
  friction_of(k, m);
}

/// T of the state's row.
void Finder::friction_of(std::size_t k, const Sight& m) {
  const Contact& c = model_.contacts[k];
  const ContactState& state = (*record_.after.mode)[k];
  const int s = sign_of_slip(state.state);
  double asked = 0.0, size = std::abs(m.T);
  if (s != 0) {
    if (c.friction.varies()) return;
    asked = -s * c.friction.kinetic * m.N;
    size += std::abs(asked) + c.friction.kinetic * size_of_normal(c, m);
  } else if (kind_of(state.state) == State::stick) {
    if (c.shear || !c.tangential_stiffness) {
      const double zero = bench_.slowest(record_, k);
      if (std::abs(m.dut) > zero)
        add(static_cast<int>(k), "rest", std::abs(m.dut), zero, seen::velocity, false);
      return;
    }
    asked = *c.tangential_stiffness * (m.ut - state.anchor);
    size += *c.tangential_stiffness * (m.place + std::abs(state.anchor));
  }
  const double limit = rounding::of_elimination * size + (c.takes_impulses() ? force_noise() : 0.0);
  if (const double off = std::abs(m.T - asked); off > limit)
    add(static_cast<int>(k), "friction force", off, limit, seen::force, false);
}

/// It acts where there is no mass: its velocities are those of its new state.
bool Finder::moves_at_once(std::size_t k) const { return bench_.own_response(k) == nullptr; }

/// Contact k in its old state, with u, v+ and the new states of all others. Nothing: its old rows cannot be told.
std::optional<Sight> Finder::as_before(std::size_t k) const {
  const Contact& c = model_.contacts[k];
  const ContactState& old = (*record_.before.mode)[k];
  const OwnResponse* own = bench_.own_response(k);
  if (own == nullptr) return std::nullopt;
  Sight m = see(c, k, record_.after);
  const bool solved_N = c.takes_impulses() && !is_open(old.state),
             solved_T = HeldRows::holds_tangent(c, old.state);
  const double sliding = -sign_of_slip(old.state) * c.friction.kinetic, N = m.N, T = m.T;
  // What its old rows say of its forces directly, and what that does to accelerations.
  if (!solved_N)
    m.N = c.is_pressed()       ? -m.q
          : is_open(old.state) ? 0.0
                               : c.normal_stiffness * m.g + c.normal_damping * m.dg;
  if (!solved_T)
    m.T = kind_of(old.state) == State::stick && !c.shear ? *c.tangential_stiffness * (m.ut - old.anchor)
                                                         : sliding * m.N;
  Vector push = -(m.N - N) * own->by_n;
  if (!solved_T) push -= (m.T - T) * own->by_t;
  HeldRows held;
  held.add(c, old, *own, -m.ddg, -m.ddut);
  for (std::size_t j = 0; j < model_.contacts.size(); ++j) {
    const Contact& other = model_.contacts[j];
    const ContactState& state = (*record_.after.mode)[j];
    const bool rigid = other.takes_impulses() || HeldRows::holds_tangent(other, state.state);
    if (j == k || other.own || is_open(state.state) || !rigid) continue;
    const OwnResponse* response = bench_.own_response(j);
    if (response == nullptr) return std::nullopt;
    held.add(other, state, *response, 0.0, 0.0);
  }
  const Eigen::VectorXd change = held.solve(push);
  if (solved_N) m.N = N + change[0];
  if (solved_T) m.T = T + change[solved_N ? 1 : 0];
  if (solved_N && !solved_T) m.T = sliding * m.N;
  m.ddg += c.normal.dot(push);
  m.ddut += c.tangent.dot(push);
  return m;
}

/// Its own g', ut', N or T jump: what it did before does not tell what it was led to.
bool Finder::jumps(std::size_t k) const {
  const Contact& c = model_.contacts[k];
  const Sight b = see(c, k, record_.before), a = see(c, k, record_.after);
  const double speed = rounding::of_elimination * a.speed + of_tolerance * bench_.limits.velocity;
  const double force = rounding::of_elimination * (size_of_normal(c, a) + std::abs(a.N) + std::abs(b.N)) +
                       of_tolerance * (bench_.limits.force + c.normal_stiffness * bench_.limits.displacement);
  const bool may_jump = !c.has_spring() || c.normal_damping > 0.0;  // N = kn g goes with u
  return std::abs(a.dg - b.dg) > speed || std::abs(a.dut - b.dut) > speed ||
         (may_jump && std::abs(a.N - b.N) > force);
}

void Finder::transitions() {
  for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
    const ContactState &old = (*record_.before.mode)[k], &now = (*record_.after.mode)[k];
    const RecordedEvent* event = event_of(k);
    const auto plain = [](State s) { return s == State::inside ? State::open : s; };
    if (plain(old.state) != plain(now.state) && !record_.start &&
        (event == nullptr || event->from != plain(old.state) || event->to != plain(now.state)))
      add(static_cast<int>(k), "record", 1.0, 0.0, {}, true);
    if (model_.contacts[k].own || record_.start || !record_.located) continue;
    if (old.state != now.state) necessity(k);
    if (event != nullptr && event->t_uncertainty >= 0.0 && !record_.breakpoint && !jumps(k)) guard_of(*event);
  }
}

/// The least guard of the old state, with v+, is above its rounding: nothing asked for another state.
void Finder::necessity(std::size_t k) {
  const Contact& c = model_.contacts[k];
  const ContactState &old = (*record_.before.mode)[k], &now = (*record_.after.mode)[k];
  if (c.shear || c.friction.varies() || (moves_at_once(k) && record_.breakpoint)) return;
  const Sight before = see(c, k, record_.before), after = see(c, k, record_.after);
  if (c.is_pressed() && (is_open(old.state) || is_open(now.state))) return;  // as the compression asks
  const bool sticks_rigidly = kind_of(old.state) == State::stick && !c.tangential_stiffness;
  const double rest = rounding::of_elimination * after.speed;
  if (sticks_rigidly && std::abs(after.dut) > rest) return;  // pushed off
  // Thrown off: beside a hit, however slowly.
  if (c.takes_impulses() && !is_open(old.state) &&
      (std::abs(after.dg) > rest || (!record_.impulses.empty() && after.dg > 0.0)))
    return;
  // T stays where N jumps: what slid sticks at it until its limit is reached anew.
  const double jump =
      rounding::of_elimination * (std::abs(before.N) + std::abs(after.N) + size_of_normal(c, after));
  if (c.tangential_stiffness && sign_of_slip(old.state) != 0 && std::abs(after.N - before.N) > jump) return;
  const std::optional<Sight> m = as_before(k);
  if (!m) return;
  const SeenGuards guards = guards_of(c, old, *m, bench_.limits);
  const RecordedEvent* event = event_of(k);
  const SeenGuard* nearest = nullptr;
  double limit = 0.0;
  for (const SeenGuard& guard : guards) {
    double zero = zero_of(guard, c);
    if (event != nullptr && event->t_uncertainty >= 0.0)
      zero +=
          of_uncertainty * event->t_uncertainty * std::max(std::abs(event->guard_rate), std::abs(guard.rate));
    if (guard.value <= zero) return;
    const bool leaves = is_open(old.state) || is_open(now.state);  // by its first guard; by its last one else
    if (nearest != nullptr && leaves) continue;
    nearest = &guard;
    limit = zero;
  }
  if (nearest != nullptr)
    add(static_cast<int>(k), "necessity", nearest->value, limit, unit_of(*nearest), false);
}

/// The guard that fell is zero at the time of its event, in the motion just before.
void Finder::guard_of(const RecordedEvent& event) {
  const std::size_t k = event.contact;
  const Contact& c = model_.contacts[k];
  if (c.friction.varies() || c.shear) return;
  const ContactState& old = (*record_.before.mode)[k];
  if (sign_of_slip(old.state) != 0 && c.normal_damping > 0.0 && record_.before.a == nullptr) return;
  const Sight m = see(c, k, record_.before);
  double least = std::numeric_limits<double>::infinity(), limit = 0.0;
  const SeenGuard* which = nullptr;
  const SeenGuards guards = guards_of(c, old, m, bench_.limits);
  for (const SeenGuard& guard : guards) {
    // It was located by u and v themselves: no tolerance is left in it.
    const double zero = zero_of(guard, c) - of_tolerance * guard.tolerance +
                        of_uncertainty * event.t_uncertainty * std::abs(event.guard_rate);
    if (which != nullptr && std::abs(guard.value) / zero >= std::abs(least) / limit) continue;
    least = guard.value;
    limit = zero;
    which = &guard;
  }
  if (which != nullptr && std::abs(least) > limit)
    add(static_cast<int>(k), "time of the event", std::abs(least), limit, unit_of(*which), false);
}

/// u, and T where nothing but its state's row changes. Both sides of u are rounded.
void Finder::continuity() {
  const WitnessLimits& tol = bench_.limits;
  // Sizes of u, and of v within what the time is known to, of translations and of rotations.
  double size[2] = {record_.before.u_reach[0] + model_.scales.displacement,
                    record_.before.u_reach[1] + model_.scales.rotation};
  double moved[2] = {0.0, 0.0}, clock = record_.resolution;
  for (const RecordedEvent& event : record_.events) clock = std::max(clock, event.t_uncertainty);
  const auto turns = [&](int i) { return model_.dofs[static_cast<std::size_t>(i)].rotation; };
  // Gaps that close do so by the smallest change in the norm of M.
  Vector closed = Vector::Zero(model_.size());
  for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
    const OwnResponse* own = model_.contacts[k].takes_impulses() ? bench_.own_response(k) : nullptr;
    if (own == nullptr || !(own->nn > 0.0) || is_open((*record_.after.mode)[k].state)) continue;
    const double gap = rounding::of_elimination * see(model_.contacts[k], k, record_.before).place;
    closed += gap / own->nn * own->by_n.cwiseAbs();
  }
  for (int i = 0; i < model_.size(); ++i) {
    size[turns(i)] = std::max(size[turns(i)], std::abs((*record_.before.u)[i]));
    moved[turns(i)] = std::max(moved[turns(i)], clock * std::abs((*record_.before.v)[i]));
  }
  for (int i = 0; i < model_.size(); ++i) {
    if (!bench_.has_mass(i) && (record_.breakpoint || record_.start)) continue;
    const bool turn = turns(i);
    const double limit = 2.0 * rounding::of_elimination * size[turn] + closed[i] +
                         of_uncertainty * moved[turn] +
                         of_tolerance * (tol.rtol * size[turn] + (turn ? tol.rotation : tol.displacement));
    const double off = std::abs((*record_.after.u)[i] - (*record_.before.u)[i]);
    if (off <= limit) continue;
    add(-1, "continuity", off, limit, turn ? Unit{} : seen::length, false);
    break;
  }
  if (record_.start || !record_.located) return;
  for (std::size_t k = 0; k < model_.contacts.size(); ++k)
    if (!model_.contacts[k].own) friction_continuity(k);
}

/// T of a spring stays; it drops from the static limit to the kinetic one where the contact lets go.
void Finder::friction_continuity(std::size_t k) {
  const Contact& c = model_.contacts[k];
  const ContactState &old = (*record_.before.mode)[k], &now = (*record_.after.mode)[k];
  if (!c.tangential_stiffness || is_open(old.state) || is_open(now.state) || c.friction.varies()) return;
  if (moves_at_once(k) && record_.breakpoint) return;
  const Sight b = see(c, k, record_.before), a = see(c, k, record_.after);
  const double fs = c.friction.static_, fk = c.friction.kinetic, kt = *c.tangential_stiffness;
  const double off_N =
      rounding::of_elimination * (size_of_normal(c, a) + std::abs(a.N) + std::abs(b.N)) +
      of_tolerance * (c.normal_stiffness * (bench_.limits.rtol * a.place + bench_.limits.displacement));
  if (std::abs(a.N - b.N) > off_N && sign_of_slip(now.state) != 0) return;  // T = -s fk N follows
  double limit = rounding::of_elimination * (kt * (a.place + std::abs(now.anchor)) + std::abs(b.T)) +
                 of_tolerance * (kt * (bench_.limits.rtol * a.place + bench_.limits.displacement)) +
                 fs * off_N;
  if (const RecordedEvent* event = event_of(k); event != nullptr && event->t_uncertainty > 0.0)
    limit += of_uncertainty * event->t_uncertainty * (std::abs(event->guard_rate) + kt * std::abs(a.dut));
  const double at_limit = fs * std::min(std::abs(b.N), std::abs(a.N)) - std::abs(b.T);
  const bool lets_go = kind_of(old.state) == State::stick && fs > fk && at_limit <= limit;
  const bool above = std::abs(b.T) > fs * std::abs(a.N) + limit;  // N has dropped
  if (lets_go || above) return;
  if (const double off = std::abs(a.T - b.T); off > limit)
    add(static_cast<int>(k), "continuity of friction", off, limit, seen::force, false);
}

}  // namespace signorini
