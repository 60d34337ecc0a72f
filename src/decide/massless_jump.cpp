#include "decide/massless_jump.hpp"

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"
#include "contact/work.hpp"
#include "motion/state_systems.hpp"

namespace signorini::decide {
namespace {

/// Position x on the path at which a gap closes, and its rounding error.
struct Closing {
  double position = 0.0, noise = 0.0;
};

/// nullopt: the gap of the failing contact does not close on the path.
std::optional<Closing> closing_of(const Model& model, const MasslessPath& way, const FailedGuard& f) {
  if (f.guard != Guard::closing || f.sign.order > 0) return std::nullopt;
  const Contact& contact = model.contacts[f.contact];
  const double from = contact.gap_at(way.from), to = contact.gap_at(way.to);
  if (!(to < 0.0 && to < from)) return std::nullopt;
  if (!(from > 0.0)) return Closing{};
  const double terms =
      std::abs(contact.gap) + contact.normal.magnitude(way.from) + contact.normal.magnitude(way.to);
  return Closing{from / (from - to), rounding::many_operations * terms / (from - to)};
}

/// True if the contact closes at the first position. Contacts that touch from the beginning close one after the other: their
/// place does not depend on the path.
bool closes_with(const Closing& first, const Closing& other) {
  return first.position > 0.0 && other.position - first.position <= first.noise + other.noise;
}

}  // namespace

const PathTouch::Landing* PathTouch::of(std::size_t contact) const {
  const auto found = std::find_if(landings.begin(), landings.end(),
                                  [&](const Landing& landing) { return landing.contact == contact; });
  return found == landings.end() ? nullptr : &*found;
}

std::optional<PathTouch> first_touch(const Model& model, const MasslessPath& way,
                                     std::vector<FailedGuard>& failed) {
  std::optional<Closing> first;
  std::size_t contact = 0;
  for (const FailedGuard& f : failed)
    if (const auto closing = closing_of(model, way, f);
        closing && (!first || closing->position < first->position)) {
      first = closing;
      contact = f.contact;
    }
  if (!first) return std::nullopt;
  PathTouch touch{first->position, {}};
  const Vector all = way.to - way.from;
  std::erase_if(failed, [&](const FailedGuard& f) {
    const auto closing = closing_of(model, way, f);
    if (!closing) return false;
    if (f.contact != contact && !closes_with(*first, *closing)) return true;
    touch.landings.push_back(
        {f.contact, model.contacts[f.contact].tangent.dot(all) * (first->position - 1.0)});
    return false;
  });
  return touch;
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
