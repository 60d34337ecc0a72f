// files.hpp: checks of input and output files and directories, file names, and texts that are part of the program.
//
//   check_output_directory       accepts a directory that does not exist, is empty, or contains earlier results
//                                (with their marker file) that may be replaced
//   make_directory               creates the directory and its parents
//   remove_created_directories   removes created directories that are empty
//
// Errors: FileError with the path.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace signorini::base {

/// Reason why the path is not a readable file, such as "is a directory". Empty for a regular file, and for a missing file,
/// because the attempt to open it gives the reason. Pipes and devices are refused, because reading a pipe would wait for a
/// writer, and reading a device may never end.
[[nodiscard]] std::string input_file_error(const std::filesystem::path& path);

/// Text for a value of errno, for example ": No such file or directory"; empty if error is 0.
[[nodiscard]] std::string system_error_text(int error);

/// Kind of a directory of results, for example description "run" and marker "summary.json", a file that each such directory
/// contains.
struct ResultsKind {
  std::string description, marker;
};

/// Errors: FileError if results must not be written to this path. replace: true if earlier results may be replaced (--force).
void check_output_directory(const std::filesystem::path& path, const ResultsKind& kind, bool replace);

/// Errors: FileError if an existing output file was not written by Signorini, that is, if its first kilobyte does not contain
/// the text `mark`. `what` describes such a file in the message. Empty files, pipes and devices are accepted, because no data
/// are lost.
void check_output_file(const std::filesystem::path& path, const std::string& what, std::string_view mark);

/// Creates the directory and its parents. Returns the outermost directory that was created; empty if all of them existed.
std::filesystem::path make_directory(const std::filesystem::path& path);

/// Removes the directories from `path` up to `first`, the return value of make_directory(). Stops at a directory that is not
/// empty.
void remove_created_directories(const std::filesystem::path& path, const std::filesystem::path& first);

/// Makes a part of a file name from the first `most` characters of a text. Characters other than ASCII letters, digits and the
/// characters in `kept` are replaced by `other`. file_name("first support", 80, "-_", '_') is "first_support".
[[nodiscard]] std::string file_name(std::string_view text, std::size_t most, std::string_view kept,
                                    char other);

// Text files that are part of the program (scripts/embed.cmake makes a source file from them).

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
