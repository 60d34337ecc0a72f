// targets.hpp: what fuzzers feed with bytes: nothing but an Error may come out.
//
//   for (const fuzz::Target& target : fuzz::targets) target.run(bytes);
//
// The corpus of each is in tests/fuzz/corpus/NAME; it is replayed as an ordinary test, and grown by the
// fuzzers of validation/robustness.
#pragma once

#include <array>
#include <string_view>

namespace signorini::fuzz {

/// A scene file, read, built and checked, where it is small.
void scene(std::string_view bytes);
/// A file in the Matrix Market format.
void matrix(std::string_view bytes);
/// A table of time and value.
void table(std::string_view bytes);
/// PATH=VALUE, as --set takes it, on a small scene; and --vary.
void setting(std::string_view bytes);
/// Files of a directory, each after a line "==> NAME": pictures are written of it as of a run, and it is read
/// and merged as a sweep.
void results(std::string_view bytes);

struct Target {
  const char* name;
  void (*run)(std::string_view);
};
inline constexpr std::array<Target, 5> targets{
    {{"scene", scene}, {"matrix", matrix}, {"table", table}, {"setting", setting}, {"results", results}}};

}  // namespace signorini::fuzz
