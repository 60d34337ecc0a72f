// share.hpp: the rows of a sweep that one of several processes computes.
//
//   3/16     every 16th row, starting with the third
//   auto     from the environment of Open MPI, of other launchers with PMI, and of Slurm arrays
//
// A launcher inside an array multiplies: task 2 of 4, rank 1 of 8 is share 10/32.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

namespace signorini {

struct Share {
  std::size_t number = 1, count = 1;  ///< number counts from 1

  [[nodiscard]] bool holds(std::size_t row) const { return row % count == number - 1; }  ///< row from 0
  [[nodiscard]] bool all() const { return count == 1; }
  [[nodiscard]] std::string text() const { return std::to_string(number) + "/" + std::to_string(count); }
  friend bool operator==(const Share&, const Share&) = default;
};

/// Value of an environment variable, if it is set.
using Environment = std::function<std::optional<std::string>(const char* name)>;

/// Errors: UsageError for anything but K/N with 1 <= K <= N or "auto", and for auto without such variables.
[[nodiscard]] Share parse_share(const std::string& text, const Environment& environment);

/// Number of processes of this sweep that a launcher (not an array) has started; 1 without a launcher.
[[nodiscard]] std::size_t ranks(const Environment& environment);

}  // namespace signorini
