#include "contact/law/data_laws.hpp"

#include <algorithm>
#include <array>

#include "contact/law/yielding_pad.hpp"

namespace signorini {

std::span<const DataLaw* const> data_laws() {
  static const std::array all = {&yielding_law()};
  return all;
}

const DataLaw* find_data_law(std::string_view name) {
  const auto laws = data_laws();
  const auto found =
      std::find_if(laws.begin(), laws.end(), [&](const DataLaw* law) { return law->name == name; });
  return found == laws.end() ? nullptr : *found;
}

}  // namespace signorini
