// decision.hpp: result of a decision: states and motion after an instant, and their accuracy.
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

/// Value of a guard just after the decision.
struct GuardStart {
  Guard kind = Guard::none;
  bool at_zero = false;   ///< starts at zero and rises
  int leading_order = 0;  ///< order of its first nonzero derivative; -1: none is known
  double noise = 0.0;     ///< rounding of its value at the start; at least the value that was taken as zero
  /// leading_order < 0: rounding of its second and third derivatives.
  std::array<double, 2> derivative_noise{};

  /// Possible drift by rounding after a time h, if all derivatives of the guard are zero: the computed gap of
  /// a body at rest next to a wall drifts. 0 if the drift is beyond the range of numbers.
  [[nodiscard]] double drift(double h) const {
    const double far = h * h * (derivative_noise[0] / 2.0 + h * derivative_noise[1] / 6.0);
    return std::isfinite(far) ? far : 0.0;
  }
};

/// The guard whose failure changed a contact's state.
struct Crossing {
  GuardForm form;
  std::array<double, MotionJet::orders - 1> derivatives{};  ///< g', g'', ... just before, in the old states
  double noise = 0.0;                                       ///< rounding of its value
};

/// A contact that sticks from an instant on, while rounding leaves open whether it slips.
struct ContactAtLimit {
  std::size_t contact = 0;
  double margin = 0.0;  ///< limit of friction minus |T|, as computed; force
  double noise = 0.0;   ///< rounding of that difference
};

struct Decision {
  bool consistent = false;
  Refusal refusal;  ///< reason if there are no consistent states
  contact::ContactStates states;
  motion::StateSystemPtr system;  ///< system of `states`; engines continue with it
  Vector u, v;
  motion::Jet jet;
  std::vector<ContactMotion> before, after;  ///< one entry per contact
  std::vector<motion::BodySlide> slides_before, slides_after;
  ForceLayout layout;                         ///< of forces and guards
  std::vector<GuardStart> guards;             ///< one entry for each slot of `layout`
  GuardForms forms;                           ///< forms of these guards, including absent ones
  std::map<std::size_t, Crossing> crossings;  ///< of visited contacts
  std::vector<bool> visited;  ///< contacts that changed state during the decision, one entry per contact
  std::vector<bool> jumped;   ///< contacts whose N or T jumps
  std::vector<std::size_t>
      released;                   ///< contacts that massless parts left instantaneously (massless_jump.hpp)
  std::vector<Impulse> impulses;  ///< one entry per contact if rigid contacts were hit; otherwise empty
  std::vector<SingleImpact> single_impacts;  ///< terms of the sums `impulses`, in the order of the impacts
  std::vector<double> departures;            ///< ImpactResult::departures
  double impact_loss = 0.0;                  ///< energy that the impacts dissipate
  double impact_surface_work = 0.0;          ///< work of moving surfaces in the impacts
  bool impact_gains = false;                 ///< an impact gained energy (Newton's law with friction)
  /// True if rounding left the decision open: the states with the smallest violation were taken, or rest continues at
  /// the limit of friction.
  bool undecided = false;
  /// Contacts that rest at their friction limit, or whose friction drops to the kinetic value if they do not.
  std::vector<ContactAtLimit> at_limit;
  /// True if a flight faster than capture_velocity was taken as rest because the clock does not resolve it, or as
  /// landed because it is lower than the rounding of its data.
  bool unresolved = false;
  double tolerated_violation = 0.0;  ///< largest violation of their guards, in multiples of the rounding
  int rounds = 0;
  /// Impulses along n and t, indexed like forces, that do not belong to an impact. They stop contacts that
  /// stay closed, and remove velocities that are rounding or errors within tolerances. Empty: none.
  Eigen::VectorXd capture_impulses = {};

  /// Guard in the new states. slot: index of a guard (contact/contact_states.hpp).
  [[nodiscard]] const GuardForm& guard(std::size_t slot) const {
    return forms[layout.contact_of_guard(slot)][layout.guard_within(slot)];
  }
  /// Form of a linear guard.
  [[nodiscard]] const Form& form(std::size_t slot) const { return guard(slot).form; }
  /// Crossing of a contact's guard; null: no guard failed, or it did not reach zero continuously.
  [[nodiscard]] const Crossing* crossing(std::size_t contact) const {
    const auto found = crossings.find(contact);
    return found != crossings.end() ? &found->second : nullptr;
  }
};

/// Friction limits that are zero with all their derivatives after the decision: the list
/// Instant::resting_limits of the next one, as long as none of them fails.
[[nodiscard]] std::vector<TriggeredGuard> find_resting_limits(const Decision& decision);

}  // namespace signorini::decide
