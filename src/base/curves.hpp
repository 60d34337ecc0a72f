// curves.hpp: reduces the number of rows such that straight lines between the kept rows approximate all rows; and the
// interpolating polynomial of a few values.
//
//   lines:   a row is dropped if the straight line between the neighbouring kept rows passes each of its quantities q
//            within c (max q - min q);   c = 2^-12, doubled as often as needed up to 2^-10
//   bins:    if too many rows remain, each time bin [i w, (i + 1) w) keeps its first and last row, and the rows with
//            the smallest and the largest value of each quantity (method M4: Jugel, Jerzak, Hackenbroich, Markl 2014;
//            lines between bins are the same as for all rows);   w = duration / 10000, doubled as often as needed
//            up to duration / 1250
//
// Rows are processed once for each c, and once more at the end. So a dropped row deviates from the lines by at most 3 c of
// the range (0.3 %), or lies within a bin whose extremes are drawn. 0.3 % is half a pixel in a panel of 170 pixels; the
// widest picture has a panel of 1234 pixels.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace signorini::base {

// Polynomial of low degree through given values at points along a line.
//
//   p(x) = sum_i L_i(x) f_i,   x_i = (1 - cos(pi i/(n - 1)))/2 in [0, 1],  degree n - 1;   n = 1: p is constant
//
//   |p - the line through both ends| <= 2 max_i |f_i - the line at x_i|       (Lebesgue's constant, n <= 6)
//
// Extremes of p lie at both ends, and where p' is zero; the zeros of p' lie between those of p'', and so on.

struct PolynomialInterpolation {
  static constexpr std::size_t max_points = 6;  ///< limit for the number of points
  static constexpr double lebesgue = 2.0;
  using Values = std::array<double, max_points>;

  /// Position in [0, 1] of the i-th of n points.
  [[nodiscard]] static double point(std::size_t n, std::size_t i);
  /// Value p(x), from the values f at the n points.
  [[nodiscard]] static double interpolate(const Values& f, std::size_t n, double x);

  /// Extreme values of p and their positions; if several values are equal up to rounding, the first position.
  struct Extremes {
    double least = 0.0, greatest = 0.0, at_least = 0.0, at_greatest = 0.0;
  };
  [[nodiscard]] static Extremes extremes(const Values& f, std::size_t n);
};

/// Rows reduced by lines and bins as above. Values{}(row) returns an array of `count` quantities; bins keep the extremes of
/// the first `drawn` quantities. Rows have a time t that never decreases.
template <class Row, std::size_t count, class Values, std::size_t drawn = count>
class Downsampled {
 public:
  using Quantities = std::array<double, count>;

  struct Options {
    /// Target for the final number of rows. May be exceeded if the bins have reached their largest width, duration / 1250.
    std::size_t max_rows = 8000;
    /// True: bins become as wide as necessary, so that there are at most max_rows rows.
    bool limits_rows = false;
    /// True: of two rows with the same time, lines keep both.
    bool both_sides = false;
    /// Largest time between two successive rows that lines keep.
    double widest = std::numeric_limits<double>::infinity();
  };
  Downsampled(double duration, const Options& wanted)
      : duration_(duration), options_(wanted), limit_(room(wanted.max_rows)) {
    least_.fill(std::numeric_limits<double>::infinity());
    greatest_.fill(-std::numeric_limits<double>::infinity());
  }

  void add(const Row& row) {
    const Quantities q = Values{}(row);
    for (std::size_t i = 0; i < count; ++i) {
      least_[i] = std::min(least_[i], q[i]);
      greatest_[i] = std::max(greatest_[i], q[i]);
    }
    // Memory is reserved once, because a growing vector fragments memory; reserved pages that are never used cost nothing.
    if (rows_.capacity() == 0)
      rows_.reserve(room(std::max(options_.max_rows, options_.limits_rows ? 0 : max_rows_in_bins)) + 1);
    rows_.push_back(row);
    if (rows_.size() > limit_) downsample();
  }

  [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }
  /// Moves all rows out of the object.
  [[nodiscard]] std::vector<Row> take() { return std::move(rows_); }
  /// Width of a bin in units of t; 0 if there are no bins.
  [[nodiscard]] double width() const { return width_; }
  /// Largest minus smallest value of the i-th quantity so far.
  [[nodiscard]] double range(std::size_t i = 0) const {
    return rows_.empty() ? 0.0 : greatest_[i] - least_[i];
  }
  /// The largest magnitude of the i-th quantity.
  [[nodiscard]] double size(std::size_t i) const {
    return rows_.empty() ? 0.0 : std::max(std::abs(least_[i]), std::abs(greatest_[i]));
  }

  /// Must be called after the last row. floors: for each quantity, the difference up to which values are treated as equal.
  void close(const Quantities& floors) {
    floors_ = floors;
    share_ = std::max(share_, finest);
    processed_ = 0;
    remove_collinear();
    if (width_ > 0.0) keep_extremes();
    if (rows_.size() > options_.max_rows) downsample();
  }

