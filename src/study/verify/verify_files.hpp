// verify_files.hpp: what `verify` writes (docs/command-line.md).
//
//   verify.json   verdict, orders, richardson, bars, step tests
//   events.csv    one row an event: its time with IDA, at the three steps' limit, both errors
//   plots/verify  differences beside what is allowed
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/verify/verify.hpp"

namespace signorini {

[[nodiscard]] std::string verify_json(const Model& model, const Verification& result);

/// verify.json and events.csv. Errors: FileError.
void write_verification(const std::filesystem::path& directory, const Model& model,
                        const Verification& result);

/// The picture's script. Errors: FileError.
[[nodiscard]] std::vector<std::filesystem::path> write_verify_plot(const std::filesystem::path& directory,
                                                                   const Model& model,
                                                                   const Verification& result);
/// Removes an earlier one.
void begin_verify_plot(const std::filesystem::path& directory);

}  // namespace signorini
