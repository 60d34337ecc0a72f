#include "base/fingerprint.hpp"

#include <fmt/core.h>

#include <cstdint>

namespace signorini {

std::string fingerprint_of(const std::string& text) {
  std::uint64_t hash = 14695981039346656037ULL;  // FNV-1a
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return fmt::format("{:016x}", hash);
}

}  // namespace signorini
