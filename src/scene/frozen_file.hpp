// frozen_file.hpp: geometric.csv, the forces whose stiffness acted in a run with run.geometric.
//
//   what,from,to,N_from,N_to,stiffness
//   member,A,A-B.1,-12.5,-12.25,
//   rigid,block,,,,-98.1
//
// The file has one row for each finite element and each rigid body, in model order. A continued run reads them here.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "signorini/scene.hpp"

namespace signorini {

inline constexpr const char* frozen_file = "geometric.csv";
[[nodiscard]] const std::vector<std::string>& frozen_heading();

/// nullopt: the file does not exist. Errors: SceneError at the line of the file; `key` begins the message.
[[nodiscard]] std::optional<FrozenForces> read_frozen_forces(const std::filesystem::path& path,
                                                             const std::string& key);

}  // namespace signorini
