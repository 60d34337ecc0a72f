// fingerprint.hpp: short text that differs where texts differ, the same on every machine.
#pragma once

#include <string>

namespace signorini {

[[nodiscard]] std::string fingerprint_of(const std::string& text);

}  // namespace signorini
