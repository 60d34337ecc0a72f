// damped_works.hpp: works and dissipated energies in an interval, in complex modes and in closed form.
//
//   int y_k y_i = [y_k y_i] / (l_k + l_i),      int y_k conj(y_i) = [y_k conj(y_i)] / (l_k + conj(l_i))
//   int y_k (c . b) = [y_k (r . b)],  r D = -l_k r + c                       time_basis.hpp
//
// Damping dissipates int q'^T C q', friction int T p'. The work of surfaces is int -T s', that of loads int f d . u'. Each
// integral is a sum over three kinds of pairs: two modes, a mode and a forced part c . b, and two forced parts. If the sum
// s = l_k + l_i is small relative to 1 / (length of the run), the integral uses the series of (e^(s h) - 1) / s. The energy
// balance checks the result independently.
#pragma once

#include <optional>

#include "engine/exact/modal/damped_motion.hpp"
#include "motion/point.hpp"

namespace signorini::modal {

class DampedWorkIntegrals {
 public:
  explicit DampedWorkIntegrals(const DampedMotion& motion) : motion_(motion) {}

  /// Called after DampedMotion::start().
  void start();
  /// Adds the works between two points of the segment.
  void add(const ModalPoint& from, const ModalPoint& to, motion::WorkIntegrals& works) const;

 private:
  /// An interval between two points, and the integrals of b on it.
  struct Stretch {
    const ModalPoint &from, &to;
    Eigen::VectorXd b_from, b_to;
    Eigen::MatrixXd products;  // integrals of b b^T; empty if no integral has two forced parts
  };
  /// Data of the integral of f g that are constant in a segment. Products of modes and forced parts contribute the difference
  /// of y . (responses b) between the ends of the interval.
  struct ProductIntegral {
    ModalQuantity f, g;
    Eigen::MatrixXcd responses;           // modes x functions b; empty if there are no such products
    bool pairs = false, courses = false;  // f g contains products of two modes; of two forced parts
  };
  [[nodiscard]] ProductIntegral product_integral(ModalQuantity f, ModalQuantity g);
  [[nodiscard]] ModalQuantity without_modes(TimeCoefficients course) const;
  void add_responses(const Eigen::VectorXcd& row, const TimeCoefficients& course,
                     Eigen::MatrixXcd& answers) const;
  void prepare_contact(std::size_t c);
  void prepare_loss();
  [[nodiscard]] double integral_of_pairs(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b,
                                         const Stretch& s) const;
  [[nodiscard]] static double integral_with_forced_part(const Eigen::MatrixXcd& answers, const Stretch& s);
  [[nodiscard]] double integral(const ProductIntegral& pairing, const Stretch& s) const;
  [[nodiscard]] double loss(const Stretch& s) const;
  void add_contact(std::size_t c, const Stretch& s, motion::WorkIntegrals& works) const;

  const DampedMotion& motion_;
  std::vector<ProductIntegral> loads_;  // integrals of the powers of the active loads
  struct ContactProducts {
    std::optional<ProductIntegral> applied_normal_force, slip, surface, dashpot;
  };
  std::vector<ContactProducts> contacts_;
  Eigen::MatrixXd forced_loss_;       // dissipation by two forced parts
  Eigen::MatrixXcd loss_responses_;   // dissipation by a mode and a forced part
  bool has_forced_products_ = false;  // at least one integral has products of two forced parts
};

}  // namespace signorini::modal
