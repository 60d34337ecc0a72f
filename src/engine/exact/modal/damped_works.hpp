// damped_works.hpp: works and dissipations of an interval in complex modes, in closed form.
//
//   int y_k y_i = [y_k y_i] / (l_k + l_i)       and with the conjugate of y_i
//   int y_k (c . b) = [y_k (r . b)],  r D = -l_k r + c                       time_basis.hpp
//
// Damping dissipates int q'^T C q', friction int T p'. The work of surfaces is int -T s', that of loads int f
// d . u'. Each is a sum over pairs of modes, pairs of a mode and a forced part c . b, and pairs of forced
// parts. Pairs whose l_k + l_i is small relative to the run use the series of (e^(s h) - 1) / s. The energy
// balance is an independent check.
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
    Eigen::MatrixXd products;  // integrals of b b^T; empty if no integral has two forced parts
  };
  /// Data of the integral of f g that are constant in a segment. Modes times forced parts contribute the
  /// difference of y . responses b between the ends of the interval.
  struct ProductIntegral {
    ModalQuantity f, g;
    Eigen::MatrixXcd responses;           // modes x b; empty: none
    bool pairs = false, courses = false;  // the integral has products of modes, of forced parts
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
  std::vector<ProductIntegral> loads_;  // rates along active loads, times the loads
  struct ContactProducts {
    std::optional<ProductIntegral> applied_normal_force, slip, surface, dashpot;
  };
  std::vector<ContactProducts> contacts_;
  Eigen::MatrixXd forced_loss_;      // b x b: dissipation by forced parts
  Eigen::MatrixXcd loss_responses_;  // dissipation by modes times forced parts
  bool courses_overlap_ = false;     // at least one integral has products of forced parts
};

}  // namespace signorini::modal
