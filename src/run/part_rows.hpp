// part_rows.hpp: merges rows and energies of parts that run separately into those of the whole model.
//
//   events:  ascending in t; at equal times jumps of loads first, then events in the order of the parts
//   rows:    u, v and contacts of all parts at each output time; energies are summed
//
//   PartRows rows(whole, parts, t_end, recorder, report);   rows.add(recorder of part i), for all parts
//   rows.forward(t), each time all parts have reached t; ...   rows.finish();   rows.forward_motion(t, recorders);
//
// All values are in the units of the whole model. A jump of a load is one row, even if the load acts on several parts.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "base/curves.hpp"
#include "model/assembly/parts.hpp"
#include "run/event_log.hpp"
#include "signorini/result.hpp"

namespace signorini {
struct Energy;
}  // namespace signorini

namespace signorini::run {

// Data of the whole model that the run of a part needs.
//
//   rows per contact, points per curve:   limited as in a common run of all parts

/// Share of a part in the data of the whole model; the default is the whole model.
struct PartShare {
  std::size_t parts = 1;
  std::size_t contacts = 0, columns = 0;  ///< numbers of contacts and of drawn columns in the whole model
  std::vector<std::size_t> numbers = {};  ///< for each contact of the part: its index in the whole model
  std::shared_ptr<const std::vector<double>> grid = nullptr;  ///< output times; null: those of the RunSpec
  /// Receives the part's energies at the rows that a picture needs.
  std::function<void(double t, const Energy&)> energies = {};

  [[nodiscard]] bool whole() const { return parts == 1; }
  [[nodiscard]] std::size_t number(std::size_t k) const { return whole() ? k : numbers[k]; }
};

// Energies of parts that run separately, summed for pictures during the run.
//
//   s(t) = sum_i y_i(t)     y_i: linear between the rows of part i; two rows at one time are a jump of y_i and of s
//
// The spacing of a part's rows suits its own energies (curve_record.hpp). The sum is thinned, not its terms, because a
// peak of a sum need not be a peak of a term. Each call of take() restarts the sum, so that the rounding errors of steep
// slopes do not accumulate.

/// All energies in the order of energy_columns, and the balance as the last entry.
using EnergyValues = std::array<double, energy_columns.size() + 1>;
/// The energies as an array.
[[nodiscard]] EnergyValues values_of(const Energy& energy);

/// Energies of a part at one time; the times of successive rows do not decrease.
struct EnergyRow {
  double t = 0.0;
  EnergyValues values{};
};
using EnergyLine = std::deque<EnergyRow>;

class EnergySum {
 public:
  /// Arguments are in the units of `whole`; curves are in the units of its scene. most: largest number of rows per curve.
  EnergySum(const Model& whole, double t_end, std::size_t most);

  /// Adds the lines up to `until`, or to the end of the shortest line, and removes the added rows; one row per line remains
  /// at this time. All lines must begin at the same time.
  void take(const std::vector<EnergyLine*>& lines, double until);
  /// Appends the summed curves to `curves`, and ends the sum.
  void write(Curves& curves);

 private:
  struct ValueOf {
    std::array<double, 1> operator()(const CurvePoint& point) const { return {point.value}; }
  };
  void add(double t, const EnergyValues& values);

  double time_, energy_;  // factors to the scene's units
  std::vector<base::Downsampled<CurvePoint, 1, ValueOf>> curves_;
};

/// Recorder of a part: keeps rows until they are merged. Events contain contact indices of the whole model.
class PartRecorder final : public Recorder {
 public:
  struct Row {
    double t = 0.0;
    Vector u, v;
    std::vector<ContactSample> contacts;
    Energy energy;
  };

  PartRecorder(const assembly::PartModel& part, bool wants_motion, const std::function<bool()>& progress)
      : part_(part), wants_motion_(wants_motion), progress_(progress) {}

  void event(const Event& event) override;
  void sample(const Sample& sample) override { rows.push_back(row_of(sample)); }
  void frame(const Sample& sample) override { frames.push_back(row_of(sample)); }
  [[nodiscard]] bool wants_motion() const override { return wants_motion_; }
  void motion(int contact, const std::vector<MotionRow>& drawn_rows) override;
  void curves(const Curves& curves) override { drawn = curves; }
  bool progress(double /*t*/) override { return progress_(); }

  void energies(double t, const Energy& energy) { energy_rows.push_back({t, values_of(energy)}); }

  std::deque<Event> events;
  std::deque<Row> rows, frames;
  EnergyLine energy_rows;
  std::vector<std::vector<MotionRow>> motions;  ///< one entry per contact of the part
  Curves drawn;

 private:
  [[nodiscard]] static Row row_of(const Sample& sample);

  const assembly::PartModel& part_;
  bool wants_motion_;
  const std::function<bool()>& progress_;
};

class PartRows {
 public:
  /// All arguments must outlive the object. The report receives the number of events by type and of load jumps, and
  /// warnings about events whose order is unknown.
  PartRows(const Model& whole, const std::vector<assembly::PartModel>& parts, double t_end,
           Recorder& recorder, Report& report);

  /// Adds a part; called in the order of the parts.
  void add(PartRecorder& recorder) {
    recorders_.push_back(&recorder);
    energy_lines_.push_back(&recorder.energy_rows);
  }
  /// Forwards rows up to t and events before t; with `last` also events at t. Returns the number of these events; a jump of
  /// a load that several parts recorded is forwarded once, but included several times in this number. If the recorder ends
  /// the run after a row, nothing after this row is forwarded.
  std::size_t forward(double t, bool last = false);
  /// Time of the row after which the recorder ended the run.
  [[nodiscard]] const std::optional<double>& stopped_at() const { return stopped_at_; }
  /// Ends the merge, after the last event.
  void finish() { order_.finish(); }
  /// Forwards the picture data of a run that ended at t. Called once. from: recorders in the order of the parts.
  void forward_motion(double t, const std::vector<PartRecorder*>& from);

 private:
  using Rows = std::deque<PartRecorder::Row> PartRecorder::*;
  std::size_t forward_events(double t, bool last);
  /// True if all parts have a row at a time up to t.
  [[nodiscard]] bool complete(double t, Rows rows) const;
  void forward_row(Rows rows, void (Recorder::*to)(const Sample&));
  [[nodiscard]] Curves displacements_of(const std::vector<PartRecorder*>& from) const;

  const Model& whole_;
  const std::vector<assembly::PartModel>& parts_;
  Recorder& recorder_;
  Report& report_;
  std::vector<PartRecorder*> recorders_;
  std::vector<EnergyLine*> energy_lines_;
  EnergySum energy_sum_;
  EventOrder order_;
  std::optional<double> stopped_at_;
  double last_load_jump_ = -1.0;  // time of the last jump of a load
};

}  // namespace signorini::run
