#include "cli/interrupt.hpp"

#include <csignal>

namespace signorini::cli {

namespace {

constexpr int stops[] = {SIGINT, SIGTERM};

volatile std::sig_atomic_t interrupted = 0;

void note_interrupt(int) { interrupted = 1; }

}  // namespace

Interrupt::Interrupt() {
  struct sigaction action {};
  action.sa_handler = note_interrupt;
  action.sa_flags = SA_RESTART;
  action.sa_flags |= static_cast<int>(SA_RESETHAND);  // the second one is not ours
  for (const int signal : stops) sigaction(signal, &action, nullptr);
}

Interrupt::~Interrupt() {
  for (const int signal : stops) std::signal(signal, SIG_DFL);
}

bool Interrupt::asked() { return interrupted != 0; }

}  // namespace signorini::cli
