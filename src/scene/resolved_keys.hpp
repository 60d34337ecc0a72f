// resolved_keys.hpp: a scene as a flat list of keys and values, to compare two of them.
//
//   "contacts.stop.gap" -> "0.3",   "springs.2.stiffness" -> "2.1",   "nodes.A" -> "[0.0,0.0]"
//
// Entries of a list have their name, or their number from 1 on. All defaults are filled in. A key that names a file has what the
// file holds, so a changed file is another value, and a moved one is not.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "signorini/scene.hpp"

namespace signorini {

using ResolvedKeys = std::map<std::string, std::string>;

/// Without the title. Errors: FileError for a file that can no longer be read.
[[nodiscard]] ResolvedKeys resolved_keys(const Scene& scene);

/// "contacts.stop.gap (0.3, here 0.2)": keys in which they differ, by name.
[[nodiscard]] std::vector<std::string> differing_keys(const ResolvedKeys& kept, const ResolvedKeys& here);

}  // namespace signorini
