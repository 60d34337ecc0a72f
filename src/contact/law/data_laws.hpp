// data_laws.hpp: laws that consist of data and that a scene can name, such as law = "yielding". Each law also contains texts
// for messages and for the reference of scene files.
//
// To add a law, define a DataLaw in a new file in this folder and add its line to data_laws.cpp.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "signorini/user_contact_law.hpp"

namespace signorini {

/// A constant of the law: a number > 0 that a scene with this law must give.
struct DataLawConstant {
  std::string_view key, unit, meaning;  ///< key, unit and description as in scene/keys.hpp
};

struct DataLaw {
  std::string_view name;
  std::string_view meaning;  ///< description of the law in the documentation of the key `law`
  std::vector<DataLawConstant> constants;
  /// Makes the law from kn and from the constants, in the order of `constants`.
  UserContactLaw (*make)(double normal_stiffness, const std::vector<double>& constants);
  /// Checks the values. Returns the key whose value contradicts the other values, and a message; nullopt: the values are valid.
  std::optional<std::pair<std::string_view, std::string>> (*validate)(double normal_stiffness,
                                                                      const std::vector<double>& constants);
};

[[nodiscard]] std::span<const DataLaw* const> data_laws();
/// Data law with this name; nullptr: no data law has the name.
[[nodiscard]] const DataLaw* find_data_law(std::string_view name);

}  // namespace signorini
