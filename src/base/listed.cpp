#include "base/listed.hpp"

#include <algorithm>

namespace signorini {

std::string listed_plainly(const std::vector<std::string>& texts, std::size_t most) {
  std::string text;
  const std::size_t shown = std::min(texts.size(), most);
  for (std::size_t i = 0; i < shown; ++i) {
    const bool last = i > 0 && i + 1 == texts.size();
    text += (i == 0 ? "" : last ? " and " : ", ") + texts[i];
  }
  return shown < texts.size() ? text + " and " + std::to_string(texts.size() - shown) + " more" : text;
}

std::string listed(const std::vector<std::string>& names, std::size_t most) {
  std::vector<std::string> quoted;
  quoted.reserve(names.size());
  for (const std::string& name : names) quoted.push_back("'" + name + "'");
  return listed_plainly(quoted, most);
}

}  // namespace signorini
