#include "decide/resting_forces.hpp"

#include <algorithm>
#include <cmath>

#include "base/eigen_dense.hpp"
#include "base/rounding.hpp"
#include "contact/friction.hpp"
#include "linear/redundant_rows.hpp"

namespace signorini::decide {
namespace {

using SetKind = base::ConvexSet::Kind;

/// Forces of zero lie inside the limits of sliders: derivatives of their forces have no limit.
void leave_discs(double zero, std::vector<base::ConvexSet>& sets) {
  for (base::ConvexSet& set : sets)
    if (set.kind == SetKind::disc) set = base::critical_cone(set, Eigen::VectorXd::Zero(set.size), zero);
}

/// A guard that an engine located is zero, whatever digits its force has lost: no engine loses half of them.
constexpr double located_digits = 0x1p-26;

/// Limit F = fs q of a slider's friction force, or its time derivative of this order.
double limit_of(const Contact& contact, std::size_t c, const motion::Forcing& forcing, double t,
                std::size_t order) {
  const double q = forcing.applied_normal_force(c, t, static_cast<int>(order));
  return order == 0 ? contact::sticking_limit(contact, -q) : contact::static_friction(contact) * q;
}

/// Sign of the component of a set's direction along the tangent.
int side_of(const base::ConvexSet& set) { return set.direction[set.size - 1] > 0.0 ? 1 : -1; }

/// side: sign of k = -T if the foot lies at or beyond its limit.
State state_of(const Contact& contact, const base::ConvexSet& set, int side) {
  const State at_limit = side > 0 ? State::slip_minus : State::slip_plus;
  switch (set.kind) {
    case SetKind::origin:
      return contact.normal_force_given() ? at_limit : State::open;
    case SetKind::line:
    case SetKind::ray:  // no derivative decides whether the foot begins to bear
      return contact.has_friction() && side != 0 ? at_limit : contact::state_at_rest(contact);
    case SetKind::cone:
    case SetKind::disc:
    case SetKind::whole:
    case SetKind::half_space:
      break;
  }
  return contact::state_at_rest(contact);
}

/// Adds what the derivative of this order has decided: the guards that were zero before rise.
void add_known(const base::ConvexSet& before, const base::ConvexSet& now, std::size_t order,
               KnownGuards& known) {
  const bool bears =
      now.kind == SetKind::whole || now.kind == SetKind::line || now.kind == SetKind::half_space;
  const bool apex = before.kind == SetKind::cone || before.kind == SetKind::ray;
  if (apex && bears && order > 0) known.separation = {order, true};
  if (now.kind != SetKind::whole || order == 0 || before.kind == SetKind::whole) return;
  if (before.kind == SetKind::cone) known.slip_plus = known.slip_minus = {order, true};
  if (before.kind == SetKind::half_space)
    (side_of(before) > 0 ? known.slip_plus : known.slip_minus) = {order, true};
}

}  // namespace

RestingFeet::RestingFeet(const Model& model, std::vector<std::size_t> contacts)
    : model_(&model), contacts_(std::move(contacts)) {
  for (const std::size_t c : contacts_) {
    const Contact& contact = model.contacts[c];
    at_.push_back(static_cast<Eigen::Index>(rows_.size()));
    if (contact.normal_force_given()) {
      rows_.push_back(model.layout.tangent(c));
      sets_.push_back({SetKind::disc, 1, 0.0, 0.0, {}});
      continue;
    }
    rows_.push_back(model.layout.normal(c));
    if (contact.has_friction()) rows_.push_back(model.layout.tangent(c));
    sets_.push_back({SetKind::cone,
                     contact.has_friction() ? 2 : 1,
                     contact.has_friction() ? contact::static_friction(contact) : 0.0,
                     0.0,
                     {}});
  }
}

std::vector<base::ConvexSet> RestingFeet::sets_at(const motion::Forcing& forcing, double t) const {
  std::vector<base::ConvexSet> sets = sets_;
  for (std::size_t i = 0; i < sets.size(); ++i)
    if (sets[i].kind == SetKind::disc)
      sets[i].radius = limit_of(model_->contacts[contacts_[i]], contacts_[i], forcing, t, 0);
  return sets;
}

std::optional<RestingFeet> RestingFeet::make(const Model& model, const motion::StateSystem& system,
                                             const std::vector<std::size_t>& contacts) {
  RestingFeet feet(model, contacts);
  for (const linear::SharedForces& shared : system.factorised().shared) {
    std::vector<Eigen::Index> places;
    for (const std::size_t row : feet.rows_) {
      const auto found = std::find(shared.rows.begin(), shared.rows.end(), row);
      if (found != shared.rows.end()) places.push_back(found - shared.rows.begin());
    }
    if (places.size() != feet.rows_.size() || places.size() != shared.rows.size()) continue;
    feet.a_ = base::orthogonal_complement(shared.null(places, Eigen::all)).transpose();
    return feet;
  }
  return std::nullopt;
}

Eigen::VectorXd RestingFeet::forces(const std::vector<MotionJet>& jets, std::size_t order) const {
  Eigen::VectorXd x(static_cast<Eigen::Index>(rows_.size()));
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const ContactMotion& m = jets[contacts_[i]].motion[order];
    const Eigen::Index last = at_[i] + sets_[i].size - 1;
    if (sets_[i].kind == SetKind::cone) x[at_[i]] = -m.N;
    if (sets_[i].kind == SetKind::disc || sets_[i].size > 1) x[last] = -m.T;
  }
  return x;
}

