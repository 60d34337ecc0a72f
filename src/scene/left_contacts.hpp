// left_contacts.hpp: where a run left its contacts, by contacts.csv.
//
//   t,contact,state,gap,ut,vt,slip,N,T   and further columns, which are not read
//
// No part of what a motion goes on from: what is held against it (src/witness).
#pragma once

#include <filesystem>
#include <vector>

#include "signorini/scene.hpp"

namespace signorini {

/// The rows at t. Empty: there are none, or they are no rows of a run.
[[nodiscard]] std::vector<SavedState::Left> read_left_contacts(const std::filesystem::path& path, double t);

}  // namespace signorini
