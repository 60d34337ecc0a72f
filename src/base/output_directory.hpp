// output_directory.hpp: a directory that results are written to.
//
//   check:   it is not there, is empty, or holds earlier results (its marker file) that may be replaced
//   make:    it and those above it
//   unmake:  those that were made, as far as they are empty
//
// Errors of all: FileError, with the directory's name.
#pragma once

#include <filesystem>
#include <string>

namespace signorini {

/// What a directory of results is: "run", whose summary.json tells it from somebody's files.
struct ResultsKind {
  std::string what, marker;
};

/// replace: earlier results give way (--force).
void check_output_directory(const std::filesystem::path& path, const ResultsKind& kind, bool replace);

/// Returns the outermost that had to be made; empty where all were there.
std::filesystem::path make_directory(const std::filesystem::path& path);

/// `first`: as make_directory() returned it.
void unmake_directory(const std::filesystem::path& path, const std::filesystem::path& first);

}  // namespace signorini
