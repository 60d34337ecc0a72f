// picture_words.hpp: translations of the words in pictures.
//
//   say("de", "slip") == "Gleiten"
//
// One table, with one row per word or phrase; phrases without a row stay English. Names of contacts, symbols and units
// are not translated. Terms of mechanics follow the textbooks of each language; stick, slip: Haften, Gleiten;
// сцепление, скольжение, as in the paper behind the program.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace signorini {

/// Language codes, "en" first.
[[nodiscard]] const std::vector<std::string>& picture_languages();

/// The phrase in a language of picture_languages().
[[nodiscard]] std::string say(std::string_view language, std::string_view english);

/// Every English phrase that has a row.
[[nodiscard]] std::vector<std::string> translated_phrases();

}  // namespace signorini
