// shrink.hpp: the smallest scene that still shows something.
//
//   const std::string small = shrink(text, [](const std::string& t) { return verdict_of(t) == bad; }, 2000);
//
// Takes away loads, contacts, members, degrees of freedom, options and damping, shortens the run, sets
// numbers to zero or rounds them to few digits, one change at a time, and keeps what still shows it: a local
// minimum.
#pragma once

#include <functional>
#include <string>

namespace signorini::differential {

/// `shows` is asked at most `attempts` times, about scene files that may be wrong ones (then: false).
[[nodiscard]] std::string shrink(const std::string& text,
                                 const std::function<bool(const std::string&)>& shows, int attempts);

}  // namespace signorini::differential
