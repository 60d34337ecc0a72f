// curve_record.hpp: displacements and energies for pictures, bounded, whatever output_dt is.
//
//   a curve a displacement of named nodes (of each kind as many as a picture shows), an energy, the balance
//   rows y_k at t_k;   where y_1 is a peak of three:   the vertex of the parabola through them is a row, too
//
// Rows are both sides of every instant, and ends and insides of steps as many as a line needs, taken where
// contacts are (motion_record.hpp). Each curve is thinned by itself (base/thinned.hpp). No parabola leads across an
// instant: its two sides have one time. Energies of a part are handed on as they come (energy_sum.hpp).
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

/// Displacements that a picture shows.
[[nodiscard]] std::vector<Column> drawn_columns(const Model& model);

/// Entries of u that they are made of, where u is the physical one.
[[nodiscard]] std::vector<int> drawn_entries(const Model& model);

/// Points of a curve, at most, of so many displacements.
[[nodiscard]] std::size_t most_points_of(std::size_t columns);

class CurveRecord {
 public:
  /// Both must outlive the record. Nothing is kept where the recorder does not want it.
  CurveRecord(const Model& model, double t_end, const Recorder& recorder, const PartShare& share = {});

  [[nodiscard]] bool wanted() const { return wanted_; }
  /// Does a line need a row at t, where nothing happens?
  [[nodiscard]] bool needs(double t) const;
  /// How close rows must be, as the last three tell (row_spacing.hpp).
  [[nodiscard]] double asked() const { return asked_; }
  /// Time of the last row; infinite where none is wanted.
  [[nodiscard]] double last() const { return last_; }
  /// u: of the model that is computed. In the scene's units from here on.
  void add(double t, const Vector& u, const Energy& energy);
  /// The record ends.
  void write(Recorder& recorder);

 private:
  struct ValueOf {
    std::array<double, 1> operator()(const CurvePoint& point) const { return {point.value}; }
  };
  /// Rounding is told by the greatest of a kind.
  enum class Kind { length, angle, energy, balance };
  struct Curve {
    std::string name;
    Kind kind;
    int dof;        // -1: held, or an energy
    double factor;  // of its unit
    Thinned<CurvePoint, 1, ValueOf> points;
    bool kept = true;  // false: somebody adds it to others
    double least = std::numeric_limits<double>::infinity(), greatest = -least;

    [[nodiscard]] double range() const {
      return kept ? points.range() : greatest >= least ? greatest - least : 0.0;
    }
    std::array<CurvePoint, 2> before = {
        {{-std::numeric_limits<double>::infinity(), 0.0}, {}}};  // the last two
    bool begun = false;
  };
  void add(Curve& curve, const CurvePoint& point);
  [[nodiscard]] double asked_by(const Curve& curve, const CurvePoint& point);

  const Model& model_;
  double t_end_, last_;
  double asked_ = std::numeric_limits<double>::infinity();
  std::array<double, 4> greatest_{};  // of each kind
  bool wanted_;
  std::function<void(double, const Energy&)> energies_;  // of a part
  std::vector<Curve> curves_;                            // displacements, energies, the balance
};

}  // namespace signorini
