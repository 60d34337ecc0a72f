// data_laws.hpp: the laws made of data that a scene can name, such as law = "yielding", with the data that the scene
// and its reference use.
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

/// Constant of the law: a number > 0 that is required in a scene with this law.
struct DataLawConstant {
  std::string_view key, unit, meaning;  ///< as in scene/keys.hpp
};

struct DataLaw {
  std::string_view name;
  std::string_view meaning;  ///< part of the sentence about the key `law`
  std::vector<DataLawConstant> constants;
  /// Makes the law from kn and the constants, in their order.
  UserContactLaw (*make)(double normal_stiffness, const std::vector<double>& constants);
  /// Checks the values: the key whose value contradicts the others, and a message; nullopt: the values are
  /// valid.
  std::optional<std::pair<std::string_view, std::string>> (*validate)(double normal_stiffness,
                                                                      const std::vector<double>& constants);
};

[[nodiscard]] std::span<const DataLaw* const> data_laws();
/// Data law with this name; nullptr: the name is that of a built-in law.
[[nodiscard]] const DataLaw* find_data_law(std::string_view name);

}  // namespace signorini
