// curve_record.hpp: displacements and energies for pictures, of bounded size for any output_dt.
//
//   a curve: a displacement of a named node (of each kind as many as a picture shows), an energy, or the balance
//   rows y_k at t_k;   where y_1 is a peak of three:   the vertex of the parabola through them is also a row
//
// Rows are both sides of every instant, and ends and interior points of steps as needed for a line, at the times of the
// contact rows (motion_record.hpp). Each curve is thinned separately (base/thinned.hpp). No parabola extends across an
// instant, whose two sides have the same time. Energies of a part are passed on immediately (energy_sum.hpp).
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <vector>

#include "base/thinned.hpp"
#include "run/part_share.hpp"
#include "signorini/model.hpp"
#include "signorini/result.hpp"

namespace signorini {

/// Displacements shown in pictures.
[[nodiscard]] std::vector<Column> drawn_columns(const Model& model);

/// Entries of u that these displacements need, for a physical u.
[[nodiscard]] std::vector<int> drawn_entries(const Model& model);

/// Limit for the points of a curve, for this number of displacements.
[[nodiscard]] std::size_t most_points_of(std::size_t columns);

class CurveRecord {
 public:
  /// Model and recorder must outlive the object. No data are kept if the recorder does not want motions.
  CurveRecord(const Model& model, double t_end, const Recorder& recorder, const PartShare& share = {});

  [[nodiscard]] bool wanted() const { return wanted_; }
  /// True if a line needs a row at t, without an event there.
  [[nodiscard]] bool needs(double t) const;
  /// Row spacing required by the last three rows (row_spacing.hpp).
  [[nodiscard]] double asked() const { return asked_; }
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
    Thinned<CurvePoint, 1, ValueOf> points;
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
  [[nodiscard]] double asked_by(const Curve& curve, const CurvePoint& point);

  const Model& model_;
  double t_end_, last_;
  double asked_ = std::numeric_limits<double>::infinity();
  std::array<double, 4> greatest_{};  // largest value of each kind
  bool wanted_;
  std::function<void(double, const Energy&)> energies_;  // receiver of a part's energies
  std::vector<Curve> curves_;                            // displacements, energies, the balance
};

}  // namespace signorini
