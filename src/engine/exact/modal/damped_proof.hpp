// damped_proof.hpp: finds intervals that provably contain no zero of a guard, in complex modes. Method of modal_proof.hpp,
// generalised to complex roots.
//
//   g(t + h x) = sum of modes with |l| h <= 4 (a polynomial in x) + time_coefficients . b + fast part,
//   |fast part| <= sum |row_k y_k| e^max(0, Re l_k h)  over the modes with |l_k| h > 4
#pragma once

#include "engine/events/active_guards.hpp"
#include "engine/exact/modal/damped_motion.hpp"
#include "engine/exact/modal/modal_flow.hpp"
#include "motion/contact_series.hpp"

namespace signorini::modal {

class DampedProof {
 public:
  explicit DampedProof(const DampedMotion& motion) : motion_(motion) {}

  /// Called after DampedMotion::start().
  void start();
  [[nodiscard]] Passage pass(const ModalPoint& at, double remaining);
  void rearm(const ModalPoint& at);
  [[nodiscard]] double magnitude(std::size_t slot, const ModalPoint& at) const;
  [[nodiscard]] double slope(std::size_t slot, const ModalPoint& at) const;

  // Functions of a Proof in modal_flow.hpp (find_turning_points_in_passage).
  [[nodiscard]] double step_length() const { return h_; }
  [[nodiscard]] double length_without_turning(const ModalPoint& at, const events::TurningPointDetector& known,
                                              double x_end) const;
  double expand_for_turning(const ModalPoint& at, const events::TurningPointDetector& known, double share,
                            double remaining);
  void find_turning_at_start(const ModalPoint& at, double time, events::TurningPointDetector& turning,
                             LastTurningTimes& turns) const;
  [[nodiscard]] const std::vector<motion::ContactSeries>& series(const ModalPoint& at);

 private:
  struct Watched {
    std::size_t slot = 0;
    double noise = 0.0;
    ModalQuantity guard, leading_derivative;  // leading_derivative: time derivative of order leading_order()
    double now = 0.0;                         // value of the guard or of its leading derivative
  };
  struct Part {  // polynomial of a quantity on a step, its remainder, and bounds on the fast part
    std::vector<double> p;
    double rest = 0.0, fast_bound = 0.0, fast_rate_bound = 0.0;
  };
  [[nodiscard]] const ModalQuantity& watched(const Watched& guard) const {
    return active_guards_.leading_order(guard.slot) > 0 ? guard.leading_derivative : guard.guard;
  }
  [[nodiscard]] bool unknown(const Watched& guard) const {
    return !active_guards_.armed(guard.slot) && active_guards_.leading_order(guard.slot) == 0;
  }
  [[nodiscard]] const Watched* find(std::size_t slot) const;
  [[nodiscard]] Eigen::Index count_slow_modes(const ModalQuantity& f, Eigen::Index first, double most) const;
  void measure(const ModalPoint& at);
  void choose_step(double remaining);
  void set_step(double h, bool all_slow);
  void expand(const ModalPoint& at);
  [[nodiscard]] Part part_of(const ModalQuantity& f, const ModalPoint& at) const;
  [[nodiscard]] bool find_zero(const Watched& guard, const ModalPoint& at, Passage& passage, double& limit,
                               double& event);
  [[nodiscard]] std::array<const ModalQuantity*, 4> watched_quantities(std::size_t contact) const;

  const DampedMotion& motion_;
  events::ActiveGuards active_guards_;
  std::vector<Watched> guards_;
  Eigen::VectorXd amplitude_, size_;  // |y|, |l|
  Eigen::Index slow_ = 0;             // number of slow modes
  std::size_t count_ = 0;             // number of coefficients of the slow modes
  double h_ = 0.0, turn_ = 0.0;       // turn_: largest |l| h of slow modes and w h of slow waves in b
  bool all_slow_ = false;             // the next step treats all modes as slow
  Eigen::MatrixXcd terms_;            // y_k (l_k h)^j / j! of slow modes k
  std::vector<motion::ContactSeries> series_;
};

}  // namespace signorini::modal
