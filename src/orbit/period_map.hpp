// period_map.hpp: motion over a period from a state at a section; derivative of the final state with respect to it.
//
//   z -> z(T; z),     Phi B: tangent motions of all columns of B, computed during the same run
//
// Phi: product of the propagators between events and of the events' rank-one jumps (sensitivity/tangent_run.hpp).
// Units: machine units of the computed model; events and energies are in the scene's units.
#pragma once

#include <array>

#include "engine/exact/modal/modal_flow.hpp"
#include "orbit/orbit_state.hpp"
#include "sensitivity/state_flow.hpp"

namespace signorini::orbit {

/// One pass through the period.
struct OrbitPass {
  Outcome outcome;
  OrbitPoint begin, end;
  std::vector<OrbitPoint> instants;  ///< just after each impact and each change of a contact state
  std::vector<Event> events;         ///< events of contacts, without jumps of loads
  Energy cycle_energy;
  double energy = 0.0;  ///< stored energy at the beginning, in the scene's unit
  /// Half of the largest range (maximum - minimum) of a displacement, a velocity and a shear, rotations included; in
  /// scales of the model; 0: at rest.
  double u_amplitude = 0.0, v_amplitude = 0.0, T_amplitude = 0.0;
  /// Half the largest range of a displacement, rotations excluded (displacement_range.hpp); scene's unit.
  double amplitude = 0.0;
  /// Phi B, rows: coordinates at the section; empty: not requested, or not available
  Eigen::MatrixXd end_derivatives;
  /// Error of end_derivatives by rounding and truncation of series, relative to the largest entry of end_derivatives.
  double derivatives_error = 0.0;
  std::string reason;  ///< reason why end_derivatives are not available
  std::vector<OutputExtremes> response;
  /// Minimum over the rows of f_s |N| - T and of f_s |N| + T, one per contact, in scales of the model.
  std::vector<std::array<double, 2>> margins;
  std::vector<bool> never_slips;  ///< contacts that stay closed without slip during the whole pass
  bool interrupted = false;

  [[nodiscard]] bool done() const { return outcome.kind == Outcome::Kind::done; }
};

/// Number of samples of a pass that computes margins. Chosen value: a parabola through three samples then has
/// an error of 1e-7 of the range.
inline constexpr int margin_samples = 192;

/// Options of one pass.
struct PassOptions {
  const OrbitState& start;
  double duration;
  bool tangents = true;
  bool outputs = false;  ///< compute extremes of outputs
  /// Number of samples from which u_amplitude, v_amplitude and T_amplitude are computed. Chosen value: they only scale the
  /// residual.
  int samples = 24;
  /// Number of nodes between which OrbitPass::amplitude is searched (displacement_range.hpp). Chosen values; `reported_nodes` for
  /// results, few for passes that only compare orbits.
  int nodes = 96;
  static constexpr int reported_nodes = 960;
};

class PeriodMap {
 public:
  /// model, run: in machine units; recorder: receives the progress, may be null.
  PeriodMap(Model model, const RunSpec& run, Recorder* recorder);

  [[nodiscard]] const Model& model() const { return model_; }
  /// Computes one pass through the period.
  [[nodiscard]] OrbitPass pass(const PassOptions& leg) const;
  /// Result of a run from `start`. Its last row is at the end of the run, so that last_state() can read it.
  [[nodiscard]] Result rows(const OrbitState& start, double duration) const;
  [[nodiscard]] const RunSpec& run() const { return run_; }
  /// Closed form that advances tangents between events. This form depends on the structure only, so successive maps
  /// share it. Null: not created yet, or the motion cannot be written in modes.
  [[nodiscard]] const std::shared_ptr<sensitivity::StateFlow>& flow() const { return flow_; }
  void take_flow(std::shared_ptr<sensitivity::StateFlow> flow) { flow_ = std::move(flow); }
  /// Uses the given cache for mode shapes of contact states; all maps of one search share this cache.
  void share(std::shared_ptr<modal::ModalCache> memory) { memory_ = std::move(memory); }

 private:
  Model model_;
  RunSpec run_;
  Recorder* recorder_;
  mutable std::shared_ptr<sensitivity::StateFlow> flow_;
  std::shared_ptr<modal::ModalCache> memory_ = std::make_shared<modal::ModalCache>();
};

}  // namespace signorini::orbit
