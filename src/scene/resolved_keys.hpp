// resolved_keys.hpp: a scene as a flat list of keys and values, to compare two of them.
//
//   "contacts.stop.gap" -> "0.3",   "springs.2.stiffness" -> "2.1",   "nodes.A" -> "[0.0,0.0]"
//
// Entries of a list are addressed by name, or by number from 1. All defaults are filled in. A key that names a file has
// the file's content as its value, so a changed file is a different value and a moved one is not.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "signorini/scene.hpp"

namespace signorini {

using ResolvedKeys = std::map<std::string, std::string>;

/// Keys without the title. Errors: FileError for a file that can no longer be read.
[[nodiscard]] ResolvedKeys resolved_keys(const Scene& scene);

/// "contacts.stop.gap (0.3, here 0.2)": keys with different values, by name.
[[nodiscard]] std::vector<std::string> differing_keys(const ResolvedKeys& kept, const ResolvedKeys& here);

}  // namespace signorini
