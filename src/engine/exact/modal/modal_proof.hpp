// modal_proof.hpp: how far no guard falls, on intervals that adapt to the amplitudes of the modes.
//
//   g(t0 + h x) = sum of slow modes (a polynomial in x) + ripple of fast modes,   |ripple| <= sum |w_k| A_k
//
// A_k is the amplitude of mode k and w_k what the guard shows of it. Slow are the modes below J, where the
// amplitudes above J together stay below a quarter of every guard; h = 4 / omega_J. The slow part is positive
// beyond the ripple's bound, the polynomial's rest and rounding on all of the step
// (engine/falls/first_fall.hpp), or up to a place, from which the next step goes on with more modes slow. A
// fall is an event where the guard decreases throughout the stretch in which it may lie: slow part and ripple
// of its rate are negative; then the closed form with all modes is zero once. A guard that starts at zero is
// held by its first derivative that is not. What this rests on besides is the modes themselves: computed
// eigenvalues, tested by their residual.
#pragma once

#include <array>
#include <optional>

#include "engine/exact/modal/modal_flow.hpp"
#include "engine/exact/modal/modal_system.hpp"
#include "engine/falls/arming.hpp"
#include "motion/contact_series.hpp"

namespace signorini {

/// What a contact shows.
struct Shown {
  double gap = 0.0, ut = 0.0, vn = 0.0, vt = 0.0;
};

class ModalProof {
 public:
  ModalProof(const Model& model, double alpha);

  /// forces: constant, in modes. The state must live until the next start.
  void start(const Segment& segment, const StateModes& state, const Oscillators& oscillators,
             const Amplitudes& forces);
  [[nodiscard]] Passage pass(const ModalPoint& at, double remaining);
  /// After a passage without event: which guards are armed now.
  void rearm(const ModalPoint& at);
  /// Sum of the magnitudes of a guard's terms.
  [[nodiscard]] double magnitude(std::size_t slot, const ModalPoint& at) const;
  [[nodiscard]] Shown shown(std::size_t contact, const ModalPoint& at) const;
  [[nodiscard]] ForceLaw law(std::size_t contact) const { return laws_[contact]; }

  // As passage_turns.hpp asks.
  [[nodiscard]] double unit() const { return h_; }
  [[nodiscard]] double within(const ModalPoint& at, const TurningPoints& known, double x_end) const;
  double expand_beside(const ModalPoint& at, const TurningPoints& known, double share, double remaining);
  void see_begin(const ModalPoint& at, double time, TurningPoints& turning, LastTurns& turns) const;
  [[nodiscard]] const std::vector<ContactSeries>& series(const ModalPoint& /*at*/) const { return slow_; }

 private:
  static constexpr double turn = 4.0;           // rad of the fastest slow mode in a step
  static constexpr double longest_decay = 2.0;  // alpha h
  static constexpr double never = 1e300;

  struct Watched {
    std::size_t slot = 0;
    Shown form;
    double constant = 0.0, noise = 0.0;
    Amplitudes place, rate;                  // what of z and z' the guard shows
    std::vector<double> size;                // |place| + |rate| sqrt(l), real modes
    double now = 0.0;                        // the value, or the leading derivative's
    double ripple = 0.0, ripple_rate = 0.0;  // bounds; of the leading derivative where it leaves
  };
  struct Size {
    double place = 0.0, rate = 0.0;
  };
  using Watch4 = std::array<double, 4>;  // N, T, g and ut, as in TurningPoints::watched
  [[nodiscard]] Watch4 ripples(std::size_t contact, bool of_rate) const;
  [[nodiscard]] Watch4 one_way(std::size_t contact, double x_end, std::vector<double>& p) const;
  void watch(const Segment& segment, const StateModes& state);
  [[nodiscard]] double value(const Watched& guard, const ModalPoint& at) const;
  [[nodiscard]] double derivative(const Watched& guard, const ModalPoint& at) const;
  void measure(const ModalPoint& at);
  void part_modes(bool all_slow);
  [[nodiscard]] std::size_t first_fast() const;
  void choose_step(double remaining);
  void bound_ripples();
  void expand_real(const ModalPoint& at);
  void expand_modes(const ModalPoint& at);
  [[nodiscard]] Size sum(const Amplitudes& row, double still, std::vector<double>& out) const;
  void expand(const ModalPoint& at);
  void combine(const Watched& guard, std::vector<double>& p, double& slack) const;
  [[nodiscard]] bool settle(const Watched& guard, const ModalPoint& at, Passage& passage, double& limit,
                            double& event);
  /// It starts at zero, and its leading derivative is watched; or nothing is known of it.
  [[nodiscard]] bool leaves(const Watched& guard) const { return arming_.leading(guard.slot) > 0; }
  [[nodiscard]] bool unknown(const Watched& guard) const {
    return !arming_.armed(guard.slot) && !leaves(guard);
  }
  [[nodiscard]] double order_of(const Watched& guard) const {
    return static_cast<double>(arming_.leading(guard.slot));
  }
  [[nodiscard]] double weight_of(const Watched& guard, std::size_t k) const;

  const Model& model_;
  double alpha_;
  const StateModes* state_ = nullptr;
  const Oscillators* oscillators_ = nullptr;
  const Amplitudes* forces_ = nullptr;
  const Decision* decision_ = nullptr;
  std::vector<ForceLaw> laws_;
  std::vector<double> surface_;
  Arming arming_;
  std::vector<Watched> guards_;
  std::vector<std::vector<double>> still_normal_, still_tangent_;  // sums of a_k p_k / l_k from k on
  std::vector<double> amplitude_, pair_amplitude_, coefficients_;
  std::vector<Complex> pair_coefficients_;
  std::vector<Size> normal_size_, tangent_size_;  // sums of magnitudes, for rounding
  std::vector<Size> normal_rest_, tangent_rest_;
  std::vector<ContactSeries> slow_;
  std::vector<bool> pair_slow_;
  std::size_t fast_ = 0, degree_ = 0, count_ = 0;  // slow modes; degree and length of their series
  double h_ = 0.0;
  bool full_ = false;  // the next step takes all modes as slow
};

}  // namespace signorini
