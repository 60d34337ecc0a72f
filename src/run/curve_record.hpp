// curve_record.hpp: displacements and energies for pictures; the size is bounded for any output_dt.
//
//   a curve: a displacement of a named node (at most as many of each kind as a picture shows), an energy, or the balance
//   rows y_k at t_k;   if y_1 is the peak of three rows:   the vertex of the parabola through them is also a row
//
// A curve has rows on both sides of every instant, and at as many ends and interior points of steps as a drawn line
// needs. The times are those of the contact rows (motion_record.hpp). Each curve is thinned separately (base/curves.hpp).
// The two sides of an instant have the same time, so no parabola extends across an instant. The energies of an independent part
// are passed to part_rows.hpp immediately.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include "base/curves.hpp"
#include "run/part_rows.hpp"
#include "signorini/model.hpp"
#include "signorini/result.hpp"

namespace signorini::run {

// Spacing of rows such that straight lines between the rows represent the curve.
//
//   rows at a, b, c:   y_b is off the line from y_a to y_c by   d = |y''| (b - a) (c - b) / 2
//   spacing h:         h^2 = (b - a) (c - b) e R / d
//
// A row then deviates from the line between its neighbours by e R, and the curve from the line between two rows by e R / 4.
//
// R: the range of y; e: max_deviation. A harmonic curve with amplitude A = R / 2 has 47 rows per period near its turning
// points. h follows from the last three rows, whose distances need not be equal.

/// Allowed error of rows, as a fraction of the range. Rows detect a bend of a curve only after half of the bend, and
/// thinning adds an error of 0.3 % (base/curves.hpp). Chosen value; the test "what pictures draw of contacts is the
/// motion" depends on it.
inline constexpr double max_deviation = 0.0045;
/// Smallest spacing of rows, as a fraction of the run: 26 rows per pixel of the widest picture.
inline constexpr double min_row_spacing = 1.0 / 32000.0;

/// Spacing h of one curve; left: b - a, right: c - b, off: d, range: R. Infinite for a straight line.
[[nodiscard]] inline double row_spacing(double left, double right, double off, double range) {
  if (!(off > 0.0) || !(range > 0.0)) return std::numeric_limits<double>::infinity();
  return std::sqrt(left * right * max_deviation * range / off);
}

// Polynomials through values at nested Chebyshev points.
//
//   x_i = -cos(pi i / 16), i = 0, ..., 16, ascending on [-1, 1]; every second, fourth or eighth point gives a polynomial
//   of degree 8, 4 or 2
//   p(x) = sum w_i r_i / (x - x_i) / sum w_i / (x - x_i),   w_i = +-1, half at the ends
//   p'(x_i) = sum over j != i of  c_i/c_j (-1)^(i+j) / (x_i - x_j) (r_j - r_i),   c = 2 at the ends, else 1
//
// `stride` selects the points: 1, 2, 4, 8 for degree 16, 8, 4, 2. Values have 17 entries; only selected ones are read.

struct Chebyshev {
  static constexpr std::size_t count = 17;
  using Values = std::array<double, count>;

  /// The 17 points x_i.
  [[nodiscard]] static const Values& nodes();
  /// Value p(x) of the polynomial through the points of the stride.
  [[nodiscard]] static double interpolate(const Values& values, std::size_t stride, double x);
  /// Derivative p' at the points of the stride.
  [[nodiscard]] static Values slopes(const Values& values, std::size_t stride);
  /// Zero x of p' between a and b, where p' has different signs; `slope` is the result of slopes().
  [[nodiscard]] static double extremum_between(const Values& slope, std::size_t stride, double a, double b);
};

/// Columns of history.csv whose displacements pictures show.
[[nodiscard]] std::vector<Column> drawn_columns(const Model& model);

/// Indices into a physical u of the displacements in drawn_columns().
[[nodiscard]] std::vector<int> drawn_entries(const Model& model);

/// Largest number of points per curve, if pictures show `columns` displacements.
[[nodiscard]] std::size_t max_curve_points(std::size_t columns);

class CurveRecord {
 public:
  /// Model and recorder must outlive the object. No data are kept if the recorder does not want motions.
  CurveRecord(const Model& model, double t_end, const Recorder& recorder, const PartShare& share = {});

  [[nodiscard]] bool enabled() const { return enabled_; }
  /// True if the last row is so far before t that a drawn line needs a row at t.
  [[nodiscard]] bool needs_row(double t) const;
  /// Row spacing required by the last three rows.
  [[nodiscard]] double requested_spacing() const { return requested_spacing_; }
  /// Time of the last row; infinite if no rows are wanted.
  [[nodiscard]] double last() const { return last_; }
  /// Adds a row to every curve. Arguments are in the units of the computed model; rows are stored in the scene's units.
  void add(double t, const Vector& u, const Energy& energy);
  /// Passes the curves to the recorder and ends the record.
  void write(Recorder& recorder);

 private:
  struct ValueOf {
    std::array<double, 1> operator()(const CurvePoint& point) const { return {point.value}; }
  };
  /// Kinds of curves; the rounding error of a curve follows from the largest value of its kind.
  enum class Kind { length, angle, energy, balance };
  struct Curve {
    std::string name;
    Kind kind;
    int dof;        // index into the physical u; -1: a fixed direction or an energy
    double factor;  // from the model's unit to the scene's
    base::Downsampled<CurvePoint, 1, ValueOf> points;
    bool kept = true;  // false: not stored, because EnergySum adds the energies of all parts
    double least = std::numeric_limits<double>::infinity(), greatest = -least;

    [[nodiscard]] double range() const {
      return kept ? points.range() : greatest >= least ? greatest - least : 0.0;
    }
    std::array<CurvePoint, 2> before = {
        {{-std::numeric_limits<double>::infinity(), 0.0}, {}}};  // the last two rows
    bool begun = false;
  };
  void add(Curve& curve, const CurvePoint& point);
  [[nodiscard]] double spacing_for_curve(const Curve& curve, const CurvePoint& point);

  const Model& model_;
  double t_end_, last_;
  double requested_spacing_ = std::numeric_limits<double>::infinity();
  std::array<double, 4> greatest_{};  // for each Kind: largest value of its curves
  bool enabled_;
  // Receives the energies of a part; empty for a whole model.
  std::function<void(double, const Energy&)> energies_;
  std::vector<Curve> curves_;  // displacements, energies, the balance
};

}  // namespace signorini::run
