// allocations.hpp: counts every call of malloc, calloc and realloc in the process (glibc).
#pragma once

namespace signorini::benchmarks {

[[nodiscard]] long allocations();

}  // namespace signorini::benchmarks
