// stroboscopic_map.hpp: points of a bifurcation diagram: states of a run at the same phase of every period,
// or after every event of a type.
//
//   0.5             t_k = k 0.5 after the start, k = 1, 2, ...
//   loads           t_k = k times the period of the run's loads; the run ends with a complete period
//   slip@block      after every event `slip` of the contact `block`; without @block at all contacts
//
//   point = (t, columns of history.csv, outputs),  t >= settle
//
// If the state jumps at t, the point is the state after the jump. Units: those of the scene.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "run/forwarding_recorder.hpp"
#include "study/sweep/response_query.hpp"

namespace signorini::sweep {

struct StroboscopicMap {
  std::string text;       ///< value of --strobe
  double period = 0.0;    ///< time between points; 0: points are after events
  bool of_loads = false;  ///< the period is that of the scene's loads
  EventQuery event;
};
/// Parses the text of --strobe. Errors: UsageError that lists the model's names; SceneError for loads without
/// a common period.
[[nodiscard]] StroboscopicMap parse_strobe(const std::string& text, const Scene& scene, const Model& model);
/// Warning if the points are at varying phases of the loads. Empty if their phase is constant, or if the
/// loads have no period.
[[nodiscard]] std::string strobe_warning(const StroboscopicMap& strobe, const Scene& scene);

/// Name and unit of one value of a point.
struct StroboscopicColumn {
  std::string name, unit;
  bool output = false;  ///< true for an [[output]]
};
/// Columns of a point: the columns of history.csv, then the outputs.
[[nodiscard]] std::vector<StroboscopicColumn> strobe_columns(const Model& model);

struct StroboscopicPoint {
  double t = 0.0;
  std::vector<double> values;  ///< one value per column
};

/// Collects the points of a run, and forwards all data to the next recorder.
class StroboscopicRecorder : public run::ForwardingRecorder {
 public:
  /// All arguments must outlive the object.
  StroboscopicRecorder(const StroboscopicMap& strobe, double settle, const Model& model, Recorder& next)
      : run::ForwardingRecorder(&next), strobe_(strobe), settle_(settle), model_(model) {}

  void event(const Event& event) override;
  void sample(const Sample& sample) override;
  void response(double t, const std::vector<double>& values) override;
  [[nodiscard]] bool steers() const override {
    return strobe_.period == 0.0 || run::ForwardingRecorder::steers();
  }
  bool steer(const Sample& now, Steering& run) override;

  [[nodiscard]] const std::vector<StroboscopicPoint>& points() const { return points_; }

 private:
  void add(const Sample& now);
  void fill_outputs(StroboscopicPoint& point) const;

  const StroboscopicMap& strobe_;
  double settle_;
  const Model& model_;
  std::vector<StroboscopicPoint> points_;
  std::optional<double> event_;  // time of an event whose point has not been added yet
  std::optional<double> t_outputs_;
  std::vector<double> outputs_;
};

/// Copy of `run` with output rows at the points. With `loads` the run ends after an integer number of load periods.
[[nodiscard]] RunSpec with_strobe_rows(RunSpec run, const StroboscopicMap& strobe);

}  // namespace signorini::sweep
