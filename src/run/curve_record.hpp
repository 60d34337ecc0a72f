// curve_record.hpp: displacements and energies for pictures, of bounded size for any output_dt.
//
//   a curve: a displacement of a named node (of each kind as many as a picture shows), an energy, or the balance
//   rows y_k at t_k;   where y_1 is a peak of three:   the vertex of the parabola through them is also a row
//
// Rows are both sides of every instant, and as many ends and interior points of steps as a line needs. Their
// times are those of the contact rows (motion_record.hpp). Each curve is thinned separately
// (base/curves.hpp). No parabola extends across an instant, whose two sides have the same time. Energies of a
// part are passed on immediately (part_rows.hpp).
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

// Distance of rows such that straight lines between them represent the curve.
//
//   rows at a, b, c:   y_b is off the line from y_a to y_c by   d = |y''| (b - a) (c - b) / 2
//   rows h apart:      h^2 = (b - a) (c - b) e R / d      rows are off by e R, lines between by e R / 4
//
// R: the range of y; e: max_deviation. A curve with amplitude A = R / 2 has 47 rows per period at its turning
// points. The existing rows determine h; their distances need not be equal.

/// Fraction of the range by which rows may be off. Half of a curve's first bend passes before rows detect it,
/// and thinned rows are off by 0.3 % (base/curves.hpp). Chosen value; the test "what pictures draw of
/// contacts is the motion" depends on it.
inline constexpr double max_deviation = 0.0045;
/// Smallest spacing of rows, as a fraction of the run: 26 rows per pixel of the widest picture.
inline constexpr double min_row_spacing = 1.0 / 32000.0;

/// Spacing h of one curve; left, right: b - a and c - b, off: d. Infinite for a straight line.
[[nodiscard]] inline double row_spacing(double left, double right, double off, double range) {
  if (!(off > 0.0) || !(range > 0.0)) return std::numeric_limits<double>::infinity();
  return std::sqrt(left * right * max_deviation * range / off);
}

// Polynomials through values at nested Chebyshev points.
//
//   x_i = -cos(pi i / 16), i = 0, ..., 16, ascending on [-1, 1]; every second, fourth, eighth of them are
//   the points of degree 8, 4, 2
//   p(x) = sum w_i r_i / (x - x_i) / sum w_i / (x - x_i),   w_i = +-1, half at the ends
//   p'(x_i) = sum over j != i of  c_i/c_j (-1)^(i+j) / (x_i - x_j) (r_j - r_i),   c = 2 at the ends, else 1
//
// `stride` chooses the points: 1, 2, 4, 8 for degree 16, 8, 4, 2. Values have all 17 entries; the others are not read.

struct Chebyshev {
  static constexpr std::size_t count = 17;
  using Values = std::array<double, count>;

  /// The 17 points x_i.
  [[nodiscard]] static const Values& nodes();
  /// Value p(x) of the polynomial through the points of the stride.
  [[nodiscard]] static double interpolate(const Values& values, std::size_t stride, double x);
  /// Derivative p' at the points of the stride.
  [[nodiscard]] static Values slopes(const Values& values, std::size_t stride);
  /// Zero of p' between two points at which its signs differ; `slope` is the result of slopes().
  [[nodiscard]] static double extremum_between(const Values& slope, std::size_t stride, double a, double b);
};

/// Columns of the displacements that pictures show.
[[nodiscard]] std::vector<Column> drawn_columns(const Model& model);

/// Entries of a physical u that drawn_columns() needs.
[[nodiscard]] std::vector<int> drawn_entries(const Model& model);

/// Limit for the points of a curve, if pictures show this number of displacements.
[[nodiscard]] std::size_t max_curve_points(std::size_t columns);

class CurveRecord {
 public:
  /// Model and recorder must outlive the object. No data are kept if the recorder does not want motions.
  CurveRecord(const Model& model, double t_end, const Recorder& recorder, const PartShare& share = {});

  [[nodiscard]] bool enabled() const { return enabled_; }
  /// True if a line needs a row at t although no event occurs at t.
  [[nodiscard]] bool needs_row(double t) const;
  /// Row spacing required by the last three rows.
  [[nodiscard]] double requested_spacing() const { return requested_spacing_; }
  /// Time of the last row; infinite if no rows are wanted.
  [[nodiscard]] double last() const { return last_; }
  /// Adds a row. u: of the computed model; rows are stored in the scene's units.
  void add(double t, const Vector& u, const Energy& energy);
  /// Passes the curves to the recorder and ends the record.
  void write(Recorder& recorder);

 private:
  struct ValueOf {
    std::array<double, 1> operator()(const CurvePoint& point) const { return {point.value}; }
  };
  /// Kinds of curves; the largest value of a kind determines its rounding.
  enum class Kind { length, angle, energy, balance };
  struct Curve {
    std::string name;
    Kind kind;
    int dof;        // -1: fixed, or an energy
    double factor;  // unit conversion
    base::Downsampled<CurvePoint, 1, ValueOf> points;
    bool kept = true;  // false: another object sums it with those of other parts
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
  std::array<double, 4> greatest_{};  // largest value of each kind
  bool enabled_;
  std::function<void(double, const Energy&)> energies_;  // receiver of a part's energies
  std::vector<Curve> curves_;                            // displacements, energies, the balance
};

}  // namespace signorini::run
