// files.hpp: input files, directories and files of results, names of files, and embedded texts.
//
//   check_output_directory       accepts a directory that is absent or empty, or contains earlier results
//                                (its marker file) that may be replaced
//   make_directory               creates it and its parents
//   remove_created_directories   removes the created ones, as far as they are empty
//
// Errors: FileError with the path.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace signorini::base {

/// Reason why this is not a readable file, such as "is a directory". Empty for a regular file, and for a
/// missing one, for which opening reports the reason. Pipes and devices are refused: a pipe would wait for a
/// writer, and a device may never end.
[[nodiscard]] std::string input_file_error(const std::filesystem::path& path);

/// ": No such file or directory" for a value of errno, or "".
[[nodiscard]] std::string system_error_text(int error);

/// Kind of a directory of results: "run", with summary.json as the file that identifies it.
struct ResultsKind {
  std::string description, marker;
};

/// replace: earlier results may be replaced (--force).
void check_output_directory(const std::filesystem::path& path, const ResultsKind& kind, bool replace);

/// Refuses a single output file that exists, unless its first bytes contain `mark`, by which Signorini marks
/// the files that it writes. `what` names such a file in the message. Empty files, pipes and devices are
/// accepted, since no data are lost.
void check_output_file(const std::filesystem::path& path, const std::string& what, std::string_view mark);

/// Returns the outermost directory that was created; empty if all existed.
std::filesystem::path make_directory(const std::filesystem::path& path);

/// Removes the directories from `path` up to `first`, the return value of make_directory(), as far as they
/// are empty.
void remove_created_directories(const std::filesystem::path& path, const std::filesystem::path& first);

/// Text as a part of a file name: the first `most` characters; those other than ASCII letters, digits and
/// characters of `kept` become `other`. file_name("first support", 80, "-_", '_') is "first_support".
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
