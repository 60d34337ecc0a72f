// modal_system.hpp: a structure and its contacts in its unconstrained modes, and in the modes of a contact
// state.
//
//   q'' + alpha q' + D q = Phi^T ( P - sum_k ( n_k N_k + t_k T_k ) ),            u = Phi q
//   N = N_g g + N_c,  T = T_g g + T_u ut + T_c in a state:   z'' + alpha z' + L z = Y p,   q = X z
//
// alpha: the damping is alpha M. D + U V^T = X L Y (spectrum.hpp).
#pragma once

#include <memory>

#include "base/containers.hpp"
#include "contact/contact_states.hpp"
#include "engine/exact/modal/mode_pairs.hpp"
#include "engine/exact/modal/spectrum.hpp"
#include "engine/exact/modal/unconstrained_modes.hpp"
#include "motion/forcing.hpp"

namespace signorini::modal {

/// Forces of one contact as functions of its gap and ut; coefficients are zero if a state has no force.
struct ForceLaw {
  double N_gap = 0.0, N_constant = 0.0;
  double T_gap = 0.0, T_ut = 0.0, T_constant = 0.0;

  [[nodiscard]] double N(double gap) const { return N_gap * gap + N_constant; }
  [[nodiscard]] double T(double gap, double ut) const { return T_gap * gap + T_ut * ut + T_constant; }
  [[nodiscard]] double N_rate(double vn) const { return N_gap * vn; }
  [[nodiscard]] double T_rate(double vn, double vt) const { return T_gap * vn + T_ut * vt; }
};
/// applied: constant applied normal force of a slider.
[[nodiscard]] ForceLaw force_law(const Contact& contact, const ContactState& state, double applied);

/// Reason why damping or contacts couple the modes of contact states; empty: they do not.
[[nodiscard]] std::string coupling_refusal(const Model& model);
/// Reason why a scene cannot be followed in uncoupled modes; empty: it can.
[[nodiscard]] std::string proportional_refusal(const Model& model);
/// Number of springs of contacts that act if all contacts are closed and stick.
[[nodiscard]] std::size_t max_state_springs(const Model& model);

/// The modes of one combination of contact states.
struct StateModes {
  Spectrum spectrum;
  std::vector<Amplitudes> normal, tangent;            ///< coefficients of each mode in n_k . u and t_k . u
  std::vector<Amplitudes> from_normal, from_tangent;  ///< Y n_k, Y t_k
  std::vector<Amplitudes> load, from_load;            ///< same for each load's direction
  ModePairs pairs;                                    ///< if a contact slips and X is written out
};

/// Y p: modal forces by loads and the constant parts of contact forces in the state, from t on.
[[nodiscard]] Amplitudes constant_forces(const Model& model, const StateModes& state,
                                         const contact::ContactStates& states, const motion::Forcing& forcing,
                                         double t);

/// Limits of the cache of states, for motions that return to earlier states.
inline constexpr base::CacheLimits max_state_modes{1024, std::size_t{1} << 28};

class ModalSystem {
 public:
  /// Both arguments must outlive the object.
  ModalSystem(const Model& model, const UnconstrainedBasis& basis);

  [[nodiscard]] double alpha() const { return alpha_; }
  [[nodiscard]] const UnconstrainedBasis& basis() const { return basis_; }
  /// The modes of a state, from the cache or new. Its spectrum may have failed.
  [[nodiscard]] std::shared_ptr<const StateModes> state(const contact::ContactStates& states);
  /// Number of states computed.
  [[nodiscard]] long made() const { return made_; }

 private:
  const Model& model_;
  const UnconstrainedBasis& basis_;
  Poles poles_;
  double alpha_ = 0.0;
  [[nodiscard]] StateModes make(const contact::ContactStates& states) const;

  base::LruCache<std::vector<State>, std::shared_ptr<const StateModes>> known_{max_state_modes};
  long made_ = 0;
};

}  // namespace signorini::modal
