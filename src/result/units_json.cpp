#include "result/units_json.hpp"

#include <nlohmann/json.hpp>

namespace signorini {

nlohmann::ordered_json units_json(const Units& units) {
  return {{"force", units.force}, {"mass", units.mass}, {"length", units.length}, {"time", units.time}};
}

Units units_from(const nlohmann::ordered_json& json) {
  return {json.at("force"), json.at("mass"), json.at("length"), json.at("time")};
}

}  // namespace signorini
