#include "motion/near_jets.hpp"

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "motion/term_size.hpp"

namespace signorini {
namespace {

/// Each order spreads what is done by one more element, by M^-1 and by K.
constexpr int spread = 2 * (Jet::orders + 1);
/// So many contacts are looked at near, one by one; more of them take the whole structure. Chosen.
constexpr std::size_t most_open = 6;

/// Has some guard an acceleration, of which order 1 is not known here?
bool accelerates(const Contact& contact, const ContactState& state) {
  for (const GuardForm& guard : guards(contact, state))
    if (guard.kind != Guard::none && (guard.form.an != 0.0 || guard.form.at != 0.0)) return true;
  return false;
}

/// What the rest does to it at order 0.
Vector from_outside(const Neighbourhood& near, const Point& now) {
  Vector P = Vector::Zero(near.model.size());
  for (const Neighbourhood::Tie& tie : near.ties)
    P[tie.at] -= tie.m * now.a[tie.dof] + tie.c * now.v[tie.dof] + tie.k * now.u[tie.dof];
  for (const Neighbourhood::Pull& pull : near.pulls)
    P[pull.at] -= pull.factor * now.forces[static_cast<Eigen::Index>(pull.force)];
  return P;
}

}  // namespace

NearJets::NearJets(ModeSystems& systems, int least)
    : model_(systems.model()),
      possible_(model_.size() >= least && follows_from_motion(model_)),
      taylor_(systems) {
  if (possible_) near_.emplace(systems, spread);
}

/// The rate of the motion but for g''' and ut'''. Forces by their own rows.
void NearJets::order_one(const ModeSystem& system, const Forcing& forcing, std::size_t contact,
                         MotionJet& result) const {
  const Rows& rows = system.rows()[contact];
  const ContactMotion& m = result.motion[0];
  ContactMotion& d = result.motion[1] = {};
  d.gap = m.vn;
  d.ut = m.vt;
  d.vn = m.an;
  d.vt = m.at;
  d.pressing = m.pressing_rate;
  d.pressing_rate = forcing.pressing(contact, series_.t, 2);
  d.N = -rows.normal.rate(d) / rows.normal.N;
  d.T = -rows.tangent.rate(d) / rows.tangent.T;
}

/// At most the noise of motion/jet.cpp: there the terms count once, and |x - y| as often as they are disturbed: places and
/// velocities as data, N in its row besides, T in its own row and through N. The rounding of x and y themselves is less than
/// one time more.
void NearJets::bound_rounding(const ModeSystem& system, const Forcing& forcing, const Point& now,
                              std::size_t contact, MotionJet& result) const {
  const Contact& c = model_.contacts[contact];
  const Rows& rows = system.rows()[contact];
  const ContactMotion& m = result.motion[0];
  ContactMotion terms, &d = result.noise[0] = {};
  terms.gap = size_of(model_, c.normal, now.u) + std::abs(c.gap);
  terms.ut = size_of(model_, c.tangent, now.u) + std::abs(forcing.surface(contact, series_.t, 0));
  terms.vn = size_of(model_, c.normal, now.v);
  terms.vt = size_of(model_, c.tangent, now.v) + std::abs(forcing.surface(contact, series_.t, 1));
  terms.pressing = std::abs(m.pressing);
  terms.pressing_rate = std::abs(m.pressing_rate);
  constexpr double once = rounding::of_many;
  terms.N = rows.normal.magnitude(terms) + std::abs(rows.normal.constant) + std::abs(m.N);
  terms.T = rows.tangent.magnitude(terms) + std::abs(rows.tangent.constant) + std::abs(m.T);
  d.N = 4.0 * once * terms.N;
  d.T = 5.0 * once * terms.T;
  d.gap = 3.0 * once * terms.gap;
  d.ut = 3.0 * once * terms.ut;
  d.vn = 3.0 * once * terms.vn;
  d.vt = 3.0 * once * terms.vt + forcing.surface_rounding(contact, series_.t);
  d.pressing = once * terms.pressing;
  d.pressing_rate = once * terms.pressing_rate;
}

/// False: it is not told here.
bool NearJets::look_near(const ModeSystemPtr& system, const Forcing& forcing, const Point& now,
                         std::size_t contact, const JetMaker::Told& told, MotionJet& motion) {
  Neighbourhood* near = near_->around(contact, *system);
  if (near == nullptr) {
    possible_ = !near_->hopeless();
    return false;
  }
  const ModeSystemPtr own = near->systems.of(near->mode_of(system->mode()));
  if (!own) return false;
  const auto at = static_cast<std::size_t>(
      std::lower_bound(near->contacts.begin(), near->contacts.end(), contact) - near->contacts.begin());
  while (work_.size() < near_->size()) work_.emplace_back();
  std::unique_ptr<Work>& work = work_[near->number];
  if (!work) work = std::make_unique<Work>(near->systems);
  const Vector outside = from_outside(*near, now);
  const auto with = [&](const Vector& more) {
    return forcing.on_part(near->model, near->dofs, near->loads, near->contacts, more);
  };
  const Forcing given = with(outside), alone = with(Vector::Zero(outside.size()));
  bool is_told = false;
  (void)work->jets.make(
      own, given, series_.t, now.u(near->dofs), now.v(near->dofs), work->motions,
      [&](std::size_t c, const MotionJet& jet, std::size_t orders) {
        if (c != at) return true;
        const bool enough = told(contact, jet, orders);
        is_told = enough && orders < MotionJet::orders;
        return enough;
      },
      &alone);
  motion = work->motions[at];
  return is_told;
}

/// Order 0 told it, and tells the same to the last bit: forces follow from its own rows, places and velocities.
bool NearJets::stays(std::size_t contact, const Jet& jet, const Beside& beside) const {
  if (jet.system->mode()[contact] != beside.jet.system->mode()[contact] ||
      std::binary_search(beside.open.begin(), beside.open.end(), contact))
    return false;
  const auto same = [&](const auto& term) { return jet.u(term.first, 2) == beside.jet.u(term.first, 2); };
  const Contact& c = model_.contacts[contact];
  return std::all_of(c.normal.terms.begin(), c.normal.terms.end(), same) &&
         std::all_of(c.tangent.terms.begin(), c.tangent.terms.end(), same);
}

std::optional<NearJets::Made> NearJets::make(const ModeSystemPtr& system, const Forcing& forcing, double t,
                                             const Vector& u, const Vector& v,
                                             std::vector<MotionJet>& motions, const JetMaker::Told& told,
                                             const std::optional<Beside>& beside) {
  if (!possible_ || !system->factorised().by_mass) return std::nullopt;
  taylor_.begin(system, forcing, t, u, v, 0, 1.0, series_);
  taylor_.extend(forcing, 0, series_);
  const std::size_t count = model_.contacts.size();
  Jet jet{t, series_.u, Eigen::MatrixXd(series_.forces.rows(), 2), system};
  jet.u.col(2) *= 2.0;
  jet.forces.col(0) = series_.forces.col(0);
  const Point now{u, v, jet.forces.col(0), jet.u.col(2)};
  motions.resize(count);
  std::vector<std::size_t> open;
  for (std::size_t c = 0; c < count; ++c) {
    MotionJet& motion = motions[c];
    const bool known = beside && stays(c, jet, *beside);
    if (!known) {
      motion.motion[0] = motion_of(model_.contacts[c], c, forcing, t, now);
      order_one(*system, forcing, c, motion);
      bound_rounding(*system, forcing, now, c, motion);
    }
    jet.forces(static_cast<Eigen::Index>(normal_slot(c)), 1) = motion.motion[1].N;
    jet.forces(static_cast<Eigen::Index>(tangent_slot(c)), 1) = motion.motion[1].T;
    if (known || (!accelerates(model_.contacts[c], system->mode()[c]) && told(c, motion, 1))) continue;
    open.push_back(c);
    if (open.size() > most_open) return std::nullopt;
  }
  for (const std::size_t c : open)
    if (!look_near(system, forcing, now, c, told, motions[c])) return std::nullopt;
  return Made{std::move(jet), std::move(open)};
}

}  // namespace signorini
