// simd.hpp: compiles a function for two and for four doubles per instruction; the version is selected at program start.
//
//   SIGNORINI_WIDE_LANES void f(...) { loops over Double4 }
//
// Results are bitwise equal on every machine: each lane computes a separate result, or one of four fixed parts of a sum; no
// fused multiply-add.
//
// Only for functions that are not templates; functions that they call must be inlined. If the compiler or a sanitizer does
// not support the selection at program start, only the version for two doubles is compiled.
#pragma once

namespace signorini::base {

#if defined(__x86_64__) && defined(__ELF__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)
#define SIGNORINI_WIDE_LANES __attribute__((target_clones("avx2", "default")))
#else
#define SIGNORINI_WIDE_LANES
#endif

using Double4 = double __attribute__((vector_size(32)));

/// A vector of doubles at an address without alignment. A class is needed, because a vector type that is a template argument
/// loses its alignment attribute.
template <class T>
struct [[gnu::packed, gnu::may_alias]] UnalignedLanes {
  T v;
};
template <class T>
[[gnu::always_inline]] inline const UnalignedLanes<T>& lanes_at(const double* from) {
  return *reinterpret_cast<const UnalignedLanes<T>*>(from);
}
template <class T>
[[gnu::always_inline]] inline UnalignedLanes<T>& lanes_at(double* to) {
  return *reinterpret_cast<UnalignedLanes<T>*>(to);
}
[[gnu::always_inline]] inline double sum_of_lanes(const Double4& a) { return (a[0] + a[1]) + (a[2] + a[3]); }

}  // namespace signorini::base
