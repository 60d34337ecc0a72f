// modal_proof.hpp: finds intervals that provably contain no zero of a guard; their length depends on the mode amplitudes.
//
//   g(t0 + h x) = sum of slow modes (a polynomial in x) + fast modes,   |fast modes| <= sum |w_k| A_k
//
// A_k is the amplitude of mode k and w_k its coefficient in the guard. Modes with an index below J are slow. J is chosen so
// that the fast modes together contribute less than a quarter of every guard; the step length is h = 4 / omega_J. A guard has
// no zero as long as its slow part exceeds the sum of the bound on the fast modes, the remainder of the polynomial and rounding
// (engine/events/first_root.hpp). If a guard satisfies this condition only on a part of the step, the next step starts at the
// end of this part, with more slow modes.
//
// A zero crossing is an event if the rate of the guard, fast modes included, is negative on the whole interval that may contain
// the crossing. The closed form with all modes then has exactly one zero in this interval. A guard that starts at zero is
// represented by its first nonzero derivative. The proof relies on the computed modes; their accuracy is tested by converting a
// motion to modes and back.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "engine/events/active_guards.hpp"
#include "engine/exact/modal/modal_flow.hpp"
#include "engine/exact/modal/modal_system.hpp"
#include "motion/contact_series.hpp"

namespace signorini::modal {

// Possible and certain zeros of a guard on a step: a polynomial plus a bounded fast part.
//
//   g(t + h x) = p(x) + fast part,  |fast part| <= R,  |rate of the fast part| <= R',  |error of p| <= slack
//   p > R + slack                     no zero
//   p decreases through +-(R + slack) in an interval with p' < -R' h:   one zero, located by the closed form
//   otherwise                         undecided: the step ends at the first zero of p - 2 (R + slack)
//
// If a guard starts at zero, p is its first nonzero time derivative instead of the guard itself.

/// A guard g(t + h x) on a step of length h, 0 <= x <= 1.
struct GuardOnStep {
  std::vector<double>
      p;  ///< coefficients of p: the guard or, if leading_order > 0, its derivative of this order
  double slack = 0.0, fast_bound = 0.0,
         fast_rate_bound = 0.0;   ///< slack, R and R' (per time) of p
  double noise = 0.0;             ///< rounding bound of the guard at the beginning of the segment
  std::size_t leading_order = 0;  ///< see ActiveGuards::leading_order()
  bool armed = false;             ///< see ActiveGuards::armed()
};

/// Coefficients of the time derivative of order m of a polynomial p in t / h.
[[nodiscard]] std::vector<double> derivative_of(const std::vector<double>& p, std::size_t m, double h);

/// Examines one guard on a step of length h. value_at(x): the guard in closed form. Updates the results for all guards so far:
/// limit, the place x up to which no guard is undecided; event, the place of the first zero; and passage. False: the guard does
/// not rise as its leading derivative predicts; this derivative is discarded, and the step must be repeated.
[[nodiscard]] bool find_guard_zero(GuardOnStep& guard, std::size_t slot, double h,
                                   const std::function<double(double)>& value_at,
                                   events::ActiveGuards& arming, Passage& passage, double& limit,
                                   double& event);

/// Ends a step of length h after all guards have been examined: the passage extends to the smaller of `limit` and `event`.
/// doubted: find_guard_zero() has returned false for a guard. nullopt: the step must be repeated. full: set to true if the next
/// attempt or step must treat all modes as slow.
[[nodiscard]] std::optional<Passage> end_of_step(Passage passage, bool doubted, double limit, double event,
                                                 double h, bool& full);

/// The greatest s <= 1 for which sign * a(x x_end) + above > 0 on 0 <= x <= s, where a(x) is the polynomial with the
/// coefficients a. p: work array.
[[nodiscard]] double stays_above(const double* a, std::size_t degree, double x_end, double sign, double above,
                                 std::vector<double>& p);

/// Gap, tangential displacement and their rates at a contact, or the coefficients of these quantities in a guard.
struct ModalKinematics {
  double gap = 0.0, ut = 0.0, vn = 0.0, vt = 0.0;
};

class ModalProof {
 public:
  ModalProof(const Model& model, double alpha);

  /// Starts a segment. forces: constant modal forces. All references must stay valid until the next start.
  void start(const engine::Segment& segment, const StateModes& state, const Oscillators& oscillators,
             const Amplitudes& forces);
  [[nodiscard]] Passage pass(const ModalPoint& at, double remaining);
  /// See ModalFlow::rearm().
  void rearm(const ModalPoint& at);
  /// See ModalFlow::magnitude().
  [[nodiscard]] double magnitude(std::size_t slot, const ModalPoint& at) const;
  [[nodiscard]] ModalKinematics kinematics(std::size_t contact, const ModalPoint& at) const;
  [[nodiscard]] ForceLaw law(std::size_t contact) const { return laws_[contact]; }

