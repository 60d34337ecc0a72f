// file_name.hpp: any text as a part of a file's name.
//
//   file_name("first support", 80, "-_", '_') == "first_support"
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace signorini {

/// The first `most` characters; what is neither a letter or digit of ASCII nor in `kept` becomes `other`.
[[nodiscard]] std::string file_name(std::string_view text, std::size_t most, std::string_view kept,
                                    char other);

}  // namespace signorini
