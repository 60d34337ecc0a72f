// html.hpp: text, tables and JSON where a page of HTML has them. Names of a scene may be anything: nothing of them is ever markup.
//
//   html_text("a<b")                     "a&lt;b"
//   script_json("{\"a\":\"</script>\"}")   "{\"a\":\"\u003c/script>\"}"
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace signorini {

/// In an element or in a quoted attribute. Bytes that HTML forbids become the replacement character.
[[nodiscard]] std::string html_text(std::string_view text);

/// JSON that may stand in <script type="application/json">.
[[nodiscard]] std::string script_json(const std::string& json);

/// A number to so many digits, "1.2e-08"; other texts as they are.
[[nodiscard]] std::string short_number(const std::string& cell, int digits = 6);

/// Numbers have six digits, times (t) eleven. `columns`: which ones, by name; all where empty. Rows after the first `most` are left out, and said so.
/// What is rounding beside the others of its column is 0. `units`: of columns, for the header. Empty where there is no such
/// file. Errors: FileError.
[[nodiscard]] std::string csv_table(const std::filesystem::path& file, std::size_t most,
                                    const std::vector<std::string>& columns = {},
                                    const std::map<std::string, std::string>& units = {});

/// "<section id=...><h2>...</h2>...</section>"; nothing around nothing.
[[nodiscard]] std::string section(const std::string& id, const std::string& heading, const std::string& body);

/// @NAME@ in the text of a page, replaced once; what comes in is not looked through.
struct Insertion {
  std::string name, value;
};
[[nodiscard]] std::string fill_in(std::string_view page, const std::vector<Insertion>& values);

}  // namespace signorini
