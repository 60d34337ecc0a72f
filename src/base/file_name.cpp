#include "base/file_name.hpp"

namespace signorini {

std::string file_name(std::string_view text, std::size_t most, std::string_view kept, char other) {
  std::string name(text.substr(0, most));
  for (char& c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       kept.find(c) != std::string_view::npos;
    if (!plain) c = other;
  }
  return name;
}

}  // namespace signorini
