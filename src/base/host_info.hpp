// host_info.hpp: the machine on which times were measured.
#pragma once

#include <cstddef>
#include <string>

namespace signorini::base {

struct HostInfo {
  std::string processor;  ///< as the system names it; "unknown processor" if it does not
  std::size_t cores = 1;  ///< processor_count()
  std::string compiler;   ///< "g++ 12.2.0, optimised"
};

[[nodiscard]] HostInfo host_info();

/// Number of processors available to this process.
[[nodiscard]] std::size_t processor_count();

}  // namespace signorini::base
