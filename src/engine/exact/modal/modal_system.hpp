// modal_system.hpp: a structure and its contacts in its open modes, and in the modes of a contact state.
//
//   q'' + alpha q' + D q = Phi^T ( P - sum_k ( n_k N_k + t_k T_k ) ),            u = Phi q
//   N = N_g g + N_c,  T = T_g g + T_u ut + T_c in a state:   z'' + alpha z' + L z = Y p,   q = X z
//
// alpha: the damping is alpha M. D + U V^T = X L Y (spectrum.hpp).
#pragma once

#include <memory>

#include "base/bounded_cache.hpp"
#include "contact/mode.hpp"
#include "engine/exact/modal/mode_pairs.hpp"
#include "engine/exact/modal/open_modes.hpp"
#include "engine/exact/modal/spectrum.hpp"
#include "engine/exact/modal/thin_product.hpp"
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
  ModePairs pairs;                                    ///< where a contact slips and X is written out
};

/// At once in memory: those of a motion that comes back to its states.
inline constexpr CacheBounds most_state_modes{1024, std::size_t{1} << 28};

class ModalSystem {
 public:
  explicit ModalSystem(const Model& model);

  [[nodiscard]] const std::string& failure() const { return modes_.failure; }
  [[nodiscard]] double alpha() const { return alpha_; }
  /// The modes of a state, from the cache or made. Its spectrum may have failed.
  [[nodiscard]] std::shared_ptr<const StateModes> state(const Mode& mode);
  /// How many were made.
  [[nodiscard]] long made() const { return made_; }

  [[nodiscard]] Vector amplitudes(const Vector& u) const { return projection_ * u; }
  /// Phi, by rows
  [[nodiscard]] const RowMatrix& shapes() const { return shapes_; }
  void motions(const std::vector<const Vector*>& q, const std::vector<Vector*>& u) const {
    thin_product(shapes_, q, u);
  }

 private:
  const Model& model_;
  OpenModes modes_;
  Poles poles_;
  double alpha_ = 0.0;
  RowMatrix shapes_;            // Phi
  Eigen::MatrixXd projection_;  // Phi^T M
  std::vector<Vector> normal_, tangent_, load_;
  [[nodiscard]] StateModes make(const Mode& mode) const;

  BoundedCache<std::vector<State>, std::shared_ptr<const StateModes>> known_{most_state_modes};
  long made_ = 0;
};

}  // namespace signorini
