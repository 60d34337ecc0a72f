// output.hpp: a response quantity as a linear functional of the motion, or the greatest of many.
//
//   r(t) = u.u + v.v + a.a + sum_k ( N_k N + T_k T ) + sum_i h_i(t) + constant + loss of a contact
//          + sum_k c_k ( |N| - N_0 ) t.u                 of pendulums whose force varies
//
// Envelopes and extremes of stresses are the greatest |r| along stretches of members, at points of which r is known.
//
// u, v, a are forms on the model's degrees of freedom. What is given (loads within a member, supports that
// move, the base) stands in the histories h_i, weight in the constant. All in the unit of the output. What is
// of a load says of which, since a load may be changed while a run is on its way (Steering).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "signorini/contact.hpp"

namespace signorini {

struct Output {
  std::string name;
  OutputKind kind = OutputKind::displacement;
  Unit unit;
  Combination u, v, a;
  struct ContactForces {
    std::size_t contact = 0;
    double N = 0.0, T = 0.0;  ///< factors of both forces
  };
  std::vector<ContactForces> forces = {};
  /// factor (|N| - said) slip . u: what the surface of a pendulum adds to the spring of a force that was said.
  struct Restoring {
    std::size_t contact = 0;
    Combination slip = {};
    double factor = 0.0, said = 0.0;  ///< factor: unit of the output over force and length; said: force
  };
  std::vector<Restoring> restoring = {};
  struct Given {
    History history;        ///< in the unit of the output
    std::string load = {};  ///< Model::loads, by name; empty: of no load
    double factor = 1.0;    ///< history = factor * the load's
    Unit of_load = {};      ///< unit of the load's history
  };
  std::vector<Given> given = {};
  double constant = 0.0;
  std::optional<std::size_t> loss = {};  ///< of this contact; nothing else counts then
  /// Linear outputs at the points (base/along.hpp) of a finite element, r a polynomial through them; or at one place.
  struct Stretch {
    std::vector<Output> at;
    std::string from, to;           ///< nodes of the piece
    double begin = 0.0, end = 0.0;  ///< stations on it
    Fibre fibre = Fibre::both;      ///< of a stress
  };
  std::vector<Stretch> stretches = {};     ///< nothing else counts where there are any
  std::vector<std::string> contains = {};  ///< of a spring's force: "preload", "stiffness", "damper"
};

/// Calls `use` with the linear outputs that it is made of, in order: itself where it has no stretches.
template <class AnOutput, class Use>
void for_each_linear(AnOutput& output, const Use& use) {
  if (output.stretches.empty()) return use(output);
  for (auto& stretch : output.stretches)
    for (auto& at : stretch.at) use(at);
}

/// Whether it is no sum of motions and forces: no part of combinations.
[[nodiscard]] inline bool is_greatest(const Output& output) { return !output.stretches.empty(); }

/// "kN m", from the names of the scene's units.
[[nodiscard]] std::string unit_text(const Unit& unit, const Units& names);

}  // namespace signorini
