#include "study/witness/table_span.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"

namespace signorini {

/// Equal up to the rounding of a conversion of units and back.
bool TableSpan::same(double a, double b) {
  return std::abs(a - b) <= rounding::of_few * std::max(std::abs(a), std::abs(b));
}

void TableSpan::misplaced(const char* file, double t, std::size_t contact) {
  in_order_ = false;
  found_({t, file, static_cast<int>(contact), "rows", 1.0, 0.0, {}, false});
}

void TableSpan::grid_row(const ToldRow& row) {
  const std::vector<double>& grid = run_.grid;
  if (place_ >= grid.size() || row.contact != due_ || !same(row.t, grid[place_])) {
    misplaced("contacts.csv", row.t, due_);
    const double early = row.t - rounding::of_few * std::abs(row.t);
    const auto found = std::lower_bound(grid.begin(), grid.end(), early);
    if (found == grid.end() || !same(*found, row.t)) return;  // not an output time
    place_ = static_cast<std::size_t>(found - grid.begin());
    due_ = row.contact;
  }
  if (++due_ < model_.contacts.size()) return;
  due_ = 0;
  ++place_;
}

void TableSpan::end_of_grid(const ToldRowReader& reader) const {
  if (model_.contacts.empty()) return;
  // The rows of a time that the run has reached exactly exist only if the instant there was completed.
  const std::size_t least =
      comes_to_its_end()
          ? run_.grid.size()
          : static_cast<std::size_t>(
                std::lower_bound(run_.grid.begin(), run_.grid.end(), run_.reached,
                                 [](double t, double end) { return t < end && !same(t, end); }) -
                run_.grid.begin());
  const bool at_last = !in_order_ && place_ + 1 >= least;  // rows out of order are reported instead
  if ((place_ < least && !at_last) || (due_ > 0 && run_.ended && in_order_))
    reader.refuse_as_cut(fmt::format("the row of contact \"{}\" at t = {:.9g}", model_.contacts[due_].name,
                                     place_ < run_.grid.size() ? run_.grid[place_] : run_.reached));
  if (reader.is_cut() && run_.ended) reader.refuse_as_cut("a line break");
}

void TableSpan::block_row(const ToldRow& row) {
  const bool next = last_ ? row.contact == last_->contact + 1 : row.contact == 0;
  const bool goes_on = last_ && row.contact == last_->contact && row.t >= last_->t;
  const bool whole = !last_ || !comes_to_its_end() || same(last_->t, run_.reached);
  if (!goes_on && !(next && whole && row.t == 0.0)) misplaced("motion.csv", row.t, row.contact);
  last_ = row;
}

void TableSpan::end_of_blocks(const ToldRowReader& reader) const {
  if (!run_.ended || model_.contacts.empty()) return;
  const std::size_t all = model_.contacts.size();
  if (!last_ || last_->contact + 1 != all)
    reader.refuse_as_cut(
        fmt::format("rows of contact \"{}\"", model_.contacts[last_ ? last_->contact + 1 : 0].name));
  if (comes_to_its_end() && !same(last_->t, run_.reached))
    reader.refuse_as_cut(fmt::format("rows of contact \"{}\" up to t = {:.9g}",
                                     model_.contacts[last_->contact].name, run_.reached));
  if (reader.is_cut()) reader.refuse_as_cut("a line break");
}

}  // namespace signorini
