// damped_system.hpp: contact states as terms on the unconstrained modes, and contact quantities in their
// complex modes.
//
//   C = alpha M + beta K + sum_i r_i d_i d_i^T:   c_j = alpha + beta omega_j^2, and a dashpot for each d_i
//
//   state    terms of a contact                                      further forces
//   closed   compliant: kn + cn d/dt along n;  rigid: n . u = -g0
//   stick    kt along t;  without kt: t . u stays with the surface
//   slip s   the force along n acts along n - s f t                  slider: s f q t, q the normal force
//
// Shapes: n unconstrained modes, K complex modes (one of each pair).
#pragma once

#include <memory>

#include "base/containers.hpp"
#include "contact/contact_states.hpp"
#include "contact/law.hpp"
#include "engine/exact/modal/damped_modes.hpp"
#include "engine/exact/modal/unconstrained_modes.hpp"

namespace signorini::modal {

/// Reason why a scene cannot be followed in complex modes; empty: it can.
[[nodiscard]] std::string damped_refusal(const Model& model);
/// Number of springs, constraints and dampers of a state in which all contacts are closed and stick.
[[nodiscard]] std::size_t max_state_terms(const Model& model);

/// Quantities of one contact in complex modes: forms times shapes; zero if a constraint prescribes them.
struct ContactRows {
  Eigen::VectorXcd gap, slide;
  int normal_term = -1, tangent_term = -1;  ///< indices of the contact's terms
  Form normal, tangent;                     ///< the contact's rows in the state
};

/// 1 / (l_k + l_i), and the same with the conjugate of l_i. 0 for pairs whose sum is small relative to the
/// run: these are listed in `slow`.
struct RootSums {
  Eigen::MatrixXcd direct, conjugate;
  struct Slow {
    Eigen::Index k, i;
    bool conjugate;
    std::complex<double> loss;  ///< entry of DampedState::loss, not divided by the sum of roots
  };
  std::vector<Slow> slow;
};

struct DampedState {
  DampedModes modes;
  std::vector<ModalTerm> terms;  ///< dampers of the structure first
  std::vector<ContactRows> contacts;
  std::vector<Eigen::Index> rigid;  ///< indices of rigid terms
  Eigen::MatrixXd from_forces;      ///< rigid x n: (V^T U)^-1 V^T
  Eigen::MatrixXd static_shapes;    ///< n x rigid: V^T static_shapes = 1
  RootSums sums;
  /// Dissipation by the rates of two modes, divided by the sum of their roots.
  Eigen::MatrixXcd loss, loss_conjugate;
  [[nodiscard]] std::size_t bytes() const;
};

inline constexpr base::CacheLimits max_damped_states{1024, std::size_t{1} << 28};

class DampedSystem {
 public:
  /// Both arguments must outlive the object.
  DampedSystem(const Model& model, const UnconstrainedBasis& basis, double t_end);

  /// Data of a state, from the cache or new; its modes may have failed.
  [[nodiscard]] std::shared_ptr<const DampedState> state(const contact::ContactStates& states);
  /// Number of states computed.
  [[nodiscard]] long made() const { return made_; }
  /// c_j; dampers(): the dashpots d_i; damped(): there is any damping.
  [[nodiscard]] const Vector& decay() const { return decay_; }
  [[nodiscard]] const std::vector<ModalTerm>& dampers() const { return dampers_; }
  [[nodiscard]] bool damped() const { return damped_; }

 private:
  [[nodiscard]] DampedState make(const contact::ContactStates& states) const;
  void add_contact(std::size_t c, const ContactState& state, DampedState& out) const;
  void find_constraints(DampedState& out) const;
  void find_losses(DampedState& out) const;

  const Model& model_;
  const UnconstrainedBasis& basis_;
  const double t_end_;
  Vector decay_;
  std::vector<ModalTerm> dampers_;
  bool damped_ = false;
  base::LruCache<std::vector<State>, std::shared_ptr<const DampedState>> known_{max_damped_states};
  long made_ = 0;
};

}  // namespace signorini::modal
