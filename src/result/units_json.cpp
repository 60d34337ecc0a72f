#include "result/units_json.hpp"

#include "base/json.hpp"

namespace signorini {

Json units_json(const Units& units) {
  return {{"force", units.force}, {"mass", units.mass}, {"length", units.length}, {"time", units.time}};
}

Units units_from(const Json& json) {
  return {json.at("force"), json.at("mass"), json.at("length"), json.at("time")};
}

}  // namespace signorini
