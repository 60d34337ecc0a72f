// modal_system.hpp: equations of a structure with contacts in its unconstrained modes, and in the modes of a contact state.
//
//   q'' + alpha q' + D q = Phi^T ( P - sum_k ( n_k N_k + t_k T_k ) ),            u = Phi q
//   with N = N_g g + N_c and T = T_g g + T_u ut + T_c in a contact state:   z'' + alpha z' + L z = Y p,   q = X z
//
// The damping is alpha M, and D + U V^T = X L Y (spectrum.hpp).
#pragma once

#include <memory>

#include "base/containers.hpp"
#include "contact/contact_states.hpp"
#include "engine/exact/modal/mode_pairs.hpp"
#include "engine/exact/modal/spectrum.hpp"
#include "engine/exact/modal/unconstrained_modes.hpp"
#include "motion/forcing.hpp"

namespace signorini::modal {

/// N and T of one contact as linear functions of its gap and ut. All coefficients of a force that does not act are zero.
struct ForceLaw {
  double N_gap = 0.0, N_constant = 0.0;
  double T_gap = 0.0, T_ut = 0.0, T_constant = 0.0;

  [[nodiscard]] double N(double gap) const { return N_gap * gap + N_constant; }
  [[nodiscard]] double T(double gap, double ut) const { return T_gap * gap + T_ut * ut + T_constant; }
  [[nodiscard]] double N_rate(double vn) const { return N_gap * vn; }
  [[nodiscard]] double T_rate(double vn, double vt) const { return T_gap * vn + T_ut * vt; }
};
/// Forces of a contact in this state. applied: constant applied normal force of a slider.
[[nodiscard]] ForceLaw force_law(const Contact& contact, const ContactState& state, double applied);

/// Reason why damping or contacts couple the modes of contact states. Empty: the modes are uncoupled.
[[nodiscard]] std::string coupling_refusal(const Model& model);
/// Reason why uncoupled modes cannot represent a scene. Empty: uncoupled modes can represent the scene.
[[nodiscard]] std::string proportional_refusal(const Model& model);
/// Number of contact springs that act if all contacts are closed and stick.
[[nodiscard]] std::size_t max_state_springs(const Model& model);

/// The modes of one combination of contact states.
struct StateModes {
  Spectrum spectrum;
  std::vector<Amplitudes> normal, tangent;            ///< coefficients of each mode in n_k . u and t_k . u
  std::vector<Amplitudes> from_normal, from_tangent;  ///< Y n_k, Y t_k
  std::vector<Amplitudes> load, from_load;            ///< coefficients of each mode in load_i . u; Y load_i
  ModePairs pairs;  ///< available only if a contact slips and the spectrum stores X
};

/// Modal forces Y p due to the loads after time t and the constant parts of the contact forces in the contact state.
[[nodiscard]] Amplitudes constant_forces(const Model& model, const StateModes& state,
                                         const contact::ContactStates& states, const motion::Forcing& forcing,
                                         double t);

/// Limits of the number and bytes of the cached modes, which are reused if a motion returns to earlier contact states.
inline constexpr base::CacheLimits max_state_modes{1024, std::size_t{1} << 28};

class ModalSystem {
 public:
  /// Both arguments must outlive the object.
  ModalSystem(const Model& model, const UnconstrainedBasis& basis);

  [[nodiscard]] double alpha() const { return alpha_; }
  [[nodiscard]] const UnconstrainedBasis& basis() const { return basis_; }
  /// Modes of the contact states, from the cache or newly computed. Check the failure() of the spectrum before use.
  [[nodiscard]] std::shared_ptr<const StateModes> state(const contact::ContactStates& states);
  /// Number of contact states whose modes were computed instead of taken from the cache.
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