  // Functions of a Proof in modal_flow.hpp (find_turning_points_in_passage).
  [[nodiscard]] double step_length() const { return h_; }
  [[nodiscard]] double length_without_turning(const ModalPoint& at, const events::TurningPointDetector& known,
                                              double x_end) const;
  double expand_for_turning(const ModalPoint& at, const events::TurningPointDetector& known, double share,
                            double remaining);
  void find_turning_at_start(const ModalPoint& at, double time, events::TurningPointDetector& turning,
                             LastTurningTimes& turns) const;
  [[nodiscard]] const std::vector<motion::ContactSeries>& series(const ModalPoint& /*at*/) const {
    return slow_;
  }

 private:
  static constexpr double max_slow_angle = 4.0;  // largest phase angle of a slow mode in a step, rad
  static constexpr double max_decay = 2.0;       // largest alpha h of a step
  static constexpr double never = 1e300;

  struct Watched {
    std::size_t slot = 0;
    ModalKinematics form;
    double constant = 0.0, noise = 0.0;
    Amplitudes place, rate;                          // coefficients of z and z' in the guard
    std::vector<double> size;                        // |place| + |rate| sqrt(l) of real modes
    double now = 0.0;                                // value of the guard, or of its leading derivative
    double fast_bound = 0.0, fast_rate_bound = 0.0;  // R and R' of the guard, or of its leading derivative
  };
  struct Size {
    double place = 0.0, rate = 0.0;
  };
  using WatchedValues = std::array<double, 4>;  // N, T, g, ut: order of TurningPointDetector::watched_fields
  [[nodiscard]] WatchedValues fast_bounds(std::size_t contact, bool of_rate) const;
  [[nodiscard]] WatchedValues monotone_parts(std::size_t contact, double x_end, std::vector<double>& p) const;
  void watch(const engine::Segment& segment, const StateModes& state);
  [[nodiscard]] double value(const Watched& guard, const ModalPoint& at) const;
  [[nodiscard]] double derivative(const Watched& guard, const ModalPoint& at) const;
  void measure(const ModalPoint& at);
  void split_modes(bool all_slow);
  [[nodiscard]] std::size_t first_fast() const;
  void choose_step(double remaining);
  void bound_fast_modes();
  void expand_real(const ModalPoint& at);
  void expand_modes(const ModalPoint& at);
  [[nodiscard]] Size sum(const Amplitudes& row, double still, std::vector<double>& out) const;
  void expand(const ModalPoint& at);
  void combine(const Watched& guard, std::vector<double>& p, double& slack) const;
  [[nodiscard]] bool find_zero(const Watched& guard, const ModalPoint& at, Passage& passage, double& limit,
                               double& event);
  /// True if the guard started at zero and is represented by its leading derivative.
  [[nodiscard]] bool starts_at_zero(const Watched& guard) const {
    return active_guards_.leading_order(guard.slot) > 0;
  }
  [[nodiscard]] bool unknown(const Watched& guard) const {
    return !active_guards_.armed(guard.slot) && !starts_at_zero(guard);
  }
  [[nodiscard]] double order_of(const Watched& guard) const {
    return static_cast<double>(active_guards_.leading_order(guard.slot));
  }
  [[nodiscard]] double weight_of(const Watched& guard, std::size_t k) const;

  const Model& model_;
  double alpha_;
  const StateModes* state_ = nullptr;
  const Oscillators* oscillators_ = nullptr;
  const Amplitudes* forces_ = nullptr;
  const decide::Decision* decision_ = nullptr;
  std::vector<ForceLaw> laws_;
  std::vector<double> surface_;
  events::ActiveGuards active_guards_;
  std::vector<Watched> guards_;
  // [c][k]: static values of n . u and t . u of contact c due to all real modes i >= k: sum of a_i p_i / l_i
  std::vector<std::vector<double>> static_normal_, static_tangent_;
  std::vector<double> amplitude_, pair_amplitude_, coefficients_;
  std::vector<Complex> pair_coefficients_;
  std::vector<Size> normal_size_, tangent_size_;  // sums of magnitudes of terms, for rounding bounds
  std::vector<Size> normal_rest_, tangent_rest_;  // bounds on the remainders of the slow modes' polynomials
  std::vector<motion::ContactSeries> slow_;
  std::vector<bool> pair_slow_;
  std::size_t fast_ = 0, degree_ = 0, count_ = 0;  // number of slow modes; degree and length of their series
  double h_ = 0.0;
  bool all_slow_ = false;  // the next step treats all modes as slow
};

}  // namespace signorini::modal
