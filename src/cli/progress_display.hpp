// progress_display.hpp: display of a run in progress: progress line, interrupt, and the events for the final table.
//
//   ProgressDisplay display(run_directory, model, t_end, show_progress);
//   Report report = simulate(model, scene.run, display);
//
// All data are forwarded to another Recorder. After the first SIGINT or SIGTERM the run stops and is kept; a
// second signal ends the program at once.
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "run/forwarding_recorder.hpp"

namespace signorini::cli {

// SIGINT and SIGTERM, one handler for both and for all commands.
//
//   without results (set-up, check)     the program ends at once, exit code 130
//   an Interrupt object exists (a run)  the request is noted: the run ends by itself and is kept, code 130;
//                                       a second signal, or a run that has not ended after grace_seconds,
//                                       ends the program at once

/// From this call on both signals end the program with exit code 130. To be called once, at the start of the program.
void end_on_interrupt();

/// Notes the signals during its lifetime. Only one object may exist.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  /// Seconds from a noted signal to the forced end: longer than a step of any practical scene.
  static constexpr unsigned grace_seconds = 30;
  [[nodiscard]] static bool requested();
};

class ProgressDisplay : public run::ForwardingRecorder {
 public:
  ProgressDisplay(Recorder& next, const Model& model, double t_end, bool show_progress,
                  bool keep_all_events = false);
  ~ProgressDisplay() override;
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  void event(const Event& event) override;
  bool progress(double t) override;
  /// Sets a function that is called once, after two seconds, with the estimated total duration in seconds,
  /// and returns a note, or "".
  void set_long_run_advice(std::function<std::string(double)> advice) { advice_ = std::move(advice); }

  /// Up to this number of events are shown in full; otherwise the first and the last ones.
  static constexpr std::size_t max_shown_events = 40, shown_first = 20, shown_last = 10;
  [[nodiscard]] const std::vector<Event>& first_events() const { return first_; }
  [[nodiscard]] const std::deque<Event>& last_events() const { return last_; }
  [[nodiscard]] long event_count() const { return count_; }

 private:
  void advise(double t);
  /// ", about 8 s left", from the speed of the last seconds; empty at the beginning.
  [[nodiscard]] std::string time_left(double t);

  Interrupt interrupt_;
  const Model& model_;
  double t_end_;
  bool show_progress_, keep_all_, line_shown_ = false;
  std::chrono::steady_clock::time_point next_line_;
  std::vector<Event> first_;  // the first max_shown_events, or all
  std::deque<Event> last_;    // the last shown_last
  long count_ = 0;
  std::function<std::string(double)> advice_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point speed_from_ = start_, next_speed_from_ = start_;
  double speed_t_ = 0.0, next_speed_t_ = 0.0;
};

}  // namespace signorini::cli
