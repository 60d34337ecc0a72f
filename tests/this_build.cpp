#include "this_build.hpp"

namespace signorini::tests {

const char* const program = SIGNORINI_PROGRAM;

#ifdef WITH_ADDRESS_SANITIZER
const bool with_address_sanitizer = true;
#else
const bool with_address_sanitizer = false;
#endif

}  // namespace signorini::tests
