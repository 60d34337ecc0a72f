// damped_motion.hpp: the motion of a segment in complex modes, with all quantities in closed form.
//
//   q = Q b(x) + Re sum_k shape_k y_k,   y_k(x) = e^(l_k x) y_k(0),   x = t - t0
//   f = Re sum_k row_k y_k + time_coefficients . b(x)          f: gap, ut, force or guard
//
// Q is the response to loads and moving constraints: the sum of the responses of all modes (time_basis.hpp) and of the
// displacement u_c that the constraints prescribe. The force lambda of a constraint is the sum of the forces due to all modes
// and of the direct reaction to the loads p:
//   lambda = sum_k force_k z_k + (V^T U)^-1 V^T p,   z_k = y_k + (response of mode k to p)
#pragma once

#include "engine/exact/modal/damped_system.hpp"
#include "engine/exact/modal/modal_flow.hpp"
#include "engine/exact/modal/oscillators.hpp"
#include "engine/exact/modal/time_basis.hpp"
#include "engine/stepper.hpp"

namespace signorini::modal {

/// A linear quantity f = Re sum_k row_k y_k + time_coefficients . b(x) of the motion.
struct ModalQuantity {
  Eigen::VectorXcd row;
  TimeCoefficients time_coefficients;

  ModalQuantity& operator+=(const ModalQuantity& b) {
    row += b.row;
    time_coefficients += b.time_coefficients;
    return *this;
  }
  friend ModalQuantity operator*(double factor, ModalQuantity a) {
    a.row *= factor;
    a.time_coefficients *= factor;
    return a;
  }
};

class DampedMotion {
 public:
  /// kept: system to use, of a structure with the same matrices (ModalCache). Null: the object creates a system.
  DampedMotion(const Model& model, const UnconstrainedBasis& basis, double t_end,
               DampedSystem* kept = nullptr)
      : model_(model),
        basis_(basis),
        t_end_(t_end),
        own_(kept == nullptr ? std::make_unique<DampedSystem>(model, basis, t_end) : nullptr),
        system_(kept == nullptr ? *own_ : *kept) {}

  /// See ModalFlow::start().
  [[nodiscard]] std::string start(const engine::Segment& segment, const Vector& q, const Vector& rate,
                                  ModalPoint& now);
  void advance(const ModalPoint& from, double time, ModalPoint& to) const;
  void motion(const ModalPoint& at, Vector& q, Vector& rate, Vector* change) const;

  [[nodiscard]] const DampedState& state() const { return *state_; }
  [[nodiscard]] double eigenvector_condition() const { return state_ ? state_->modes.condition : 1.0; }
  [[nodiscard]] const DampedSystem& system() const { return system_; }
  [[nodiscard]] const Eigen::VectorXcd& root() const { return state_->modes.root; }
  [[nodiscard]] const TimeBasis& time() const { return time_; }
  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] const decide::Decision& decision() const { return *decision_; }
  /// Q of this file's header, and its time derivative: n rows, one column for each function in b.
  [[nodiscard]] const Eigen::MatrixXd& forced_response() const { return forced_response_; }
  [[nodiscard]] const Eigen::MatrixXd& forced_response_rate() const { return forced_response_rate_; }

  struct ContactQuantities {
    ModalQuantity N, T, gap, ut;
    TimeCoefficients surface, applied_normal_force;
  };
  [[nodiscard]] const ContactQuantities& contact(std::size_t c) const { return contacts_[c]; }
  [[nodiscard]] ModalQuantity derivative(const ModalQuantity& f) const {
    return {f.row.cwiseProduct(root()), time_.derivative(f.time_coefficients)};
  }
  /// Value of a form of a contact's motion, as a quantity.
  [[nodiscard]] ModalQuantity quantity_of(const Form& form, std::size_t contact) const;
  /// Value of a form of the structure, as a quantity. form: coefficients in unconstrained modes.
  [[nodiscard]] ModalQuantity quantity_of(const Vector& form) const {
    return {state_->modes.shape.transpose() * form, forced_response_.transpose() * form};
  }
  [[nodiscard]] ModalQuantity load_quantity(std::size_t load) const { return quantity_of(basis_.load(load)); }
  [[nodiscard]] double value(const ModalQuantity& f, const ModalPoint& at) const {
    return f.row.cwiseProduct(at.y).sum().real() + f.time_coefficients.dot(time_.at(at.time));
  }
  /// See ModalFlow::fast_mode_bound(). Fast modes are those with |l| > omega.
  [[nodiscard]] engine::FastModeBound fast_mode_bound(const ModalPoint& from, double time,
                                                      double omega) const;
  /// Sum of the magnitudes of the terms of f, to which its rounding error is relative.
  [[nodiscard]] double magnitude(const ModalQuantity& f, const ModalPoint& at) const {
    return f.row.cwiseAbs().dot(at.y.cwiseAbs()) +
           f.time_coefficients.cwiseAbs().dot(time_.at(at.time).cwiseAbs());
  }
  /// See ModalFlow::terms().
  [[nodiscard]] SumTerms terms(const ModalPoint& at) const;

 private:
  [[nodiscard]] Eigen::MatrixXd constraint_displacements(const engine::Segment& segment,
                                                         const Vector& q) const;
  [[nodiscard]] Eigen::MatrixXd forces() const;
  [[nodiscard]] Eigen::MatrixXd inertia_of(const Eigen::MatrixXd& held) const;
  void find_contacts(const Eigen::MatrixXd& forces, const Eigen::MatrixXcd& answers);

  const Model& model_;
  const UnconstrainedBasis& basis_;
  const double t_end_;
  std::unique_ptr<DampedSystem> own_;
  DampedSystem& system_;
  std::shared_ptr<const DampedState> state_;
  const decide::Decision* decision_ = nullptr;
  TimeBasis time_;
  Eigen::MatrixXd forced_response_, forced_response_rate_, change_;
  Eigen::VectorXd lengths_, omega_shape_norms_;  // norms of the shapes, and of omega times the shapes
  Eigen::VectorXd response_norms_, response_rate_norms_, response_omega_norms_;
  std::vector<ContactQuantities> contacts_;
};

}  // namespace signorini::modal
