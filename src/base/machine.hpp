// machine.hpp: what times were measured on.
#pragma once

#include <string>

namespace signorini {

struct Machine {
  std::string processor;  ///< as the system names it; "unknown processor" where it does not
  unsigned cores = 1;     ///< this process may use
  std::string compiler;   ///< "g++ 12.2.0, optimised"
};

[[nodiscard]] Machine this_machine();

}  // namespace signorini
