// state_flow.hpp: tangents by the initial state over a stretch, in the modes of its contact state.
//
//   w'' + alpha w' + L w = f = Y Phi^T sum_k t_k kt_k p_k           p_k: tangents of anchors, constant on a stretch
//   w(t) = c w0 + s w0' + h f,   w'(t) = c' w0 + s' w0' + h' f      mode by mode, in closed form (oscillators.hpp)
//   W = Phi X w,   w = Y Phi^T M W                                  W: n x columns
//
// Loads do not appear, because they act equally on all neighbouring motions. So for any excitation a stretch
// costs four matrix products, independent of its length. Modes of a contact state are kept.
#pragma once

#include <map>

#include "engine/exact/modal/modal_system.hpp"
#include "engine/exact/modal/oscillators.hpp"
#include "sensitivity/tangent_state.hpp"

namespace signorini::sensitivity {

class StateFlow {
 public:
  /// modes_uncouple(model) must be true. The flow keeps a copy of the model, whose loads and initial state
  /// are not used.
  explicit StateFlow(const Model& model);

  /// True if all data that the flow depends on are equal: matrices, forms and stiffnesses of contacts.
  [[nodiscard]] bool matches(const Model& model) const;
  /// True if the modes of this contact state are accurate enough.
  [[nodiscard]] bool has_accurate_modes(const contact::ContactStates& contact_states);
  /// Advances all active tangents by `time`: displacements, velocities; accelerations of degrees of freedom with
  /// contacts; contact forces and their rates.
  void advance(const contact::ContactStates& contact_states, double time, std::vector<TangentState>& states);

 private:
  /// Rows are flat amplitudes: real modes, real and imaginary parts of pairs.
  struct Modes {
    std::shared_ptr<const modal::StateModes> state;
    /// seen: rows of `out` at the degrees of freedom of contacts.
    Eigen::MatrixXd in, out, seen, from_tangent;
    modal::Oscillators oscillators;
    bool accurate = false;
  };
  [[nodiscard]] const Modes& modes_of(const contact::ContactStates& contact_states);
  void make(Modes& modes) const;
  void evaluate(const contact::ContactStates& contact_states, const Eigen::MatrixXd& moved,
                const Eigen::MatrixXd& seen, std::vector<TangentState>& states) const;

  const Model model_;
  modal::UnconstrainedBasis basis_;
  std::optional<modal::ModalSystem> system_;
  std::vector<Eigen::Index> affected_;  // degrees of freedom with contacts
  std::map<std::vector<State>, Modes> known_;
  std::size_t bytes_ = 0;
};

/// True if damping alpha M, alpha >= 0, leaves the modes of each contact state uncoupled (modal_system.hpp).
[[nodiscard]] bool modes_uncouple(const Model& model);

}  // namespace signorini::sensitivity
