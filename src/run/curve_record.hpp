// curve_record.hpp: displacements and energies for pictures, bounded, whatever output_dt is.
//
//   t, displacements of named nodes (of each kind as many as a picture shows), energies, balance
//
// Rows are both sides of every instant, and ends and insides of steps as many as a line needs, taken where
// contacts are (motion_record.hpp); thinned in the same way, with the extremes of every column kept.
#pragma once

#include <vector>

#include "signorini/model.hpp"
#include "signorini/result.hpp"

namespace signorini {

class CurveRecord {
 public:
  /// Both must outlive the record. Nothing is kept where the recorder does not want it.
  CurveRecord(const Model& model, double t_end, const Recorder& recorder);

  [[nodiscard]] bool wanted() const { return wanted_; }
  /// Entries of u that rows are made of, where u is the physical one.
  [[nodiscard]] std::vector<int> dofs() const;
  /// Does a line need a row at t, where nothing happens?
  [[nodiscard]] bool needs(double t) const;
  /// Time of the last row; infinite where none is wanted.
  [[nodiscard]] double last() const { return last_; }
  /// u: of the model that is computed. In the scene's units from here on.
  void add(double t, const Vector& u, const Energy& energy);
  void write(Recorder& recorder) const;

 private:
  struct Row {
    double t = 0.0;
    std::vector<double> values;
  };
  void thin();

  const Model& model_;
  double t_end_, last_, width_ = 0.0;
  bool wanted_;
  std::vector<Column> columns_;  // of displacements
  std::vector<double> factors_;  // of their units
  std::size_t most_rows_ = 0;
  std::vector<Row> rows_;
};

}  // namespace signorini
