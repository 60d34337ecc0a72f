#include "study/speed/decades.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/number.hpp"
#include "signorini/error.hpp"

namespace signorini {

namespace {

constexpr double most_values = 100;

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

double positive(const std::string& option, const std::string& text) {
  const std::optional<double> number = parse_number(text);
  if (!number || !std::isfinite(*number) || !(*number > 0.0))
    throw UsageError(fmt::format("{}: found \"{}\", expected a number > 0", option, text));
  return *number;
}

}  // namespace

double tidy(double value) { return *parse_number(fmt::format("{:.12g}", value)); }

std::vector<double> parse_decades(const std::string& option, const std::string& text) {
  const std::string given = option + " " + text;
  const std::vector<std::string> parts = split(text, ':');
  std::vector<double> values;
  if (parts.size() == 1) {
    for (const std::string& part : split(text, ',')) values.push_back(positive(given, part));
  } else if (parts.size() <= 3) {
    const double start = positive(given, parts[0]), stop = positive(given, parts[1]);
    const double factor = parts.size() == 3 ? positive(given, parts[2]) : 10.0;
    if (!(factor > 1.0))
      throw UsageError(fmt::format("{}: found the factor {}, expected more than 1", given, parts[2]));
    // A stop that is reached up to rounding is included.
    const double count = std::floor(std::abs(std::log(stop / start)) / std::log(factor) + 1e-9) + 1.0;
    if (!(count <= most_values))
      throw UsageError(fmt::format("{}: makes {:.0f} values, expected at most 100", given, count));
    for (double k = 0.0; k < count; ++k)
      values.push_back(tidy(start * std::pow(factor, stop < start ? -k : k)));
  } else {
    throw UsageError(
        fmt::format("{}: found {} numbers between colons, expected start:stop or start:stop:factor", given,
                    parts.size()));
  }
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::count(values.begin(), values.end(), values[i]) > 1)
      throw UsageError(fmt::format("{}: {} stands twice", given, shortest(values[i])));
  return values;
}

}  // namespace signorini
