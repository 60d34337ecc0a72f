#include "decide/massless_jump.hpp"

#include <algorithm>

#include "contact/work.hpp"
#include "motion/state_systems.hpp"

namespace signorini::decide {
namespace {

/// Position x on the path at which the gap of the failing contact closes; nullopt: the gap does not close on the path.
std::optional<double> closing_position(const Model& model, const MasslessPath& way, const FailedGuard& f) {
  if (f.guard != Guard::closing || f.sign.order > 0) return std::nullopt;
  const Contact& contact = model.contacts[f.contact];
  const double from = contact.gap_at(way.from), to = contact.gap_at(way.to);
  if (!(to < 0.0 && to < from)) return std::nullopt;
  return from > 0.0 ? from / (from - to) : 0.0;
}

}  // namespace

std::optional<PathTouch> first_touch(const Model& model, const MasslessPath& way,
                                     std::vector<FailedGuard>& failed) {
  std::optional<PathTouch> first;
  for (const FailedGuard& f : failed)
    if (const auto x = closing_position(model, way, f); x && (!first || *x < first->fraction))
      first = PathTouch{f.contact, *x, 0.0};
  if (!first) return std::nullopt;
  std::erase_if(failed, [&](const FailedGuard& f) {
    return f.contact != first->contact && closing_position(model, way, f);
  });
  const Vector all = way.to - way.from;
  first->ut = model.contacts[first->contact].tangent.dot(all) * (first->fraction - 1.0);
  return first;
}

void defer_slip_failures(const Model& model, std::vector<FailedGuard>& failed) {
  const auto carried = [&](const FailedGuard& f) {
    const Contact& c = model.contacts[f.contact];
    return !c.takes_impulses() && !c.sticks_rigidly() && acts_on_massless(model, c);
  };
  const bool on_the_way = std::any_of(failed.begin(), failed.end(), [&](const FailedGuard& f) {
    return f.guard != Guard::sliding && f.sign.order == 0 && carried(f);
  });
  if (on_the_way)
    std::erase_if(failed, [&](const FailedGuard& f) { return f.guard == Guard::sliding && carried(f); });
}

bool stops_on_path(const Contact& contact, const FailedGuard& failure, State slip, const MasslessPath& way,
                   double noise) {
  if (failure.guard != Guard::sliding || !contact::slides_instantaneously(contact)) return false;
  return slip_sign(slip) * (contact.tangent.dot(way.to) - contact.tangent.dot(way.from)) > 2.0 * noise;
}

bool acts_on_massless(const Model& model, const Contact& contact) {
  const auto massless = [&](const Combination& form) {
    return std::any_of(form.terms.begin(), form.terms.end(), [&](const auto& term) {
      return model.dofs[static_cast<std::size_t>(term.first)].massless;
    });
  };
  return massless(contact.normal) || massless(contact.tangent);
}

std::optional<Vector> released(motion::StateSystems& systems, motion::JetMaker& jets,
                               const motion::Forcing& forcing, const Instant& instant,
                               contact::ContactStates states, std::size_t c) {
  const Model& model = systems.model();
  const Contact& contact = model.contacts[c];
  if (!contact.is_elastic_along_normal() || !acts_on_massless(model, contact)) return std::nullopt;
  states[c] = {State::open, 0.0};
  const motion::StateSystemPtr system = systems.system_of(states);
  if (!system) return std::nullopt;
  Vector u = instant.u, v = instant.v;
  motion::project_constraints(model, *system, forcing, instant.t, u, v);
  std::vector<MotionJet> motions;
  const motion::Jet jet = jets.make(system, forcing, instant.t, u, v, motions);
  u = jet.u.col(0);
  if (!(contact.gap_at(u) > contact.gap_at(instant.u))) return std::nullopt;
  return u;
}

}  // namespace signorini::decide
