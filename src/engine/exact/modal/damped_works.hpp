// damped_works.hpp: works and dissipations of a stretch in complex modes, in closed form.
//
//   int y_k y_i = [y_k y_i] / (l_k + l_i)       and with the conjugate of y_i
//   int y_k (c . b) = [y_k (r . b)],  r D = -l_k r + c                       time_basis.hpp
//
// Damping takes int q'^T C q', friction int T p', surfaces int -T s', loads int f d . u', each a sum over pairs
// of modes, of modes with courses and of courses. Pairs whose l_k + l_i is small beside the run take the series
// of (e^(s h) - 1) / s. So the balance of energy is not computed from itself.
#pragma once

#include "engine/exact/modal/damped_motion.hpp"
#include "motion/powers.hpp"

namespace signorini {

class DampedWorks {
 public:
  explicit DampedWorks(const DampedMotion& motion) : motion_(motion) {}

  /// After motion.start.
  void start();
  void add(const ModalPoint& from, const ModalPoint& to, Works& works) const;

 private:
  struct Stretch {
    const ModalPoint &from, &to;
  };
  [[nodiscard]] double of_pairs(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b, const Stretch& s) const;
  [[nodiscard]] double with_course(const Eigen::VectorXcd& row, const Course& course, const Stretch& s) const;
  [[nodiscard]] double integral(const ModalQuantity& f, const ModalQuantity& g, const Stretch& s) const;
  [[nodiscard]] double loss(const Stretch& s) const;
  void add_contact(std::size_t c, const Stretch& s, Works& works) const;

  const DampedMotion& motion_;
  std::vector<ModalQuantity> loads_;  // rates along loads that act
  std::vector<Course> factors_;       // and how strongly they act
  std::vector<ModalQuantity> slips_;  // slip rates, one a contact; empty rows where none slips
  Eigen::MatrixXd still_loss_;        // b x b: of courses alone
  Eigen::MatrixXcd course_loss_;      // modes x b: what damping takes of modes beside courses
};

}  // namespace signorini
