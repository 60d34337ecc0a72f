// output_directory.hpp: a directory, or a single file, that results are written to.
//
//   check:   it is not there, is empty, or holds earlier results (its marker file) that may be replaced
//   make:    it and those above it
//   unmake:  those that were made, as far as they are empty
//
// Errors of all: FileError, with the directory's name.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace signorini {

/// What a directory of results is: "run", whose summary.json tells it from somebody's files.
struct ResultsKind {
  std::string what, marker;
};

/// replace: earlier results give way (--force).
void check_output_directory(const std::filesystem::path& path, const ResultsKind& kind, bool replace);

/// A file that is not in such a directory: refused where it is there and has no `mark` among its first bytes, as `what` that
/// Signorini writes has. Empty files, pipes and devices lose nothing.
void check_output_file(const std::filesystem::path& path, const std::string& what, std::string_view mark);

/// Returns the outermost that had to be made; empty where all were there.
std::filesystem::path make_directory(const std::filesystem::path& path);

/// `first`: as make_directory() returned it.
void unmake_directory(const std::filesystem::path& path, const std::filesystem::path& first);

}  // namespace signorini
