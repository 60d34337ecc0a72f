// json.hpp: reads and writes JSON. Parser and writer are compiled only in json.cpp, because they add four seconds to the
// compile time of each file that instantiates them (docs/decisions/dense-algebra-in-one-file.md).
#pragma once

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>

namespace signorini::base {

using Json = nlohmann::ordered_json;

/// Indented text with a final line break. Bytes that are not UTF-8 become replacement characters, and -0 becomes 0.
[[nodiscard]] std::string json_text(const Json& json);
/// JSON text in one line, without a line break. Bytes that are not UTF-8 become replacement characters, and -0 becomes 0.
[[nodiscard]] std::string json_line(const Json& json);
/// Reads one JSON value. Errors: Json::exception.
[[nodiscard]] Json parse_json(std::istream& stream);
[[nodiscard]] Json parse_json(const std::string& text);

}  // namespace signorini::base
