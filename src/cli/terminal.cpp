#include "cli/terminal.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <system_error>

#include "signorini/error.hpp"

namespace signorini::cli {

namespace {

bool colour() {
  const char* no_color = std::getenv("NO_COLOR");
  return stderr_is_terminal() && (no_color == nullptr || *no_color == '\0');
}

void message(const char* escape, const char* word, const std::string& text) {
  const std::string head = colour() ? std::string(escape) + word + "\x1b[0m" : std::string(word);
  std::fprintf(stderr, "%s: %s\n", head.c_str(), text.c_str());
}

}  // namespace

void print(const std::string& text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0) return;
  const int error = errno == 0 ? EIO : errno;
  throw FileError("standard output", "cannot be written: " + std::generic_category().message(error));
}

void print_error(const std::string& text) { message("\x1b[1;31m", "error", text); }

void print_warning(const std::string& text) { message("\x1b[1;33m", "warning", text); }

void print_note(const std::string& text) { message("\x1b[1m", "note", text); }

bool stderr_is_terminal() { return isatty(STDERR_FILENO) == 1; }

void open_closed_streams() {
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream)
    if (fcntl(stream, F_GETFD) < 0 && errno == EBADF && open("/dev/null", O_RDWR) != stream) std::abort();
}

void progress_line(const std::string& text) {
  std::fprintf(stderr, "\r\x1b[K%s", text.c_str());
  std::fflush(stderr);
}

}  // namespace signorini::cli
