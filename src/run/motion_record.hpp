// motion_record.hpp: the motion of the contacts for pictures, bounded, whatever output_dt is.
//
//   rows of a contact: both sides of every instant that reaches it, turning points, and ends and insides of
//   steps as many as a line needs; thinned (base/thinned.hpp) by N, T, gap and ut
//
// How close rows are follows from how the last three bend (row_spacing.hpp), of contacts and curves together; a distance
// that nothing asks for grows by a fifth of what passes.
//
// So a short run is drawn in full, and of a long one what a picture can show of its rows; of contacts that
// no picture is drawn of by itself, what a number of rows can show. An
// instant reaches the contacts that M, C, K or contacts couple with one that has changed; a jump of the
// forcing reaches all. A thousand bodies have no rows of each other's events.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "base/thinned.hpp"
#include "run/audit.hpp"
#include "run/part_share.hpp"
#include "signorini/result.hpp"

namespace signorini {

class MotionRecord {
 public:
  /// Both must outlive the record. Nothing is kept where the recorder does not want it.
  MotionRecord(const Model& model, double t_end, const Recorder& recorder, const PartShare& share = {});

  /// A time inside of a step.
  struct Moment {
    double t = 0.0;
    bool turns = false;  ///< a turning point
  };
  /// A step: its turning points, ascending, and as many times between as a line needs are its moments.
  void step(double begin, double end, std::span<const double> turning_points);
  /// They ascend; nothing: there is no other.
  [[nodiscard]] std::optional<Moment> next();
  /// At t, the time of the last row: how close rows must be for curves; with those of the contacts it is how close they are.
  void adapt(double t, double asked);
  /// Somebody draws it.
  [[nodiscard]] bool wanted() const { return wanted_; }
  /// Does a line need a row at t, the end of a step?
  [[nodiscard]] bool needs(double t) const;
  /// A row of every contact; times ascend, and may repeat.
  void add(double t, const Auditor& auditor, const Forcing& forcing, const Mode& mode, const Point& point);
  /// The side before an instant, kept when `after` says whom it reaches.
  void before(double t, const Auditor& auditor, const Forcing& forcing, const Mode& mode, const Point& point);
  /// changed: contacts; absent: all.
  void after(double t, const Auditor& auditor, const Forcing& forcing, const Mode& mode, const Point& point,
             const std::optional<std::vector<std::size_t>>& changed);
  /// Time of the last row of all contacts.
  [[nodiscard]] double last() const { return last_; }
  /// Hands over all rows, contact by contact. The record ends.
  void write(Recorder& recorder);

 private:
  /// Both sides of a change of the state are kept, as far as lines go.
  struct Drawn {
    std::array<double, 5> operator()(const MotionRow& row) const {
      return {row.sample.N, row.sample.T, row.sample.gap, row.sample.ut,
              static_cast<double>(row.sample.state)};
    }
  };
  struct Track {
    Thinned<MotionRow, 5, Drawn, 4> rows;
    bool drawn = true;     // a picture of its own
    std::size_t part = 0;  // contacts of other parts do not reach this one
    MotionRow before = {};
    std::array<MotionRow, 2> last = {};  // rows since the last instant
    int lasts = 0;
  };
  void keep(Track& track, const MotionRow& row);
  [[nodiscard]] double asked_by(Track& track, const MotionRow& row) const;

  double t_end_;
  double spacing_;  // of rows that nothing but a line needs
  bool wanted_;
  double last_ = 0.0, adapted_ = 0.0;
  double asked_ = std::numeric_limits<double>::infinity();  // by the rows since the last adapt()
  double force_ = 0.0, length_ = 0.0;                       // greatest of all contacts that are drawn
  double at_ = 0.0, end_ = 0.0;                             // of the step
  std::vector<double> turns_;
  std::size_t turn_ = 0;  // the next of them
  std::vector<Track> tracks_;
  std::vector<bool> reached_;  // parts
};

}  // namespace signorini
