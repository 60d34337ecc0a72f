// touching.hpp: rigid contacts that touch, from velocities to states.
//
//   hit:     g = 0, g' < 0        impact (decide/impact.hpp), then
//   leaves:  g' > 0               open
//   stays:   g' = 0               decided with all others that stay (decide/levels.hpp)
//
// What is slower than an acceleration undoes within the resolution of the clock is zero. The acceleration is
// known only once a state has been tried, so what is zero is found out in the course of a decision.
//
// Blocks of contacts that nothing couples are decided each on its own, at the price of one motion for all.
#pragma once

#include <limits>

#include "decide/decision.hpp"
#include "decide/guard_signs.hpp"
#include "decide/levels.hpp"
#include "decide/turns.hpp"

namespace signorini {

/// Contacts that move each other through M, C, K and contacts, ascending.
using Block = std::vector<std::size_t>;

/// What is known at an instant of the contacts whose forces may jump; lists: one entry a contact.
struct Findings {
  explicit Findings(std::size_t n)
      : decided(n, false),
        kinetic(n, false),
        bears_limit(n, false),
        stays(n, false),
        rests(n, false),
        departures(n, std::numeric_limits<double>::quiet_NaN()),
        known(n) {}
  bool hit = false;                ///< the last decision began with an impact
  bool sliders = false;            ///< sliders that stick rigidly take part
  bool grounded = false;           ///< a flight was taken as rest for its height alone
  bool unresolved = false;         ///< Decision::unresolved
  double slowest = 0.0;            ///< the greatest speed of leaving that was taken as rest
  std::vector<bool> decided;       ///< took part
  std::vector<bool> kinetic;       ///< its slip has begun: the static coefficient is gone
  std::vector<bool> bears_limit;   ///< others hold it: it stays at its static limit
  std::vector<bool> stays, rests;  ///< vn, vt count as zero
  /// The speed of leaving over that below which a contact stays; NaN: nobody asked.
  std::vector<double> departures;
  Eigen::VectorXd captures;  ///< Decision::captures; empty: none so far
  /// Adds impulses of rows 2 i, 2 i + 1 of the i-th of these contacts; empty: none.
  void capture(const Model& model, const std::vector<std::size_t>& contacts, const Eigen::VectorXd& impulses);
  /// The same, of all contacts.
  void capture(const Eigen::VectorXd& impulses);
  std::vector<KnownGuards> known;         ///< of those that touch
  std::vector<Participant> participants;  ///< of the last decision
};

class Touching {
 public:
  /// capture_velocity: of contacts that have none of their own.
  Touching(ModeSystems& systems, JetMaker& jets, double capture_velocity);

  /// Impacts where there are any, then the states of the given blocks. failed: the guards that led here.
  [[nodiscard]] Refusal decide(Instant& instant, const Forcing& forcing, const std::vector<MotionJet>& jets,
                               const std::vector<Failure>& failed, const std::vector<Block>& blocks,
                               Findings& found, Decision& decision, Mode& mode);

 private:
  /// Rigid contacts of a block with g = 0.
  struct Met {
    Block contacts;
    std::vector<Approach> approaches;  // one of each
    bool hit = false, apart = false;   // one closes; a gap is not exactly zero
    bool unresolved = false;           // one flies, but lower than the rounding of its data
  };
  struct Carried {
    double gap = 0.0, rate = 0.0;
  };
  /// Of a contact: a rebound below this speed rests.
  [[nodiscard]] double slowest_flight(std::size_t contact) const;
  [[nodiscard]] double rounding_of_gap(std::size_t contact, double of_data, const Instant& instant) const;
  [[nodiscard]] Carried carried_by(std::size_t contact, double da, const Instant& instant) const;
  [[nodiscard]] Met meet(const Instant& instant, const std::vector<MotionJet>& jets,
                         const std::vector<Failure>& failed, const Block& block, const Mode& mode) const;
  [[nodiscard]] bool lands_alike(const Approach& approach, const Instant& instant,
                                 const std::vector<MotionJet>& jets, const std::vector<Failure>& failed,
                                 const Block& block) const;
  [[nodiscard]] Refusal strike_once(Instant& instant, const Forcing& forcing, const Block& struck,
                                    const Block& block, Findings& found, Decision& decision, Mode& mode);
  [[nodiscard]] Refusal strike(Instant& instant, const Forcing& forcing, const Met& met, const Block& block,
                               Findings& found, Decision& decision, Mode& mode);
  void add_staying(const Instant& instant, const Forcing& forcing, const Met& met,
                   const std::vector<MotionJet>& free, const Decision& decision, Findings& found) const;
  void rest_together(const Instant& instant, const Forcing& forcing, const Mode& mode, Findings& found) const;
  [[nodiscard]] std::vector<std::size_t> sharing(const Instant& instant, const Forcing& forcing,
                                                 const Mode& mode, const Decision& decision) const;
  void add_sliders(const Instant& instant, const Forcing& forcing, const Met& met, const Block& block,
                   const Mode& mode, const Decision& decision, Findings& found) const;
  [[nodiscard]] bool presses_harder(std::size_t contact, const Vector& before, const Vector& after) const;
  void follow_velocity(const Instant& instant, const Vector& before, const Forcing& after, const Block& block,
                       const std::vector<ContactMotion>& motion, Mode& mode) const;
  [[nodiscard]] bool settle_resting(Instant& instant, const Forcing& forcing, const ModeSystem& free,
                                    const Met& met, Findings& found) const;
  [[nodiscard]] bool slide_anew(const Instant& instant, const Forcing& forcing, const Met& met,
                                Findings& found) const;
  [[nodiscard]] double rounding_of_slide(std::size_t contact, const Forcing& forcing,
                                         const Instant& instant) const;
  [[nodiscard]] bool add_sticking(const std::vector<Block>& blocks, const Mode& mode, Findings& found) const;
  [[nodiscard]] Refusal solve_levels(const Instant& instant, const Forcing& forcing,
                                     const std::vector<Block>& blocks, const Mode& old, Findings& found,
                                     Mode& mode);
  /// What becomes of a contact with g = 0 by its g', and that over the greatest with which it would stay.
  struct Departure {
    enum class How : unsigned char { stays, low, leaves } how;  // low: it would, but below its rounding
    double ratio = std::numeric_limits<double>::quiet_NaN();    // NaN: no speed is too low
  };
  [[nodiscard]] Departure departure(std::size_t contact, const MotionJet& free, double fell,
                                    const Instant& instant) const;

  const Model& model_;
  ModeSystems& systems_;
  JetMaker& jets_;
  double capture_velocity_;
  Impacts impacts_;
  Levels levels_;
};

}  // namespace signorini
