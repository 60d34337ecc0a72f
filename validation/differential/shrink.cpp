#include "differential/shrink.hpp"

#include <fmt/core.h>

#include <regex>
#include <sstream>

#include "differential/reductions.hpp"

namespace signorini::differential {
namespace {

constexpr int most_cuts = 20;

/// toml++ writes 17 digits; the shortest that read back say the same.
std::string with_short_numbers(const std::string& text) {
  static const std::regex number(R"(-?\d+\.\d+(e[+-]?\d+)?)");
  std::string result;
  auto from = text.cbegin();
  for (std::sregex_iterator it(text.begin(), text.end(), number), end; it != end; ++it) {
    result.append(from, (*it)[0].first);
    const std::string shortest = fmt::format("{}", std::stod(it->str()));
    // A number stays one of floating point, which later reductions look for.
    result += shortest.find_first_of(".e") == std::string::npos ? shortest + ".0" : shortest;
    from = (*it)[0].second;
  }
  return result.append(from, text.cend());
}

/// toml++ sorts the keys; schema has to come first.
std::string written(toml::table scene) {
  const auto schema = scene["schema"].value_or(std::int64_t{1});
  scene.erase("schema");
  std::ostringstream text;
  text << "schema = " << schema << '\n' << toml::toml_formatter(scene) << '\n';
  return with_short_numbers(text.str());
}

}  // namespace

std::string shrink(const std::string& text, const std::function<bool(const std::string&)>& shows,
                   int attempts) {
  toml::table scene = toml::parse(text);
  std::string best = text;
  const auto take_first = [&](const Tables& candidates) {
    for (const toml::table& candidate : candidates) {
      if (attempts-- <= 0) return false;
      const std::string smaller = written(candidate);
      if (!shows(smaller)) continue;
      scene = candidate;
      best = smaller;
      return true;
    }
    return false;
  };
  // What does not depend on time would be made shorter for ever.
  for (int i = 0; i < most_cuts && take_first(shorter(scene)); ++i) {
  }
  bool again = true;
  while (again && attempts > 0) {
    again = false;
    for (const auto kind : {without_parts, without_dofs, without_options, plainer_pairs, plainer_numbers})
      while (take_first(kind(scene))) again = true;
  }
  return best;
}

}  // namespace signorini::differential
