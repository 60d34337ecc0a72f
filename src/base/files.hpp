// files.hpp: a directory, or a single file, that results are written to.
//
//   check:   it is absent or empty, or contains earlier results (its marker file) that may be replaced
//   make:    creates it and its parents
//   unmake:  removes the created ones, as far as they are empty
//
// Errors of all: FileError, with the directory's name.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace signorini::base {

// Checks a file before it is read.

/// Reason why this is not a readable file, "is a directory"; empty for a regular file, and for a missing one, for which
/// opening reports the reason. A pipe would wait for a writer, and a device may never end.
[[nodiscard]] std::string input_file_error(const std::filesystem::path& path);

/// ": No such file or directory" for a value of errno, or "".
[[nodiscard]] std::string system_error_text(int error);

/// Kind of a directory of results: "run", with summary.json as the file that identifies it.
struct ResultsKind {
  std::string description, marker;
};

/// replace: earlier results may be replaced (--force).
void check_output_directory(const std::filesystem::path& path, const ResultsKind& kind, bool replace);

/// Refuses a single output file if it exists and does not contain `mark` among its first bytes, the mark of the `what`
/// that Signorini writes. Empty files, pipes and devices are accepted, since no data are lost.
void check_output_file(const std::filesystem::path& path, const std::string& what, std::string_view mark);

/// Returns the outermost directory that was created; empty if all existed.
std::filesystem::path make_directory(const std::filesystem::path& path);

/// `first`: return value of make_directory().
void remove_created_directories(const std::filesystem::path& path, const std::filesystem::path& first);

// Converts text to a part of a file name.
//
//   file_name("first support", 80, "-_", '_') == "first_support"

/// The first `most` characters; characters other than ASCII letters, digits and those in `kept` become `other`.
[[nodiscard]] std::string file_name(std::string_view text, std::size_t most, std::string_view kept,
                                    char other);

// Text files that are part of the program (scripts/embed.cmake makes them a source).

struct EmbeddedFile {
  std::string_view name, text;
};

/// Template scenes: src/cli/scenes.
[[nodiscard]] std::span<const EmbeddedFile> scene_templates();
/// Texts of the scene reference: src/cli/texts.
[[nodiscard]] std::span<const EmbeddedFile> reference_texts();
/// Parts of the page of `report`: src/report/page.
[[nodiscard]] std::span<const EmbeddedFile> page_parts();

}  // namespace signorini::base
