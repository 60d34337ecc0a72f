// interrupt.hpp: SIGINT and SIGTERM, one handler for both and for all commands.
//
//   nothing to keep (set-up, check)   the program ends at once, exit code 130
//   an Interrupt lives (a run)        a wish to stop, noted: the run ends by itself and is kept, 130;
//                                     a second signal, or a run that has not ended after `patience`,
//                                     ends it at once
#pragma once

namespace signorini::cli {

/// From here on both signals end the program with exit code 130. Once, at the start of the program.
void end_on_interrupt();

/// Notes them while it lives. One at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  /// s from a noted signal to the end at the latest: longer than a step of any scene that can be computed.
  static constexpr unsigned patience = 30;
  [[nodiscard]] static bool asked();
};

}  // namespace signorini::cli
