// motion_record.hpp: motion of the contacts for pictures; the size is bounded for any output_dt.
//
//   rows of a contact: both sides of every instant that affects it, turning points, and as many ends and interior points
//   of steps as a drawn line needs; thinned (base/curves.hpp) by N, T, gap and ut
//
// The row spacing follows from the curvature of the last three rows of all contacts and curves (curve_record.hpp); for
// straight lines it grows by a fifth of the elapsed time.
//
// Thus a short run is drawn completely, and a long run with as many rows as a picture can show. Contacts without a
// picture have fewer rows. An instant affects the contacts whose states change, and the contacts coupled with them by
// M, C, K or other contacts; a jump of the forcing affects all contacts. In a model of a thousand uncoupled bodies, the
// events of one body add no rows to the other bodies.
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

  /// Time of a row inside a step.
  struct RowTime {
    double t = 0.0;
    bool is_turning_point = false;
  };
  /// Sets the current step. Its rows are at its turning points, which ascend, and at the times between them that a drawn
  /// line needs.
  void step(double begin, double end, std::span<const double> turning_points);
  /// The next row time of the step, in ascending order; nullopt after the last one.
  [[nodiscard]] std::optional<RowTime> next();
  /// Sets the row spacing after the row at t: the smaller of the spacings that curves (`asked`) and contacts need.
  void adapt(double t, double asked);
  /// True if the recorder wants motions.
  [[nodiscard]] bool enabled() const { return enabled_; }
  /// True if a drawn line needs a row at t, the end of a step.
  [[nodiscard]] bool needs_row(double t) const;
  /// Adds a row for every contact; successive times do not decrease.
  void add(double t, const Auditor& auditor, const motion::Forcing& forcing,
           const contact::ContactStates& states, const motion::Point& point);
  /// Keeps the values just before an instant; after() adds them for the contacts that the instant affects.
  void before(double t, const Auditor& auditor, const motion::Forcing& forcing,
              const contact::ContactStates& states, const motion::Point& point);
  /// Adds the rows just after an instant. changed: the contacts whose states have changed; nullopt: all.
  void after(double t, const Auditor& auditor, const motion::Forcing& forcing,
             const contact::ContactStates& states, const motion::Point& point,
             const std::optional<std::vector<std::size_t>>& changed);
  /// Last time at which every contact received a row.
  [[nodiscard]] double last() const { return last_; }
  /// Passes all rows to the recorder, contact by contact, and ends the record.
  void write(Recorder& recorder);

 private:
  /// Values of a row by which rows are thinned; the state is one of them, so both sides of a change of state remain.
  struct Drawn {
    std::array<double, 5> operator()(const MotionRow& row) const {
      return {row.sample.N, row.sample.T, row.sample.gap, row.sample.ut,
              static_cast<double>(row.sample.state)};
    }
  };
  struct Track {
    base::Downsampled<MotionRow, 5, Drawn, 4> rows;
    bool drawn = true;     // the contact has a picture
    std::size_t part = 0;  // index of the group of coupled contacts
    MotionRow before = {};
    std::array<MotionRow, 2> last = {};  // rows since the last instant
    int lasts = 0;
  };
  void keep(Track& track, const MotionRow& row);
  [[nodiscard]] double spacing_for_track(Track& track, const MotionRow& row) const;

  double t_end_;
  double spacing_;  // row spacing that drawn lines need
  bool enabled_;
  double last_ = 0.0, adapted_ = 0.0;
  // Least spacing requested since the last call of adapt().
  double requested_spacing_ = std::numeric_limits<double>::infinity();
  // Largest values of all drawn contacts.
  double force_ = 0.0, length_ = 0.0;
  double at_ = 0.0, end_ = 0.0;  // current time and end of the step
  std::vector<double> turns_;
  std::size_t turn_ = 0;  // index of the next turning point
  std::vector<Track> tracks_;
  std::vector<bool> reached_;  // for each group of coupled contacts: the instant affects it
};

}  // namespace signorini::run
