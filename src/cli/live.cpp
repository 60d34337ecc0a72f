#include "cli/live.hpp"

#include <fmt/core.h>

#include <csignal>

#include "cli/terminal.hpp"

namespace signorini::cli {

namespace {

constexpr int stops[] = {SIGINT, SIGTERM};

volatile std::sig_atomic_t interrupted = 0;

void note_interrupt(int) { interrupted = 1; }

}  // namespace

Live::Live(Recorder& next, const Model& model, double t_end, bool show_progress)
    : next_(next),
      model_(model),
      t_end_(t_end),
      show_progress_(show_progress && stderr_is_terminal()),
      next_line_(std::chrono::steady_clock::now() + std::chrono::milliseconds(300)) {
  struct sigaction action {};
  action.sa_handler = note_interrupt;
  action.sa_flags = SA_RESTART;
  action.sa_flags |= static_cast<int>(SA_RESETHAND);  // the second one is not ours
  for (const int signal : stops) sigaction(signal, &action, nullptr);
}

Live::~Live() {
  if (line_shown_) progress_line("");
  for (const int signal : stops) std::signal(signal, SIG_DFL);
}

void Live::event(const Event& event) {
  next_.event(event);
  ++count_;
  if (first_.size() < most_shown) first_.push_back(event);
  last_.push_back(event);
  if (last_.size() > shown_last) last_.pop_front();
}

bool Live::progress(double t) {
  reached_ = t;
  const bool go_on = next_.progress(t) && interrupted == 0;
  const auto now = std::chrono::steady_clock::now();
  if (show_progress_ && now >= next_line_) {
    next_line_ = now + std::chrono::milliseconds(100);
    progress_line(fmt::format("t = {:.6g} of {:.6g} {}, {:.0f} %, {} events", t, t_end_, model_.units.time,
                              t_end_ > 0.0 ? 100.0 * t / t_end_ : 0.0, count_));
    line_shown_ = true;
  }
  return go_on;
}

}  // namespace signorini::cli
