// steering.hpp: loads that are changed while a run is on its way.
//
//   f(t) <- f before now, the new history from now on;   breakpoints follow
//
// Pieces of a history that forcings hold stay where they are until the run ends.
#pragma once

#include "run/engines.hpp"

namespace signorini {

/// Turns what is asked for, in the scene's units, into changes of the model that is computed.
class LoadChanges final : public Steering {
 public:
  /// All must outlive it.
  LoadChanges(Model& model, const RunSpec& run, const EngineRow& engine, const Method& method)
      : model_(model), run_(run), engine_(engine), method_(method) {}

  void set_load(const std::string& name, const History& history) override;

  /// The present instant, machine's time.
  void at(double t) { t_ = t; }
  /// Whether anything is changed, and whether a value jumps.
  struct Change {
    bool any = false, jump = false;
  };
  /// What was asked for since the last call is in force now.
  void apply() { change_ = std::exchange(asked_, {}); }
  /// In force at the present instant.
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
