#include "base/json.hpp"

#include <algorithm>
#include <cmath>
#include <istream>

namespace signorini::base {

namespace {

void remove_negative_zeros(Json& json) {
  if (json.is_structured())
    for (Json& part : json) remove_negative_zeros(part);
  else if (json.is_number_float())
    json = json.get<double>() + 0.0;
}

bool has_negative_zero(const Json& json) {
  if (json.is_structured()) return std::any_of(json.begin(), json.end(), has_negative_zero);
  return json.is_number_float() && json.get<double>() == 0.0 && std::signbit(json.get<double>());
}

/// JSON text without negative zeros; the value is copied only if it contains a negative zero.
std::string json_dump(const Json& json, int indent) {
  if (has_negative_zero(json)) {
    Json mended = json;
    remove_negative_zeros(mended);
    return mended.dump(indent, ' ', false, Json::error_handler_t::replace);
  }
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string json_text(const Json& json) { return json_dump(json, 2) + "\n"; }

std::string json_line(const Json& json) { return json_dump(json, -1); }

Json parse_json(std::istream& stream) { return Json::parse(stream); }

Json parse_json(const std::string& text) { return Json::parse(text); }

}  // namespace signorini::base
