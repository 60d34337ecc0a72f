#include "base/machine.hpp"

#include <fstream>
#include <thread>

namespace signorini {

Machine this_machine() {
  Machine machine{"unknown processor", std::max(1U, std::thread::hardware_concurrency()), "g++ " __VERSION__};
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

}  // namespace signorini
