// machine.hpp: what times were measured on.
#pragma once

#include <cstddef>
#include <string>

namespace signorini {

struct Machine {
  std::string processor;  ///< as the system names it; "unknown processor" where it does not
  std::size_t cores = 1;  ///< processors()
  std::string compiler;   ///< "g++ 12.2.0, optimised"
};

[[nodiscard]] Machine this_machine();

/// How many processors this process may use.
[[nodiscard]] std::size_t processors();

}  // namespace signorini
