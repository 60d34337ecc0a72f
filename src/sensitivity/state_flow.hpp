// state_flow.hpp: tangents by the initial state alone over a stretch, in the modes of its contact state.
//
//   w'' + alpha w' + L w = f = Y Phi^T sum_k t_k kt_k p_k           p_k: tangents of anchors, constant on a stretch
//   w(t) = c w0 + s w0' + h f,   w'(t) = c' w0 + s' w0' + h' f      mode by mode, in closed form (oscillators.hpp)
//   W = Phi X w,   w = Y Phi^T M W                                  W: n x columns
//
// Loads do not appear: they act on all neighbouring motions alike. So whatever drives the structure, a stretch costs four
// products of matrices, and its length costs nothing. Modes of a contact state are kept.
#pragma once

#include <map>

#include "engine/exact/modal/modal_system.hpp"
#include "engine/exact/modal/oscillators.hpp"
#include "sensitivity/tangent_state.hpp"

namespace signorini {

class StateFlow {
 public:
  /// Of a model that modes_uncouple(). The flow keeps a copy of it, in which loads and the start mean nothing.
  explicit StateFlow(const Model& model);

  /// Whether all that the flow depends on is the same: matrices, forms and stiffnesses of contacts.
  [[nodiscard]] bool fits(const Model& model) const;
  /// Whether the modes of this contact state are good enough.
  [[nodiscard]] bool knows(const Mode& mode);
  /// All tangents that are alive, `time` later: displacements, velocities; accelerations of degrees of freedom that
  /// contacts see; forces of contacts and their rates.
  void advance(const Mode& mode, double time, std::vector<TangentState>& states);

 private:
  /// Rows of flat amplitudes: real modes, real and imaginary parts of pairs.
  struct Modes {
    std::shared_ptr<const StateModes> state;
    Eigen::MatrixXd in, out, seen, from_tangent;  ///< seen: rows of out at the degrees of freedom of contacts
    Oscillators oscillators;
    bool good = false;
  };
  [[nodiscard]] const Modes& modes_of(const Mode& mode);
  void make(Modes& modes) const;
  void tell(const Mode& mode, const Eigen::MatrixXd& moved, const Eigen::MatrixXd& seen,
            std::vector<TangentState>& states) const;

  const Model model_;
  OpenBasis basis_;
  std::optional<ModalSystem> system_;
  std::vector<Eigen::Index> felt_;  // degrees of freedom that contacts see
  std::map<std::vector<State>, Modes> known_;
  std::size_t bytes_ = 0;
};

/// The modes of each contact state are uncoupled by damping alpha M, alpha >= 0 (modal_system.hpp).
[[nodiscard]] bool modes_uncouple(const Model& model);

}  // namespace signorini
