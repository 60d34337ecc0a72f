// steering.hpp: changes of loads during a run.
//
//   f(t) <- f before now, the new history from now on;   breakpoints are updated
//
// Pieces of a history that forcings refer to stay in memory until the run ends.
#pragma once

#include "run/engines.hpp"

namespace signorini {

/// Converts requests, in the scene's units, to changes of the computed model.
class LoadChanges final : public Steering {
 public:
  /// All arguments must outlive the object.
  LoadChanges(Model& model, const RunSpec& run, const EngineRow& engine, const Method& method)
      : model_(model), run_(run), engine_(engine), method_(method) {}

  void set_load(const std::string& name, const History& history) override;

  /// Sets the current time, in the units of the computation.
  void at(double t) { t_ = t; }
  /// Flags: a load has changed; a value jumps.
  struct Change {
    bool any = false, jump = false;
  };
  /// Puts the requests since the last call in force.
  void apply() { change_ = std::exchange(asked_, {}); }
  /// Change at the current instant.
  [[nodiscard]] const Change& change() const { return change_; }

 private:
  Model& model_;
  const RunSpec& run_;
  const EngineRow& engine_;
  const Method& method_;
  double t_ = 0.0;
  Change asked_, change_;
  std::vector<History> past_;
};

}  // namespace signorini
