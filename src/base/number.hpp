// number.hpp: converts numbers to text and back, independent of the locale.
//
//   shortest(0.1) == "0.1";  parse_number(shortest(x)) == x for every finite x
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace signorini {

/// The shortest digits that read back exactly (std::to_chars): "1e-08", "0.3", "100", "inf", "nan".
[[nodiscard]] std::string shortest(double value);

/// The whole text as a number (a leading + is allowed); nullopt if any character is left over.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

/// The whole text as an integer; nullopt if any character is left over or it overflows.
[[nodiscard]] std::optional<long long> parse_integer(std::string_view text);

/// "1 value", "3 values".
[[nodiscard]] std::string count_of(std::size_t number, std::string_view thing);

}  // namespace signorini
