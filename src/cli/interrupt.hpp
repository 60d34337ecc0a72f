// interrupt.hpp: SIGINT and SIGTERM as a wish to stop: the first one is noted, a second one of its kind ends
// the program at once.
#pragma once

namespace signorini::cli {

/// Listens while it lives. One at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  [[nodiscard]] static bool asked();
};

}  // namespace signorini::cli
