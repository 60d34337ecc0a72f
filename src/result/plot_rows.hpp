// plot_rows.hpp: which rows of a run's tables are those of which contact.
//
//   contacts.csv: contact k of n has rows k, k + n, k + 2 n, ...;   motion.csv, curves.csv: all of its rows one after another
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "result/plot_parts.hpp"

namespace signorini {

using ContactNumbers = std::map<std::string, std::size_t>;
/// Of the contacts of summary.json, by name.
[[nodiscard]] ContactNumbers contact_numbers(const RunFacts& facts);
/// Errors: FileError for a name that summary.json has not.
[[nodiscard]] std::size_t number_of(const ContactNumbers& numbers, const std::string& contact,
                                    const std::filesystem::path& file);
/// Where motion.csv has the rows of which contact, and the greatest forces; nothing where it is missing.
/// greatest_compression has a number a contact. Errors: FileError for rows that are not in order.
void read_motion(const std::filesystem::path& directory, const ContactNumbers& numbers, PlottedRun& run);
/// Where curves.csv has the rows of which curve; nothing where it is missing. Errors: FileError for rows that are not in
/// order.
void read_curves(const std::filesystem::path& directory, PlottedRun& run);

}  // namespace signorini
