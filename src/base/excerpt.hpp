// excerpt.hpp: shortens foreign text for messages.
#pragma once

#include <string>
#include <string_view>

namespace signorini {

/// At most 80 characters, with "..." if it was longer; characters other than printable ASCII become '?'.
[[nodiscard]] std::string excerpt(std::string_view text);

/// True for valid UTF-8: no overlong forms, no surrogates, nothing beyond U+10FFFF.
[[nodiscard]] bool is_utf8(std::string_view text);

/// True for UTF-8 without control characters other than tabs and line breaks.
[[nodiscard]] bool is_plain_text(std::string_view text);

}  // namespace signorini
