// contact_law.hpp: the interface of a contact law.
//
//   in state i      normal row = 0,  tangent row = 0       forms (form.hpp) from which N and T follow
//   valid while     guards > 0                             at most three
//   at their zero   i <- next,  p <- memory                p: memory of the contact, such as an anchor or a dent
//
// A law is constant and shared by contacts. Stiffnesses, friction and gap of one contact are in Contact; the built-in laws
// build their rows from these numbers. Engines, decisions, the law checker and statics query the capabilities of a law, never
// its name.
//
// A user law is data (user_contact_law.hpp), or a built-in law with other guards or transitions (modified_law.hpp), or a class
// that derives from ContactLaw. Such a class has its own states and contains its own numbers, in the units of the scene.
// ContactSpec::user_law gives it to a contact of a scene; build_model refuses a law whose rows, guards and capabilities
// contradict each other.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "signorini/contact_work.hpp"
#include "signorini/form.hpp"
#include "signorini/guard_form.hpp"

namespace signorini {

struct Contact;
struct ContactState;
struct UserContactLaw;
struct Unit;

/// The laws that a scene can name.
enum class Law { compliant, rigid, slider };

/// How a law determines the forces, and which conditions the forces satisfy.
struct LawCapabilities {
  /// True: N = -normal_force(t) is given, independent of the motion, and there is no gap. False: N is an unknown, with g >= 0
  /// and N <= 0.
  bool normal_force_given = false;
  /// A spring determines N while the contact is closed. Its stiffness, used by statics, modes and scales, is
  /// Contact::normal_stiffness. Forces and velocities are continuous.
  bool normal_spring = false;
  /// g = 0 is a constraint while the contact is closed: velocities jump when the contact closes with g' < 0.
  bool takes_impulses = false;
  /// The law obeys Signorini's conditions (6) and Coulomb's (7), which the audit and the law checker then check. Springs are
  /// N = kn g + cn g' and T = kt (ut - p). All states are built-in states, and their rows are those of a built-in law.
  bool signorini_coulomb = true;
  /// True: guards are linear forms. False: guards may contain products of forms; `ida` and the series of `exact` support them.
  bool linear_guards = true;
  /// The springs of the law represent local compliance of the structure: results contain the motion of the touching surfaces.
  bool compliance_split = false;
  /// Number of forces along the surface and number of guards, for ForceLayout. Without such a force the tangent row is T = 0 in
  /// all states, and neither the normal row nor guards depend on ut or T.
  std::uint32_t tangents = 1, guards = 3;
};

/// Capabilities of the laws that a scene can name.
[[nodiscard]] constexpr LawCapabilities capabilities_of(Law law) {
  switch (law) {
    case Law::compliant:
      return {.normal_spring = true};
    case Law::rigid:
      return {.takes_impulses = true};
    case Law::slider:
      break;
  }
  return {.normal_force_given = true};
}

class ContactLaw {
 public:
  static constexpr std::size_t max_guards = 3;
  using Guards = std::array<GuardForm, max_guards>;
  using VisitConstant = std::function<void(double&, const Unit&)>;

  explicit ContactLaw(const LawCapabilities& of) : capabilities(of) {}
  virtual ~ContactLaw() = default;
  ContactLaw(const ContactLaw&) = delete;
  ContactLaw& operator=(const ContactLaw&) = delete;

  const LawCapabilities capabilities;

  /// Name in check, messages and summary.json.
  [[nodiscard]] virtual std::string name() const = 0;
  /// True if messages can name the law.
  [[nodiscard]] virtual bool is_named() const { return true; }

