// part_rows.hpp: merges rows and energies of parts that run separately into those of the whole model.
//
//   events:  ascending in t; at equal times jumps of loads come first, then events in the order of the parts
//   rows:    at each time of the grid u, v and contacts of all parts; energies are summed
//
//   PartRows rows(whole, parts, t_end, recorder, report);   Loop(part i, ..., rows.of(i));   rows.forward(t); ...
//
// All values are in the units of the whole model. A jump of a load is one row, for any number of parts it acts on.
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

// Data that a run of a part has in common with the runs of the other parts.
//
//   rows per contact, points per curve:   as if all parts ran together

/// Share of a part in the data of the whole model; the default is the whole model.
struct PartShare {
  std::size_t parts = 1;
  std::size_t contacts = 0, columns = 0;  ///< counts in the whole model; columns: drawn ones
  std::vector<std::size_t> numbers = {};  ///< numbers of its contacts in the whole model
  std::shared_ptr<const std::vector<double>> grid = nullptr;  ///< output times; null: its own
  std::function<void(double t, const Energy&)> energies =
      {};  ///< receives energies as often as a picture needs them

  [[nodiscard]] bool whole() const { return parts == 1; }
  [[nodiscard]] std::size_t number(std::size_t k) const { return whole() ? k : numbers[k]; }
};

// Energies of parts that run separately, summed for pictures during the run.
//
//   s(t) = sum_i y_i(t)     y_i: linear between the rows of part i; two rows at one time are a jump, and a jump of s
//
// The rows of a part are as close as its own energies need (curve_record.hpp). The sum is thinned, not its terms: a
// peak of a sum need not be a peak of a term. Sums restart with every piece, so that rounding of steep slopes does not
// accumulate.

/// All energies in the order of energy_columns, then the balance.
using EnergyValues = std::array<double, energy_columns.size() + 1>;
/// The energies as an array.
[[nodiscard]] EnergyValues values_of(const Energy& energy);

/// Energies at one time, in any units; times of one part ascend.
struct EnergyRow {
  double t = 0.0;
  EnergyValues values{};
};
using EnergyLine = std::deque<EnergyRow>;

class EnergySum {
 public:
  /// Arguments are in the units of `whole`; curves are in those of its scene. most: rows per curve.
  EnergySum(const Model& whole, double t_end, std::size_t most);

  /// Adds the lines up to `until`, or to the end of the shortest line, and removes the added rows except one per line
  /// at that time. All lines begin at the same time.
  void take(const std::vector<EnergyLine*>& lines, double until);
  /// Appends the curves and ends the sum.
  void write(Curves& curves);

 private:
  struct ValueOf {
    std::array<double, 1> operator()(const CurvePoint& point) const { return {point.value}; }
  };
  void add(double t, const EnergyValues& values);

  double time_, energy_;  // units
  std::vector<base::Downsampled<CurvePoint, 1, ValueOf>> curves_;
};

/// Rows that a part has recorded and that are not merged yet; contacts have their numbers in the whole model.
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
  /// All arguments must outlive the object. The report receives events by type, load jumps, and events of unknown
  /// order.
  PartRows(const Model& whole, const std::vector<assembly::PartModel>& parts, double t_end,
           Recorder& recorder, Report& report);

  /// Adds a part; called in the order of the parts.
  void add(PartRecorder& recorder) {
    recorders_.push_back(&recorder);
    energy_lines_.push_back(&recorder.energy_rows);
  }
  /// Passes on rows up to t and events before t, with `last` also events at t. Returns the number of these
  /// events, including those left out because another part has recorded the same jump of a load.
  std::size_t forward(double t, bool last = false);
  /// Ends the merge, after the last event.
  void finish() { order_.finish(); }
  /// Passes on the picture data of a run that ended at t. Called once; `from`: recorders in the order of the
  /// parts.
  void forward_motion(double t, const std::vector<PartRecorder*>& from);

 private:
  using Rows = std::deque<PartRecorder::Row> PartRecorder::*;
  std::size_t forward_events(double t, bool last);
  void forward_rows(double t, Rows rows, void (Recorder::*to)(const Sample&));
  [[nodiscard]] Curves displacements_of(const std::vector<PartRecorder*>& from) const;

  const Model& whole_;
  const std::vector<assembly::PartModel>& parts_;
  Recorder& recorder_;
  Report& report_;
  std::vector<PartRecorder*> recorders_;
  std::vector<EnergyLine*> energy_lines_;
  EnergySum energy_sum_;
  EventOrder order_;
  double last_load_jump_ = -1.0;  // time of the last jump of a load
};

}  // namespace signorini::run
