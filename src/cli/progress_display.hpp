// progress_display.hpp: display of a run in progress: progress line, interrupts, and the events for the final table.
//
//   ProgressDisplay display(run_directory, model, t_end, show_progress);
//   Report report = simulate(model, scene.run, display);
//
// All data are forwarded to another Recorder. After the first SIGINT or SIGTERM the run stops, and its results so far
// remain on disk; a second signal ends the program immediately.
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "run/forwarding_recorder.hpp"

namespace signorini::cli {

// Reaction to SIGINT and SIGTERM, the same for both signals and for all commands.
//
//   without an Interrupt object (set-up, check)   the program ends immediately with exit code 130
//   with an Interrupt object (a run)              the run stops after its current step, its results so far remain, exit
//                                                 code 130; after a second signal, or after grace_seconds, the program
//                                                 ends immediately

/// Installs the signal handler. To be called once, at the start of the program.
void end_on_interrupt();

/// While an object exists, signals only request a stop; requested() returns the request. Only one object may exist.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  /// Seconds from the first signal to the forced end of the program; steps of practical scenes take less time.
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
  /// Sets a function that is called once, after two seconds, with the estimated duration of the run in seconds. It returns
  /// a note to print, or "".
  void set_long_run_advice(std::function<std::string(double)> advice) { advice_ = std::move(advice); }

  /// Up to max_shown_events events are all shown; of more events, only the first and the last are shown.
  static constexpr std::size_t max_shown_events = 40, shown_first = 20, shown_last = 10;
  [[nodiscard]] const std::vector<Event>& first_events() const { return first_; }
  [[nodiscard]] const std::deque<Event>& last_events() const { return last_; }
  [[nodiscard]] long event_count() const { return count_; }

 private:
  void print_advice(double t);
  /// Text such as ", about 8 s left", estimated from the speed of the last seconds; empty during the first second.
  [[nodiscard]] std::string time_left(double t);

  Interrupt interrupt_;
  const Model& model_;
  double t_end_;
  bool show_progress_, keep_all_, line_shown_ = false;
  std::chrono::steady_clock::time_point next_line_;
  std::vector<Event> first_;  // the first max_shown_events events
  std::deque<Event> last_;    // the last shown_last events
  long count_ = 0;
  std::function<std::string(double)> advice_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point speed_from_ = start_, next_speed_from_ = start_;
  double speed_t_ = 0.0, next_speed_t_ = 0.0;
};

}  // namespace signorini::cli
