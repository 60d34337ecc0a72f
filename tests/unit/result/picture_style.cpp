#include "result/picture_style.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

using namespace signorini;

TEST_SUITE_BEGIN("unit/result/picture_style");

TEST_CASE("every phrase stands in every language once, with the same places for names and numbers") {
  const auto places = [](const std::string& text) {
    std::size_t count = 0;
    for (std::size_t at = text.find("{}"); at != std::string::npos; at = text.find("{}", at + 2)) ++count;
    return count;
  };
  const std::vector<std::string> phrases = result::translated_phrases();
  CHECK(std::set<std::string>(phrases.begin(), phrases.end()).size() == phrases.size());
  for (const std::string& phrase : phrases) {
    CAPTURE(phrase);
    CHECK(result::translate("en", phrase) == phrase);
    for (const std::string& language : result::picture_languages()) {
      CHECK_FALSE(result::translate(language, phrase).empty());
      CHECK(places(result::translate(language, phrase)) == places(phrase));
    }
    const std::string russian = result::translate("ru", phrase);
    CHECK(
        std::any_of(russian.begin(), russian.end(), [](char c) { return static_cast<signed char>(c) < 0; }));
  }
  CHECK(result::translate("de", "slip") == "Gleiten");
  CHECK(result::translate("ru", "stick") == "сцепление");
  CHECK(result::translate("de", "contact of mine") == "contact of mine");
}

TEST_SUITE_END();
