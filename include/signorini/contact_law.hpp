// contact_law.hpp: the interface of a contact law.
//
//   in state i      normal row = 0,  tangent row = 0       forms (form.hpp) from which N and T follow
//   valid while     guards > 0                             at most three
//   at their zero   i <- next,  p <- memory                p: memory of the contact, such as an anchor or a dent
//
// A law is constant and shared by contacts. Stiffnesses, friction and gap of one contact are in Contact; the built-in laws
// build their rows from these numbers. A user law (user_contact_law.hpp) contains its own numbers. Engines, decisions, the
// law checker and statics query the capabilities of a law, never its name.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "signorini/form.hpp"

namespace signorini {

struct Contact;
struct ContactMotion;
struct ContactIncrement;
struct ContactState;
struct ContactWork;
struct GuardForm;
struct MotionJet;
struct UserContactLaw;
struct Rows;
struct Unit;
struct Violations;
enum class Guard : unsigned char;

/// The laws that a scene can name; user laws are defined by data instead (user_contact_law.hpp).
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
  /// N = kn g + cn g' and T = kt (ut - p). All states are built-in states.
  bool signorini_coulomb = true;
  /// True: guards are linear forms. False: guards may contain products of forms.
  bool linear_guards = true;
  /// The springs of the law represent local compliance of the structure: results contain the motion of the touching surfaces.
  bool compliance_split = false;
  /// Number of forces along the surface and number of guards, for ForceLayout.
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
  /// True if scenes can name the law. A law made in code may have no name.
  [[nodiscard]] virtual bool is_named() const { return true; }

  // Interface for engines and decisions. src/contact has functions with the same names that call these.
  /// The two residual rows in this state.
  [[nodiscard]] virtual Rows rows(const Contact& contact, const ContactState& state) const = 0;
  /// Guards of this state; unused entries have the kind Guard::none.
  [[nodiscard]] virtual Guards guards(const Contact& contact, const ContactState& state) const = 0;
  /// Slip rate p' as a form, in a state that slips in direction s.
  [[nodiscard]] virtual Form slip_rate(const Contact& contact, int s) const = 0;
  /// State after the guard `failed` of state `now` has reached zero. jet: motion in state `now`, with time derivatives.
  [[nodiscard]] virtual ContactState next_state(const Contact& contact, const ContactState& now, Guard failed,
                                                const MotionJet& jet) const = 0;
  /// States that may follow `now` if guards do not determine the next state; `before`: the motion just before the instant.
  [[nodiscard]] virtual std::vector<ContactState> candidates(const Contact& contact, const ContactState& now,
                                                             const ContactMotion& before) const = 0;

  // Interface for energies and for the conditions of the law. Units and signs: src/contact/work.hpp and law.hpp.
  /// Factor of T in the power of ContactWork::friction: p' of a slipping contact, ut' for a user law, otherwise 0.
  [[nodiscard]] virtual double working_slip_rate(const Contact& contact, State state,
                                                 const ContactMotion& m) const = 0;
  [[nodiscard]] virtual ContactWork work(const Contact& contact, State state, double N, double T,
                                         const ContactIncrement& path) const = 0;
  [[nodiscard]] virtual double stored_energy(const Contact& contact, State state,
                                             const ContactMotion& m) const = 0;
  [[nodiscard]] virtual Violations violations(const Contact& contact, State state,
                                              const ContactMotion& m) const = 0;

  // States and constants of the law itself, in addition to those of Contact.
  /// States of a user law, in the order that numbers them in files; a run starts in one of them. Empty: the law has the
  /// built-in states.
  [[nodiscard]] virtual std::vector<State> user_law_states() const { return {}; }
  /// True if the law has a rule that sets p at events.
  [[nodiscard]] virtual bool has_memory() const { return false; }
  /// Copy of the law in which `visit` may change each constant; nullptr: the law has no constants.
  [[nodiscard]] virtual std::shared_ptr<const ContactLaw> with_constants(const VisitConstant& visit) const;
  [[nodiscard]] virtual bool equals(const ContactLaw& other) const { return this == &other; }
};

/// Shared pointer to the law of a contact; never null.
class ContactLawPtr {
 public:
  ContactLawPtr(Law law = Law::compliant);  // NOLINT(google-explicit-constructor): converts a Law
  ContactLawPtr(std::shared_ptr<const ContactLaw> law)
      : law_(std::move(law)) {}  // NOLINT(google-explicit-constructor)
  /// Makes a user law.
  ContactLawPtr(std::shared_ptr<const UserContactLaw> law);  // NOLINT(google-explicit-constructor)

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
