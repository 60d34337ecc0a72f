#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "base/eigen_dense.hpp"
#include "base/rounding.hpp"
#include "law_check/laws.hpp"
#include "model/assembly/parts.hpp"

namespace signorini::law_check {
namespace {

struct ClosedRows {
  std::vector<const Combination*> forms;
  std::vector<Vector> columns;  // for each row: M^-1 times its form, plus friction if the contact slides
  std::vector<double> gaps;

  void add(const Combination& form, Vector column, double gap) {
    forms.push_back(&form);
    columns.push_back(std::move(column));
    gaps.push_back(gap);
  }
  [[nodiscard]] Vector moved(int size) const {
    Vector by = Vector::Zero(size);
    const auto m = static_cast<Eigen::Index>(gaps.size());
    if (m == 0) return by;
    Eigen::MatrixXd W(m, m);
    for (Eigen::Index i = 0; i < m; ++i)
      for (Eigen::Index j = 0; j < m; ++j)
        W(i, j) = forms[static_cast<std::size_t>(i)]->dot(columns[static_cast<std::size_t>(j)]);
    const Eigen::VectorXd push =
        base::pseudo_inverse(W).cwiseAbs() * Eigen::Map<const Eigen::VectorXd>(gaps.data(), m);
    for (Eigen::Index j = 0; j < m; ++j) by += push[j] * columns[static_cast<std::size_t>(j)].cwiseAbs();
    return by;
  }
};

}  // namespace

/// Checks that u is continuous, and T unless the new state gives T by another equation.
void InstantLawChecker::continuity() {
  const LawLimits& tol = context_.limits;
  // Largest |u_i| and |v_i| of translations and rotations; v times the uncertainty of the time is a change of u.
  const std::array<double, 2> of_u = context_.max_entries(*record_.before.u),
                              of_v = context_.max_entries(*record_.before.v);
  const std::array<double, 2> off_by = context_.max_entries(*record_.after.u - *record_.before.u);
  double clock = record_.resolution;
  for (const RecordedEvent& event : record_.events) clock = std::max(clock, event.t_uncertainty);
  std::array<double, 2> limits{};
  for (const bool turn : {false, true}) {
    const double size =
        std::max(of_u[turn],
                 record_.before.max_u[turn] + (turn ? model_.scales.rotation : model_.scales.displacement));
    limits[turn] = 2.0 * rounding::elimination * size + uncertainty_factor * clock * of_v[turn] +
                   tolerance_factor * (tol.rtol * size + (turn ? tol.rotation : tol.displacement));
  }
  std::optional<Vector> closed;
  const bool massless_jump = lets_massless_jump();
  const bool any = !(off_by[0] <= limits[0] && off_by[1] <= limits[1]);
  for (int i = 0; any && i < model_.size(); ++i) {
    if (!context_.has_mass(i) && massless_jump) continue;
    const bool turn = model_.dofs[static_cast<std::size_t>(i)].rotation;
    double limit = limits[turn];
    const double off = std::abs((*record_.after.u)[i] - (*record_.before.u)[i]);
    if (off <= limit) continue;
    if (!closed) closed = closing();
    limit += (*closed)[i];
    if (off > limit) limit += massless_dof_uncertainty(i);
    if (off <= limit) continue;
    add(-1, "continuity", off, limit, turn ? Unit{} : seen::length, false);
    break;
  }
  if ((record_.start && !record_.continues) || !record_.located) return;
  for (std::size_t k = 0; k < model_.contacts.size(); ++k)
    if (model_.contacts[k].obeys_coulomb()) friction_continuity(k);
}

/// Uncertainty of u_i at a massless degree of freedom i, where u follows from forces. Stiff contact springs convert the
/// rounding of u to forces, which bend the structure by  sum_j |(K^-1)_ij| noise_j,  K: stiffness of the structure on
/// massless degrees of freedom. Returns 0 if the degree of freedom has mass, or K is singular.
double InstantLawChecker::massless_dof_uncertainty(int dof) const {
  if (context_.has_mass(dof) || record_.after.loads.empty() || record_.before.loads.empty()) return 0.0;
  const std::vector<int>& all = context_.massless();
  const SparseMatrix only = assembly::selection(all, model_.size());
  Eigen::SimplicialLDLT<SparseMatrix> ldlt(only.transpose() * model_.stiffness * only);
  if (ldlt.info() != Eigen::Success) return 0.0;
  const Vector by_force = ldlt.solve(only.transpose() * Vector::Unit(model_.size(), dof));
  const Vector noise =
      massless_noise(context_, record_.before, 0) + massless_noise(context_, record_.after, 0);
  const double bent = by_force.cwiseAbs().dot(only.transpose() * noise);
  return std::isfinite(bent) ? bent : 0.0;
}

/// Bound of the change of u if the decision closes all gaps of rigid contacts that are within rounding. It closes them
/// together by the smallest change of u in the norm of M that does not move sticking contacts along t:
/// du = M^-1 G^T W^-1 (g, 0),  W = G M^-1 G^T,  G: rows (n, t).
Vector InstantLawChecker::closing() const {
  Vector most = Vector::Zero(model_.size());
  const auto close = [&](const std::vector<ContactState>& mode, bool by_impulses) {
    ClosedRows rows;
    for (std::size_t k = 0; k < model_.contacts.size(); ++k) {
      const Contact& c = model_.contacts[k];
      const ContactResponse* own = context_.contact_response(k);
      const bool touches =
          !is_open(mode[k].state) || std::any_of(record_.impulses.begin(), record_.impulses.end(),
                                                 [&](const RecordedImpulse& p) { return p.contact == k; });
      if (own == nullptr || !touches) continue;
      const ContactKinematics before = kinematics(c, k, record_.before);
      const double gap = rounding::elimination * before.displacement_size;
      const double friction =
          by_impulses ? 0.0
                      : -slip_direction(mode[k].state) * friction_in(c, mode[k].state, before.dut, before.N);
      if (c.takes_impulses()) rows.add(c.normal, own->by_n + friction * own->by_t, gap);
      if (!by_impulses && c.sticks_rigidly() && kind_of(mode[k].state) == State::stick)
        rows.add(c.tangent, own->by_t, 0.0);
    }
    most = most.cwiseMax(rows.moved(model_.size()));
  };
  close(*record_.before.mode, false);
  close(*record_.after.mode, false);
  close(*record_.after.mode, true);  // all touching contacts, which may move along t without friction
  return most;
}

/// True if massless parts may jump, because the forces on them jump: at a breakpoint of the forcing, when they leave a
/// contact, and when friction drops to its kinetic value.
bool InstantLawChecker::lets_massless_jump() const {
  if (massless_jump_) return *massless_jump_;
  bool any = record_.breakpoint || record_.start || !record_.released.empty();
  for (const std::size_t k : context_.contacts_on_massless()) any = any || lets_go(k);
  massless_jump_ = any;
  return any;
}

/// True if the body of a contact is massless: if the sliding point has a dashpot, the body jumps instead of this point.
bool InstantLawChecker::body_follows(std::size_t k) const {
  const std::vector<std::pair<int, double>>& terms = model_.contacts[k].body_tangent().terms;
  return std::any_of(terms.begin(), terms.end(),
                     [&](const auto& term) { return !context_.has_mass(term.first); });
}

/// True if contact k stuck at its static limit, which is above the kinetic limit, and stick ended: the contact slides, is
/// open, or slid and stopped within the instant (an event "slip" from stick to stick).
bool InstantLawChecker::lets_go(std::size_t k) const {
  const Contact& c = model_.contacts[k];
  const ContactState &old = (*record_.before.mode)[k], &now = (*record_.after.mode)[k];
  if (!c.obeys_coulomb() || (c.sliding_point() && !body_follows(k)) || c.friction.is_rate_dependent() ||
      !c.friction.has_static_drop())
    return false;
  const RecordedEvent* event = event_of(k);
  if (event == nullptr || event->t_uncertainty < 0.0) return false;
  const bool stopped = kind_of(now.state) == State::stick && event->type == "slip";
  if (kind_of(old.state) != State::stick || (kind_of(now.state) == State::stick && !stopped)) return false;
  const ContactKinematics before = kinematics(c, k, record_.before);
  for (const GuardValue& guard : guards_of(c, old, before, context_.limits)) {
    if (guard.law != std::string_view("friction")) continue;
    const double zero = zero_of(guard, c) + uncertainty_factor * event->t_uncertainty *
                                                std::max(std::abs(event->guard_rate), std::abs(guard.rate));
    return std::abs(guard.value) <= zero;
  }
  return false;
}

/// Checks the sliding point p = ut - T/kt of contact k if massless parts jump: p of a sticking contact does not move; if
/// stick ends, p slides in the direction s of slip:  s (p+ - p-) >= 0.
void InstantLawChecker::instantaneous_slide(std::size_t k) {
  const Contact& c = model_.contacts[k];
  const ContactState &old = (*record_.before.mode)[k], &now = (*record_.after.mode)[k];
  if (record_.breakpoint || record_.start || is_released(k)) return;
  const ContactKinematics b = kinematics(c, k, record_.before), a = kinematics(c, k, record_.after);
  const double kt = *c.tangential_stiffness;
  const double limit =
      rounding::elimination *
          (kt * (a.displacement_size + b.displacement_size) + std::abs(a.T) + std::abs(b.T)) +
      tolerance_factor * (kt * (context_.limits.rtol * a.displacement_size + context_.limits.displacement) +
                          context_.limits.rtol * (std::abs(a.T) + std::abs(b.T)) + context_.limits.force);
  const double moved = kt * (a.ut - b.ut) - (a.T - b.T);
  const bool sticks = kind_of(old.state) == State::stick && kind_of(now.state) == State::stick;
  if (sticks && event_of(k) == nullptr && std::abs(moved) > limit)
    add(static_cast<int>(k), "continuity of friction", std::abs(moved), limit, seen::force, false);
  const double back = b.T >= 0.0 ? -moved : moved;
  if (lets_go(k) && back > limit)
    add(static_cast<int>(k), "continuity of friction", back, limit, seen::force, false);
}

/// True if T is equal on both sides, up to rounding of T, and has the sign that belongs to the new slip direction, if any.
bool InstantLawChecker::shear_stays(std::size_t k) const {
  const auto at = static_cast<Eigen::Index>(model_.layout.tangent(k));
  const double before = (*record_.before.forces)[at], after = (*record_.after.forces)[at];
  return std::abs(after - before) <= rounding::elimination * std::abs(before) &&
         slip_direction((*record_.after.mode)[k].state) * before >= 0.0;
}

/// True if |N| of a sliding contact drops and T is at the new kinetic limit. The new state may be any: an impact that makes
/// N jump may reverse the slip at the same instant, or the contact may stick with this T.
bool InstantLawChecker::friction_follows_drop(std::size_t k, const ContactKinematics& before,
                                              const ContactKinematics& after, double off_N,
                                              double off_T) const {
  const Contact& c = model_.contacts[k];
  const State old = (*record_.before.mode)[k].state;
  const int s = slip_direction(old);
  if (s == 0 || std::abs(after.N) >= std::abs(before.N) - off_N) return false;
  return std::abs(after.T + s * friction_in(c, old, before.dut, after.N) * after.N) <= off_T;
}

/// Checks that T of a tangential spring is continuous, except that it may drop from the static to the kinetic limit.
void InstantLawChecker::friction_continuity(std::size_t k) {
  const Contact& c = model_.contacts[k];
  const ContactState &old = (*record_.before.mode)[k], &now = (*record_.after.mode)[k];
  if (!c.tangential_stiffness || is_open(old.state) || is_open(now.state) || c.friction.is_rate_dependent())
    return;
  if (lets_massless_jump() && moves_instantaneously(k)) return instantaneous_slide(k);
  if (shear_stays(k)) return;
  const ContactKinematics b = kinematics(c, k, record_.before), a = kinematics(c, k, record_.after);
  const bool by_force = c.friction.is_load_dependent();
  const double fs = by_force ? friction_at(c, 0.0, a.N) : c.friction.static_;
  const double fk = by_force ? fs : c.friction.kinetic, kt = *c.tangential_stiffness;
  const double off_N =
      rounding::elimination * (normal_force_size(c, a) + std::abs(a.N) + std::abs(b.N)) +
      tolerance_factor *
          (c.normal_stiffness * (context_.limits.rtol * a.displacement_size + context_.limits.displacement));
  if (std::abs(a.N - b.N) > off_N && slip_direction(now.state) != 0) return;  // T = -s fk N jumps with N
  double limit =
      rounding::elimination * (kt * (a.displacement_size + std::abs(now.anchor)) + std::abs(b.T)) +
      tolerance_factor * (kt * (context_.limits.rtol * a.displacement_size + context_.limits.displacement)) +
      fs * off_N;
  if (const RecordedEvent* event = event_of(k); event != nullptr && event->t_uncertainty > 0.0)
    limit += uncertainty_factor * event->t_uncertainty * (std::abs(event->guard_rate) + kt * std::abs(a.dut));
  if (friction_follows_drop(k, b, a, off_N, limit)) return;
  const double at_limit = fs * std::min(std::abs(b.N), std::abs(a.N)) - std::abs(b.T);
  const bool lets_go = kind_of(old.state) == State::stick && fs > fk && at_limit <= limit;
  const bool above = std::abs(b.T) > fs * std::abs(a.N) + limit;  // |N| has dropped
  if (lets_go || above) {                                         // T drops to the limit and keeps its sign
    if (slip_direction(now.state) * b.T < 0.0 && std::abs(b.T) > limit && !moves_instantaneously(k))
      add(static_cast<int>(k), "continuity of friction", std::abs(a.T - b.T), limit, seen::force, false);
    return;
  }
  if (const double off = std::abs(a.T - b.T); off > limit)
    add(static_cast<int>(k), "continuity of friction", off, limit, seen::force, false);
}

// Laws between two successive instants, 1 and 2, checked from the two ends of the motion only: +, just after instant 1,
// and -, just before instant 2.
//
//   states- = states+                                      s (p- - p+) >= 0 for sliding contacts,  p = ut - T/kt
//   ut- = ut+ for rigid stick,  g- = g+ for rigid closed contacts        only for engines without tolerances and steps
//   M a + C v + K u + sum ( n N + t T + t (-N - N_carried) ut / R ) = P         just after an instant; R: of a pendulum

namespace {

/// Motion of one contact at the two ends: just after one instant, and just before the next.
struct StretchEnds {
  ContactKinematics from, to;
  [[nodiscard]] double place() const { return from.displacement_size + to.displacement_size; }
};

/// Displacement of the sliding point p = ut - T/kt between the two ends.
double slid(const Contact& c, const StretchEnds& ends) {
  const double by_force = c.tangential_stiffness ? (ends.to.T - ends.from.T) / *c.tangential_stiffness : 0.0;
  return ends.to.ut - ends.from.ut - by_force;
}

/// Error of slid() due to rounding and tolerances. scale: displacement scale of the scene; even a point at rest moves by
/// the rounding of such displacements.
double slid_noise(const Contact& c, const StretchEnds& ends, const LawLimits& tol, double scale) {
  const double by_force =
      c.tangential_stiffness ? (std::abs(ends.to.T) + std::abs(ends.from.T)) / *c.tangential_stiffness : 0.0;
  return rounding::elimination * (ends.place() + scale + by_force) +
         tolerance_factor * (tol.rtol * (ends.place() + by_force) + 2.0 * tol.displacement);
}

class RowSums {
 public:
  explicit RowSums(int size) : sum(Vector::Zero(size)), terms(sum) {}
  /// Adds matrix * x. reach: scales of the rounding error of x for translations and rotations, if larger than |x_j|.
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

std::vector<Violation> stretch_laws(const CheckContext& context, double t, const CheckedSide& from,
                                    const CheckedSide& to) {
  std::vector<Violation> found;
  const Model& model = context.model;
  const bool drifts = context.limits.rtol > 0.0 || context.limits.step > 0.0;
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
    const StretchEnds ends{kinematics(c, k, from), kinematics(c, k, to)};
    const double noise = slid_noise(c, ends, context.limits, model.scales.displacement);
    const int s =
        is_at_static_limit(now.state) || may_be_held_by_neighbour(model, k) ? 0 : slip_direction(now.state);
    if (s != 0) add("way of slip", -s * slid(c, ends), noise, seen::length);
    if (drifts) continue;
    if (kind_of(now.state) == State::stick && !c.tangential_stiffness)
      add("unbroken rest", std::abs(slid(c, ends)), noise, seen::length);
    if (c.takes_impulses() && !is_open(now.state))
      add("unbroken rest", std::abs(ends.to.g - ends.from.g), noise, seen::length);
  }
  return found;
}

std::vector<Violation> equilibrium_law(const CheckContext& context, double t, const CheckedSide& side,
                                       const Vector& load) {
  const Model& model = context.model;
  RowSums rows(model.size());
  rows.add(model.mass, *side.a, side.acceleration_terms, model);
  rows.add(model.damping, *side.v, side.max_v, model);
  rows.add(model.stiffness, *side.u, side.max_u, model);
  for (std::size_t k = 0; k < model.contacts.size(); ++k) {
    const Contact& c = model.contacts[k];
    const ContactKinematics m = kinematics(c, k, side);
    const double size = std::abs(m.N) + std::abs(m.T) + normal_force_size(c, m) +
                        c.tangential_stiffness.value_or(0.0) * m.displacement_size;
    rows.add(c.normal, m.N, size);
    rows.add(c.tangent, m.T, size);
    const CurvedSurface* bowl = c.curved_surface();
    if (bowl == nullptr) continue;
    // K contains the restoring force of a pendulum under its nominal force; that of the remaining force is added here.
    const double slope = (c.body_tangent().dot(*side.u) - side.driven[k].s) / bowl->radius;
    rows.add(c.body_tangent(), (-m.N - bowl->nominal_force) * slope,
             (size + bowl->nominal_force) * m.displacement_size / bowl->radius);
  }
  rows.sum -= load;
  rows.terms += load.cwiseAbs();
  // Residuals of solves scale with the largest row, separately for forces and for moments.
  const std::array<double, 2> greatest = context.max_entries(rows.terms);
  std::optional<Violation> worst;
  for (int i = 0; i < model.size(); ++i) {
    const bool turns = model.dofs[static_cast<std::size_t>(i)].rotation;
    const double limit = rounding::elimination * std::max(rows.terms[i], greatest[turns]);
    const double off = std::abs(rows.sum[i]);
    if (!context.has_mass(i) || off <= limit || (worst && off / limit <= worst->value / worst->limit))
      continue;
    worst = Violation{t, "", -1, "equilibrium", off, limit, turns ? Unit{1, 1, 0} : seen::force, false};
  }
  if (!worst) return {};
  return {*worst};
}

}  // namespace signorini::law_check
