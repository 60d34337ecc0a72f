// fit_files.hpp: files of `fit` (docs/command-line.md).
//
//   fit.json        keys with their sigmas, covariance, chi_squared, reason for the end
//   residuals.csv   row,event_index,column,t,measured,residual,sigma
#pragma once

#include <filesystem>

#include "signorini/fit.hpp"

namespace signorini {

[[nodiscard]] std::string fit_json(const Fit& fit, const Measurements& measured);
/// Writes both files. Errors: FileError.
void write_fit(const std::filesystem::path& directory, const Fit& fit, const Measurements& measured);

}  // namespace signorini
