// scene_units.hpp: converts results from the units of the computation to those of the scene.
//
//   value in the scene's units = value * factor        factors: Model::unit of the computed model
//
// Factors are powers of two, so the conversion has no rounding error.
#pragma once

#include "model/internal_units.hpp"
#include "signorini/result.hpp"
#include "signorini/trace.hpp"

namespace signorini::run {

/// Converts all values except guard_rate, which is in the scene's units already (event_log.hpp).
[[nodiscard]] Event to_scene_units(Event event, const Factors& of);
/// Converts a sample, without u and v.
[[nodiscard]] Sample to_scene_units(Sample sample, const Factors& of);
/// Converts a report, except the extremes of outputs.
[[nodiscard]] Report to_scene_units(Report report, const Factors& of);
/// Converts a report, including the extremes of the outputs of the computed model.
[[nodiscard]] Report to_scene_units(Report report, const Model& computed);
/// Converts displacements, velocities (order 1) or accelerations (order 2) of these degrees of freedom.
[[nodiscard]] Vector to_scene_units(Vector motion, const std::vector<Dof>& dofs, int order,
                                    const Factors& of);
/// Converts both sides of an instant. dofs: degrees of freedom of the computed model; amplitudes in a reduced model.
[[nodiscard]] InstantRow to_scene_units(InstantRow row, const std::vector<Dof>& dofs, const Factors& of);

/// Recorder that converts all data to the scene's units and forwards them.
class SceneUnitsRecorder : public Recorder {
 public:
  /// Model and recorder must outlive the object.
  SceneUnitsRecorder(const Model& model, Recorder& recorder) : model_(model), recorder_(recorder) {}
  void event(const Event& event) override { recorder_.event(to_scene_units(event, model_.unit)); }
  void sample(const Sample& sample) override { recorder_.sample(in_scene(sample)); }
  void frame(const Sample& sample) override { recorder_.frame(in_scene(sample)); }
  [[nodiscard]] bool wants_motion() const override { return recorder_.wants_motion(); }
  void motion(int contact, const std::vector<MotionRow>& rows) override;
  void curves(const Curves& curves) override { recorder_.curves(curves); }  // already in the scene's units
  void response(double t, const std::vector<double>& values) override;
  [[nodiscard]] bool wants_instants() const override { return recorder_.wants_instants(); }
  void instant(const InstantRow& row) override {
    recorder_.instant(to_scene_units(row, model_.dofs, model_.unit));
  }
  [[nodiscard]] bool steers() const override { return recorder_.steers(); }
  bool steer(const Sample& now, Steering& run) override { return recorder_.steer(in_scene(now), run); }
  bool progress(double t) override { return recorder_.progress(t * model_.unit.time); }

 private:
  [[nodiscard]] Sample in_scene(const Sample& sample);

  const Model& model_;
  Recorder& recorder_;
  Vector u_, v_;
  std::vector<double> values_;
};

/// Listener that converts rounds to the scene's units and calls `listener`; empty if `listener` is empty. The model must
/// outlive the result.
[[nodiscard]] RoundListener to_scene_units(const RoundListener& listener, const Model& model);

}  // namespace signorini::run