  // Interface for engines and decisions. src/contact has functions with the same names that call these.
  /// The two residual rows in this state.
  [[nodiscard]] virtual Rows rows(const Contact& contact, const ContactState& state) const = 0;
  /// Guards of this state; unused entries have the kind Guard::none.
  [[nodiscard]] virtual Guards guards(const Contact& contact, const ContactState& state) const = 0;
  /// State after the guard `failed` of state `now` has reached zero. jet: motion in state `now`, with time derivatives.
  [[nodiscard]] virtual ContactState next_state(const Contact& contact, const ContactState& now, Guard failed,
                                                const MotionJet& jet) const = 0;
  /// States that may follow `now` if guards do not determine the next state; `before`: the motion just before the instant.
  /// Default: all user_law_states(), with the memory of `now`.
  [[nodiscard]] virtual std::vector<ContactState> candidates(const Contact& contact, const ContactState& now,
                                                             const ContactMotion& before) const;
  /// Slip rate p' as a form, in a state that slips in direction s. Default: ut'.
  [[nodiscard]] virtual Form slip_rate(const Contact& contact, int s) const;

  // Interface for energies and for the conditions of the law (contact_work.hpp). Default: all work on the contact is work of
  // friction, no energy is stored, and there are no conditions.
  /// Factor of T in the power of ContactWork::friction: p' of a slipping contact, ut' for a user law, otherwise 0.
  [[nodiscard]] virtual double working_slip_rate(const Contact& contact, State state,
                                                 const ContactMotion& m) const;
  [[nodiscard]] virtual ContactWork work(const Contact& contact, State state, double N, double T,
                                         const ContactIncrement& path) const;
  [[nodiscard]] virtual double stored_energy(const Contact& contact, State state,
                                             const ContactMotion& m) const;
  [[nodiscard]] virtual Violations violations(const Contact& contact, State state,
                                              const ContactMotion& m) const;

  // States and constants of the law itself, in addition to those of Contact.
  /// States of a law with its own states: user_law_state(i, kind) for i = 0, 1, ... Files number them in this order; a run
  /// starts in the first one. Empty: the law has the built-in states.
  [[nodiscard]] virtual std::vector<State> user_law_states() const { return {}; }
  /// True if the law has a rule that sets p at events.
  [[nodiscard]] virtual bool has_memory() const { return false; }
  /// Copy of the law in which visit(constant, unit) may change each constant, for other units or for perturbed data; nullptr:
  /// the law has no constants. A law that leaves a constant out is wrong in every run, because runs have their own units.
  [[nodiscard]] virtual std::shared_ptr<const ContactLaw> with_constants(
      const VisitConstant& visit) const = 0;
  /// Message about the first error in the data of the law; empty: there is no error. build_model refuses a law with an error.
  [[nodiscard]] virtual std::string validation_error() const { return {}; }
  [[nodiscard]] virtual bool equals(const ContactLaw& other) const { return this == &other; }
};

/// Shared pointer to the law of a contact; never null, because a null pointer is replaced by the compliant law.
class ContactLawPtr {
 public:
  ContactLawPtr(Law law = Law::compliant);  // NOLINT(google-explicit-constructor): converts a Law
  ContactLawPtr(std::shared_ptr<const ContactLaw> law);  // NOLINT(google-explicit-constructor)
  /// Makes a user law from its data.
  ContactLawPtr(std::shared_ptr<const UserContactLaw> law);  // NOLINT(google-explicit-constructor)
  /// Converts a pointer to a class that derives from ContactLaw, or to data that is not const.
  template <class L>
  requires std::convertible_to<L*, const ContactLaw*> ContactLawPtr(
      std::shared_ptr<L> law)  // NOLINT(google-explicit-constructor)
      : ContactLawPtr(std::shared_ptr<const ContactLaw>(std::move(law))) {}
  ContactLawPtr(const std::shared_ptr<UserContactLaw>& law)  // NOLINT(google-explicit-constructor)
      : ContactLawPtr(std::shared_ptr<const UserContactLaw>(law)) {}

  const ContactLaw* operator->() const { return law_.get(); }
  const ContactLaw& operator*() const { return *law_; }
  friend bool operator==(const ContactLawPtr& a, const ContactLawPtr& b) { return a->equals(*b); }

 private:
  std::shared_ptr<const ContactLaw> law_;
};

/// Law of a rigid contact on massless parts. It is computed as a compliant contact; its springs are the local compliance of the
/// structure, which is removed from the structure (model/compliance_split.hpp).
[[nodiscard]] ContactLawPtr compliance_split_law();

}  // namespace signorini
