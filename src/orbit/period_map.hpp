// period_map.hpp: motion over a period from a state at a section, and the derivative of its end by that state.
//
//   z -> z(T; z),     Phi B = the tangent motions of all columns of B, beside one run
//
// Phi: product of the stretches' propagators and of the events' rank-one jumps (sensitivity/tangent_run.hpp). Units:
// those of the computed model, the machine's; events and energies in units of the scene.
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
  std::vector<OrbitPoint> instants;  ///< just after each change of a state in between
  std::vector<Event> events;         ///< without jumps of loads
  Energy cycle_energy;
  double energy = 0.0;  ///< stored at the beginning; the scene's units
  /// Half the largest range of displacements, velocities and shears, in scales of the model; 0: at rest. Includes
  /// rotations.
  double u_amplitude = 0.0, v_amplitude = 0.0, T_amplitude = 0.0;
  double amplitude = 0.0;     ///< of displacements alone, without rotations; the scene's unit
  Eigen::MatrixXd end_rates;  ///< Phi B, rows: coordinates at the section; empty: not requested, or unknown
  /// Error of end_rates by rounding and truncation of series, relative to their largest entry.
  double rates_error = 0.0;
  std::string reason;  ///< reason why end_rates are unknown
  std::vector<OutputExtremes> response;
  /// Minimum over the rows of f_s |N| - T and of f_s |N| + T, one per contact, in scales of the model.
  std::vector<std::array<double, 2>> margins;
  std::vector<bool> never_slips;  ///< contacts that stayed closed without slip all the time
  bool interrupted = false;

  [[nodiscard]] bool done() const { return outcome.kind == Outcome::Kind::done; }
};

/// Number of samples of a pass for margins; chosen value: a parabola through three of them has an error of 1e-7 of the
/// range.
inline constexpr int margin_samples = 192;

/// Options of one pass.
struct PassOptions {
  const OrbitState& start;
  double duration;
  bool tangents = true;
  bool outputs = false;  ///< compute extremes of outputs
  int samples = 24;      ///< number of samples for amplitudes; chosen value: they only scale the residual
};

class PeriodMap {
 public:
  /// model, run: in the machine's units; recorder: for progress, or null.
  PeriodMap(Model model, const RunSpec& run, Recorder* recorder);

  [[nodiscard]] const Model& model() const { return model_; }
  /// One pass through the period.
  [[nodiscard]] OrbitPass pass(const PassOptions& leg) const;
  /// Rows of a run from this state; the last one is at the end, for last_state().
  [[nodiscard]] Result rows(const OrbitState& start, double duration) const;
  [[nodiscard]] const RunSpec& run() const { return run_; }
  /// Closed form with which tangents cross stretches. It belongs to the structure, and is passed from map to
  /// map. Null: not created yet, or modes cannot follow the motion.
  [[nodiscard]] const std::shared_ptr<sensitivity::StateFlow>& flow() const { return flow_; }
  void take_flow(std::shared_ptr<sensitivity::StateFlow> flow) { flow_ = std::move(flow); }
  /// Shares the mode shapes of contact states among all maps of one search.
  void share(std::shared_ptr<modal::ModalCache> memory) { memory_ = std::move(memory); }

 private:
  Model model_;
  RunSpec run_;
  Recorder* recorder_;
  mutable std::shared_ptr<sensitivity::StateFlow> flow_;
  std::shared_ptr<modal::ModalCache> memory_ = std::make_shared<modal::ModalCache>();
};

}  // namespace signorini::orbit
