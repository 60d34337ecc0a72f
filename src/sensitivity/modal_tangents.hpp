// modal_tangents.hpp: motion and tangents on a stretch with constant forces, in the modes of the stretch's contact state.
//
//   z'' + alpha z' + L z = p                                        the motion, engine/exact/modal
//   w'' + alpha w' + L w = f - B z - G z'                           the tangent of one parameter
//   B = Y Phi^T ( K_p + contacts' ) Phi X - Y Phi^T M_p Phi X L,    G = Y Phi^T ( C_p - alpha M_p ) Phi X
//   w_k(t) = w0 c + w0' s + f h + sum_l ( B_kl y_l[k, l] + G_kl y_l'[k, l] )
//
// For y_l[k, l] see oscillator_pairs.hpp. contacts': n (N_gap,p n + N_gap n_p)^T + ..., products of few vectors. The cost of
// a stretch does not depend on its length. A constant part p_l / l_l of the motion is included in f if it is at most a few
// thousand times the motion.
#pragma once

#include <map>
#include <memory>

#include "engine/exact/modal/oscillators.hpp"
#include "sensitivity/contact_rates.hpp"
#include "sensitivity/oscillator_pairs.hpp"
#include "sensitivity/state_rates.hpp"

namespace signorini::sensitivity {

/// Largest number n of degrees of freedom; with more, n^2 operations per row cost more than the series. Chosen value.
inline constexpr Eigen::Index max_modal_tangent_dofs = 600;

/// Motion and tangents of all parameters at one time.
struct MotionAndTangents {
  SeriesPoint motion;
  Vector force_bends;  ///< second time derivatives of the contact forces
  /// One entry per parameter; its vectors are empty if the tangent is not computed.
  std::vector<SeriesPoint> tangents;
};

class ModalStretch;
struct TangentCache;

class ModalTangents {
 public:
  /// For models whose motion can be computed in modes (proportional_refusal). Model and derivatives must outlive the object.
  /// usual: most frequent time between two requested times; data for steps of this length are stored.
  ModalTangents(const Model& model, const std::vector<const ModelDerivative*>& derivatives, double usual);
  ~ModalTangents();
  ModalTangents(const ModalTangents&) = delete;
  ModalTangents& operator=(const ModalTangents&) = delete;

  /// Starts a stretch after a decision. Returns false if modes cannot represent the motion. Modes, decision, forcing and the
  /// starts of the tangents must live until the next stretch.
  [[nodiscard]] bool start(modal::ModalSystem& modes, const decide::Decision& decision,
                           const motion::Forcing& forcing, std::vector<TangentSource> sources);
  /// Values at t, which must not be before the last t. whole: all degrees of freedom, with accelerations of tangents;
  /// otherwise only the degrees of freedom of columns and contacts.
  [[nodiscard]] MotionAndTangents at(double t, bool whole);
  /// Displayed values of the motion alone at t; the stretch is not advanced.
  [[nodiscard]] MotionAndTangents motion(double t) const;

 private:
  const Model& model_;
  std::vector<const ModelDerivative*> derivatives_;
  std::vector<Eigen::Index> shown_;
  double usual_;
  std::unique_ptr<TangentCache> store_;
  std::unique_ptr<ModalStretch> stretch_;
};

// Data that ModalTangents keeps for contact states that recur.
//
//   per state: B and G of every parameter (state_rates.hpp), displayed rows of the state's modes,
//              data of the usual step

/// Largest size of the store in bytes; if it is exceeded, all stored states are removed. Chosen value.
inline constexpr std::size_t max_state_bytes = std::size_t{1} << 28;

template <class S>
struct StateStore {
  std::vector<ParameterModes<S>> parameters;
  modal::RowMatrix shown;    // maps flat amplitudes to displayed degrees of freedom
  OscillatorPairs<S> usual;  // for the usual step; empty: not yet computed
};

/// Scratch arrays of one step. driven, dragging: y_l[k, l] of the motion and of its rate; ..._rate: their time derivatives.
template <class S>
struct StepWorkspace {
  OscillatorPairs<S> pairs;
  Square<S> driven, driven_rate, dragging, dragging_rate;
};

struct TangentCache {
  std::vector<UnconstrainedRates> open;
  std::map<std::vector<State>, StateStore<double>> real;
  std::map<std::vector<State>, StateStore<modal::Complex>> pairs;
  std::size_t bytes = 0;
  StepWorkspace<double> real_work;
  StepWorkspace<modal::Complex> pair_work;
  StepWorkspace<double>& work(double) { return real_work; }
  StepWorkspace<modal::Complex>& work(modal::Complex) { return pair_work; }

  StateStore<double>* find(const std::vector<State>& states, double) {
    const auto at = real.find(states);
    return at == real.end() ? nullptr : &at->second;
  }
  StateStore<modal::Complex>* find(const std::vector<State>& states, modal::Complex) {
    const auto at = pairs.find(states);
    return at == pairs.end() ? nullptr : &at->second;
  }
  StateStore<double>& keep(const std::vector<State>& states, StateStore<double> made) {
    return real.insert_or_assign(states, std::move(made)).first->second;
  }
  StateStore<modal::Complex>& keep(const std::vector<State>& states, StateStore<modal::Complex> made) {
    return pairs.insert_or_assign(states, std::move(made)).first->second;
  }
};

}  // namespace signorini::sensitivity
