// damped_works.hpp: works and dissipations of a stretch in complex modes, in closed form.
//
//   int y_k y_i = [y_k y_i] / (l_k + l_i)       and with the conjugate of y_i
//   int y_k (c . b) = [y_k (r . b)],  r D = -l_k r + c                       time_basis.hpp
//
// Damping dissipates int q'^T C q', friction int T p', surfaces int -T s', loads int f d . u', each a sum over pairs of
// modes, of modes with courses and of courses. Pairs whose l_k + l_i is small relative to the run use the series of
// (e^(s h) - 1) / s. The energy balance is therefore an independent check.
#pragma once

#include <optional>

#include "engine/exact/modal/damped_motion.hpp"
#include "motion/point.hpp"

namespace signorini::modal {

class DampedWorkIntegrals {
 public:
  explicit DampedWorkIntegrals(const DampedMotion& motion) : motion_(motion) {}

  /// Called after motion.start.
  void start();
  void add(const ModalPoint& from, const ModalPoint& to, motion::WorkIntegrals& works) const;

 private:
  struct Stretch {
    const ModalPoint &from, &to;
    Eigen::VectorXd b_from, b_to;
    Eigen::MatrixXd products;  // products of courses; empty if none overlap
  };
  /// Integral of f g, as far as it is known per segment: modes times courses give y . answers b at the ends of a
  /// stretch.
  struct ProductIntegral {
    ModalQuantity f, g;
    Eigen::MatrixXcd responses;  // modes x b; empty: none
    bool pairs = false, courses = false;
  };
  [[nodiscard]] ProductIntegral product_integral(ModalQuantity f, ModalQuantity g);
  [[nodiscard]] ModalQuantity without_modes(TimeCoefficients course) const;
  void add_responses(const Eigen::VectorXcd& row, const TimeCoefficients& course,
                     Eigen::MatrixXcd& answers) const;
  void prepare_contact(std::size_t c);
  void prepare_loss();
  [[nodiscard]] double of_pairs(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b, const Stretch& s) const;
  [[nodiscard]] static double with_courses(const Eigen::MatrixXcd& answers, const Stretch& s);
  [[nodiscard]] double integral(const ProductIntegral& pairing, const Stretch& s) const;
  [[nodiscard]] double loss(const Stretch& s) const;
  void add_contact(std::size_t c, const Stretch& s, motion::WorkIntegrals& works) const;

  const DampedMotion& motion_;
  std::vector<ProductIntegral> loads_;  // rates along active loads, and the courses of the loads
  struct ContactProducts {
    std::optional<ProductIntegral> applied_normal_force, slip, surface, dashpot;
  };
  std::vector<ContactProducts> contacts_;
  Eigen::MatrixXd forced_loss_;      // b x b: courses only
  Eigen::MatrixXcd loss_responses_;  // dissipation by modes together with courses
  bool courses_overlap_ = false;     // at least two courses overlap in the segment
};

}  // namespace signorini::modal
