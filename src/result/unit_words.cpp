#include "result/unit_words.hpp"

#include <array>
#include <cctype>
#include <utility>

namespace signorini {

std::string unit_in_words(std::string_view unit, const Units& units) {
  const std::array<std::pair<std::string_view, const std::string*>, 4> words = {
      {{"force", &units.force}, {"mass", &units.mass}, {"length", &units.length}, {"time", &units.time}}};
  std::string text;
  for (std::size_t at = 0; at < unit.size();) {
    std::size_t end = at;
    while (end < unit.size() && std::isalpha(static_cast<unsigned char>(unit[end])) != 0) ++end;
    if (end == at) {
      text += unit[at] == '*' ? ' ' : unit[at];
      ++at;
      continue;
    }
    const std::string_view word = unit.substr(at, end - at);
    std::string said(word);
    for (const auto& [name, own] : words)
      if (word == name) said = *own;
    text += said;
    at = end;
  }
  return text;
}

}  // namespace signorini
