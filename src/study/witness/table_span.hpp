// table_span.hpp: which rows contacts.csv and motion.csv must have.
//
//   contacts.csv   t in the grid of run.toml, every contact at each t      up to t_end; where the run stopped; the last instant
//   motion.csv     contact by contact, t ascending, the first row at 0     of a run that came to its end, the last one at t_end
//
// Rows out of place are violations ("rows"). A table that ends before it must is cut: FileError, with its line.
#pragma once

#include <functional>
#include <vector>

#include "study/witness/told_row.hpp"

namespace signorini {

/// How far a run came.
struct RunSpan {
  std::vector<double> grid;           ///< times of output, up to t_end
  bool ended = true, stopped = true;  ///< of ToldSummary
  double reached = 0.0;               ///< told; of a run that has not ended the last instant
};

class TableSpan {
 public:
  using Found = std::function<void(Violation)>;

  /// All must outlive it.
  TableSpan(const Model& model, const RunSpan& run, const Found& found)
      : model_(model), run_(run), found_(found) {}

  /// Rows of contacts.csv in their order; at its end.
  void grid_row(const ToldRow& row);
  void end_of_grid(const ToldRowReader& reader) const;
  /// The same of motion.csv.
  void block_row(const ToldRow& row);
  void end_of_blocks(const ToldRowReader& reader) const;

 private:
  void misplaced(const char* file, double t, std::size_t contact);
  [[nodiscard]] static bool same(double a, double b);
  [[nodiscard]] bool comes_to_its_end() const { return run_.ended && !run_.stopped; }

  const Model& model_;
  const RunSpan& run_;
  const Found& found_;
  std::size_t place_ = 0, due_ = 0;  // the time in the grid, and the contact, of the row that comes next
  bool in_order_ = true;
  std::optional<ToldRow> last_;  // of a block
};

}  // namespace signorini
