#include "study/optional_values.hpp"

#include "result/summary_parts.hpp"
#include "scene/overrides.hpp"

namespace signorini::study {

std::string key_unit(const std::string& path, const Units& units) {
  const scene::Key* key = scene::key_of(path);
  return key != nullptr ? result::unit_in_words(key->unit, units) : "";
}

std::string key_with_unit(const std::string& path, const Units& units) {
  const std::string unit = key_unit(path, units);
  return unit.empty() ? path : path + " [" + unit + "]";
}

}  // namespace signorini::study
