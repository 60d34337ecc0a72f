// motion_record.hpp: the motion of the contacts for pictures, bounded, whatever output_dt is.
//
//   rows: both sides of every instant, turning points, and ends and insides of steps as many as a line needs.
//   Of each bin of width w they are thinned to the first, the last, and those with the least and the greatest
//   N, T, gap and ut;   w = 0 at first, then doubled as often as bins leave too many
//
// So a short run is drawn in full, and of a long one what a picture can show of it, every peak included.
#pragma once

#include <vector>

#include "run/audit.hpp"
#include "signorini/result.hpp"

namespace signorini {

class MotionRecord {
 public:
  /// Both must outlive the record. Nothing is kept where the recorder does not want it.
  MotionRecord(const Model& model, double t_end, const Recorder& recorder);

  /// A time inside of a step.
  struct Moment {
    double t = 0.0;
    bool turns = false;  ///< a turning point
  };
  /// The turning points of a step and as many times between as a line needs; ascending.
  [[nodiscard]] const std::vector<Moment>& moments(double begin, double end,
                                                   const std::vector<double>& turning_points);
  /// Does a line need a row at t, the end of a step?
  [[nodiscard]] bool needs(double t) const;
  /// A row of every contact; times ascend, and may repeat.
  void add(double t, const Auditor& auditor, const Forcing& forcing, const Mode& mode, const Point& point);
  /// Time of the last row.
  [[nodiscard]] double last() const { return last_; }
  /// Hands over all rows, contact by contact.
  void write(Recorder& recorder) const;

 private:
  void thin(std::vector<MotionRow>& rows) const;

  double t_end_;
  double spacing_;      // of rows that nothing but a line needs, at least
  double width_ = 0.0;  // of a bin
  double last_ = 0.0;
  std::vector<Moment> moments_;
  std::size_t most_rows_ = 0;  // of a contact
  std::vector<std::vector<MotionRow>> tracks_;
};

}  // namespace signorini
