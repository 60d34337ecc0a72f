// sweep_plots.hpp: gnuplot scripts that draw a sweep over its first varied key.
//
//   DIR/plots/motion.gp   peaks along tangent and normal, one curve per contact and combination of the other keys
//   DIR/plots/forces.gp   peaks of |N| and |T|
//   DIR/plots/losses.gp   friction work, and events
//   DIR/plots/responses.gp results of the queries, one panel each
//   DIR/plots/exceedance.gp for a sampled sweep, instead of all others: exceedance probabilities
//   DIR/plots/strobe.gp   for a stroboscopic sweep: bifurcation diagrams (sweep_table.hpp)
//   DIR/plots/curve-1.csv x, events, then the figures of every contact: one file per combination
//
// The first key with more than one value is the axis; if its values are not numbers, they are evenly spaced. Two keys
// with at least three numbers each are the axes of maps instead (sweep_map.hpp).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "result/picture_files.hpp"
#include "study/sweep/sweep_table.hpp"

namespace signorini::sweep {

/// The key of a sweep that is the axis of its pictures.
///
///   x of a row = value of the key on the axis, or the number of the value if values are not numbers
struct SweepAxis {
  std::size_t key = 0;  ///< index into SweepSpec::vary
  bool numbers = true;  ///< true if all values of the key are numbers
  const ParameterRange* vary = nullptr;

  [[nodiscard]] std::string x(const SweepRow& row) const;
};
/// The first key with more than one value, or with `last` the last such key. `spec` must outlive the result.
[[nodiscard]] SweepAxis axis_of(const SweepSpec& spec, bool last = false);

/// Rows that have equal values of all keys except the key on the axis.
struct SweepCurve {
  std::string name;  ///< values of the other keys, as text
  std::vector<const SweepRow*> rows;
};
/// Curves of the rows with a run, in the order of the rows.
[[nodiscard]] std::vector<SweepCurve> swept_curves(const SweepSpec& spec, const SweepRows& rows,
                                                   const SweepAxis& axis);
/// Text that names the keys whose values are names of curves: "; curves: PATH, PATH".
[[nodiscard]] std::string other_keys(const SweepSpec& spec, const SweepAxis& axis);
/// "set xrange [a:b]" around all values, including those without a run, so that a gap at an end is visible.
[[nodiscard]] std::string x_range(const SweepAxis& axis);

/// Pictures of the sweep; empty if fewer than two rows ran.
[[nodiscard]] result::PictureFiles sweep_pictures(const SweepSpec& spec, const SweepRows& rows,
                                                  const result::PictureStyle& look = {});

/// Removes the files of these pictures and scripts from DIR/plots. Errors: FileError.
void remove_sweep_plots(const std::filesystem::path& directory);

}  // namespace signorini::sweep
