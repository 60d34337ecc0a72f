#include "cli/interrupt.hpp"

#include <unistd.h>

#include <csignal>

#include "signorini/error.hpp"

namespace signorini::cli {

namespace {

volatile std::sig_atomic_t noting = 0, noted = 0;

// A signal handler may only make POSIX's async-signal-safe calls.
void end_or_note(int signal) {
  if (signal != SIGALRM && noting != 0 && noted == 0) {
    noted = 1;
    alarm(Interrupt::patience);
    return;
  }
  constexpr char text[] = "error: interrupted\n";
  [[maybe_unused]] const ssize_t told = write(STDERR_FILENO, text, sizeof text - 1);
  _exit(static_cast<int>(ExitCode::interrupted));
}

}  // namespace

void end_on_interrupt() {
  struct sigaction action {};
  action.sa_handler = end_or_note;
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM, SIGALRM}) sigaction(signal, &action, nullptr);
}

Interrupt::Interrupt() { noting = 1; }

Interrupt::~Interrupt() {
  noting = 0;
  alarm(0);
}

bool Interrupt::asked() { return noted != 0; }

}  // namespace signorini::cli
