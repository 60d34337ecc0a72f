// decision.hpp: what comes after an instant: states, motion, and how sharply they are known.
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

namespace signorini {

/// How one guard starts that is in force after the decision.
struct GuardStart {
  Guard kind = Guard::none;
  bool at_zero = false;  ///< starts at zero and rises
  int leading = 0;       ///< order of its first derivative that is not zero; -1: none is known
  double noise = 0.0;    ///< rounding of its value at the start; no less than what was taken for zero
  std::array<double, 2> loose{};  ///< leading < 0: rounding of its second and third derivative

  /// How far rounding of what nothing tells may have taken it after a time h: a body at rest beside a wall drifts.
  /// Beyond the range of numbers nothing does.
  [[nodiscard]] double drift(double h) const {
    const double far = h * h * (loose[0] / 2.0 + h * loose[1] / 6.0);
    return std::isfinite(far) ? far : 0.0;
  }
};

/// The guard whose failure changed a contact's state.
struct Crossing {
  GuardForm form;
  std::array<double, MotionJet::orders - 1> derivatives{};  ///< g', g'', ... just before, in the old mode
  double noise = 0.0;                                       ///< rounding of its value
};

/// A contact that sticks from an instant on, where rounding cannot tell whether it does.
struct AtLimit {
  std::size_t contact = 0;
  double below = 0.0;  ///< the limit of friction less |T|, as computed; force
  double noise = 0.0;  ///< rounding of that
};

struct Decision {
  bool consistent = false;
  Refusal refusal;  ///< why not
  Mode mode;
  ModeSystemPtr system;  ///< of `mode`; engines go on with it
  Vector u, v;
  Jet jet;
  std::vector<ContactMotion> before, after;  ///< one a contact
  std::vector<BodySlide> slides_before, slides_after;
  std::vector<GuardStart> guards;             ///< guards_per_contact a contact
  GuardForms forms;                           ///< of these, and of those that are none
  std::map<std::size_t, Crossing> crossings;  ///< of contacts visited
  std::vector<bool> visited;                  ///< contacts that changed state in between, one a contact
  std::vector<bool> jumped;                   ///< contacts whose N or T jumps
  std::vector<std::size_t> released;          ///< contacts that parts without mass left at once (release.hpp)
  std::vector<Impulse> impulses;              ///< one a contact, where rigid contacts were hit; else empty
  std::vector<Blow> blows;                    ///< those that the impulses are the sums of, turn by turn
  std::vector<double> departures;             ///< Findings::departures
  double impact_loss = 0.0;                   ///< energy that the impacts dissipate
  double impact_surface_work = 0.0;           ///< that moving surfaces do in them
  bool impact_gains = false;                  ///< an impact gained energy (Newton's law with friction)
  /// Rounding could not tell: the states that fail least were taken, or rest goes on at the limit of
  /// friction.
  bool undecided = false;
  /// Those that rest there, or whose friction drops to the kinetic one if they do not.
  std::vector<AtLimit> at_limit;
  /// A flight faster than capture_velocity was taken as rest, since the clock does not resolve it, or as landed, since
  /// it is lower than the rounding of its data.
  bool unresolved = false;
  double forgiven = 0.0;  ///< by how many of their roundings those states fail
  int rounds = 0;
  /// Impulses along n and t, slots as those of forces, that no law of impact knows: what stays is set to rest, and what
  /// rounding and tolerances have left of velocities that are zero is taken out. Empty: none.
  Eigen::VectorXd captures = {};

  /// In force.
  [[nodiscard]] const GuardForm& guard(std::size_t slot) const {
    return forms[contact_of_guard(slot)][guard_within(slot)];
  }
  /// Of a guard that is linear.
  [[nodiscard]] const Form& form(std::size_t slot) const { return guard(slot).form; }
  /// Null: no guard of the contact failed, or it did not fall.
  [[nodiscard]] const Crossing* crossing(std::size_t contact) const {
    const auto found = crossings.find(contact);
    return found != crossings.end() ? &found->second : nullptr;
  }
};

}  // namespace signorini
