// left_contacts.hpp: states of the contacts at the end of a run, from contacts.csv.
//
//   t,contact,state,gap,ut,vt,slip,N,T   further columns are ignored
//
// A continued motion does not depend on these rows; the witness compares it with them (src/witness).
#pragma once

#include <filesystem>
#include <vector>

#include "signorini/scene.hpp"

namespace signorini {

/// The rows at t. Empty: there are none, or the file is not that of a run.
[[nodiscard]] std::vector<SavedState::Left> read_left_contacts(const std::filesystem::path& path, double t);

}  // namespace signorini
