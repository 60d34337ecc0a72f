// terminal.hpp: output streams. Data goes to stdout, messages and progress to stderr.
//
// Colour only on a terminal, and never when NO_COLOR is set (https://no-color.org).
#pragma once

#include <string>

namespace signorini::cli {

/// Writes to stdout without buffering. Errors: FileError (a full disk behind a redirection).
void print(const std::string& text);

/// "error: ...", "warning: ..." and "note: ..." on stderr.
void print_error(const std::string& message);
void print_warning(const std::string& message);
void print_note(const std::string& message);

/// True if the progress line may be shown.
[[nodiscard]] bool stderr_is_terminal();
/// Opens /dev/null in place of a closed standard input, output or error. Otherwise the next opened file would get that
/// descriptor, and receive printed text.
void open_closed_streams();

/// Replaces the progress line; an empty text removes it.
void progress_line(const std::string& text);

}  // namespace signorini::cli
