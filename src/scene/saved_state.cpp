#include "scene/saved_state.hpp"

#include <fmt/core.h>
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <fstream>

#include "base/rounding.hpp"
#include "base/text.hpp"
#include "signorini/error.hpp"
#include "signorini/form.hpp"

namespace signorini::scene {
namespace {

constexpr std::string_view of_shear = ".T", of_state = ".state", user_law_state_suffix = ".own",
                           of_memory = ".memory";

/// Name of the contact in the name of a column: "c" for "c.T".
std::string contact_in(const std::string& name, std::string_view end) {
  return name.substr(0, name.size() - end.size());
}

/// Reads the state or the memory of a user law from one column. False if the column is neither.
bool read_user_law_column(const std::string& name, double value,
                          std::vector<SavedState::UserLawMemory>& own) {
  if (!name.ends_with(user_law_state_suffix) && !name.ends_with(of_memory)) return false;
  const bool memory = name.ends_with(of_memory);
  const std::string contact = contact_in(name, memory ? of_memory : user_law_state_suffix);
  auto found = std::find_if(own.begin(), own.end(),
                            [&](const SavedState::UserLawMemory& o) { return o.contact == contact; });
  if (found == own.end()) found = own.insert(own.end(), {contact});
  if (memory)
    found->memory = value;
  else
    found->state =
        value >= 0.0 && value < max_user_law_states ? static_cast<std::size_t>(value) : max_user_law_states;
  return true;
}

/// Sign of the slip rate in a cell of a column "x.state", 0 without slip; nullopt if the cell is not a state.
std::optional<int> slip_in(const std::string& name, const std::string& cell) {
  if (!name.ends_with(of_state)) return std::nullopt;
  if (cell == "slip+") return 1;
  if (cell == "slip-") return -1;
  if (cell == "stick" || cell == "open" || cell == "closed") return 0;
  return std::nullopt;
}

}  // namespace

std::optional<double> saved_motion(const SavedState& state, const std::string& name) {
  for (const auto& [saved, value] : state.motions)
    if (saved == name) return value;
  return std::nullopt;
}

SavedStates read_saved_states(std::istream& in, const std::string& file, const std::string& key,
                              std::optional<double> t) {
  int number = 1;
  const auto fail = [&](const std::string& message) { throw SceneError({file, number, 0}, key, message); };
  std::vector<std::string> names, cells;
  if (!base::read_csv_row(in, names)) fail("the file is empty, expected states of a run");
  if (names[0] != "t" || names.size() < 3) fail("found no heading \"t,...\", expected states of a run");
  SavedStates found;
  while (base::read_csv_row(in, cells)) {
    ++number;
    if (cells.size() != names.size())
      fail(fmt::format("found {}, expected {}", base::count_text(cells.size(), "cell"), names.size()));
    SavedState state;
    double time = 0.0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (const auto slip = slip_in(names[i], cells[i])) {
        state.slips.emplace_back(contact_in(names[i], of_state), *slip);
        continue;
      }
      const auto value = base::parse_number(cells[i]);
      if (!value || !std::isfinite(*value))
        fail(fmt::format("found \"{}\", expected a number", base::excerpt(cells[i])));
      if (i == 0)
        time = *value;
      else if (names[i].ends_with(of_shear))
        state.shears.emplace_back(contact_in(names[i], of_shear), *value);
      else if (!read_user_law_column(names[i], *value, state.user_law_states))
        state.motions.emplace_back(names[i], *value);
    }
    state.t = time;
    found.times.push_back(base::format_number(time));
    // The scene may give t with fewer digits than the file.
    if (!t || std::abs(time - *t) <= 1e-9 * std::abs(*t)) found.state = std::move(state);
  }
  return found;
}

namespace {

const std::vector<std::string> heading = {"t", "contact", "state", "gap", "ut", "vt", "slip", "N", "T"};

/// The contact in a row of contacts.csv; nullopt if a cell that must be a number is not.
std::optional<SavedState::FinalContact> row_of(const std::vector<std::string>& cells) {
  SavedState::FinalContact left;
  left.contact = cells[1];
  left.state = cells[2];
  if (!cells[3].empty() && !(left.gap = base::parse_number(cells[3]))) return std::nullopt;
  double* const numbers[] = {&left.ut, &left.vt, &left.slip, &left.N, &left.T};
  for (std::size_t i = 0; i < std::size(numbers); ++i) {
    const std::optional<double> value = base::parse_number(cells[4 + i]);
    if (!value) return std::nullopt;
    *numbers[i] = *value;
  }
  return left;
}

}  // namespace

std::vector<SavedState::FinalContact> read_final_contacts(const std::filesystem::path& path, double t) {
  std::ifstream in(path, std::ios::binary);
  std::vector<std::string> cells;
  std::vector<SavedState::FinalContact> rows;
  if (!in || !base::read_csv_row(in, cells)) return {};
  if (cells.size() < heading.size() || !std::equal(heading.begin(), heading.end(), cells.begin())) return {};
  const std::size_t width = cells.size();
  while (base::read_csv_row(in, cells)) {
    const std::optional<double> time = base::parse_number(cells[0]);
    if (cells.size() != width || !time || std::abs(*time - t) > rounding::few_operations * std::abs(t))
      continue;
    std::optional<SavedState::FinalContact> row = row_of(cells);
    if (!row) return {};
    rows.push_back(std::move(*row));
  }
  return rows;
}

const std::vector<std::string>& prestress_columns() {
  static const std::vector<std::string> heading = {"what", "from", "to", "N_from", "N_to", "stiffness"};
  return heading;
}

std::optional<Prestress> read_prestress(const std::filesystem::path& path, const std::string& key) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return std::nullopt;
  int line = 1;
  const auto fail = [&](const std::string& message) {
    throw SceneError({path.string(), line, 0}, key, message);
  };
  std::vector<std::string> cells;
  if (!base::read_csv_row(in, cells) || cells != prestress_columns())
    fail(fmt::format("found no heading \"{}\", expected the frozen static forces of a run",
                     fmt::join(prestress_columns(), ",")));
  const auto number = [&](const std::string& cell) {
    const auto value = base::parse_number(cell);
    if (!value || !std::isfinite(*value))
      fail(fmt::format("found \"{}\", expected a number", base::excerpt(cell)));
    return *value;
  };
  Prestress forces;
  while (base::read_csv_row(in, cells)) {
    ++line;
    if (cells.size() != prestress_columns().size())
      fail(fmt::format("found {} cells, expected {}", cells.size(), prestress_columns().size()));
    if (cells[0] == "member")
      forces.elements.push_back({cells[1], cells[2], number(cells[3]), number(cells[4])});
    else if (cells[0] == "rigid")
      forces.bodies.push_back({cells[1], number(cells[5])});
    else
      fail(fmt::format("found \"{}\", expected member or rigid", base::excerpt(cells[0])));
  }
  ++line;
  if (!cells.empty()) fail("found no line break, expected the end of a row");
  return forces;
}

}  // namespace signorini::scene
