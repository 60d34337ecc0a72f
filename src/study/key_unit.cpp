#include "study/key_unit.hpp"

#include "result/unit_words.hpp"
#include "scene/key_path.hpp"

namespace signorini {

std::string key_unit(const std::string& path, const Units& units) {
  const Key* key = key_of(path);
  return key != nullptr ? unit_in_words(key->unit, units) : "";
}

std::string key_with_unit(const std::string& path, const Units& units) {
  const std::string unit = key_unit(path, units);
  return unit.empty() ? path : path + " [" + unit + "]";
}

}  // namespace signorini
