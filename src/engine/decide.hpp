// decide.hpp: the states of all contacts just after an instant.
//
//   every guard g of the new states:  g, g', g'', ...  is lexicographically not negative
//
// Never a flipped flag: the next states are those whose guards hold on the solution to their right.
// Contacts whose guard fails take their next state (contact/transition.hpp), the jet is expanded again
// in the new mode, until all guards hold; if the states repeat, the contacts without tangential
// stiffness that changed are tried in all combinations. If none is consistent the decision says so.
#pragma once

#include <string>

#include "engine/jet.hpp"

namespace signorini {

/// A guard that an integrator found at zero.
struct Fired {
  std::size_t contact = 0;
  Guard guard = Guard::none;
};

struct Instant {
  double t = 0.0;
  double resolution = 0.0;  ///< events closer than this in time are one instant
  Vector u, v;
  Mode mode;  ///< just before
  std::vector<Fired> fired;
  bool jump = false;  ///< the forcing is not smooth here
};

/// One guard in force after the decision.
struct GuardStart {
  Guard kind = Guard::none;
  Form form;
  bool at_zero = false;  ///< starts at zero and rises
  double noise = 0.0;    ///< rounding of its value at the start
  int leading = 0;       ///< order of its first derivative that is not zero; -1: none is known
};

/// The guard whose failure changed a contact's state.
struct Crossing {
  Form form;
  bool failed = false;
  std::array<double, MotionJet::orders - 1> derivatives{};  ///< g', g'', ... just before, in the old mode
  double noise = 0.0;                                       ///< rounding of its value
};

struct Decision {
  bool consistent = false;
  std::string reason;  ///< why not: contacts, guards
  Mode mode;
  Vector u, v;
  Jet jet;
  std::vector<ContactMotion> before, after;  ///< one a contact
  std::vector<BodySlide> slides_before, slides_after;
  std::vector<GuardStart> guards;   ///< guards_per_contact a contact
  std::vector<Crossing> crossings;  ///< of the contacts visited
  std::vector<bool> visited;        ///< contacts that changed state in between, one a contact
  std::vector<bool> jumped;         ///< contacts whose N or T jumps
  int rounds = 0;
};

/// A first guess of the states from displacements and velocities at the start.
[[nodiscard]] Mode first_mode(const Model& model, const Forcing& forcing, double t, const Vector& u,
                              const Vector& v);

class Decider {
 public:
  Decider(const Model& model, Expander& expander, int max_rounds)
      : model_(model), expander_(expander), max_rounds_(max_rounds) {}

  /// `before` and `after`: the forcing on both sides of the instant.
  [[nodiscard]] Decision decide(Instant instant, const Forcing& before, const Forcing& after) const;
  /// Takes the states of `mode` as they are, from an engine that finds states itself and no instants:
  /// forces and accelerations that follow from them, the same before and after.
  [[nodiscard]] Decision adopt(const Instant& instant, const Mode& mode, const Forcing& forcing) const;

 private:
  struct Failure {
    std::size_t contact;
    Guard guard;
    Form form = {};
  };
  [[nodiscard]] std::vector<Failure> failures(const std::vector<MotionJet>& jets, const Mode& mode,
                                              const Instant& instant, bool first) const;
  void follow_forcing(const Instant& instant, const Forcing& before, const Forcing& after,
                      const std::vector<ContactMotion>& motion, Mode& mode) const;
  bool evaluate(const Instant& instant, const Forcing& after, const Mode& mode, Decision& decision,
                std::vector<MotionJet>& jets) const;
  bool enumerate(const Instant& instant, const Forcing& after, Decision& decision,
                 std::vector<MotionJet>& jets) const;
  [[nodiscard]] std::vector<BodySlide> slides(const Forcing& forcing, double t, const Vector& u,
                                              const Vector& v) const;
  [[nodiscard]] std::string describe(const std::vector<Failure>& failures) const;

  const Model& model_;
  Expander& expander_;
  int max_rounds_;
};

}  // namespace signorini
