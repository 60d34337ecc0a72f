// keys.hpp: keys and values of a scene file, in the order in which they are drawn.
//
//   table("[[loads]]", Keys().name("node", "B").set("amplitude", draw.real(1, 2)).set("history", "{ ... }"))
//
// Calls in a chain are evaluated from left to right, arguments of one call are not: so a scene draws at
// most one number a call, and a seed means the same with every compiler.
#pragma once

#include <fmt/core.h>

#include <string>
#include <vector>

namespace signorini::differential {

class Keys {
 public:
  Keys& set(const char* key, double value) { return set(key, fmt::format("{}", value)); }
  /// A value as it stands in the file.
  Keys& set(const char* key, const std::string& value) {
    parts_.push_back(fmt::format("{} = {}", key, value));
    return *this;
  }
  /// A string.
  Keys& name(const char* key, const std::string& value) { return set(key, "\"" + value + "\""); }
  Keys& add(const Keys& more) {
    parts_.insert(parts_.end(), more.parts_.begin(), more.parts_.end());
    return *this;
  }

  /// One a line.
  [[nodiscard]] std::string lines() const {
    std::string all;
    for (const std::string& part : parts_) all += part + "\n";
    return all;
  }
  /// "{ a = 1, b = 2 }"
  [[nodiscard]] std::string braced() const {
    std::string all = "{ ";
    for (const std::string& part : parts_) all += (all.size() > 2 ? ", " : "") + part;
    return all + " }";
  }

 private:
  std::vector<std::string> parts_;
};

/// "\n[[loads]]\n..."
[[nodiscard]] inline std::string table(const char* header, const Keys& keys) {
  return "\n" + std::string(header) + "\n" + keys.lines();
}

}  // namespace signorini::differential
