// excerpt.hpp: what a message shows of a text that somebody else wrote.
#pragma once

#include <string>
#include <string_view>

namespace signorini {

/// At most 80 characters, "..." where more were there; what is not printable ASCII becomes '?'.
[[nodiscard]] std::string excerpt(std::string_view text);

/// Whether the bytes are UTF-8: no overlong forms, no surrogates, nothing beyond U+10FFFF.
[[nodiscard]] bool is_utf8(std::string_view text);

/// UTF-8 without control characters, but for tabs and line breaks.
[[nodiscard]] bool is_plain_text(std::string_view text);

}  // namespace signorini
