// gmsh_words.hpp: reads the words of a mesh file one by one, with their line numbers.
//
//   GmshWords words(in, file, key);   while (words.next_section(name)) ... words.integer() ... words.number()
#pragma once

#include <istream>
#include <string>

#include "signorini/error.hpp"

namespace signorini {

class GmshWords {
 public:
  GmshWords(std::istream& in, std::string file, std::string key)
      : in_(in), file_(std::move(file)), key_(std::move(key)) {}

  /// The next "$Name"; false at the end of the file.
  bool next_section(std::string& name);
  /// Skips to "$EndName".
  void skip_section(const std::string& name);
  /// Expects "$EndName".
  void end_section(const std::string& name);

  [[nodiscard]] long integer(const char* what);
  /// An integer >= 0, at most `most_entries`.
  [[nodiscard]] long count(const char* what);
  [[nodiscard]] double number(const char* what);
  /// A text in quotes.
  [[nodiscard]] std::string quoted(const char* what);

  [[nodiscard]] SourcePlace place() const { return {file_, line_, 0}; }
  [[noreturn]] void fail(const std::string& message) const { throw SceneError(place(), key_, message); }

 private:
  /// The next word; empty at the end of the file.
  std::string word();

  std::istream& in_;
  std::string file_, key_;
  int line_ = 1;
};

}  // namespace signorini
