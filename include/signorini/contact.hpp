// contact.hpp: constants and state of a contact, its constraint rows and its guards.
//
//   g >= 0,  N <= 0,  g N = 0                                paper (6)
//   |T| <= T_U,  T p' >= 0,  (|T| - T_U) p' = 0,  T_U = -f N  paper (7)
//
//   state    normal row              tangent row                  guards (positive while valid)
//   open     N = 0                   T = 0                        g
//   inside   N = 0                   T = 0                        g + (cn/kn) g', -g
//   closed   N = kn g                T = 0                        -N
//   stick    N = kn g                T = kt (ut - p)              -N, fs |N| - T, fs |N| + T
//   slip s   N = kn g                T = -s fk N                  -N, s p'
//
// A rigid contact has the row g'' = 0 in place of N = kn g, and in stick the row ut'' = 0, where ut is relative to the
// surface. If a rigid contact closes with g' < 0, an impact is computed (decide/impact.hpp). With Stribeck friction fk
// depends on the slip rate (contact/friction.hpp).
//
// With a shear element (kt and ct in parallel) p is an unknown:
//   ct (ut' - p') + kt (ut - p) = T,   and p' = 0 in stick
// A slider has no gap and the normal row N = -normal_force(t); without kt its row in stick is ut'' = 0.
// A user law may replace all rows and guards: user_contact_law.hpp, modified_law.hpp. The interface of all laws: contact_law.hpp.
// Forces on the body: -N along n, -T along t.
// Source: Lukashevich et al. 2021, eqs (6)-(11), generalised to slip in both directions.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "signorini/contact_law.hpp"
#include "signorini/form.hpp"
#include "signorini/history.hpp"
#include "signorini/scene.hpp"

namespace signorini {

/// A sparse linear form on the displacements: sum of factor * u[index].
struct Combination {
  std::vector<std::pair<int, double>> terms;

  template <class V>
  [[nodiscard]] double dot(const V& u) const {
    double sum = 0.0;
    for (const auto& [index, factor] : terms) sum += factor * u[index];
    return sum;
  }
  /// Sum of the magnitudes of the terms of dot(); the rounding error of dot() is proportional to this sum.
  template <class V>
  [[nodiscard]] double magnitude(const V& u) const {
    double sum = 0.0;
    for (const auto& [index, factor] : terms) sum += std::abs(factor * u[index]);
    return sum;
  }
  /// f += force times the form: the effect of a force along the form on the equations of motion.
  template <class V>
  void add_to(V& f, double force) const {
    for (const auto& [index, factor] : terms) f[index] += factor * force;
  }
};

/// A spring and a dashpot in parallel between the body and its sliding point:
///
///   T = stiffness (ut - p) + damping (ut' - p')
///
/// The sliding point is then a separate massless degree of freedom, and Contact::tangent refers to that point.
struct ShearElement {
  Combination body;  ///< tangential displacement of the body
  double stiffness = 0.0, damping = 0.0;
};

/// All constants of one contact.
struct Contact {
  std::string name;
  ContactLawPtr law;
  Combination normal;   ///< g = gap + normal . u; empty for sliders
  Combination tangent;  ///< along the surface: ut = tangent . u - surface_motion
  double gap = 0.0;
  double normal_stiffness = 0.0;
  std::optional<double> tangential_stiffness;
  std::optional<ShearElement> shear;              ///< if set, tangential_stiffness is empty
  std::optional<CurvedSurface> pendulum_surface;  ///< surface of a friction pendulum; not for rigid contacts
  double normal_damping = 0.0;                    ///< dashpot parallel to the normal spring
  Friction friction;
  double restitution = 0.0;  ///< rigid: Newton's coefficient
  /// rigid: the contact stays closed after a rebound with a departure speed below this velocity; absent: the engine's default
  std::optional<double> capture_velocity;
  History normal_force;        ///< slider: the given compressive force, >= 0
  History surface_motion;      ///< integral of the surface velocity from t = 0
  double initial_shear = 0.0;  ///< force T of the tangential spring at t = 0
  /// Sign of the slip at t = 0; needed because T below the static limit does not determine the sign.
  int initial_slip = 0;
  std::size_t initial_law_state = 0;                   ///< user law: initial state
  double initial_memory = 0.0;                         ///< user law: initial memory p
  std::uint32_t unused_forces = 0, unused_guards = 0;  ///< see ForceLayout::Counts

  [[nodiscard]] bool has_friction() const { return friction.any(); }

  // Properties of a contact that follow from its law. Other code queries these functions and does not compare laws.

