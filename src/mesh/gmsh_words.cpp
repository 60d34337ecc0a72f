#include "mesh/gmsh_words.hpp"

#include <fmt/core.h>

#include <cmath>

#include "base/number.hpp"

namespace signorini {
namespace {

constexpr std::size_t longest_word = 200;
constexpr long most_entries = 10'000'000;

bool is_blank(int c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

std::string found(const std::string& word) {
  return word.empty() ? "the end of the file" : "\"" + word + "\"";
}

}  // namespace

std::string GmshWords::word() {
  int c = in_.get();
  for (; c != EOF && is_blank(c); c = in_.get())
    if (c == '\n') ++line_;
  std::string text;
  for (; c != EOF && !is_blank(c); c = in_.get()) {
    if (text.size() == longest_word)
      fail("found a word of more than 200 characters, expected a mesh of Gmsh in ASCII");
    text += static_cast<char>(c);
  }
  if (c != EOF) in_.unget();  // keep the end of the line for the next word
  return text;
}

bool GmshWords::next_section(std::string& name) {
  const std::string text = word();
  if (text.empty()) return false;
  if (text[0] != '$')
    fail(fmt::format("found {}, expected a section of a mesh of Gmsh, \"$...\"", found(text)));
  name = text.substr(1);
  return true;
}

void GmshWords::skip_section(const std::string& name) {
  const std::string wanted = "$End" + name;
  for (std::string text = word(); text != wanted; text = word())
    if (text.empty()) fail(fmt::format("found the end of the file, expected {}", wanted));
}

void GmshWords::end_section(const std::string& name) {
  if (const std::string text = word(); text != "$End" + name)
    fail(fmt::format("found {}, expected $End{}", found(text), name));
}

long GmshWords::integer(const char* what) {
  const std::string text = word();
  const auto value = parse_integer(text);
  if (!value) fail(fmt::format("found {}, expected {}, an integer", found(text), what));
  return static_cast<long>(*value);
}

long GmshWords::count(const char* what) {
  const long value = integer(what);
  if (value < 0 || value > most_entries)
    fail(fmt::format("found {}, expected {}, 0 to {}", value, what, most_entries));
  return value;
}

double GmshWords::number(const char* what) {
  const std::string text = word();
  const auto value = parse_number(text);
  if (!value || !std::isfinite(*value))
    fail(fmt::format("found {}, expected {}, a number", found(text), what));
  return *value;
}

std::string GmshWords::quoted(const char* what) {
  int c = in_.get();
  for (; c != EOF && is_blank(c); c = in_.get())
    if (c == '\n') ++line_;
  if (c != '"') fail(fmt::format("found no quote, expected {}", what));
  std::string text;
  for (c = in_.get(); c != EOF && c != '"' && c != '\n'; c = in_.get()) {
    if (text.size() == longest_word) fail(fmt::format("found more than 200 characters, expected {}", what));
    text += static_cast<char>(c);
  }
  if (c != '"') fail(fmt::format("found no closing quote, expected {}", what));
  return text;
}

}  // namespace signorini
