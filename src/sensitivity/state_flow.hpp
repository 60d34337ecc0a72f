// state_flow.hpp: tangents with respect to the initial state over a stretch, in the modes of its contact state.
//
//   w'' + alpha w' + L w = f = Y Phi^T sum_k t_k kt_k p_k           p_k: tangents of anchors, constant on a stretch
//   w(t) = c w0 + s w0' + h f,   w'(t) = c' w0 + s' w0' + h' f      mode by mode, in closed form (oscillators.hpp)
//   W = Phi X w,   w = Y Phi^T M W                                  W: n x columns
//
// Loads do not appear, because they act equally on all neighbouring motions. So a stretch costs four matrix products for any
// excitation and any length. The modes of each contact state are stored.
#pragma once

#include <map>

#include "engine/exact/modal/modal_system.hpp"
#include "engine/exact/modal/oscillators.hpp"
#include "sensitivity/tangent_state.hpp"

namespace signorini::sensitivity {

class StateFlow {
 public:
  /// modes_uncouple(model) must be true. The object keeps a copy of the model; loads and initial state of the copy are not
  /// used.
  explicit StateFlow(const Model& model);

  /// True if the given model has the same data on which the flow depends: matrices, and forms and stiffnesses of contacts.
  [[nodiscard]] bool matches(const Model& model) const;
  /// True if the modes of this contact state are accurate enough to be used.
  [[nodiscard]] bool has_accurate_modes(const contact::ContactStates& contact_states);
  /// Advances all valid tangents by `time`: displacements, velocities, accelerations at degrees of freedom with contacts,
  /// contact forces and their rates.
  void advance(const contact::ContactStates& contact_states, double time, std::vector<TangentState>& states);

 private:
  /// Rows of matrices are flat amplitudes: real modes, then real parts and imaginary parts of pairs.
  struct Modes {
    std::shared_ptr<const modal::StateModes> state;
    /// in: maps degrees of freedom to flat amplitudes; out: the inverse map; seen: rows of `out` at degrees of freedom with
    /// contacts; from_tangent: amplitudes that a unit force along t of each contact excites.
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

/// True if damping is alpha M with alpha >= 0 and contacts have constant stiffness, so that modes are uncoupled in each
/// state.
[[nodiscard]] bool modes_uncouple(const Model& model);

}  // namespace signorini::sensitivity
