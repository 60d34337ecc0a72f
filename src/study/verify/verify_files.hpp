// verify_files.hpp: files of `verify` (docs/command-line.md).
//
//   verify.json   verdict, orders, richardson, bars, step tests
//   events.csv    one row per event: its time by IDA, the limit of newmark's three times, error bounds of both
//   plots/verify  differences relative to the allowed ones
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/verify/verify.hpp"

namespace signorini::verify {

/// Text of verify.json.
[[nodiscard]] std::string verify_json(const Model& model, const Verification& result);

/// Writes verify.json and events.csv. Errors: FileError.
void write_verification(const std::filesystem::path& directory, const Model& model,
                        const Verification& result);

/// Writes the picture's script. Errors: FileError.
[[nodiscard]] std::vector<std::filesystem::path> write_verify_plot(const std::filesystem::path& directory,
                                                                   const Model& model,
                                                                   const Verification& result);
/// Removes the picture of an earlier verification.
void begin_verify_plot(const std::filesystem::path& directory);

}  // namespace signorini::verify
