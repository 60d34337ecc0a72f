#include "scene/saved_state.hpp"

#include <fmt/core.h>

#include <cmath>

#include "base/csv_row.hpp"
#include "base/excerpt.hpp"
#include "base/number.hpp"
#include "signorini/error.hpp"

namespace signorini {
namespace {

bool is_shear(const std::string& name) { return name.size() > 2 && name.ends_with(".T"); }

SavedState state_of(const std::vector<std::string>& names, const std::vector<double>& values) {
  SavedState state;
  for (std::size_t i = 1; i < names.size(); ++i) {
    if (is_shear(names[i]))
      state.shears.emplace_back(names[i].substr(0, names[i].size() - 2), values[i]);
    else
      state.motions.emplace_back(names[i], values[i]);
  }
  return state;
}

}  // namespace

SavedStates read_saved_states(std::istream& in, const std::string& file, const std::string& key,
                              std::optional<double> t) {
  int number = 1;
  const auto fail = [&](const std::string& message) { throw SceneError({file, number, 0}, key, message); };
  std::vector<std::string> names, cells;
  if (!read_csv_row(in, names)) fail("found no line, expected states of a run");
  if (names[0] != "t" || names.size() < 3) fail("found no heading \"t,...\", expected states of a run");
  SavedStates found;
  while (read_csv_row(in, cells)) {
    ++number;
    if (cells.size() != names.size())
      fail(fmt::format("found {} cells, expected {}", cells.size(), names.size()));
    std::vector<double> values;
    for (const std::string& cell : cells) {
      const auto value = parse_number(cell);
      if (!value || !std::isfinite(*value))
        fail(fmt::format("found \"{}\", expected a number", excerpt(cell)));
      values.push_back(*value);
    }
    found.times.push_back(shortest(values[0]));
    // The file has the digits of the run; the scene may have fewer.
    if (!t || std::abs(values[0] - *t) <= 1e-9 * std::abs(*t)) found.wanted = state_of(names, values);
  }
  return found;
}

}  // namespace signorini
