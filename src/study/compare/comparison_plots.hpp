// comparison_plots.hpp: gnuplot scripts that lay several runs over each other.
//
//   DIR/plots/contact-NAME.gp   ut, gap, N and T of one contact, a curve a run
//   DIR/plots/differences.gp    displacements, forces and event times against the reference, logarithmic
//
// differences.gp reads plots/motion-RUN.csv and plots/forces-RUN.csv, which compare_runs writes.
#pragma once

#include <filesystem>
#include <vector>

#include "result/picture_look.hpp"
#include "study/compare/comparison_files.hpp"

namespace signorini {

/// The part of the names of files that stands for run number i: "2-exact".
[[nodiscard]] std::string run_slug(const std::string& name, std::size_t i);

/// DIR/plots, there and without what an earlier comparison left. Errors: FileError.
void begin_comparison_plots(const std::filesystem::path& directory);

/// Writes the scripts into DIR/plots and returns them; none with fewer than two output times. Errors:
/// FileError.
std::vector<std::filesystem::path> write_comparison_plots(const std::filesystem::path& directory,
                                                          const ComparisonReport& report,
                                                          const PictureLook& look = {});

}  // namespace signorini
