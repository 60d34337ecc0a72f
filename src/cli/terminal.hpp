// terminal.hpp: the two streams. Data goes to stdout, messages and progress to stderr.
//
// Colour only on a terminal, and never when NO_COLOR is set (https://no-color.org).
#pragma once

#include <string>

namespace signorini::cli {

/// Writes to stdout at once. Errors: FileError (a full disk behind a redirection).
void print(const std::string& text);

/// "error: ...", "warning: ..." and "note: ..." on stderr.
void print_error(const std::string& message);
void print_warning(const std::string& message);
void print_note(const std::string& message);

/// The progress line may be shown.
[[nodiscard]] bool stderr_is_terminal();
/// Puts /dev/null where standard input, output or error are closed: else the next file to be opened would be
/// one of them, and receive what is printed.
void open_closed_streams();

/// Replaces the progress line; an empty text removes it.
void progress_line(const std::string& text);

}  // namespace signorini::cli
