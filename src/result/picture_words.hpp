// picture_words.hpp: the words of pictures in the languages that papers are written in.
//
//   say("de", "slip") == "Gleiten"
//
// One table, a row a word or a phrase; what stands in no row stays English. Names of contacts, symbols and units stay
// as they are. Words of mechanics as in the textbooks of each language; stick, slip: Haften, Gleiten; сцепление,
// скольжение, as in the paper behind the program.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace signorini {

/// "en" first.
[[nodiscard]] const std::vector<std::string>& picture_languages();

/// The phrase in a language of picture_languages().
[[nodiscard]] std::string say(std::string_view language, std::string_view english);

/// Every English phrase that has a row.
[[nodiscard]] std::vector<std::string> translated_phrases();

}  // namespace signorini
