// motion_record.hpp: motion of the contacts for pictures, of bounded size for any output_dt.
//
//   rows of a contact: both sides of every instant that reaches it, turning points, and ends and interior points of
//   steps as needed for a line; thinned (base/curves.hpp) by N, T, gap and ut
//
// The spacing of rows follows from the bends of the last three rows, of contacts and curves together; without
// bends it grows by a fifth of the time passed.
//
// So a short run is drawn completely, and a long one with the rows that a picture can show; contacts without
// a picture of their own have fewer rows. An instant reaches the contacts that have changed, and those that
// M, C, K or other contacts couple with them; a jump of the forcing reaches all. In a model of a thousand
// uncoupled bodies no body has rows of another body's events.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "base/curves.hpp"
#include "run/audit.hpp"
#include "run/part_rows.hpp"
#include "signorini/result.hpp"

namespace signorini::run {

class MotionRecord {
 public:
  /// Model and recorder must outlive the object. No data are kept if the recorder does not want motions.
  MotionRecord(const Model& model, double t_end, const Recorder& recorder, const PartShare& share = {});

  /// A time inside a step.
  struct RowTime {
    double t = 0.0;
    bool is_turning_point = false;
  };
  /// Sets a step. Its rows are at its turning points, which ascend, and at times between that a line needs.
  void step(double begin, double end, std::span<const double> turning_points);
  /// The next row time of the step, in ascending order; nullopt after the last one.
  [[nodiscard]] std::optional<RowTime> next();
  /// Sets the row spacing after the last row, at t, from those that curves (`asked`) and contacts need.
  void adapt(double t, double asked);
  /// True if the motion is drawn.
  [[nodiscard]] bool enabled() const { return enabled_; }
  /// True if a line needs a row at t, the end of a step.
  [[nodiscard]] bool needs_row(double t) const;
  /// Adds a row of every contact; times ascend, and may repeat.
  void add(double t, const Auditor& auditor, const motion::Forcing& forcing,
           const contact::ContactStates& states, const motion::Point& point);
  /// Keeps the side before an instant; `after` adds it for the contacts that the instant reaches.
  void before(double t, const Auditor& auditor, const motion::Forcing& forcing,
              const contact::ContactStates& states, const motion::Point& point);
  /// Adds the rows after an instant. changed: the contacts that have changed; absent: all.
  void after(double t, const Auditor& auditor, const motion::Forcing& forcing,
             const contact::ContactStates& states, const motion::Point& point,
             const std::optional<std::vector<std::size_t>>& changed);
  /// Time of the last row of all contacts.
  [[nodiscard]] double last() const { return last_; }
  /// Passes all rows to the recorder, contact by contact, and ends the record.
  void write(Recorder& recorder);

 private:
  /// Values that determine the thinning; both sides of a change of state are kept.
  struct Drawn {
    std::array<double, 5> operator()(const MotionRow& row) const {
      return {row.sample.N, row.sample.T, row.sample.gap, row.sample.ut,
              static_cast<double>(row.sample.state)};
    }
  };
  struct Track {
    base::Downsampled<MotionRow, 5, Drawn, 4> rows;
    bool drawn = true;     // has a picture of its own
    std::size_t part = 0;  // contacts of other parts do not affect this one
    MotionRow before = {};
    std::array<MotionRow, 2> last = {};  // rows since the last instant
    int lasts = 0;
  };
  void keep(Track& track, const MotionRow& row);
  [[nodiscard]] double spacing_for_track(Track& track, const MotionRow& row) const;

  double t_end_;
  double spacing_;  // spacing of rows that only a line needs
  bool enabled_;
  double last_ = 0.0, adapted_ = 0.0;
  double requested_spacing_ = std::numeric_limits<double>::infinity();  // by the rows since the last adapt()
  double force_ = 0.0, length_ = 0.0;                                   // largest of all drawn contacts
  double at_ = 0.0, end_ = 0.0;                                         // of the step
  std::vector<double> turns_;
  std::size_t turn_ = 0;  // index of the next turning point
  std::vector<Track> tracks_;
  std::vector<bool> reached_;  // by part
};

}  // namespace signorini::run
