// modal_tangents.hpp: the motion and its tangents on a stretch under constant forces, in the modes of its state.
//
//   z'' + alpha z' + L z = p                                        the motion, engine/exact/modal
//   w'' + alpha w' + L w = f - B z - G z'                           the tangent of one parameter
//   B = Y Phi^T ( K_p + contacts' ) Phi X - Y Phi^T M_p Phi X L,    G = Y Phi^T ( C_p - alpha M_p ) Phi X
//   w_k(t) = w0 c + w0' s + f h + sum_l ( B_kl y_l[k, l] + G_kl y_l'[k, l] )
//
// y_l[k, l]: oscillator_pairs.hpp. Contacts': n (N_gap,p n + N_gap n_p)^T + ..., of few vectors. What a stretch
// costs does not depend on its length. Constant parts p_l / l_l of the motion belong to f where they are no
// greater than a few thousand times the motion.
#pragma once

#include <memory>

#include "engine/exact/modal/oscillators.hpp"
#include "sensitivity/law_rates.hpp"

namespace signorini {

/// Degrees of freedom beyond which n^2 numbers a row cost more than the series; chosen.
inline constexpr Eigen::Index most_modal_tangents = 600;

/// The motion and the tangents of all parameters at one time.
struct TangentsAt {
  SeriesPoint motion;
  Vector force_bends;                 ///< second derivatives of the contact forces
  std::vector<SeriesPoint> tangents;  ///< one a parameter; empty vectors: it is not followed
};

class ModalStretch;
struct ModalStore;

class ModalTangents {
 public:
  /// Both must outlive it; of models that modes can follow (proportional_refusal). usual: how far apart most times
  /// are that are asked for; what follows from it alone is kept.
  ModalTangents(const Model& model, const std::vector<const ModelDerivative*>& derivatives, double usual);
  ~ModalTangents();
  ModalTangents(const ModalTangents&) = delete;
  ModalTangents& operator=(const ModalTangents&) = delete;

  /// From a decision on; modes, decision, forcing and the starts must live until the next one. False: modes
  /// cannot follow this stretch.
  [[nodiscard]] bool start(ModalSystem& modes, const Decision& decision, const Forcing& forcing,
                           std::vector<TangentSource> sources);
  /// At t, not before the last one. whole: of all degrees of freedom, accelerations of tangents too; else of those
  /// that columns and contacts show.
  [[nodiscard]] TangentsAt at(double t, bool whole);
  /// The motion alone, of what is shown, and without going there.
  [[nodiscard]] TangentsAt motion(double t) const;

 private:
  const Model& model_;
  std::vector<const ModelDerivative*> derivatives_;
  std::vector<Eigen::Index> shown_;
  double usual_;
  std::unique_ptr<ModalStore> store_;
  std::unique_ptr<ModalStretch> stretch_;
};

}  // namespace signorini
