// modal_system.hpp: a structure and its contacts in its open modes, and in the modes of a contact state.
//
//   q'' + alpha q' + D q = Phi^T ( P - sum_k ( n_k N_k + t_k T_k ) ),            u = Phi q
//   N = N_g g + N_c,  T = T_g g + T_u ut + T_c in a state:   z'' + alpha z' + L z = Y p,   q = X z
//
// alpha: the damping is alpha M. D + U V^T = X L Y (spectrum.hpp).
#pragma once

#include <map>
#include <memory>

#include "contact/mode.hpp"
#include "engine/exact/modal/open_modes.hpp"
#include "engine/exact/modal/spectrum.hpp"
#include "motion/forcing.hpp"

namespace signorini {

/// Forces of one contact as functions of its gap and its slide; empty lines where a state has no force.
struct ForceLaw {
  double N_gap = 0.0, N_constant = 0.0;
  double T_gap = 0.0, T_ut = 0.0, T_constant = 0.0;
};
/// pressing: of a slider, constant.
[[nodiscard]] ForceLaw force_law(const Contact& contact, const ContactState& state, double pressing);

/// Why a scene cannot be followed in modes; empty: it can.
[[nodiscard]] std::string modal_refusal(const Model& model);

/// One combination of contact states.
struct StateModes {
  Spectrum spectrum;
  std::vector<Amplitudes> normal, tangent;            ///< what each mode shows of n_k . u and t_k . u
  std::vector<Amplitudes> from_normal, from_tangent;  ///< Y n_k, Y t_k
  std::vector<Amplitudes> load, from_load;            ///< of each load's direction
};

class ModalSystem {
 public:
  explicit ModalSystem(const Model& model);

  [[nodiscard]] const std::string& failure() const { return modes_.failure; }
  [[nodiscard]] double alpha() const { return alpha_; }
  /// The modes of a state, made when first asked for. Its spectrum may have failed.
  [[nodiscard]] const StateModes& state(const Mode& mode);
  [[nodiscard]] std::size_t states() const { return known_.size(); }

  [[nodiscard]] Vector amplitudes(const Vector& u) const { return projection_ * u; }
  [[nodiscard]] Vector motion(const Vector& q) const { return modes_.shapes * q; }

 private:
  const Model& model_;
  OpenModes modes_;
  Poles poles_;
  double alpha_ = 0.0;
  Eigen::MatrixXd projection_;  // Phi^T M
  std::vector<Vector> normal_, tangent_, load_;
  std::map<std::vector<State>, std::unique_ptr<StateModes>> known_;
};

}  // namespace signorini
