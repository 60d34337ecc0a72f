// observed.hpp: observations of a run: its events, and at output times the columns of history.csv, N, T and outputs.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "certify/tracker.hpp"
#include "signorini/simulate.hpp"

namespace signorini {

struct Observed {
  Track track;
  KeptRows rows;
  Report report;

  [[nodiscard]] double at(std::size_t row, std::size_t column) const {
    return rows.values[row * rows.width + column];
  }
};

/// A column of Observed::rows.
struct ObservedColumn {
  std::string name;  ///< "A.ux", "first.N", an output's
  std::string
      kind;  ///< "displacement", "rotation", "velocity", "angular_velocity", "force", "output [m/s^2]"
  std::string unit;
};
[[nodiscard]] std::vector<ObservedColumn> observed_columns(const Model& model);

/// Periodically checks whether to continue, and stores nothing.
class Patient : public Recorder {
 public:
  explicit Patient(const std::function<bool()>& go_on) : go_on_(go_on) {}
  void event(const Event& /*event*/) override {}
  void sample(const Sample& /*sample*/) override {}
  bool progress(double /*t*/) override { return go_on_(); }

 private:
  const std::function<bool()>& go_on_;
};

/// Errors: SceneError for scenes that the engine refuses.
[[nodiscard]] Observed observe(const Model& model, const RunSpec& run, const std::function<bool()>& go_on);

/// Observations of a run that has ended.
[[nodiscard]] Observed observed(Tracker&& tracker, Report report);

}  // namespace signorini
