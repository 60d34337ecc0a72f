#include "scene/frozen_file.hpp"

#include <fmt/core.h>
#include <fmt/format.h>

#include <cmath>
#include <fstream>

#include "base/csv_row.hpp"
#include "base/excerpt.hpp"
#include "base/number.hpp"
#include "signorini/error.hpp"

namespace signorini {

const std::vector<std::string>& frozen_heading() {
  static const std::vector<std::string> heading = {"what", "from", "to", "N_from", "N_to", "stiffness"};
  return heading;
}

std::optional<FrozenForces> read_frozen_forces(const std::filesystem::path& path, const std::string& key) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return std::nullopt;
  int line = 1;
  const auto fail = [&](const std::string& message) {
    throw SceneError({path.string(), line, 0}, key, message);
  };
  std::vector<std::string> cells;
  if (!read_csv_row(in, cells) || cells != frozen_heading())
    fail(fmt::format("found no heading \"{}\", expected the frozen forces of a run",
                     fmt::join(frozen_heading(), ",")));
  const auto number = [&](const std::string& cell) {
    const auto value = parse_number(cell);
    if (!value || !std::isfinite(*value)) fail(fmt::format("found \"{}\", expected a number", excerpt(cell)));
    return *value;
  };
  FrozenForces forces;
  while (read_csv_row(in, cells)) {
    ++line;
    if (cells.size() != frozen_heading().size())
      fail(fmt::format("found {} cells, expected {}", cells.size(), frozen_heading().size()));
    if (cells[0] == "member")
      forces.elements.push_back({cells[1], cells[2], number(cells[3]), number(cells[4])});
    else if (cells[0] == "rigid")
      forces.bodies.push_back({cells[1], number(cells[5])});
    else
      fail(fmt::format("found \"{}\", expected member or rigid", excerpt(cells[0])));
  }
  ++line;
  if (!cells.empty()) fail("found no line break, expected the end of a row");
  return forces;
}

}  // namespace signorini
