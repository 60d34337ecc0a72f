// files.hpp: checks of input and output files and directories, file names, and texts that are part of the program.
//
//   check_output_directory       accepts a directory that is absent, empty, or contains earlier results
//                                (its marker file) that may be replaced
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
/// for which opening the file gives the reason. Pipes and devices are refused: a pipe would wait for a writer, and a device
/// may never end.
[[nodiscard]] std::string input_file_error(const std::filesystem::path& path);

/// Text for a value of errno, for example ": No such file or directory"; empty if error is 0.
[[nodiscard]] std::string system_error_text(int error);

/// Kind of a directory of results: description "run", with the file summary.json as marker of such a directory.
struct ResultsKind {
  std::string description, marker;
};

/// Refuses a directory that must not be overwritten. replace: true if earlier results may be replaced (--force).
void check_output_directory(const std::filesystem::path& path, const ResultsKind& kind, bool replace);

/// Refuses an existing output file, unless its first bytes contain `mark`, with which Signorini marks the files that it
/// writes. `what` describes such a file in the message. Empty files, pipes and devices are accepted, because no data are
/// lost.
void check_output_file(const std::filesystem::path& path, const std::string& what, std::string_view mark);

/// Creates the directory and its parents. Returns the outermost created directory; empty if all existed.
std::filesystem::path make_directory(const std::filesystem::path& path);

/// Removes the directories from `path` up to `first`, the return value of make_directory(); stops at one that is not empty.
void remove_created_directories(const std::filesystem::path& path, const std::filesystem::path& first);

/// Makes a part of a file name from a text: the first `most` characters, in which every character becomes `other` except
/// ASCII letters, digits and characters of `kept`. file_name("first support", 80, "-_", '_') is "first_support".
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
