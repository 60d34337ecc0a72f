// output_directory.hpp: a directory, or a single file, that results are written to.
//
//   check:   it is absent or empty, or contains earlier results (its marker file) that may be replaced
//   make:    creates it and its parents
//   unmake:  removes the created ones, as far as they are empty
//
// Errors of all: FileError, with the directory's name.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace signorini {

/// Kind of a directory of results: "run", with summary.json as the file that identifies it.
struct ResultsKind {
  std::string what, marker;
};

/// replace: earlier results may be replaced (--force).
void check_output_directory(const std::filesystem::path& path, const ResultsKind& kind, bool replace);

/// Refuses a single output file if it exists and does not contain `mark` among its first bytes, the mark of the `what`
/// that Signorini writes. Empty files, pipes and devices are accepted, since no data are lost.
void check_output_file(const std::filesystem::path& path, const std::string& what, std::string_view mark);

/// Returns the outermost directory that was created; empty if all existed.
std::filesystem::path make_directory(const std::filesystem::path& path);

/// `first`: return value of make_directory().
void unmake_directory(const std::filesystem::path& path, const std::filesystem::path& first);

}  // namespace signorini
