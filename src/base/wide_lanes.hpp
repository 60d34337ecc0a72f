// wide_lanes.hpp: a function compiled twice, for two and for four doubles an instruction, chosen at start.
//
//   SIGNORINI_WIDE_LANES void f(...) { loops over Four }      bits the same on every machine:
//   each lane holds a result of its own, or a sum is taken in the same four parts; never a fused product and sum
//
// For functions outside templates; what they call has to be inlined into them. Where the compiler or a sanitizer
// cannot choose at start, there is the narrow one only.
#pragma once

namespace signorini {

#if defined(__x86_64__) && defined(__ELF__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)
#define SIGNORINI_WIDE_LANES __attribute__((target_clones("avx2", "default")))
#else
#define SIGNORINI_WIDE_LANES
#endif

using Four = double __attribute__((vector_size(32)));

/// Lanes at any address of doubles. What a template is told of a vector's type is not how it is aligned.
template <class T>
struct [[gnu::packed, gnu::may_alias]] LanesAt {
  T v;
};
template <class T>
[[gnu::always_inline]] inline const LanesAt<T>& lanes_at(const double* from) {
  return *reinterpret_cast<const LanesAt<T>*>(from);
}
template <class T>
[[gnu::always_inline]] inline LanesAt<T>& lanes_at(double* to) {
  return *reinterpret_cast<LanesAt<T>*>(to);
}
[[gnu::always_inline]] inline double sum_of_lanes(const Four& a) { return (a[0] + a[1]) + (a[2] + a[3]); }

}  // namespace signorini
