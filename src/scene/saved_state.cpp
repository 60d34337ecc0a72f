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

constexpr std::string_view of_state = ".state";

/// The sign of the slip that the cell of a column "x.state" tells; none where it is no state.
std::optional<int> slip_in(const std::string& name, const std::string& cell) {
  if (!name.ends_with(of_state)) return std::nullopt;
  if (cell == "slip+") return 1;
  if (cell == "slip-") return -1;
  if (cell == "stick" || cell == "open" || cell == "closed") return 0;
  return std::nullopt;
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
    SavedState state;
    double time = 0.0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (const auto slip = slip_in(names[i], cells[i])) {
        state.slips.emplace_back(names[i].substr(0, names[i].size() - of_state.size()), *slip);
        continue;
      }
      const auto value = parse_number(cells[i]);
      if (!value || !std::isfinite(*value))
        fail(fmt::format("found \"{}\", expected a number", excerpt(cells[i])));
      if (i == 0)
        time = *value;
      else if (is_shear(names[i]))
        state.shears.emplace_back(names[i].substr(0, names[i].size() - 2), *value);
      else
        state.motions.emplace_back(names[i], *value);
    }
    found.times.push_back(shortest(time));
    // The file has the digits of the run; the scene may have fewer.
    if (!t || std::abs(time - *t) <= 1e-9 * std::abs(*t)) found.wanted = std::move(state);
  }
  return found;
}

}  // namespace signorini