 private:
  static constexpr double finest = 1.0 / 4096.0, coarsest = 1.0 / 1024.0;
  static constexpr double initial_bin_count = 10000.0, pixels = 1250.0;
  static constexpr std::size_t max_rows_in_bins = (2 * drawn + 2) * (static_cast<std::size_t>(pixels) + 1);

  /// Number of rows at which downsampling begins, if it keeps `kept` rows. The margin of one eighth limits the memory, and each
  /// row is processed about nine times.
  static std::size_t room(std::size_t kept) { return kept + kept / 8; }

  void downsample() {
    const std::size_t enough = options_.max_rows;
    if (share_ > 0.0) remove_collinear();
    while (rows_.size() > enough && share_ < coarsest) {
      share_ = std::max(2.0 * share_, finest);
      processed_ = 0;
      remove_collinear();
    }
    if (width_ > 0.0) keep_extremes();
    while (rows_.size() > enough && width_ < (options_.limits_rows ? duration_ : duration_ / pixels)) {
      width_ = std::max(2.0 * width_, duration_ / initial_bin_count);
      keep_extremes();
    }
    limit_ = room(std::max(enough, rows_.size()));
  }

  /// Drops rows that lie on straight lines. low, high: smallest and largest slope of the lines that start at the last kept row
  /// and pass every later row within the distance d.
  void remove_collinear() {
    if (rows_.size() < processed_ + 3) return;
    Quantities d, low, high, from;
    for (std::size_t i = 0; i < count; ++i) d[i] = std::max(share_ * (greatest_[i] - least_[i]), floors_[i]);
    // `kept`: index of the last kept row after compaction. `anchor`: its index before compaction, where the line begins.
    std::size_t kept = processed_;
    double t = 0.0;
    const auto begin_at = [&](const Row& row) {
      from = Values{}(row);
      t = row.t;
      low.fill(-std::numeric_limits<double>::infinity());
      high.fill(std::numeric_limits<double>::infinity());
    };
    begin_at(rows_[kept]);
    std::size_t anchor = kept;
    for (std::size_t j = kept + 1; j < rows_.size(); ++j) {
      const Quantities to = Values{}(rows_[j]);
      const auto all = [&](const auto& holds) {
        for (std::size_t i = 0; i < count; ++i)
          if (!holds(i)) return false;
        return true;
      };
      double h = rows_[j].t - t;
      const bool side = options_.both_sides && rows_[j].t == rows_[j - 1].t;
      const bool needed = side || h > options_.widest || !all([&](std::size_t i) {
                            return to[i] - from[i] >= low[i] * h && to[i] - from[i] <= high[i] * h;
                          });
      if (needed && j - 1 > anchor) {
        anchor = j - 1;
        begin_at(rows_[anchor]);
        rows_[++kept] = rows_[anchor];
        h = rows_[j].t - t;
      }
      if (h > 0.0) {
        for (std::size_t i = 0; i < count; ++i) {
          low[i] = std::max(low[i], (to[i] - d[i] - from[i]) / h);
          high[i] = std::min(high[i], (to[i] + d[i] - from[i]) / h);
        }
      } else if (options_.both_sides ||
                 !all([&](std::size_t i) { return std::abs(to[i] - from[i]) <= d[i]; })) {
        anchor = j;  // row j is the other side of a jump
        begin_at(rows_[j]);
        rows_[++kept] = rows_[j];
      }
    }
    if (anchor + 1 < rows_.size()) rows_[++kept] = rows_.back();
    rows_.resize(kept + 1);
    processed_ = kept;
  }

  /// Keeps, for each bin, the first and the last row and the rows with the extremes of the drawn quantities.
  void keep_extremes() {
    std::size_t kept = 0;
    std::array<std::size_t, 2 * drawn + 2> chosen;
    for (std::size_t begin = 0; begin < rows_.size();) {
      const double bin = std::floor(rows_[begin].t / width_);
      std::size_t end = begin + 1;
      std::ptrdiff_t n = 0;
      while (end < rows_.size() && std::floor(rows_[end].t / width_) == bin) ++end;
      const auto choose = [&](std::size_t j) { chosen[static_cast<std::size_t>(n++)] = j; };
      choose(begin);
      choose(end - 1);
      for (std::size_t i = 0; i < drawn; ++i) {
        std::size_t least = begin, greatest = begin;
        for (std::size_t j = begin + 1; j < end; ++j) {
          const double q = Values{}(rows_[j])[i];
          if (q < Values{}(rows_[least])[i]) least = j;
          if (q > Values{}(rows_[greatest])[i]) greatest = j;
        }
        choose(least);
        choose(greatest);
      }
      std::sort(chosen.begin(), chosen.begin() + n);
      const auto last = std::unique(chosen.begin(), chosen.begin() + n);
      for (auto j = chosen.begin(); j != last; ++j) rows_[kept++] = rows_[*j];
      begin = end;
    }
    rows_.resize(kept);
    processed_ = kept - 1;
  }

  double duration_;
  Options options_;
  std::size_t limit_;
  std::vector<Row> rows_;
  Quantities least_, greatest_, floors_{};
  double share_ = 0.0, width_ = 0.0;  // c; width w of a bin
  std::size_t processed_ = 0;         // index of the last row that was processed with the current c
};

}  // namespace signorini::base
