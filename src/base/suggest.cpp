#include "base/suggest.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>

namespace signorini {

namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

std::string nearest(std::string_view given, const std::vector<std::string>& known) {
  constexpr std::size_t longest = 60;  // longer names are unlikely to be typing errors
  if (given.size() > longest) return {};
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(1, given.size() / 3) + 1;
  for (const std::string& name : known) {
    if (name.size() > longest) continue;
    const std::size_t distance = edit_distance(lower(given), lower(name));
    if (distance < best_distance && distance < name.size()) {
      best = name;
      best_distance = distance;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view given, const std::vector<std::string>& known) {
  const std::string best = nearest(given, known);
  return best.empty() ? "" : fmt::format("; did you mean \"{}\"?", best);
}

std::string suggestion(std::string_view given, const std::vector<std::string>& known) {
  if (std::string meant = did_you_mean(given, known); !meant.empty()) return meant;
  if (known.empty()) return {};
  constexpr std::size_t most = 12;
  std::string list;
  for (std::size_t i = 0; i < std::min(known.size(), most); ++i) list += (i ? ", " : "") + known[i];
  return fmt::format("; known: {}{}", list, known.size() > most ? ", ..." : "");
}

}  // namespace signorini
