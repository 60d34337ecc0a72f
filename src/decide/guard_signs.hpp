// guard_signs.hpp: finds the guards of contact states that fail just after an instant.
//
//   g, g', g'', ...  lexicographically nonnegative; an entry is zero if it is within its rounding error
//
// A derivative is also treated as zero if the next derivative would compensate it within the resolution of time. A quantity
// that a decision has set to zero is treated as zero, although it may contain rounding errors of an elimination.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "base/containers.hpp"
#include "decide/instant.hpp"
#include "motion/jet.hpp"
#include "signorini/form.hpp"

namespace signorini::decide {

// Fast evaluation of forms with at most six terms; most forms have no other terms.
//
//   f = c + N N + T T + gap g + ut ut + vn g' + vt ut'        other terms of the form are zero
//
// For finite motions the values agree with Form to the last bit, because omitting zero terms does not change a sum.

/// True if all terms of the form other than c, N, T, gap, ut, vn and vt are zero.
[[nodiscard]] inline bool is_plain(const Form& f) {
  return f.an == 0.0 && f.at == 0.0 && f.applied_normal_force == 0.0 && f.applied_normal_force_rate == 0.0 &&
         f.limit == 0.0 && f.limit_rate == 0.0;
}

/// Evaluates a form, by the short sum if is_plain(form). The form must outlive the object. Functions: see Form.
class QuickForm {
 public:
  explicit QuickForm(const Form& form) : f_(form), plain_(is_plain(form)) {}

  [[nodiscard]] double rate(const ContactMotion& m) const {
    return plain_ ? f_.N * m.N + f_.T * m.T + f_.gap * m.gap + f_.ut * m.ut + f_.vn * m.vn + f_.vt * m.vt
                  : f_.rate(m);
  }
  [[nodiscard]] double value(const ContactMotion& m) const { return f_.constant + rate(m); }
  [[nodiscard]] double magnitude(const ContactMotion& m) const {
    return plain_ ? std::abs(f_.N * m.N) + std::abs(f_.T * m.T) + std::abs(f_.gap * m.gap) +
                        std::abs(f_.ut * m.ut) + std::abs(f_.vn * m.vn) + std::abs(f_.vt * m.vt)
                  : f_.magnitude(m);
  }

 private:
  const Form& f_;
  bool plain_;
};

/// Known signs of a guard's derivatives: derivatives of orders below `zeros` are zero; if `rises`, the derivative of order
/// `zeros` is positive.
struct Known {
  std::size_t zeros = 0;
  bool rises = false;

  /// Known signs of a guard that is zero with all available derivatives.
  [[nodiscard]] static Known at_limit() { return {MotionJet::orders, false}; }
};

/// Known signs of the guards of a contact that is decided together with other contacts.
struct KnownGuards {
  bool touches = false;  ///< true: g = 0
  Known closing, separation, slip_plus, slip_minus, sliding;

  /// The known signs that are valid in every state of the contact: zeros of g, g' and the slip rate.
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
      case Guard::friction_limit:  // it has the signs of the limit that is reached
        return slip_plus.zeros > slip_minus.zeros ? slip_plus : slip_minus;
      case Guard::sliding:
        return sliding;
      case Guard::none:
      case Guard::opening:
      case Guard::user_1:
      case Guard::user_2:
      case Guard::user_3:
        break;
    }
    return {};
  }
};

/// Sign of a guard just after an instant.
struct Sign {
  int sign = 0;         // -1, 0, +1
  int order = 0;        // order of the first nonzero derivative; MotionJet::orders if all are zero
  double excess = 0.0;  // that derivative's magnitude / limit up to which it is treated as zero
};

/// Returns `motion_up_to_instant`, the motion of the contact up to the instant, if the guard is a friction limit in Instant::resting_limits
/// and is still zero; otherwise nullptr. The guard of the slip rate is treated like the friction limit in the direction of
/// slip, because p' = -(fs |N| - T)' / kt.
[[nodiscard]] const MotionJet* resting_reference(const Contact& contact, std::size_t c,
                                                 const ContactState& state, const GuardForm& guard,
                                                 const MotionJet& motion_up_to_instant,
                                                 const Instant& instant);
/// Sign of the first derivative of the form, from order `first` on, that is not zero within its rounding error. base: a motion
/// for which the form is exactly zero; its computed derivatives are subtracted, to remove accumulated rounding errors.
[[nodiscard]] Sign leading_sign(const GuardForm& form, const MotionJet& jet, const Instant& instant,
                                std::size_t first, const MotionJet* base = nullptr);
/// True if the form's value is zero within its rounding error and the resolution of time.
[[nodiscard]] bool starts_at_zero(const GuardForm& form, const MotionJet& jet, const Instant& instant);
/// Smallest factor on the rounding errors of the form's derivatives for which the form is lexicographically nonnegative; 0: the
/// form is nonnegative without a factor.
[[nodiscard]] double relative_violation(const GuardForm& form, const MotionJet& jet, const Instant& instant,
                                        std::size_t first);
/// Sign of a guard with known signs of derivatives. If known.rises, the guard is positive unless its derivative of order
/// known.zeros is negative by more than rounding.
[[nodiscard]] Sign sign_of_guard(const GuardForm& form, const MotionJet& jet, const Instant& instant,
                                 const Known& known, const MotionJet* base = nullptr);

using GuardsOfState = ContactLaw::Guards;

/// True if derivatives of orders below `orders` determine the signs of all guards of contact c, even if noise and resolution
/// are `max_noise_factor` times as large. Only for contacts that are decided separately. known: known signs of the guards.
[[nodiscard]] bool signs_are_decided(const GuardsOfState& guards, std::size_t c, const MotionJet& jet,
                                     std::size_t orders, const Instant& instant, const KnownGuards& known,
                                     double max_noise_factor);

/// Guards of every contact. Copies share the guards of contacts whose states do not change.
using GuardForms = base::CopyOnWriteVector<GuardsOfState>;

/// Cache of the guards of each contact in its last state; most states do not change between two decisions.
class GuardCache {
 public:
  /// The model must outlive the object.
  explicit GuardCache(const Model& model)
      : model_(model), states_(model.contacts.size()), forms_(model.contacts.size()) {}
  /// Guards of the contact in this state; computed only if the state has changed.
  [[nodiscard]] const GuardsOfState& of(std::size_t contact, const ContactState& state);
  /// Guards of all contacts in the cache.
  [[nodiscard]] const GuardForms& all() const { return forms_; }

 private:
  const Model& model_;
  std::vector<std::optional<ContactState>> states_;  // states of the cached guards; nullopt: not in the cache
  GuardForms forms_;
};

/// A guard that is negative just after the instant; sign.sign is -1.
struct FailedGuard {
  std::size_t contact = 0;
  Guard guard = Guard::none;
  GuardForm form = {};
  Sign sign = {};
};

/// Returns, for each contact with a failing guard, the guard that fails first. before: true if `states` are the states before
/// the instant, so that the guards located by the engine are zero. known: one entry per contact. motion_up_to_instant: motion up to the
/// instant, one entry per contact; empty if there are no resting limits. asked: contacts to examine, ascending.
[[nodiscard]] std::vector<FailedGuard> find_failed_guards(
    const Model& model, const std::vector<MotionJet>& jets, const contact::ContactStates& states,
    const Instant& instant, bool before, const std::vector<KnownGuards>& known,
    const std::vector<MotionJet>& motion_up_to_instant, const std::vector<std::size_t>& asked);

}  // namespace signorini::decide
