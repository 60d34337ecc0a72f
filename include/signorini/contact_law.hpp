// contact_law.hpp: a contact law, and all that the rest of the program may ask of it.
//
//   in state i      normal row = 0,  tangent row = 0       forms (form.hpp) from which N and T follow
//   it holds while  guards > 0                             at most three
//   where one falls i <- next,  p <- memory                p: what the contact remembers, an anchor or a dent
//
// A law is constant and shared. The numbers of one contact (stiffnesses, friction, gap) stand in Contact, from which the built-in
// laws make their rows; a law made of data (own_law.hpp) holds its own numbers. Engines, decisions, witness and statics ask the
// capabilities, never which law it is.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "signorini/form.hpp"

namespace signorini {

struct Contact;
struct ContactMotion;
struct ContactPath;
struct ContactState;
struct ContactWork;
struct GuardForm;
struct MotionJet;
struct OwnLaw;
struct Rows;
struct Unit;
struct Violations;
enum class Guard : unsigned char;

/// The laws that a scene names; more are made of data (own_law.hpp).
enum class Law { compliant, rigid, slider };

/// How a law determines forces, and which equations check it.
struct LawCapabilities {
  /// N = -normal_force(t), whatever moves: N is a datum, and there is no gap. Else g >= 0, N <= 0, and N is an unknown.
  bool normal_force_given = false;
  /// While the contact is closed a spring determines N. Its stiffness, by which statics, modes and scales go, is
  /// Contact::normal_stiffness. Forces and velocities are continuous.
  bool normal_spring = false;
  /// While the contact is closed g = 0 is a constraint: velocities jump where it closes with g' < 0.
  bool takes_impulses = false;
  /// Signorini's conditions (6) and Coulomb's (7) are those of the law: they are audited and witnessed, N = kn g + cn g' is its
  /// spring, T = kt (ut - p) that of its anchor, and each state is one of the built-in ones.
  bool signorini_coulomb = true;
  /// Guards are linear forms; else products of forms may stand in them.
  bool linear_guards = true;
  /// Its springs are compliance of the structure beside it: results show the motion of the surfaces that touch.
  bool compliance_split = false;
};

/// The laws that a scene names differ in these.
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
  static constexpr std::size_t most_guards = 3;
  using Guards = std::array<GuardForm, most_guards>;
  using VisitConstant = std::function<void(double&, const Unit&)>;

  explicit ContactLaw(const LawCapabilities& of) : capabilities(of) {}
  virtual ~ContactLaw() = default;
  ContactLaw(const ContactLaw&) = delete;
  ContactLaw& operator=(const ContactLaw&) = delete;

  const LawCapabilities capabilities;

  /// In check, messages and summary.json.
  [[nodiscard]] virtual std::string name() const = 0;
  /// Is it one that scenes can name? A law made in code need not have a name.
  [[nodiscard]] virtual bool is_named() const { return true; }

  // The interface of advance and decide. src/contact has functions of the same names that call these.
  [[nodiscard]] virtual Rows rows(const Contact& contact, const ContactState& state) const = 0;
  [[nodiscard]] virtual Guards guards(const Contact& contact, const ContactState& state) const = 0;
  /// p' as a form, in a state that slips in direction s.
  [[nodiscard]] virtual Form slip_rate(const Contact& contact, int s) const = 0;
  /// After a guard of `now` has fallen; the motion holds in state `now`.
  [[nodiscard]] virtual ContactState next_state(const Contact& contact, const ContactState& now, Guard fallen,
                                                const MotionJet& jet) const = 0;
  /// All states that may follow where guards decide nothing.
  [[nodiscard]] virtual std::vector<ContactState> candidates(const Contact& contact, const ContactState& now,
                                                             const ContactMotion& before) const = 0;

  // Energy and conditions: src/contact/work.hpp, conditions.hpp.
  /// The slip rate with which T does the work of ContactWork::friction.
  [[nodiscard]] virtual double working_slip_rate(const Contact& contact, State state,
                                                 const ContactMotion& m) const = 0;
  [[nodiscard]] virtual ContactWork work(const Contact& contact, State state, double N, double T,
                                         const ContactPath& path) const = 0;
  [[nodiscard]] virtual double stored_energy(const Contact& contact, State state,
                                             const ContactMotion& m) const = 0;
  [[nodiscard]] virtual Violations violations(const Contact& contact, State state,
                                              const ContactMotion& m) const = 0;

  // States and numbers of the law itself, beside those of Contact.
  /// Its states in order, where they are its own: files show their numbers, a run begins with one of them. Empty: the built-in
  /// states.
  [[nodiscard]] virtual std::vector<State> own_states() const { return {}; }
  /// Do events set p in it by a rule of its own?
  [[nodiscard]] virtual bool has_memory() const { return false; }
  /// The law with its own numbers visited; nullptr: it has none.
  [[nodiscard]] virtual std::shared_ptr<const ContactLaw> with_constants(const VisitConstant& visit) const;
  [[nodiscard]] virtual bool equals(const ContactLaw& other) const { return this == &other; }
};

/// A law of a contact, never null.
class ContactLawPtr {
 public:
  ContactLawPtr(
      Law law = Law::compliant);  // NOLINT(google-explicit-constructor): a built-in law stands for its name
  ContactLawPtr(std::shared_ptr<const ContactLaw> law)
      : law_(std::move(law)) {}  // NOLINT(google-explicit-constructor)
  /// A law made of data.
  ContactLawPtr(std::shared_ptr<const OwnLaw> law);  // NOLINT(google-explicit-constructor)

  const ContactLaw* operator->() const { return law_.get(); }
  const ContactLaw& operator*() const { return *law_; }
  friend bool operator==(const ContactLawPtr& a, const ContactLawPtr& b) { return a->equals(*b); }

 private:
  std::shared_ptr<const ContactLaw> law_;
};

/// A rigid contact on parts without mass: a compliant one whose springs are compliance of the structure
/// (model/borrowed_springs.hpp).
[[nodiscard]] ContactLawPtr compliance_split_law();

}  // namespace signorini
