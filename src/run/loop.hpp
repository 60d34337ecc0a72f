// loop.hpp: the loop of signorini/simulate.hpp, in the units of its model, which may be a part of one.
//
//   Loop loop(model, spec, engine, method, recorder, company);
//   loop.begin();   loop.on(t_1);   loop.on(t_2); ...   loop.end()
//
// Where on() pauses changes nothing: the stretch that is under way goes on with its next step.
#pragma once

#include <memory>
#include <optional>

#include "decide/decider.hpp"
#include "run/audit.hpp"
#include "run/breakpoints.hpp"
#include "run/curve_record.hpp"
#include "run/engines.hpp"
#include "run/event_log.hpp"
#include "run/large_motions.hpp"
#include "run/last_touch.hpp"
#include "run/meddler.hpp"
#include "run/motion_record.hpp"
#include "run/observer.hpp"
#include "run/part_share.hpp"
#include "run/response.hpp"
#include "run/run_witness.hpp"
#include "run/samples.hpp"
#include "run/standstill.hpp"
#include "run/steering.hpp"
#include "run/zero_since.hpp"

namespace signorini {

/// Who follows a run from inside; nobody: null, or empty.
struct Company {
  RoundListener listener = {};
  MotionObserver* observer = nullptr;
  Meddler* meddler = nullptr;

  [[nodiscard]] bool none() const { return !listener && observer == nullptr && meddler == nullptr; }
};

/// What a loop has found, in the units of its model. Times are said in those of the scene.
struct Ending {
  Report report;
  /// What a double leaves of the energy stored, whose terms may be far greater than their sum.
  double energy_rounding = 0.0;
  bool grave = false;  ///< it stopped for what its witness found
};

class Loop {
 public:
  /// All that is referred to must outlive it.
  Loop(Model& model, const RunSpec& spec, const EngineRow& engine, Method method, Recorder& recorder,
       const Company& company, const PartShare& share = {});

  /// Decides the states at 0. Once, before all else.
  void begin();
  /// Whether they could be decided.
  [[nodiscard]] bool begun() const { return begun_; }
  /// To the first step that ends at `until` or later, to t_end at most, or to where the run stops.
  void on(double until);
  [[nodiscard]] double t() const { return t_; }
  [[nodiscard]] const Outcome& outcome() const { return report_.outcome; }
  /// Whether on() has more to do.
  [[nodiscard]] bool goes_on() const { return going_ && t_ < spec_.t_end; }
  /// Of a run that goes no further. Once, after all else.
  [[nodiscard]] Ending end();

 private:
  const Model& corrected();
  bool stop(std::string reason, Outcome::Kind kind = Outcome::Kind::stopped);
  bool refuse(const Refusal& refusal);
  void watch();
  bool start();
  void open_stretch(double end);
  bool step();
  bool steer();
  bool steered();
  void pass(const Step& step);
  void pass_turns(const std::vector<Stepper::ContactTurn>& turns);
  bool instant(std::vector<Fired> fired, std::optional<Mode> adopted = std::nullopt);
  bool witnessed();
  void meddle(Instant now, Decision& decided);
  [[nodiscard]] std::vector<std::size_t> concerned(const Instant& now,
                                                   const std::optional<Mode>& adopted) const;
  bool pass_breakpoints(Instant& now);
  [[nodiscard]] Point decided_point() const;
  void take_decision(const std::optional<std::vector<std::size_t>>& changed);
  void add_curves(double t, double to);
  void emit(double t, Point& point);
  void warn_of_decision();
  [[nodiscard]] double rounding_of_energy() const;

  const Model& model_;
  const RunSpec& spec_;
  Recorder& recorder_;
  MotionObserver* observer_;  // null: nobody
  Meddler* meddler_;          // null: nobody
  Report report_;
  Structure structure_;
  ModeSystems systems_;
  Tolerance tolerance_;
  Decider decider_;
  std::unique_ptr<Stepper> engine_;
  std::unique_ptr<Model> truth_;  // null: model_
  RunWitness witness_;
  Auditor auditor_;
  EventLog log_;
  Samples samples_;
  MotionRecord motion_;
  CurveRecord curves_;
  ResponseWatch response_;
  LastTouch touches_;
  LargeMotions large_;
  ZeroSince zero_since_;
  Standstill standstill_;
  std::vector<Breakpoint> breakpoints_;
  Forcing forcing_;  // after t_
  Decision decision_;
  Point point_;
  Works works_{model_.contacts.size()};
  Energy last_energy_;
  double t_ = 0.0, resolution_ = 0.0;
  std::size_t next_breakpoint_ = 0;
  LoadChanges changes_;
  LoadChanges::Change change_;  // of the loads, at t_
  bool shares_ = false;         // it was said
  int gains_ = 0, releases_ = 0, at_limit_ = 0;
  bool begun_ = false, going_ = false;
  double stretch_end_ = 0.0;  // of the stretch that is under way
  bool under_way_ = false;
  bool same_forcing_ = false;  // the last instant has changed none
  bool residual_due_ = false;  // at the end of the step: once for every row
};

}  // namespace signorini
