// decision.hpp: result of a decision: states, motion and guards just after an instant, with their rounding errors.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "decide/guard_signs.hpp"
#include "decide/impact.hpp"
#include "motion/jet.hpp"
#include "signorini/trace.hpp"

namespace signorini::decide {

/// Properties of a guard just after the decision.
struct GuardStart {
  Guard kind = Guard::none;
  bool at_zero = false;   ///< true: the guard is zero just after the decision
  int leading_order = 0;  ///< order of the first nonzero derivative; -1: no derivative is known to be nonzero
  /// Rounding error of the guard's value. Not less than the value itself if the decision treated the value as zero.
  double noise = 0.0;
  /// Rounding errors of the second and third derivatives; used only if leading_order < 0.
  std::array<double, 2> derivative_noise{};

  /// Bound of the value that rounding errors give a guard after a time h, if all derivatives of the guard are zero: for
  /// example, the computed gap of a body at rest next to a wall drifts. 0 if the bound overflows.
  [[nodiscard]] double drift(double h) const {
    const double far = h * h * (derivative_noise[0] / 2.0 + h * derivative_noise[1] / 6.0);
    return std::isfinite(far) ? far : 0.0;
  }
};

/// A guard whose failure changed the state of a contact.
struct Crossing {
  GuardForm form;
  /// g', g'', ... just before the instant, in the old states.
  std::array<double, MotionJet::orders - 1> derivatives{};
  double noise = 0.0;  ///< rounding error of the guard's value
};

/// A contact that sticks from an instant on, although rounding errors hide whether it sticks or slips.
struct ContactAtLimit {
  std::size_t contact = 0;
  double margin = 0.0;  ///< computed friction limit minus |T|; force
  double noise = 0.0;   ///< rounding error of `margin`
};

struct Decision {
  bool consistent = false;
  Refusal refusal;  ///< reason if no states are consistent
  contact::ContactStates states;
  motion::StateSystemPtr system;  ///< system of equations in `states`, for the engine
  Vector u, v;
  motion::Jet jet;
  std::vector<ContactMotion> before, after;  ///< one entry per contact
  std::vector<motion::BodySlide> slides_before, slides_after;
  ForceLayout layout;              ///< layout of forces and guards
  std::vector<GuardStart> guards;  ///< one entry for each slot of `layout`
  /// Guards in the new states, one entry per contact; unused entries have the kind Guard::none.
  GuardForms forms;
  std::map<std::size_t, Crossing> crossings;  ///< guards that changed the states of contacts, by contact
  /// True for contacts that changed state during the decision, one entry per contact.
  std::vector<bool> visited;
  std::vector<bool> jumped;  ///< true for contacts whose N or T jumps, one entry per contact
  /// Contacts from which massless parts separated instantaneously (massless_jump.hpp).
  std::vector<std::size_t> released;
  std::vector<Impulse> impulses;  ///< one entry per contact if rigid contacts were hit; otherwise empty
  /// Impulses of each single impact, in the order of the impacts. `impulses` contains their sums.
  std::vector<SingleImpact> single_impacts;
  std::vector<double> departures;    ///< see ImpactResult::departures
  double impact_loss = 0.0;          ///< energy that the impacts dissipate
  double impact_surface_work = 0.0;  ///< work of moving surfaces in the impacts
  bool impact_gains_energy = false;  ///< true: an impact gained energy (Newton's law with friction)
  /// True if rounding errors did not allow a unique decision: the states with the smallest violation were taken, or a contact
  /// stays at rest at its friction limit.
  bool undecided = false;
  /// Contacts that rest at their friction limit.
  std::vector<ContactAtLimit> at_limit;
  /// True if a flight faster than capture_velocity was replaced: by rest, because the flight is too short for the resolution of
  /// time; or by a closed contact, because the flight is lower than the rounding error of the gap.
  bool unresolved = false;
  /// Largest violation of a guard in the accepted states, as a multiple of the rounding error.
  double tolerated_violation = 0.0;
  int rounds = 0;
  /// Impulses along n and t, in the order of forces, in addition to those of impacts. They stop contacts that stay closed,
  /// and set to zero velocities that are only rounding or integration errors. Empty: none.
  Eigen::VectorXd capture_impulses = {};

  /// Guard in the new states. slot: index of the guard (signorini/force_layout.hpp).
  [[nodiscard]] const GuardForm& guard(std::size_t slot) const {
    return forms[layout.contact_of_guard(slot)][layout.guard_within(slot)];
  }
  /// Form of a linear guard.
  [[nodiscard]] const Form& form(std::size_t slot) const { return guard(slot).form; }
  /// Crossing of a contact's guard; nullptr: no guard failed, or the guard did not reach zero continuously.
  [[nodiscard]] const Crossing* crossing(std::size_t contact) const {
    const auto found = crossings.find(contact);
    return found != crossings.end() ? &found->second : nullptr;
  }
};

/// Friction limits that are zero with all known derivatives after the decision: Instant::resting_limits of the next decision,
/// unless one of them fails before.
[[nodiscard]] std::vector<TriggeredGuard> find_resting_limits(const Decision& decision);

}  // namespace signorini::decide
