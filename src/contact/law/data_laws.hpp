// data_laws.hpp: the laws made of data that a scene can name, law = "yielding": all that the scene and its reference know of one.
//
// A new law is a file beside this one that defines a DataLaw, and its line in data_laws.cpp.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "signorini/own_law.hpp"

namespace signorini {

/// A constant of the law: a number > 0 that a scene with the law must give.
struct DataLawConstant {
  std::string_view key, unit, meaning;  ///< as in scene/keys.hpp
};

struct DataLaw {
  std::string_view name;
  std::string_view meaning;  ///< in the sentence on the key `law`
  std::vector<DataLawConstant> constants;
  /// kn and the constants, in order, make the law.
  OwnLaw (*make)(double normal_stiffness, const std::vector<double>& constants);
  /// The key whose value is impossible beside the others, and a message; nullopt: none is.
  std::optional<std::pair<std::string_view, std::string>> (*objection)(double normal_stiffness,
                                                                       const std::vector<double>& constants);
};

[[nodiscard]] std::span<const DataLaw* const> data_laws();
/// nullptr: it is built in.
[[nodiscard]] const DataLaw* find_data_law(std::string_view name);

}  // namespace signorini
