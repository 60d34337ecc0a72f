#include "base/fingerprint.hpp"

#include <fmt/core.h>

namespace signorini {

void Fingerprint::add(std::string_view part) {
  std::uint64_t hash = hash_;  // a member would be stored after every byte
  for (const char c : part) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  hash_ = hash;
}

std::string Fingerprint::text() const { return fmt::format("{:016x}", hash_); }

std::string fingerprint_of(const std::string& text) {
  Fingerprint whole;
  whole.add(text);
  return whole.text();
}

}  // namespace signorini
