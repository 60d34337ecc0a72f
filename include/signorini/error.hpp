// error.hpp: errors of input and of files, with message, place and exit code of the program.
//
//   pipeline.toml:34:20: contacts.first.friction: found -0.3, expected a number >= 0
//
// Exceptions report wrong input and file errors; a run that stops early returns an Outcome instead.
#pragma once

#include <stdexcept>
#include <string>

namespace signorini {

/// Exit codes of the program (docs/command-line.md).
enum class ExitCode : int {
  done = 0,
  bug = 1,
  usage = 2,
  scene = 3,
  stopped = 4,
  limit = 5,
  file = 6,
  interrupted = 130
};

/// A place in a text file; lines and columns are numbered from 1; 0: unknown.
struct SourcePlace {
  /// Value of `line` for a place on the command line; `file` is then the text typed by the user (Override::shown_as).
  static constexpr int command_line = -1;

  std::string file;
  int line = 0;
  int column = 0;
};

/// Base of all errors. what() is the whole message, ready to be printed.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  [[nodiscard]] ExitCode code() const noexcept { return code_; }

 private:
  ExitCode code_;
};

/// An invalid scene: "FILE:LINE:COLUMN: KEY: MESSAGE"; the message omits parts that are unknown.
class SceneError : public Error {
 public:
  SceneError(const SourcePlace& place, const std::string& key, const std::string& message);
};

/// An invalid command line, including an invalid --set.
class UsageError : public Error {
 public:
  explicit UsageError(const std::string& message) : Error(ExitCode::usage, message) {}
};

/// A file that cannot be read or written: "PATH: MESSAGE".
class FileError : public Error {
 public:
  FileError(const std::string& path, const std::string& message)
      : Error(ExitCode::file, path + ": " + message) {}
  /// The same error with an explanation appended.
  FileError(const FileError& error, const std::string& more) : Error(ExitCode::file, error.what() + more) {}
};

}  // namespace signorini
