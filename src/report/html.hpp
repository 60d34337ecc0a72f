// html.hpp: text, tables and JSON for HTML pages. All text is escaped: names of a scene never become markup.
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

namespace signorini::report {

/// Text for an element or a quoted attribute. Bytes that HTML forbids become the replacement character.
[[nodiscard]] std::string html_text(std::string_view text);

/// JSON that is safe in <script type="application/json">.
[[nodiscard]] std::string script_json(const std::string& json);

/// The number in `cell` with this many significant digits, "1.2e-08"; a text that is no number stays unchanged.
[[nodiscard]] std::string short_number(const std::string& cell, int digits = 6);

/// HTML table of a CSV file: numbers with six digits, times (t) with eleven. columns: names of the columns
/// shown; empty: all. Rows after the first `most` are omitted, with a note. Rounding errors, compared with the values of
/// their column, are shown as 0. units: units of columns, for the header. Returns an empty text if the file is missing or
/// has no rows. Errors: FileError.
[[nodiscard]] std::string csv_table(const std::filesystem::path& file, std::size_t most,
                                    const std::vector<std::string>& columns = {},
                                    const std::map<std::string, std::string>& units = {});

/// "<section id=...><h2>...</h2>...</section>"; empty for an empty body.
[[nodiscard]] std::string section(const std::string& id, const std::string& heading, const std::string& body);

/// Replacement of @NAME@ in the text of a page. Inserted text is not searched again.
struct Insertion {
  std::string name, value;
};
/// The page with all insertions.
[[nodiscard]] std::string fill_template(std::string_view page, const std::vector<Insertion>& values);

}  // namespace signorini::report
