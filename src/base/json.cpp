#include "base/json.hpp"

#include <istream>

namespace signorini {

std::string json_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string json_line(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json parse_json(std::istream& stream) { return Json::parse(stream); }

Json parse_json(const std::string& text) { return Json::parse(text); }

}  // namespace signorini
