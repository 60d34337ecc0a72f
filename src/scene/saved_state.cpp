#include "scene/saved_state.hpp"

#include <fmt/core.h>

#include <cmath>
#include <vector>

#include "base/excerpt.hpp"
#include "base/number.hpp"
#include "signorini/error.hpp"

namespace signorini {
namespace {

// The rest of a line; a million degrees of freedom have 40 MB.
constexpr std::size_t longest_row = 100u << 20;

/// False: the end. Refuses a row without end.
bool next_row(std::istream& in, std::string& line) {
  line.clear();
  char c = 0;
  while (in.get(c) && c != '\n') {
    if (c != '\r') line += c;
    if (line.size() > longest_row) return false;
  }
  return in || !line.empty();
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::size_t from = 0;
  for (std::size_t comma = line.find(','); comma != std::string::npos; comma = line.find(',', from)) {
    cells.push_back(line.substr(from, comma - from));
    from = comma + 1;
  }
  cells.push_back(line.substr(from));
  return cells;
}

bool is_shear(const std::string& name) { return name.size() > 2 && name.ends_with(".T"); }

}  // namespace

SavedState read_saved_state(std::istream& in, const std::string& file, const std::string& key,
                            std::optional<double> t) {
  int number = 1;
  const auto fail = [&](const std::string& message) { throw SceneError({file, number, 0}, key, message); };
  std::string line;
  if (!next_row(in, line)) fail("the file is empty, expected states of a run");
  const std::vector<std::string> names = cells_of(line);
  if (names[0] != "t" || names.size() < 3) fail("found no heading \"t,...\", expected states of a run");
  SavedState state;
  std::string times;
  while (next_row(in, line)) {
    ++number;
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() != names.size())
      fail(fmt::format("found {} cells, expected {}", cells.size(), names.size()));
    std::vector<double> values;
    for (const std::string& cell : cells) {
      const auto value = parse_number(cell);
      if (!value || !std::isfinite(*value))
        fail(fmt::format("found \"{}\", expected a number", excerpt(cell)));
      values.push_back(*value);
    }
    times += (times.empty() ? "" : ", ") + shortest(values[0]);
    // The file has the digits of the run; the scene may have fewer.
    if (t && !(std::abs(values[0] - *t) <= 1e-9 * std::abs(*t))) continue;
    state = {};
    for (std::size_t i = 1; i < names.size(); ++i) {
      if (is_shear(names[i]))
        state.shears.emplace_back(names[i].substr(0, names[i].size() - 2), values[i]);
      else
        state.motions.emplace_back(names[i], values[i]);
    }
  }
  if (state.motions.empty())
    fail(t ? fmt::format("found states at {}, expected one at {}", times.empty() ? "no time" : times,
                         shortest(*t))
           : "found no state, expected one at the end of the run");
  return state;
}

}  // namespace signorini
