// table_span.hpp: rows that contacts.csv and motion.csv must have.
//
//   contacts.csv   t in the grid of run.toml, every contact at each t      up to t_end, the time of the stop, or the
// last instant
//   motion.csv     contact by contact, t ascending, the first row at 0     in a completed run the last row at t_end
//
// Rows out of place are violations ("rows"). A table that ends too early is cut: FileError, with its line.
#pragma once

#include <functional>
#include <vector>

#include "study/witness/told_row.hpp"

namespace signorini {

/// Time span of a run.
struct RunSpan {
  std::vector<double> grid;           ///< output times, up to t_end
  bool ended = true, stopped = true;  ///< as in the run's summary
  double reached = 0.0;               ///< as recorded; for a run that has not ended, the last instant
};

class TableSpan {
 public:
  using Found = std::function<void(Violation)>;

  /// All arguments must outlive the object.
  TableSpan(const Model& model, const RunSpan& run, const Found& found)
      : model_(model), run_(run), found_(found) {}

  /// Checks the next row of contacts.csv; at its end, completeness.
  void grid_row(const ToldRow& row);
  void end_of_grid(const ToldRowReader& reader) const;
  /// Checks the next row of motion.csv; at its end, completeness.
  void block_row(const ToldRow& row);
  void end_of_blocks(const ToldRowReader& reader) const;

 private:
  void misplaced(const char* file, double t, std::size_t contact);
  [[nodiscard]] static bool same(double a, double b);
  [[nodiscard]] bool comes_to_its_end() const { return run_.ended && !run_.stopped; }

  const Model& model_;
  const RunSpan& run_;
  const Found& found_;
  std::size_t place_ = 0, due_ = 0;  // expected next row: index in the grid, and contact
  bool in_order_ = true;
  std::optional<ToldRow> last_;  // last row of a contact's block
};

}  // namespace signorini