/// Rounding of these derivatives of the forces, and their change within the resolution of time.
double RestingFeet::zero_force(const Instant& instant, const std::vector<MotionJet>& jets,
                               std::size_t order) const {
  double zero = 0.0;
  for (const std::size_t c : contacts_)
    zero = std::max({zero, jets[c].noise[order].N, jets[c].noise[order].T});
  zero *= instant.noise_factor;
  if (order + 1 < jets[contacts_.front()].motion.size())
    zero += instant.resolution * forces(jets, order + 1).norm();
  return zero;
}

bool RestingFeet::may_rest(const motion::Forcing& forcing, double t,
                           const std::vector<MotionJet>& jets) const {
  return base::least_norm(a_, a_ * forces(jets, 0), sets_at(forcing, t)).has_value();
}

/// True if the faces of the sets on which x lies leave A' y undetermined: as many feet as can be lie on edges.
bool RestingFeet::is_degenerate(const std::vector<base::ConvexSet>& sets, const Eigen::VectorXd& x,
                                double zero) const {
  const auto size = static_cast<Eigen::Index>(rows_.size());
  Eigen::MatrixXd face = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Eigen::Index at = at_[i], n = sets[i].size;
    const Eigen::VectorXd part = x.segment(at, n);
    if (sets[i].kind == SetKind::disc) {
      face(at, at) = std::abs(part[0]) < sets[i].radius - zero ? 1.0 : 0.0;
      continue;
    }
    if (part.norm() <= zero) continue;
    const bool inside = n == 1 || sets[i].friction * part[0] - std::abs(part[1]) > zero;
    face.block(at, at, n, n) = inside ? Eigen::MatrixXd::Identity(n, n)
                                      : Eigen::MatrixXd(part * part.transpose() / part.squaredNorm());
  }
  const Eigen::VectorXd values = base::singular_values(a_ * face * a_.transpose());
  return values.minCoeff() <= located_digits * values.maxCoeff();
}

/// The forces of least norm at an instant, with the multipliers just after it. Where multipliers are not unique, those
/// are taken that the first change of r leads to.
std::optional<base::LeastNorm> RestingFeet::at_instant(const std::vector<base::ConvexSet>& sets,
                                                       const std::vector<MotionJet>& jets,
                                                       const Eigen::VectorXd& noise, double& zero) const {
  const Eigen::VectorXd now = forces(jets, 0);
  auto least = base::least_norm_point(a_, a_ * now, sets);
  if (!least || !is_degenerate(sets, least->x, located_digits * now.norm())) return least;
  for (std::size_t order = 1; order < MotionJet::orders; ++order) {
    const Eigen::VectorXd change = forces(jets, order);
    if (change.norm() <= noise[static_cast<Eigen::Index>(order)]) continue;
    zero = rounding::many_operations / rounding::eps * located_digits;
    return base::least_norm_point(a_, a_ * (now + located_digits * now.norm() / change.norm() * change),
                                  sets);
  }
  return least;
}

