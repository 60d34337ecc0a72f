// output.hpp: a response quantity, either a linear functional of the motion or the maximum of several of them.
//
//   r(t) = u.u + v.v + a.a + sum_k ( N_k N + T_k T ) + sum_i h_i(t) + constant + loss of a contact
//          + sum_k c_k ( |N| - N_0 ) t.u                 only pendulums with a varying normal force
//
// Envelopes and largest stresses are the maximum of |r| over segments of members (Output::Segment).
//
// u, v, a are forms on the model's degrees of freedom. Given terms (loads within a member, moving supports, base motion) are
// in the histories h_i, weight is in the constant. All terms have the unit of the output. A term of a load contains the name
// of the load, because Steering may replace the load's history during a run.
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
  /// factor (|N| - scene_force) slip . u: restoring force of a pendulum's surface in addition to the force of its spring. The
  /// stiffness of the spring corresponds to the normal force `scene_force`.
  struct Restoring {
    std::size_t contact = 0;
    Combination slip = {};
    /// factor: unit of the output / (force length); scene_force: force
    double factor = 0.0, scene_force = 0.0;
  };
  std::vector<Restoring> restoring = {};
  struct Given {
    History history;        ///< in the unit of the output
    std::string load = {};  ///< name of the load in Model::loads; empty: the term belongs to no load
    double factor = 1.0;    ///< ratio of `history` to the history of the load
    Unit load_unit = {};    ///< unit of the load's history
  };
  std::vector<Given> given = {};
  double constant = 0.0;
  /// Index of the contact whose friction loss is the output; other terms are then ignored.
  std::optional<std::size_t> loss = {};
  /// Linear outputs at the points (base/curves.hpp) of a finite element, between which r is the interpolating polynomial; or
  /// one linear output at a single place.
  struct Segment {
    std::vector<Output> at;
    std::string from, to;           ///< nodes of the piece
    double begin = 0.0, end = 0.0;  ///< stations on the piece, from 0 to 1
    Fibre fibre = Fibre::both;      ///< fibre of a stress
  };
  std::vector<Segment> segments = {};  ///< if not empty, all other terms are ignored
  /// Contributions to a spring's force: "preload", "stiffness", "damper".
  std::vector<std::string> contains = {};
};

/// Calls `use` with each linear output of this output, in order: with the output itself if it has no segments.
template <class AnOutput, class Use>
void for_each_linear(AnOutput& output, const Use& use) {
  if (output.segments.empty()) return use(output);
  for (auto& segment : output.segments)
    for (auto& at : segment.at) use(at);
}

/// True if the output is a maximum; such an output is nonlinear and cannot be part of a combination.
[[nodiscard]] inline bool is_envelope(const Output& output) { return !output.segments.empty(); }

/// Unit as text, for example "kN m", from the names of the scene's units.
[[nodiscard]] std::string unit_text(const Unit& unit, const Units& names);

}  // namespace signorini