  /// True if N = -normal_force(t) is given and the contact has no gap. False: N is an unknown, with g >= 0 and N <= 0.
  [[nodiscard]] bool normal_force_given() const { return law->capabilities.normal_force_given; }
  /// Stiffness of the spring that determines N while the contact is closed, for statics, modes, scales and rounding bounds.
  /// nullopt: N is given, or N is the force of a constraint.
  [[nodiscard]] std::optional<double> normal_spring() const {
    return law->capabilities.normal_spring ? std::optional(normal_stiffness) : std::nullopt;
  }
  /// Force N <= 0 of the normal spring at displacements u and zero velocity; nullopt: u does not determine N.
  template <class U>
  [[nodiscard]] std::optional<double> resting_force(const U& u) const {
    return law->capabilities.normal_spring ? std::optional(normal_stiffness * std::min(0.0, gap_at(u)))
                                           : std::nullopt;
  }
  /// True if velocities jump when the contact closes with g' < 0.
  [[nodiscard]] bool takes_impulses() const { return law->capabilities.takes_impulses; }
  /// g itself if the contact has a gap; nullopt if N is given.
  [[nodiscard]] std::optional<double> optional_gap(double g) const {
    return normal_force_given() ? std::nullopt : std::optional(g);
  }

  /// True if conditions (6) and (7) apply to the contact. The audit and the law checker then check these conditions, and the
  /// contact has only built-in states.
  [[nodiscard]] bool obeys_coulomb() const { return law->capabilities.signorini_coulomb; }
  /// True if engines that know only Coulomb friction with linear guards can compute the contact.
  [[nodiscard]] bool has_linear_coulomb_law() const {
    return law->capabilities.signorini_coulomb && law->capabilities.linear_guards;
  }
  /// True if N = kn g + cn g' while closed.
  [[nodiscard]] bool is_elastic_along_normal() const {
    return law->capabilities.normal_spring && law->capabilities.signorini_coulomb;
  }
  /// kt of T = kt (ut - p), where p is the memory of the contact; nullopt: there is no such spring, and p is equal to ut.
  [[nodiscard]] std::optional<double> anchor_spring() const {
    return obeys_coulomb() ? tangential_stiffness : std::nullopt;
  }
  /// Shear element whose sliding point is a separate massless degree of freedom, so that p is an unknown; nullptr: none.
  [[nodiscard]] const ShearElement* sliding_point() const { return shear ? &*shear : nullptr; }
  /// Stiffness between the body and the sliding point, along body_tangent(); nullopt: no spring along the tangent.
  [[nodiscard]] std::optional<double> tangent_spring() const {
    return shear ? std::optional(shear->stiffness) : tangential_stiffness;
  }
  /// Curved surface: in addition to T a force proportional to N ut acts along body_tangent() (contact/curved_surface.hpp).
  /// nullptr: the surface is plane.
  [[nodiscard]] const CurvedSurface* curved_surface() const {
    return pendulum_surface ? &*pendulum_surface : nullptr;
  }
  /// True if, in each state, the contact forces are linear in the motion with constant coefficients.
  [[nodiscard]] bool is_linear() const {
    return !friction.is_rate_dependent() && !friction.is_load_dependent() && !pendulum_surface;
  }
  /// True for springs of constant stiffness with Coulomb friction and no other force. Only such contacts are supported by
  /// statics and by flows in closed form.
  [[nodiscard]] bool has_constant_stiffness() const { return obeys_coulomb() && !pendulum_surface; }
  /// True if N, T and p' are functions of the contact's motion at the same instant, so that no equation of the law has a rate
  /// as an unknown.
  [[nodiscard]] bool forces_follow_motion() const {
    return obeys_coulomb() && !shear && !friction.is_rate_dependent();
  }
  /// True if the contact's springs represent local compliance of the structure; results then contain the motion of the
  /// touching surfaces, without the deformation of the springs.
  [[nodiscard]] bool compliance_split() const { return law->capabilities.compliance_split; }

  /// True if there is no spring along the tangent: T may then jump, and stick is a constraint on accelerations.
  [[nodiscard]] bool sticks_rigidly() const {
    return has_friction() && !law->capabilities.normal_spring && !tangential_stiffness && !shear;
  }
  /// True if T is the force of a constraint while N is given: the contact constrains the tangent alone.
  [[nodiscard]] bool constrains_tangent_only() const { return normal_force_given() && sticks_rigidly(); }
  /// True if T is the force of a constraint in this state.
  [[nodiscard]] bool constrains_tangent(State state) const {
    return kind_of(state) == State::stick && !tangential_stiffness && !shear;
  }
  /// Gap g at displacements u.
  template <class U>
  [[nodiscard]] double gap_at(const U& u) const {
    return gap + normal.dot(u);
  }
  /// Tangential displacement of the touching body as a form; equal to `tangent` unless there is a shear element.
  [[nodiscard]] const Combination& body_tangent() const { return shear ? shear->body : tangent; }
};

/// State and memory of one contact. They change only at events.
struct ContactState {
  State state = State::open;
  /// Memory p: the anchor of the tangential spring, used only in stick; with a user law, the memory of that law.
  double anchor = 0.0;

  [[nodiscard]] bool is_open() const { return signorini::is_open(state); }
  friend bool operator==(const ContactState&, const ContactState&) = default;
};

}  // namespace signorini
