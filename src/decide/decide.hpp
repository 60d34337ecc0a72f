// decide.hpp: the states of all contacts just after an instant.
//
//   every guard g of the new states:  g, g', g'', ...  is lexicographically not negative
//
// Never a flipped flag: the next states are those whose guards hold on the solution to their right.
// Contacts whose guard fails take their next state (contact/transition.hpp), the jet is expanded again
// in the new mode, until all guards hold. Rigid contacts are decided together: velocities first where one
// closes with g' < 0 (decide/impact.hpp), then accelerations and their derivatives
// (decide/levels.hpp). Sliders without tangential stiffness join them if their own states repeat.
// If no mode is consistent the decision says so.
#pragma once

#include <algorithm>
#include <string>

#include "decide/impact.hpp"
#include "motion/jet.hpp"

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
  bool jump = false;   ///< the forcing is not smooth here
  double blur = 1.0;   ///< times the noise of a jet, below which its entries are zero
  bool start = false;  ///< of the run: what touches rigidly is decided even where nothing fails

  [[nodiscard]] bool has_fired(std::size_t contact, Guard guard) const {
    return std::any_of(fired.begin(), fired.end(),
                       [&](const Fired& f) { return f.contact == contact && f.guard == guard; });
  }
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
  ModeSystemPtr system;  ///< of `mode`; engines go on with it
  Vector u, v;
  Jet jet;
  std::vector<ContactMotion> before, after;  ///< one a contact
  std::vector<BodySlide> slides_before, slides_after;
  std::vector<GuardStart> guards;    ///< guards_per_contact a contact
  std::vector<Crossing> crossings;   ///< of the contacts visited
  std::vector<bool> visited;         ///< contacts that changed state in between, one a contact
  std::vector<bool> jumped;          ///< contacts whose N or T jumps
  std::vector<Impulse> impulses;     ///< one a contact, where rigid contacts were hit; else empty
  double impact_loss = 0.0;          ///< energy that the impacts dissipate
  double impact_surface_work = 0.0;  ///< that moving surfaces do in them
  bool impact_gains = false;         ///< an impact gained energy (Newton's law with friction)
  int rounds = 0;
};

/// A first guess of the states from displacements and velocities at the start.
[[nodiscard]] Mode first_mode(const Model& model, const Forcing& forcing, double t, const Vector& u,
                              const Vector& v);

/// Why a mode cannot be put in force.
inline constexpr const char* dependent_rows =
    "the rows of the contacts that stick are linearly dependent, so their forces are not unique";

/// "'first' (compression), 'second' (gap)": of anything with a contact and a guard.
template <class Guarded>
[[nodiscard]] std::string names_of(const Model& model, const std::vector<Guarded>& list) {
  std::string text;
  for (const Guarded& g : list)
    text += (text.empty() ? "'" : ", '") + model.contacts[g.contact].name + "' (" + to_string(g.guard) + ")";
  return text;
}

struct Participant;  // decide/levels.hpp

class Decider {
 public:
  /// capture_velocity: of rigid contacts that have none of their own.
  Decider(ModeSystems& systems, int max_rounds, double capture_velocity);

  /// `before` and `after`: the forcing on both sides of the instant.
  [[nodiscard]] Decision decide(Instant instant, const Forcing& before, const Forcing& after);
  /// Takes the states of `mode` as they are, from an engine that finds states itself and no instants:
  /// forces and accelerations that follow from them, the same before and after.
  [[nodiscard]] Decision adopt(const Instant& instant, const Mode& mode, const Forcing& forcing);

 private:
  struct Failure {
    std::size_t contact;
    Guard guard;
    Form form = {};
  };
  [[nodiscard]] std::vector<Failure> failures(const std::vector<MotionJet>& jets, const Mode& mode,
                                              const Instant& instant, bool first,
                                              const std::vector<bool>& touching) const;
  void follow_forcing(const Instant& instant, const Forcing& before, const Forcing& after,
                      const std::vector<ContactMotion>& motion, Mode& mode) const;
  bool evaluate(const Instant& instant, const Forcing& after, const Mode& mode, Decision& decision,
                std::vector<MotionJet>& jets);
  /// What is known at an instant of the contacts whose forces may jump.
  struct Joint {
    bool sliders = false;                ///< sliders that stick rigidly take part
    std::vector<bool> decided, kinetic;  ///< one a contact
    // What is slower than an acceleration undoes within the resolution of the clock is zero. The acceleration
    // is known only once a state has been tried, so these are found out in the course of a decision.
    std::vector<bool> stays, rests;  ///< vn, vt count as zero
    std::vector<bool> touching;      ///< g is zero
    explicit Joint(std::size_t n)
        : decided(n, false), kinetic(n, false), stays(n, false), rests(n, false), touching(n, false) {}
  };
  [[nodiscard]] std::string decide_jointly(Instant& instant, const Forcing& after, Joint& joint,
                                           Decision& decision, const std::vector<MotionJet>& jets,
                                           const std::vector<Failure>& failed,
                                           const std::vector<std::size_t>& group, Mode& mode);
  [[nodiscard]] bool has_rigid(const std::vector<std::size_t>& group) const;
  void follow_velocity(const Instant& instant, const Forcing& after, const std::vector<ContactMotion>& before,
                       Mode& mode) const;
  void settle_resting(Instant& instant, const Forcing& forcing, const ModeSystem& free,
                      const std::vector<std::size_t>& touching,
                      const std::vector<Participant>& participants) const;
  [[nodiscard]] double rounding_of_slide(std::size_t contact, const Forcing& forcing,
                                         const Instant& instant) const;
  [[nodiscard]] double leaving_velocity(std::size_t contact, const MotionJet& free,
                                        const Instant& instant) const;
  [[nodiscard]] std::vector<BodySlide> slides(const Forcing& forcing, double t, const Vector& u,
                                              const Vector& v) const;

  const Model& model_;
  ModeSystems& systems_;
  JetMaker jets_;
  int max_rounds_;
  double capture_velocity_;
  Impacts impacts_;
  std::vector<std::vector<std::size_t>> groups_;  // of contacts that move each other: decided each on its own
};

}  // namespace signorini
