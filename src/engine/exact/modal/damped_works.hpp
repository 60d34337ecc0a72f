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
  struct Pairing {
    ModalQuantity f, g;
    Eigen::MatrixXcd answers;  // modes x b; empty: none
    bool pairs = false, courses = false;
  };
  [[nodiscard]] Pairing paired(ModalQuantity f, ModalQuantity g);
  [[nodiscard]] ModalQuantity alone(Course course) const;
  void add_answers(const Eigen::VectorXcd& row, const Course& course, Eigen::MatrixXcd& answers) const;
  void pair_contact(std::size_t c);
  void pair_loss();
  [[nodiscard]] double of_pairs(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b, const Stretch& s) const;
  [[nodiscard]] static double with_courses(const Eigen::MatrixXcd& answers, const Stretch& s);
  [[nodiscard]] double integral(const Pairing& pairing, const Stretch& s) const;
  [[nodiscard]] double loss(const Stretch& s) const;
  void add_contact(std::size_t c, const Stretch& s, motion::WorkIntegrals& works) const;

  const DampedMotion& motion_;
  std::vector<Pairing> loads_;  // rates along active loads, and the courses of the loads
  struct ContactPairings {
    std::optional<Pairing> applied_normal_force, slip, surface, dashpot;
  };
  std::vector<ContactPairings> contacts_;
  Eigen::MatrixXd still_loss_;     // b x b: courses only
  Eigen::MatrixXcd loss_answers_;  // dissipation by modes together with courses
  bool courses_meet_ = false;      // at least two courses overlap in the segment
};

}  // namespace signorini::modal
