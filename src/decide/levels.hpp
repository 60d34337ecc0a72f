// joint_decision.hpp: the next states of all contacts whose forces may jump, at one instant together.
//
//   order k = 0, 1, 2, ...:  r^(k) = b^(k) + W f^(k)        r: g'' and ut'' of the contacts that are
//   undecided
//
// Rigid contacts with g = g' = 0 and sliders that stick rigidly move each other through M. On the level of
// accelerations that is a joint problem (decide/coulomb_problem.hpp) with the forces as unknowns. A contact
// whose force and acceleration are both zero, or whose friction is just at its limit, stays undecided and
// goes into the same problem of the next derivative, with all decided ones in force. What is undecided after
// the last known derivative stays as it was.
//
// A problem without solution, or with several, is Painleve's: friction couples the tangent to the normal so
// strongly that pressing a sliding contact pushes it into the ground. It is refused with its numbers.
// Source: Glocker 2001, chapters 4 to 6; Painleve 1895.
#pragma once

#include <string>

#include "decide/coulomb_problem.hpp"
#include "decide/decide.hpp"
#include "decide/delassus.hpp"

namespace signorini {

/// A contact that takes part, and what is known of it beforehand.
struct Participant {
  std::size_t contact = 0;
  bool slipping = false;  ///< t . v is not the surface's velocity: it slides along `sign`
  int sign = 0;
  double sliding_friction = 0.0;  ///< coefficient while it slips, at its slip rate
  bool kinetic = false;           ///< its slip has begun at this instant: the static coefficient is gone
};

class JointDecision {
 public:
  JointDecision(ModeSystems& systems, JetMaker& jets)
      : model_(systems.model()), systems_(systems), jets_(jets) {}

  /// Changes the states of the participants, open in `mode`; old: what they were. Returns an empty text, or
  /// why there are none.
  [[nodiscard]] std::string decide(const Instant& instant, const Forcing& forcing,
                                   const std::vector<Participant>& participants, const Mode& old, Mode& mode);

 private:
  enum class Standing : unsigned char { apex, limit, decided };
  struct Entry {
    Participant who;
    Standing standing = Standing::apex;
  };
  [[nodiscard]] JointItem item_of(const Entry& entry, const Forcing& forcing, double t) const;
  [[nodiscard]] std::string refusal(const JointProblem& problem, const std::vector<std::size_t>& contacts,
                                    bool several) const;

  const Model& model_;
  ModeSystems& systems_;
  JetMaker& jets_;
};

}  // namespace signorini
