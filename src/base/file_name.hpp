// file_name.hpp: converts text to a part of a file name.
//
//   file_name("first support", 80, "-_", '_') == "first_support"
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace signorini {

/// The first `most` characters; characters other than ASCII letters, digits and those in `kept` become `other`.
[[nodiscard]] std::string file_name(std::string_view text, std::size_t most, std::string_view kept,
                                    char other);

}  // namespace signorini
