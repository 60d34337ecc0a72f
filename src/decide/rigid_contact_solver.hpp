// rigid_contact_solver.hpp: decides the states of touching rigid contacts from velocities and accelerations.
//
//   1. a contact with g = 0, g' < 0 is hit: impact (decide/impact.hpp)
//   2. a contact with g' > 0 leaves: open
//   3. contacts with g' = 0 stay: they are decided together (decide/derivative_levels.hpp)
//
// A velocity is treated as zero if an acceleration compensates it within the resolution of time. Since accelerations are known
// only after states have been tried, such velocities are found during a decision.
//
// Blocks of contacts that are not coupled are decided separately, but their motion is computed together.
#pragma once

#include <limits>

#include "decide/decision.hpp"
#include "decide/derivative_levels.hpp"
#include "decide/guard_signs.hpp"
#include "decide/impact.hpp"

namespace signorini::decide {

/// A block: contacts that are coupled through M, C, K or other contacts; indices, ascending.
using Block = std::vector<std::size_t>;

/// Results of one decision about contacts whose forces may jump. Lists have one entry per contact.
struct ImpactResult {
  explicit ImpactResult(std::size_t n)
      : decided(n, false),
        kinetic(n, false),
        stays_at_limit(n, false),
        stays(n, false),
        rests(n, false),
        departures(n, std::numeric_limits<double>::quiet_NaN()),
        known(n) {}
  bool hit = false;      ///< true: the last round began with an impact
  bool sliders = false;  ///< true: sliders that stick rigidly are decided with the rigid contacts
  bool flight_taken_as_rest = false;  ///< true: a flight was replaced by rest only because it is low
  bool unresolved = false;            ///< see Decision::unresolved
  double max_rest_speed = 0.0;        ///< largest g' that was treated as rest; length/time
  std::vector<bool> decided;          ///< true: the contact was decided together with other contacts
  std::vector<bool> kinetic;          ///< true: slip has begun, so the static coefficient does not apply
  std::vector<bool> stays_at_limit;   ///< true: at the static limit, but other contacts prevent slip
  std::vector<bool> stays, rests;     ///< true: g' (stays) or ut' (rests) is treated as zero
  /// Ratio of g' to the speed below which the contact stays closed; NaN: not computed.
  std::vector<double> departures;
  Eigen::VectorXd capture_impulses;  ///< see Decision::capture_impulses; empty: none so far
  /// Adds impulses to capture_impulses. Rows of `impulses`: places of the listed contacts (decide/coulomb_problem.hpp).
  /// Empty: none.
  void capture(const Model& model, const std::vector<std::size_t>& contacts, const Eigen::VectorXd& impulses);
  /// Same for impulses on all contacts, in the order of forces.
  void capture(const Eigen::VectorXd& impulses);
  std::vector<KnownGuards> known;         ///< known signs of the guards of touching contacts
  std::vector<Participant> participants;  ///< contacts decided together in the last round
};

class RigidContactSolver {
 public:
  /// capture_velocity: value for contacts without their own value.
  RigidContactSolver(motion::StateSystems& systems, motion::JetMaker& jets, double capture_velocity);

  /// Computes impacts of contacts that close, and then decides `states` of the given blocks. On entry `states` are the states
  /// tried last; jets: motion in these states; failed: guards that fail in this motion.
  [[nodiscard]] Refusal decide(Instant& instant, const motion::Forcing& forcing,
                               const std::vector<MotionJet>& jets, const std::vector<FailedGuard>& failed,
                               const std::vector<Block>& blocks, ImpactResult& found, Decision& decision,
                               contact::ContactStates& states);

