// contact.hpp: a contact's constants, its state, and the forms that a state puts in force.
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
// A rigid contact has the row g'' = 0 in place of N = kn g, and ut'' = surface acceleration in stick; where
// it closes with g' < 0 it is hit (decide/impact.hpp). Stribeck friction: fk of the slip rate,
// sliding_friction().
//
// With a shear element (kt and ct side by side) p is an unknown: ct (ut' - p') + kt (ut - p) = T, and p' = 0
// in stick.
// A slider has N = -normal_force(t) instead, no gap, and without kt the row t.v' = surface acceleration.
// A compliant contact may have a law of one's own in place of all this: own_law.hpp.
// Forces on the body: -N along n, -T along t.
// Source: Lukashevich et al. 2021, eqs (6)-(11), generalised to slip in both directions.
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "signorini/form.hpp"
#include "signorini/history.hpp"
#include "signorini/own_law.hpp"
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
  /// Sum of the magnitudes of its terms: what the rounding of dot() is relative to.
  template <class V>
  [[nodiscard]] double magnitude(const V& u) const {
    double sum = 0.0;
    for (const auto& [index, factor] : terms) sum += std::abs(factor * u[index]);
    return sum;
  }
  template <class V>
  void add_to(V& f, double force) const {
    for (const auto& [index, factor] : terms) f[index] += factor * force;
  }
};

/// A spring and a dashpot side by side between the body and the point that slides:
///   T = stiffness (ut - p) + damping (ut' - p').
/// That point is a degree of freedom of its own then, without mass, and Contact::tangent is on it.
struct ShearElement {
  Combination body;  ///< tangential displacement of the body
  double stiffness = 0.0, damping = 0.0;
};

/// The constants of one contact.
struct Contact {
  std::string name;
  Law law = Law::compliant;
  Combination normal;   ///< g = gap + normal . u; empty for sliders
  Combination tangent;  ///< ut = tangent . u - surface_motion
  double gap = 0.0;
  double normal_stiffness = 0.0;
  std::optional<double> tangential_stiffness;
  /// Rigid, on parts without mass: its springs are compliance of the structure (model/borrowed_springs.hpp).
  bool borrows = false;
  std::optional<ShearElement> shear;  ///< tangential_stiffness is empty then
  std::optional<Bowl> bowl;           ///< not of rigid contacts
  double normal_damping = 0.0;        ///< dashpot beside the normal spring
  Friction friction;
  double restitution = 0.0;                ///< rigid: Newton's coefficient
  std::optional<double> capture_velocity;  ///< rigid: rebounds slower than this rest; absent: the engine's
  History normal_force;                    ///< slider: compression >= 0
  History surface_motion;                  ///< integral of the surface velocity from t = 0
  double initial_shear = 0.0;
  int initial_slip = 0;  ///< sign of the slip at t = 0, which T alone does not tell below the static limit
  std::shared_ptr<const OwnLaw> own;  ///< compliant: what stands in place of its rows and guards
  std::size_t own_state = 0;          ///< where that law begins: its state
  double own_memory = 0.0;            ///< and p

  [[nodiscard]] bool has_gap() const { return signorini::has_gap(law); }
  [[nodiscard]] bool has_spring() const { return signorini::has_spring(law); }
  [[nodiscard]] bool takes_impulses() const { return signorini::takes_impulses(law); }
  [[nodiscard]] bool is_pressed() const { return signorini::is_pressed(law); }
  [[nodiscard]] bool has_friction() const { return friction.any(); }
  /// Without a spring along the tangent: T may jump, and stick is a row on accelerations.
  [[nodiscard]] bool sticks_rigidly() const {
    return has_friction() && !has_spring() && !tangential_stiffness && !shear;
  }
  /// g at displacements u.
  template <class U>
  [[nodiscard]] double gap_at(const U& u) const {
    return gap + normal.dot(u);
  }
  /// Along which the touching body moves; `tangent` unless there is a shear element.
  [[nodiscard]] const Combination& body_tangent() const { return shear ? shear->body : tangent; }
};

/// State and memory of one contact: what a switch changes.
struct ContactState {
  State state = State::open;
  /// p; meaningful in stick with tangential stiffness. Of a law of one's own: its memory.
  double anchor = 0.0;

  [[nodiscard]] bool is_open() const { return signorini::is_open(state); }
  friend bool operator==(const ContactState&, const ContactState&) = default;
};

}  // namespace signorini
