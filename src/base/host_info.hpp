// host_info.hpp: processor and compiler of the machine on which run times are measured.
#pragma once

#include <cstddef>
#include <string>

namespace signorini::base {

struct HostInfo {
  std::string processor;  ///< name given by the system; "unknown processor" if the system gives none
  std::size_t cores = 1;  ///< processor_count()
  std::string compiler;   ///< compiler name, version and optimisation, for example "g++ 12.2.0, optimised"
};

[[nodiscard]] HostInfo host_info();

/// Number of processors available to this process.
[[nodiscard]] std::size_t processor_count();

}  // namespace signorini::base
