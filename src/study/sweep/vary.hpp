// vary.hpp: which values a sweep takes.
//
//   0:1.3:0.1     start:stop:step, the stop included where it is a step; 0.3 is 0.3, not 0.30000000000000004
//   ida,exact     a list of TOML values; commas inside of quotes, brackets and braces do not part it
//
// Several ranges make a product; the last one runs fastest.
#pragma once

#include <string>
#include <vector>

#include "signorini/scene.hpp"

namespace signorini {

/// One `--vary path=values`.
struct Vary {
  std::string path;
  std::string text;                 ///< as given
  std::vector<std::string> values;  ///< each as `--set` takes it

  friend bool operator==(const Vary&, const Vary&) = default;
};

/// Errors: UsageError, also for more than 1e6 values.
[[nodiscard]] Vary parse_vary(const std::string& text);
/// The product: entry i holds one value a Vary, in their order. Errors: UsageError for more than 1e6 points,
/// and for a path that stands twice.
[[nodiscard]] std::vector<std::vector<Override>> points(const std::vector<Vary>& varied);

}  // namespace signorini