/// Moves the critical cones of sliders at their limits by the derivative of the limit, of this order. Returns the norm of all
/// offsets; unit: force per time^order.
double RestingFeet::set_offsets(const motion::Forcing& forcing, double t, std::size_t order,
                                const std::vector<int>& sides, std::vector<base::ConvexSet>& sets) const {
  double squared = 0.0;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    if (sets_[i].kind != SetKind::disc || sides[i] == 0 || sets[i].kind == SetKind::whole) continue;
    const double rate = limit_of(model_->contacts[contacts_[i]], contacts_[i], forcing, t, order);
    sets[i].offset = Eigen::VectorXd::Constant(1, sides[i] * rate);
    squared += rate * rate;
  }
  return std::sqrt(squared);
}

bool RestingFeet::decide(const Instant& instant, const motion::Forcing& forcing,
                         const std::vector<MotionJet>& jets, contact::ContactStates& states,
                         std::vector<KnownGuards>& known) const {
  std::vector<base::ConvexSet> sets = sets_at(forcing, instant.t);
  std::vector<int> sides(contacts_.size(), 0);  // of feet at their limits: sign of k = -T
  for (const std::size_t c : contacts_) {
    known[c] = {};
    known[c].touches = model_->contacts[c].takes_impulses();
  }
  Eigen::VectorXd noises(static_cast<Eigen::Index>(MotionJet::orders));
  for (std::size_t order = 0; order < MotionJet::orders; ++order)
    noises[static_cast<Eigen::Index>(order)] = zero_force(instant, jets, order);
  for (std::size_t order = 0; order < MotionJet::orders; ++order) {
    const Eigen::VectorXd x = forces(jets, order);
    const double moved = order > 0 ? set_offsets(forcing, instant.t, order, sides, sets) : 0.0;
    const double noise = noises[static_cast<Eigen::Index>(order)];
    if (x.norm() <= noise && moved == 0.0) {  // no change by this derivative
      if (order == 0) leave_discs(noise, sets);
      continue;
    }
    double blur = 0.0;
    const auto least =
        order == 0 ? at_instant(sets, jets, noises, blur) : base::least_norm_point(a_, a_ * x, sets);
    if (!least) return false;
    const double size = std::max({least->multipliers.norm(), x.norm(), moved});
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      const std::size_t c = contacts_[i];
      const bool located = order == 0 && std::any_of(instant.triggered.begin(), instant.triggered.end(),
                                                     [&](const TriggeredGuard& f) { return f.contact == c; });
      const double zero = (noise / std::max(x.norm(), moved) + rounding::elimination + blur +
                           (located ? located_digits : 0.0)) *
                          size;
      const base::ConvexSet before = sets[i];
      const Eigen::VectorXd z = least->multipliers.segment(at_[i], before.size);
      sets[i] = base::critical_cone(before, z, zero);
      if (before.kind == SetKind::disc && sets[i].kind != SetKind::whole) sides[i] = z[0] > 0.0 ? 1 : -1;
      if (sets[i].kind == SetKind::line || sets[i].kind == SetKind::ray)
        sides[i] = sets[i].size > 1 && sets[i].direction[1] != 0.0 ? side_of(sets[i]) : 0;
      add_known(before, sets[i], order, known[c]);
    }
  }
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const std::size_t c = contacts_[i];
    states[c] = {state_of(model_->contacts[c], sets[i], sides[i]), 0.0};
    if (sets[i].kind == SetKind::half_space)  // at its limit, and no derivative leads away
      (side_of(sets[i]) > 0 ? known[c].slip_plus : known[c].slip_minus) = Known::at_limit();
    if (sets[i].kind == SetKind::ray || sets[i].kind == SetKind::cone) {
      known[c].separation = known[c].slip_plus = known[c].slip_minus = Known::at_limit();
    }
    known[c].closing = known[c].sliding = Known::at_limit();  // the others hold it
  }
  return true;
}

