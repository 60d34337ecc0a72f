// period_map.hpp: the motion over a period from a state at a section, and how its end moves with that state.
//
//   z -> z(T; z),     Phi B = the tangent motions of all columns of B, beside one run
//
// Phi: the product of the stretches' propagators and of the events' rank-one jumps (sensitivity/tangent_run.hpp).
// Units: of the model that is computed, the machine's; events and energies are those of the scene.
#pragma once

#include <array>

#include "engine/exact/modal/modal_memory.hpp"
#include "orbit/orbit_state.hpp"
#include "sensitivity/state_flow.hpp"

namespace signorini {

/// One pass through the period.
struct OrbitPass {
  Outcome outcome;
  OrbitPoint begin, end;
  std::vector<OrbitPoint> instants;  ///< those in between at which a state changed, just after
  std::vector<Event> events;         ///< without jumps of loads
  Energy cycle;
  double energy = 0.0;  ///< stored at the beginning; the scene's units
  /// Half the greatest range of displacements, velocities and shears, in scales of the model; 0: at rest. Rotations count.
  double u_amplitude = 0.0, v_amplitude = 0.0, T_amplitude = 0.0;
  double amplitude = 0.0;     ///< of displacements alone, without rotations; the scene's unit
  Eigen::MatrixXd end_rates;  ///< Phi B, rows: coordinates at the section; empty: not asked for, or not known
  double rates_error = 0.0;   ///< of end_rates, over their greatest entry: rounding and what series leave out
  std::string reason;         ///< why they are not known
  std::vector<OutputExtremes> response;
  /// Least over the rows of f_s |N| - T and of f_s |N| + T, one a contact, in scales of the model.
  std::vector<std::array<double, 2>> margins;
  std::vector<bool> held;  ///< contacts that never changed their state, closed and not slipping
  bool interrupted = false;

  [[nodiscard]] bool done() const { return outcome.kind == Outcome::Kind::done; }
};

/// Places of a pass whose margins decide; chosen: a parabola through three of them is wrong by 1e-7 of the swing.
inline constexpr int places_of_margins = 192;

/// What one pass is asked for.
struct OrbitLeg {
  const OrbitState& start;
  double duration;
  bool tangents = true;
  bool outputs = false;  ///< their extremes
  int places = 24;       ///< of which amplitudes are made; chosen: for scales of the residual
};

class PeriodMap {
 public:
  /// model, run: in the machine's units; recorder: for progress, or null.
  PeriodMap(Model model, const RunSpec& run, Recorder* recorder);

  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] OrbitPass pass(const OrbitLeg& leg) const;
  /// The row at the end, and all rows before: for last_state().
  [[nodiscard]] Result rows(const OrbitState& start, double duration) const;
  [[nodiscard]] const RunSpec& run() const { return run_; }
  /// What tangents cross stretches by, where modes can: of this structure, kept and handed on from map to map. Null: not
  /// made yet, or there is none.
  [[nodiscard]] const std::shared_ptr<StateFlow>& flow() const { return flow_; }
  void take_flow(std::shared_ptr<StateFlow> flow) { flow_ = std::move(flow); }
  /// Mode shapes of contact states, shared by all maps of one search.
  void share(std::shared_ptr<ModalMemory> memory) { memory_ = std::move(memory); }

 private:
  Model model_;
  RunSpec run_;
  Recorder* recorder_;
  mutable std::shared_ptr<StateFlow> flow_;
  std::shared_ptr<ModalMemory> memory_ = std::make_shared<ModalMemory>();
};

}  // namespace signorini
