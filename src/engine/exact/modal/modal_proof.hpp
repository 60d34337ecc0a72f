// modal_proof.hpp: intervals without a zero of a guard, adapted to the amplitudes of the modes.
//
//   g(t0 + h x) = sum of slow modes (a polynomial in x) + fast modes,   |fast modes| <= sum |w_k| A_k
//
// A_k is the amplitude of mode k and w_k its coefficient in the guard. The modes below J are slow. J is
// chosen so that the modes above J together stay below a quarter of every guard; h = 4 / omega_J. There is no
// zero as long as the slow part exceeds the bound on the fast modes, the remainder of the polynomial and
// rounding (engine/events/first_root.hpp). If this holds on a part of the step only, the next step continues
// there with more slow modes.
//
// A zero crossing is an event if the rate of the guard, fast modes included, is negative on the whole
// interval that may contain it. The closed form with all modes then has exactly one zero there. A guard that
// starts at zero is represented by its first nonzero derivative. The proof relies on the computed modes,
// which are tested by their residual.
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
//   otherwise                         undecided beyond the zero of p - 2 (R + slack)
//
// A guard that starts at zero is represented by its first nonzero derivative: p is then that derivative.

/// A guard on a step, x in [0, 1].
struct GuardOnStep {
  std::vector<double> p;  ///< coefficients of p; if leading > 0, of the time derivative of that order
  double slack = 0.0, fast_bound = 0.0, fast_rate_bound = 0.0;  ///< bounds for g, g, g' (by time), or for p
  double noise = 0.0;
  std::size_t leading_order = 0;
  bool armed = false;  ///< the guard was clearly positive
};

/// Coefficients of the time derivative of order m of a polynomial in t / h.
[[nodiscard]] std::vector<double> derivative_of(const std::vector<double>& p, std::size_t m, double h);

/// Examines one guard on a step. event: place of the first zero of all guards so far; limit: place up to
/// which no guard reaches zero. value_at(x): the guard in closed form. False: the prediction by the guard's
/// derivatives at the start is refuted and no longer used.
[[nodiscard]] bool find_guard_zero(GuardOnStep& guard, std::size_t slot, double h,
                                   const std::function<double(double)>& value_at,
                                   events::ActiveGuards& arming, Passage& passage, double& limit,
                                   double& event);

/// The passage of a step whose guards have been examined, limited by `limit` and `event`. doubted: the
/// prediction of a guard has just been refuted. nullopt: the step must be repeated; `full` is then set unless
/// doubted, so that all modes are slow. h: length of the step.
[[nodiscard]] std::optional<Passage> end_of_step(Passage passage, bool doubted, double limit, double event,
                                                 double h, bool& full);

/// The greatest s <= 1 such that sign a(x x_end) + above > 0 on [0, s]; p: scratch for degree + 1 numbers.
[[nodiscard]] double stays_above(const double* a, std::size_t degree, double x_end, double sign, double above,
                                 std::vector<double>& p);

/// Kinematic quantities of a contact.
struct ModalKinematics {
  double gap = 0.0, ut = 0.0, vn = 0.0, vt = 0.0;
};

class ModalProof {
 public:
  ModalProof(const Model& model, double alpha);

  /// forces: constant, in modes. The state must live until the next start.
  void start(const engine::Segment& segment, const StateModes& state, const Oscillators& oscillators,
             const Amplitudes& forces);
  [[nodiscard]] Passage pass(const ModalPoint& at, double remaining);
  /// Called after a passage without an event: updates the armed guards.
  void rearm(const ModalPoint& at);
  /// Sum of the magnitudes of a guard's terms.
  [[nodiscard]] double magnitude(std::size_t slot, const ModalPoint& at) const;
  [[nodiscard]] ModalKinematics kinematics(std::size_t contact, const ModalPoint& at) const;
  [[nodiscard]] ForceLaw law(std::size_t contact) const { return laws_[contact]; }

  // Interface required by modal_flow.hpp.
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
  static constexpr double max_slow_angle = 4.0;  // rad of the fastest slow mode in a step
  static constexpr double max_decay = 2.0;       // alpha h
  static constexpr double never = 1e300;

  struct Watched {
    std::size_t slot = 0;
    ModalKinematics form;
    double constant = 0.0, noise = 0.0;
    Amplitudes place, rate;                          // coefficients of z and z' in the guard
    std::vector<double> size;                        // |place| + |rate| sqrt(l), real modes
    double now = 0.0;                                // value of the guard, or of its leading derivative
    double fast_bound = 0.0, fast_rate_bound = 0.0;  // for the leading derivative if starts_at_zero()
  };
  struct Size {
    double place = 0.0, rate = 0.0;
  };
  using WatchedValues = std::array<double, 4>;  // N, T, g, ut, as TurningPointDetector::watched_fields
  [[nodiscard]] WatchedValues fast_bounds(std::size_t contact, bool of_rate) const;
  [[nodiscard]] WatchedValues one_way(std::size_t contact, double x_end, std::vector<double>& p) const;
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
  /// The guard starts at zero, and its leading derivative is watched.
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
  std::vector<std::vector<double>> static_normal_, static_tangent_;  // sums of a_k p_k / l_k from k on
  std::vector<double> amplitude_, pair_amplitude_, coefficients_;
  std::vector<Complex> pair_coefficients_;
  std::vector<Size> normal_size_, tangent_size_;  // sums of magnitudes, for rounding bounds
  std::vector<Size> normal_rest_, tangent_rest_;
  std::vector<motion::ContactSeries> slow_;
  std::vector<bool> pair_slow_;
  std::size_t fast_ = 0, degree_ = 0, count_ = 0;  // number of slow modes; degree and length of their series
  double h_ = 0.0;
  bool all_slow_ = false;  // the next step treats all modes as slow
};

}  // namespace signorini::modal
