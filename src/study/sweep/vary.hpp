// vary.hpp: values of the keys of a sweep.
//
//   0:1.3:0.1     start:stop:step, the stop included if it is a multiple; 0.3 is 0.3, not 0.30000000000000004
//   ida,exact     a list of TOML values; commas inside of quotes, brackets and braces do not separate
//
// Several ranges form a product; the last one varies fastest. Keys of one group vary in step, and count as one range,
// at the place of the first of them.
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
  int group = 0;                    ///< keys of the same group, above 0, vary in step
  bool sampled = false;             ///< the values are draws from the distribution `text`

  friend bool operator==(const Vary&, const Vary&) = default;
};

/// "vary" or "sample", the option that gave the values.
[[nodiscard]] const char* option_of(const Vary& vary);
/// Override for one of its values.
[[nodiscard]] Override override_of(const Vary& vary, const std::string& value);
/// Refuses duplicates: two options that set one key under different names (contacts.*.friction and
/// contacts.first.friction), and a setting all of whose keys are varied. Errors: UsageError; those of the file.
void check_overlaps(const std::string& scene, const std::vector<Vary>& varied,
                    const std::vector<Override>& settings);
/// Errors: UsageError, also for more than 1e6 values.
[[nodiscard]] Vary parse_vary(const std::string& text);
/// The product: entry i holds one value for each Vary, in their order. Errors: UsageError for more than 1e6 points, for
/// a repeated path, and for keys in step with different numbers of values.
[[nodiscard]] std::vector<std::vector<Override>> points(const std::vector<Vary>& varied);

}  // namespace signorini
