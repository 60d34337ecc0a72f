#include "base/text.hpp"

#include <doctest/doctest.h>

using namespace signorini;

TEST_SUITE_BEGIN("unit/base/excerpt");

TEST_CASE("excerpt: at most 80 characters that can be printed") {
  CHECK(base::excerpt("a b") == "a b");
  CHECK(base::excerpt("\x1b[31m\xff\n") == "?[31m??");
  CHECK(base::excerpt(std::string(80, 'x')) == std::string(80, 'x'));
  CHECK(base::excerpt(std::string(81, 'x')) == std::string(77, 'x') + "...");
}

TEST_CASE("is_utf8: whole characters in their shortest form, and nothing else") {
  for (const char* text : {"", "plain", "\xc3\xbc", "\xe2\x82\xac", "\xf0\x9f\x98\x80", "\xf4\x8f\xbf\xbf"})
    CHECK(base::is_utf8(text));
  for (const char* text : {"\xff", "\x80", "\xc3", "\xc0\xaf", "\xe0\x80\xaf", "\xed\xa0\x80",
                           "\xf0\x80\x80\x80", "\xf4\x90\x80\x80", "\xe2\x82"})
    CHECK_FALSE(base::is_utf8(text));
}

TEST_CASE("is_plain_text: blanks of all kinds, but nothing that moves a cursor") {
  CHECK(base::is_plain_text("two words\tand\r\n\u20ac"));
  for (const char* text : {"\x1b[31m", "\x7f", "\x01", "\xff"}) CHECK_FALSE(base::is_plain_text(text));
}

TEST_SUITE_END();
