// this_build.hpp: the build that tests are linked to. Their own code may have been compiled by another one.
#pragma once

namespace signorini::tests {

extern const char* const program;  ///< path of `signorini`
extern const bool with_address_sanitizer;

}  // namespace signorini::tests