std::vector<RestingFeet::Release> RestingFeet::releases(const contact::ContactStates& states) const {
  const auto size = static_cast<Eigen::Index>(rows_.size());
  Eigen::MatrixXd face = Eigen::MatrixXd::Zero(size, size);  // D
  Eigen::VectorXd moves = Eigen::VectorXd::Ones(size);  // 0: force of a slider at its limit, which is given
  bool any = false;
  std::vector<int> side(contacts_.size(), 0);  // of an edge: sign of k = -T
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Eigen::Index at = at_[i], n = sets_[i].size;
    const ContactState& state = states[contacts_[i]];
    if (state.is_open()) {
      any = true;
      continue;
    }
    side[i] = -slip_sign(state.state);
    if (side[i] == 0) {
      face.block(at, at, n, n).setIdentity();
      continue;
    }
    any = true;
    if (sets_[i].kind == SetKind::disc) {
      moves[at] = 0.0;
      continue;
    }
    const Eigen::Vector2d edge = Eigen::Vector2d(1.0, side[i] * sets_[i].friction).normalized();
    face.block(at, at, n, n) = edge * edge.transpose();
  }
  if (!any) return {};
  const Eigen::MatrixXd spanned = a_ * face * a_.transpose();
  if (base::rank(spanned) < spanned.rows()) return {};  // the body moves
  const Eigen::MatrixXd z = a_.transpose() * base::solve_dense(spanned, a_ * moves.asDiagonal());
  std::vector<Release> result;
  const auto add = [&](std::size_t i, Guard guard, const Eigen::VectorXd& of_z) {
    Release release{{contacts_[i], guard}, Eigen::VectorXd::Zero(model_->force_count())};
    Eigen::VectorXd of_x = z.middleRows(at_[i], sets_[i].size).transpose() * of_z;
    if (sets_[i].kind == SetKind::disc) of_x[at_[i]] -= side[i];  // F = |k|
    for (std::size_t row = 0; row < rows_.size(); ++row)
      release.weights.data()[rows_[row]] = -of_x[static_cast<Eigen::Index>(row)];  // l = -N, k = -T
    result.push_back(std::move(release));
  };
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const double f = sets_[i].friction;
    if (side[i] != 0 && sets_[i].kind == SetKind::disc)
      add(i, Guard::sliding, Eigen::VectorXd::Constant(1, side[i]));
    else if (side[i] != 0)
      add(i, Guard::sliding, Eigen::Vector2d(-f, side[i]));
    if (!states[contacts_[i]].is_open()) continue;
    if (sets_[i].size == 1) add(i, Guard::closing, Eigen::VectorXd::Constant(1, -1.0));
    if (sets_[i].size > 1)
      for (const double s : {1.0, -1.0}) add(i, Guard::closing, Eigen::Vector2d(-1.0, -s * f));
  }
  return result;
}

bool is_held_at_zero_gap(const motion::StateSystems& systems, std::size_t c,
                         const contact::ContactStates& states, const Vector& u) {
  if (!systems.may_share(c)) return false;
  const Model& model = systems.model();
  const Contact& contact = model.contacts[c];
  const double size = std::abs(contact.gap) + contact.normal.magnitude(u) + model.scales.displacement;
  return std::abs(contact.gap_at(u)) <= rounding::many_operations * size &&
         systems.gap_held_by_others(c, states);
}

std::optional<RestingFeet> find_resting_feet(motion::StateSystems& systems, const motion::Forcing& forcing,
                                             double t, const std::vector<std::size_t>& feet,
                                             contact::ContactStates states) {
  const Model& model = systems.model();
  if (feet.size() < 2) return std::nullopt;
  for (const std::size_t c : feet)
    if (model.contacts[c].normal_force_given() && model.contacts[c].friction.is_load_dependent())
      return std::nullopt;  // the rate of its limit is not linear in that of its compression
  for (const std::size_t c : feet) states[c] = {contact::state_at_rest(model.contacts[c]), 0.0};
  const motion::StateSystemPtr system = systems.system_of(states);
  if (!system) return std::nullopt;
  for (const std::size_t c : feet)
    if (model.contacts[c].has_friction() && !systems.holds_as_one(c, *system, forcing, t))
      return std::nullopt;
  return RestingFeet::make(model, *system, feet);
}

std::vector<RestingFeet::Release> releases(motion::StateSystems& systems, const motion::Forcing& forcing,
                                           double t, const contact::ContactStates& states, const Vector& u) {
  const Model& model = systems.model();
  std::vector<RestingFeet::Release> result;
  for (const std::vector<std::size_t>& group : systems.sharing()) {
    std::vector<std::size_t> feet;
    bool at_faces = false;
    for (const std::size_t c : group) {
      const bool slider = model.contacts[c].normal_force_given();
      if (states[c].is_open() && (slider || !is_held_at_zero_gap(systems, c, states, u))) continue;
      feet.push_back(c);
      at_faces = at_faces || states[c].is_open() || slip_sign(states[c].state) != 0;
    }
    if (!at_faces) continue;
    const auto resting = find_resting_feet(systems, forcing, t, feet, states);
    if (!resting) continue;
    for (RestingFeet::Release& release : resting->releases(states)) result.push_back(std::move(release));
  }
  return result;
}

}  // namespace signorini::decide
