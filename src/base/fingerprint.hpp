// fingerprint.hpp: short text that differs if texts differ, the same on every machine.
//
//   FNV-1a of 64 bits:   h = 14695981039346656037,  for each byte  h = (h xor byte) 1099511628211 mod 2^64
//   sixteen hexadecimal digits of h
//
// A single changed byte always changes the fingerprint; any other change does so except with the probability 2^-64.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace signorini {

/// The text may be passed in parts.
class Fingerprint {
 public:
  void add(std::string_view part);
  [[nodiscard]] std::string text() const;

 private:
  std::uint64_t hash_ = 14695981039346656037ULL;
};

[[nodiscard]] std::string fingerprint_of(const std::string& text);

}  // namespace signorini
