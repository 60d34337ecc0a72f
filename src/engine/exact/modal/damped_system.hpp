// damped_system.hpp: the terms (springs, dashpots, constraints) that a contact state adds to the unconstrained modes, and
// contact quantities in the complex modes of this state.
//
//   C = alpha M + beta K + sum_i r_i d_i d_i^T:   c_j = alpha + beta omega_j^2, and one dashpot for each d_i
//
//   state    terms of a contact                                      further forces
//   closed   compliant: kn + cn d/dt along n;  rigid: n . u = -g0
//   stick    kt along t;  without kt: t . u follows the surface
//   slip s   the term's force acts along n - s f t instead of n      slider: s f q t with the normal force q
//
// Sizes in this file: n unconstrained modes, K complex modes (one of each conjugate pair).
#pragma once

#include <memory>

#include "base/containers.hpp"
#include "contact/contact_states.hpp"
#include "contact/law.hpp"
#include "engine/exact/modal/damped_modes.hpp"
#include "engine/exact/modal/unconstrained_modes.hpp"

namespace signorini::modal {

/// Reason why complex modes cannot represent a scene. Empty: complex modes can represent the scene.
[[nodiscard]] std::string damped_refusal(const Model& model);
/// Number of springs, constraints and dampers of a state in which all contacts are closed and stick.
[[nodiscard]] std::size_t max_state_terms(const Model& model);

/// Gap and tangential displacement of one contact per unit amplitude of each complex mode. Zero if a constraint prescribes the
/// gap or the displacement.
struct ContactRows {
  Eigen::VectorXcd gap, slide;
  int normal_term = -1, tangent_term = -1;  ///< indices of the contact's terms; -1: no such term
  Form normal, tangent;                     ///< the contact's rows in this contact state
};

/// direct: 1 / (l_k + l_i) of all pairs of roots; conjugate: 1 / (l_k + conj(l_i)). Exception: if the sum of both roots is so
/// small that the product of both modes hardly changes during the run, the entry is 0 and the pair is listed in `slow`.
struct RootSums {
  Eigen::MatrixXcd direct, conjugate;
  struct Slow {
    Eigen::Index k, i;
    bool conjugate;
    std::complex<double> loss;  ///< dissipated power as in DampedState::loss, not divided by the sum of roots
  };
  std::vector<Slow> slow;
};

struct DampedState {
  DampedModes modes;
  std::vector<ModalTerm> terms;  ///< first the dampers of the structure, then the terms of the contacts
  std::vector<ContactRows> contacts;
  std::vector<Eigen::Index> rigid;  ///< indices of the rigid terms in `terms`
  Eigen::MatrixXd from_forces;      ///< rigid x n: (V^T U)^-1 V^T
  Eigen::MatrixXd static_shapes;    ///< n x rigid: V^T static_shapes is the unit matrix
  RootSums sums;
  /// Dissipated power of each pair of modes, divided by the sum of both roots: the integral over time is the dissipated energy.
  Eigen::MatrixXcd loss, loss_conjugate;
  [[nodiscard]] std::size_t bytes() const;
};

inline constexpr base::CacheLimits max_damped_states{1024, std::size_t{1} << 28};

class DampedSystem {
 public:
  /// Both arguments must outlive the object.
  DampedSystem(const Model& model, const UnconstrainedBasis& basis, double t_end);

  /// Data of a contact state, from the cache or newly computed. Check modes.failure before use.
  [[nodiscard]] std::shared_ptr<const DampedState> state(const contact::ContactStates& states);
  /// Number of contact states whose modes were computed instead of taken from the cache.
  [[nodiscard]] long made() const { return made_; }
  /// c_j of all unconstrained modes; dampers(): the dashpots d_i; damped(): true if there is any damping.
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
