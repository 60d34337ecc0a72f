#include "base/host_info.hpp"

#include <sched.h>

#include <algorithm>
#include <fstream>
#include <thread>

namespace signorini::base {

#ifdef __clang__
static constexpr const char* compiler = __VERSION__;  // begins with "Clang"
#else
static constexpr const char* compiler = "g++ " __VERSION__;
#endif

HostInfo host_info() {
  HostInfo machine{"unknown processor", processor_count(), compiler};
#ifdef __OPTIMIZE__
  machine.compiler += ", optimised";
#else
  machine.compiler += ", not optimised";
#endif
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (!line.starts_with("model name") || colon == std::string::npos) continue;
    machine.processor = line.substr(colon + 2);
    break;
  }
  return machine;
}

std::size_t processor_count() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof set, &set) == 0)
    return std::max<std::size_t>(1, static_cast<std::size_t>(CPU_COUNT(&set)));
  return std::max(1U, std::thread::hardware_concurrency());
}

}  // namespace signorini::base
