// step_guards.hpp: the guards in force, at both ends of a step of newmark.
//
//   g0, g1, g0', g1'      values; rates where displacements, velocities and accelerations tell them
//   noticed               what is not positive at the end, waits, or may dip in between: Bernstein's coefficients of the
//                         cubic through values and rates, and of the parabola through the last three values
//
// Most contacts are soft, and nothing drives them: their guards are forms of N, T, g, ut and rates of these. Of such the
// coefficients stand together, and are gathered anew where a contact's state has changed.
#pragma once

#include "engine/falls/arming.hpp"
#include "engine/falls/guard_path.hpp"
#include "engine/stepper.hpp"
#include "motion/point.hpp"

namespace signorini {

class StepGuards {
 public:
  explicit StepGuards(const Model& model);

  /// Those of a decision; what it points to must live as long as they are in force. Nothing is known of the motion.
  void start(const Segment& segment);
  /// Values and rates at the end of the step. The point, here and in level(): with accelerations.
  void weigh(const Point& point, double t);
  /// What ends a step begins the next one, and what was dismissed counts again.
  void turn();

  [[nodiscard]] const Arming& arming() const { return arming_; }
  [[nodiscard]] double value(std::size_t slot, double t, const Point& point) const;
  /// Below this its sign at `point` is rounding.
  [[nodiscard]] double level(std::size_t slot, double t, const Point& point) const;
  /// At both ends of a step of length h.
  [[nodiscard]] GuardPath path(std::size_t slot, double h) const {
    return {g0_[slot], g1_[slot], h * rate0_[slot], h * rate1_[slot]};
  }
  [[nodiscard]] bool has_rate(std::size_t slot) const { return has_rate_[slot] != 0; }
  /// Where a guard that is positive at both ends may fall between them: by its rates there, or by its values alone, where
  /// modes far above the step make the rates useless. h_before: of the step before; 0: there was none.
  [[nodiscard]] std::optional<double> dip(std::size_t slot, double h, double h_before) const;
  /// The step redone did not confirm its dip.
  void dismiss(std::size_t slot) { dismissed_.push_back(slot); }
  /// Slots that a step of length h has to look at, ascending; all others hold in it.
  [[nodiscard]] const std::vector<std::size_t>& noticed(double h, double h_before);
  /// At the end of a step without more to find: what waits may be armed.
  void see(double t, const Point& point);

 private:
  /// The nonzero coefficients of a guard, and whether it is one.
  struct Plain {
    double N = 0.0, T = 0.0, gap = 0.0, ut = 0.0, vn = 0.0, vt = 0.0, constant = 0.0;
  };
  /// What weigh() reads of a contact.
  struct Seen {
    bool watched = false;             // some guard is in force
    bool plain = false;               // they are forms as above, and so are its rows
    bool accelerates = false;         // a rate needs accelerations
    double gap = 0.0, surface = 0.0;  // that stands
    double normal_gap = 0.0, tangent_N = 0.0, tangent_ut = 0.0;
    std::array<Plain, guards_per_contact> guards{};
  };
  struct Term {
    std::size_t dof;
    double n, t;
  };
  void gather(std::size_t contact);
  void weigh_plain(std::size_t contact, const Point& point);
  void weigh_any(std::size_t contact, const Point& point, double t);
  [[nodiscard]] bool rates_known(std::size_t slot) const;

  const Model& model_;
  std::vector<Term> terms_;           // contact by contact
  std::vector<std::size_t> ends_{0};  // of each contact's
  Segment segment_;
  Mode mode_;  // that was gathered
  Arming arming_;
  std::vector<Seen> seen_;  // one a contact
  std::vector<double> before_, g0_, g1_, rate0_,
      rate1_;  // one a slot; before_: at the beginning of the step before
  std::vector<char> has_rate_;
  std::vector<std::size_t> waiting_, dismissed_, noticed_;
};

}  // namespace signorini
