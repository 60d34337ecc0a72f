// guard_signs.hpp: which guards of a mode fail just after an instant.
//
//   g, g', g'', ...  lexicographically not negative, each entry zero within its rounding
//
// A derivative also counts as zero when the next one would undo it within the resolution of the clock. What a
// decision has set to zero is zero, whatever an elimination has left of it.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "base/shared_vector.hpp"
#include "decide/instant.hpp"
#include "motion/jet.hpp"

namespace signorini {

/// What a decision knows of a guard: derivatives below `zeros` vanish, and whether the next one is positive.
struct Known {
  std::size_t zeros = 0;
  bool rises = false;

  /// Zero to the last known derivative: no rounding of it tells more.
  [[nodiscard]] static Known at_limit() { return {MotionJet::orders, false}; }
};

/// Of the guards of one contact that is decided together with others.
struct KnownGuards {
  bool touches = false;  ///< g = 0
  Known closing, separation, slip_plus, slip_minus, sliding;

  /// What holds whatever the states are: g, g' and the slip rate that were set to zero.
  [[nodiscard]] KnownGuards of_motion() const {
    KnownGuards result;
    result.touches = touches;
    result.closing.zeros = std::min<std::size_t>(closing.zeros, 2);
    result.sliding.zeros = std::min<std::size_t>(sliding.zeros, 1);
    return result;
  }
  [[nodiscard]] Known of(Guard guard) const {
    switch (guard) {
      case Guard::closing:
        return closing;
      case Guard::separation:
        return separation;
      case Guard::slip_plus:
        return slip_plus;
      case Guard::slip_minus:
        return slip_minus;
      case Guard::sliding:
        return sliding;
      case Guard::none:
      case Guard::clearing:
      case Guard::own_1:
      case Guard::own_2:
      case Guard::own_3:
        break;
    }
    return {};
  }
};

struct Sign {
  int sign = 0;         // -1, 0, +1
  int order = 0;        // of the derivative that decides; past the last one when all vanish
  double excess = 0.0;  // that derivative's magnitude over what counts as zero
};

/// so_far, the motion of the contact up to the instant, where the guard has rested and has not risen since; else null. Of
/// the slip rate of a state that slips, p' = -(fs |N| - T)' / kt: where the limit has rested that it left.
[[nodiscard]] const MotionJet* rested(const Contact& contact, std::size_t c, const ContactState& state,
                                      const GuardForm& guard, const MotionJet& so_far,
                                      const Instant& instant);
/// Sign of the first derivative of the form, from `first` on, that is not zero to working precision.
/// base: a motion in which the form is zero, whatever rounding has left of it; what counts is the difference.
[[nodiscard]] Sign sign_after(const GuardForm& form, const MotionJet& jet, const Instant& instant,
                              std::size_t first, const MotionJet* base = nullptr);
[[nodiscard]] bool starts_at_zero(const GuardForm& form, const MotionJet& jet, const Instant& instant);
/// How many times its rounding must be forgiven for the form not to be lexicographically negative; 0: none.
[[nodiscard]] double forgiveness(const GuardForm& form, const MotionJet& jet, const Instant& instant,
                                 std::size_t first);
/// Sign of a guard of which something is known: one that rises is only asked whether it clearly does not.
[[nodiscard]] Sign sign_of_guard(const GuardForm& form, const MotionJet& jet, const Instant& instant,
                                 const Known& known, const MotionJet* base = nullptr);

using GuardsOfState = std::array<GuardForm, guards_per_contact>;

/// Do the noises of the first `orders` orders tell all that a decision asks of a contact that is decided alone: the signs
/// of its guards, of which something may be known, though zeros be blurred `most_blur` times?
[[nodiscard]] bool told_by(const GuardsOfState& guards, std::size_t c, const MotionJet& jet,
                           std::size_t orders, const Instant& instant, const KnownGuards& known,
                           double most_blur);

/// The guards of every contact; whoever keeps them shares those of contacts whose states have not changed since.
using GuardForms = SharedVector<GuardsOfState>;

/// Guards of contacts in the states that they were last asked for in: most have not changed since.
class GuardsInForce {
 public:
  /// Must outlive it.
  explicit GuardsInForce(const Model& model)
      : model_(model), states_(model.contacts.size()), forms_(model.contacts.size()) {}
  [[nodiscard]] const GuardsOfState& of(std::size_t contact, const ContactState& state);
  /// All, as they were last asked for.
  [[nodiscard]] const GuardForms& all() const { return forms_; }

 private:
  const Model& model_;
  std::vector<std::optional<ContactState>> states_;  // nothing: never asked for
  GuardForms forms_;
};

struct Failure {
  std::size_t contact = 0;
  Guard guard = Guard::none;
  GuardForm form = {};
  Sign sign = {};
};

/// The guard that fails soonest of each contact of which one fails. before: the mode is that of the motion
/// up to the instant, so what the engine located is zero. known: one a contact. so_far: the motion up to the
/// instant, one a contact, needed where limits have rested. asked: contacts that may fail, ascending.
[[nodiscard]] std::vector<Failure> failures(const Model& model, const std::vector<MotionJet>& jets,
                                            const Mode& mode, const Instant& instant, bool before,
                                            const std::vector<KnownGuards>& known,
                                            const std::vector<MotionJet>& so_far,
                                            const std::vector<std::size_t>& asked);

}  // namespace signorini
