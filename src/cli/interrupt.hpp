// interrupt.hpp: SIGINT and SIGTERM, one handler for both and for all commands.
//
//   without results (set-up, check)   the program ends at once, exit code 130
//   an Interrupt object exists (a run)  the request is noted: the run ends by itself and is kept, 130;
//                                     a second signal, or a run that has not ended after `patience`,
//                                     ends the program at once
#pragma once

namespace signorini::cli {

/// From this call on both signals end the program with exit code 130. To be called once, at the start of the program.
void end_on_interrupt();

/// Notes the signals during its lifetime. Only one object may exist.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  /// s from a noted signal to the forced end: longer than a step of any practical scene.
  static constexpr unsigned patience = 30;
  [[nodiscard]] static bool asked();
};

}  // namespace signorini::cli