 private:
  /// Rigid contacts of a block that touch (g = 0).
  struct TouchingContacts {
    Block contacts;
    std::vector<Approach> approaches;  // one entry per contact
    bool hit = false, apart = false;   // hit: a contact closes; apart: a gap is not exactly 0
    bool unresolved = false;           // true: a flight is lower than the rounding error of the gap
  };
  /// Rounding errors of g and g' accumulated since the contact's last touch.
  struct AccumulatedRounding {
    double gap = 0.0, rate = 0.0;
  };
  /// Speed below which a rebound of the contact is treated as rest.
  [[nodiscard]] double min_flight_speed(std::size_t contact) const;
  [[nodiscard]] double rounding_of_gap(std::size_t contact, double of_data, const Instant& instant) const;
  [[nodiscard]] AccumulatedRounding accumulated_rounding(std::size_t contact, double da,
                                                         const Instant& instant) const;
  [[nodiscard]] TouchingContacts find_touching(const Instant& instant, const std::vector<MotionJet>& jets,
                                               const std::vector<FailedGuard>& failed, const Block& block,
                                               const contact::ContactStates& states) const;
  [[nodiscard]] bool closes_with_others(const Approach& approach, const Instant& instant,
                                        const std::vector<MotionJet>& jets,
                                        const std::vector<FailedGuard>& failed, const Block& block) const;
  [[nodiscard]] Refusal apply_impact(Instant& instant, const motion::Forcing& forcing, const Block& struck,
                                     const Block& block, ImpactResult& found, Decision& decision,
                                     contact::ContactStates& states);
  [[nodiscard]] Refusal apply_impacts(Instant& instant, const motion::Forcing& forcing,
                                      const TouchingContacts& met, const Block& block, ImpactResult& found,
                                      Decision& decision, contact::ContactStates& states);
  void add_staying_contacts(const Instant& instant, const motion::Forcing& forcing,
                            const TouchingContacts& met, const std::vector<MotionJet>& free,
                            const Decision& decision, ImpactResult& found) const;
  void stop_constrained_participants(const Instant& instant, const motion::Forcing& forcing,
                                     const contact::ContactStates& states, ImpactResult& found) const;
  [[nodiscard]] std::vector<std::size_t> sharing(const Instant& instant, const motion::Forcing& forcing,
                                                 const contact::ContactStates& states,
                                                 const Decision& decision) const;
  void add_sliders(const Instant& instant, const motion::Forcing& forcing, const TouchingContacts& met,
                   const Block& block, const contact::ContactStates& states, const Decision& decision,
                   ImpactResult& found) const;
  [[nodiscard]] bool compression_jumps_up(std::size_t contact, const Vector& before,
                                          const Vector& after) const;
  void update_states_after_impact(const Instant& instant, const Vector& before, const motion::Forcing& after,
                                  const Block& block, const std::vector<ContactMotion>& motion,
                                  contact::ContactStates& states) const;
  [[nodiscard]] bool set_resting_velocities(Instant& instant, const motion::Forcing& forcing,
                                            const motion::StateSystem& free, const TouchingContacts& met,
                                            ImpactResult& found) const;
  [[nodiscard]] bool update_slip_directions(const Instant& instant, const motion::Forcing& forcing,
                                            const TouchingContacts& met, ImpactResult& found) const;
  [[nodiscard]] double slip_rate_tolerance(std::size_t contact, const motion::Forcing& forcing,
                                           const Instant& instant) const;
  [[nodiscard]] bool add_sticking_sliders(const std::vector<Block>& blocks,
                                          const contact::ContactStates& states, ImpactResult& found) const;
  [[nodiscard]] Refusal solve_levels(const Instant& instant, const motion::Forcing& forcing,
                                     const std::vector<Block>& blocks, const contact::ContactStates& old,
                                     ImpactResult& found, contact::ContactStates& states);
  /// Result for a contact with g = 0: it stays or leaves. ratio: g' / largest g' at which the contact stays.
  struct Departure {
    // low: the contact leaves, but its flight is too slow or too low to be computed.
    enum class Type : unsigned char { stays, low, leaves } type;
    double ratio = std::numeric_limits<double>::quiet_NaN();  // NaN: no acceleration closes the gap again
  };
  [[nodiscard]] Departure departure(std::size_t contact, const MotionJet& free, double pull_before,
                                    const Instant& instant) const;

  const Model& model_;
  motion::StateSystems& systems_;
  motion::JetMaker& jets_;
  double capture_velocity_;
  ImpactSolver impacts_;
  DerivativeLevels levels_;
};

}  // namespace signorini::decide
