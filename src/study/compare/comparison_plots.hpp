// comparison_plots.hpp: gnuplot scripts that overlay several runs.
//
//   DIR/plots/contact-NAME.gp   ut, gap, N and T of one contact, one curve per run
//   DIR/plots/differences.gp    displacements, forces and event times against the reference, logarithmic
//
// differences.gp reads plots/motion-RUN.csv and plots/forces-RUN.csv, which compare_runs writes.
#pragma once

#include <filesystem>
#include <vector>

#include "result/picture_style.hpp"
#include "study/compare/comparison_files.hpp"

namespace signorini::compare {

/// Part of file names for the run with index i: "2-exact" for i = 1.
[[nodiscard]] std::string run_slug(const std::string& name, std::size_t i);

/// Creates DIR/plots, or removes the files of an earlier comparison from it. Errors: FileError.
void begin_comparison_plots(const std::filesystem::path& directory);

/// Writes the scripts into DIR/plots and returns their paths; empty if there are fewer than two output times.
/// Errors: FileError.
std::vector<std::filesystem::path> write_comparison_plots(const std::filesystem::path& directory,
                                                          const ComparisonReport& report,
                                                          const result::PictureStyle& look = {});

}  // namespace signorini::compare
