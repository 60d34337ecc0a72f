#include "cli/progress_display.hpp"

#include <fmt/core.h>
#include <unistd.h>
#include <csignal>

#include "base/text.hpp"
#include "cli/terminal.hpp"
#include "signorini/error.hpp"

namespace signorini::cli {

ProgressDisplay::ProgressDisplay(Recorder& next, const Model& model, double t_end, bool show_progress,
                                 bool keep_all_events)
    : run::ForwardingRecorder(&next),
      model_(model),
      t_end_(t_end),
      show_progress_(show_progress && stderr_is_terminal()),
      keep_all_(keep_all_events),
      next_line_(std::chrono::steady_clock::now() + std::chrono::milliseconds(300)) {}

ProgressDisplay::~ProgressDisplay() {
  if (line_shown_) progress_line("");
}

void ProgressDisplay::event(const Event& event) {
  run::ForwardingRecorder::event(event);
  ++count_;
  if (keep_all_ || first_.size() < max_shown_events) first_.push_back(event);
  last_.push_back(event);
  if (last_.size() > shown_last) last_.pop_front();
}

void ProgressDisplay::print_advice(double t) {
  constexpr double seconds_before_advice = 2.0;  // s, time of the run before the advice
  const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  if (s < seconds_before_advice) return;
  const auto ask = std::exchange(advice_, nullptr);
  const std::string note = ask(s * t_end_ / t);
  if (note.empty()) return;
  if (line_shown_) progress_line("");
  print_note(note);
}

std::string ProgressDisplay::time_left(double t) {
  // Seconds before the first estimate; seconds over which the speed is averaged.
  constexpr double settled = 1.0, window = 5.0;
  const auto now = std::chrono::steady_clock::now();
  const auto seconds = [&](auto from) { return std::chrono::duration<double>(now - from).count(); };
  if (seconds(speed_from_) > window) {  // the mean speed is that of the last one or two windows
    speed_from_ = std::exchange(next_speed_from_, now);
    speed_t_ = std::exchange(next_speed_t_, t);
  }
  if (seconds(start_) < settled || !(t > speed_t_)) return "";
  return ", about " + base::duration_text(seconds(speed_from_) * (t_end_ - t) / (t - speed_t_)) + " left";
}

bool ProgressDisplay::progress(double t) {
  const bool go_on = run::ForwardingRecorder::progress(t) && !Interrupt::requested();
  if (advice_ && go_on && t > 0.0) print_advice(t);
  if (!show_progress_) return go_on;
  if (const auto now = std::chrono::steady_clock::now(); now >= next_line_) {
    next_line_ = now + std::chrono::milliseconds(100);
    progress_line(fmt::format("t = {:.6g} of {:.6g} {}, {:.0f} %, {} events{}", t, t_end_, model_.units.time,
                              t_end_ > 0.0 ? 100.0 * t / t_end_ : 0.0, count_, time_left(t)));
    line_shown_ = true;
  }
  return go_on;
}

namespace {

volatile std::sig_atomic_t interrupts_are_deferred = 0, interrupt_was_requested = 0;

// Signal handler; it may call only functions that are async-signal-safe in POSIX.
void handle_signal(int signal) {
  if (signal != SIGALRM && interrupts_are_deferred != 0 && interrupt_was_requested == 0) {
    interrupt_was_requested = 1;
    alarm(Interrupt::grace_seconds);
    return;
  }
  constexpr char text[] = "error: interrupted\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text, sizeof text - 1);
  _exit(static_cast<int>(ExitCode::interrupted));
}

}  // namespace

void end_on_interrupt() {
  struct sigaction action {};
  action.sa_handler = handle_signal;
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM, SIGALRM}) sigaction(signal, &action, nullptr);
}

Interrupt::Interrupt() { interrupts_are_deferred = 1; }

Interrupt::~Interrupt() {
  interrupts_are_deferred = 0;
  alarm(0);
}

bool Interrupt::requested() { return interrupt_was_requested != 0; }

}  // namespace signorini::cli
