// part_rows.hpp: merges rows of parts that run separately into rows of the whole model.
//
//   events:  ascending in t; at the same time, that of a load first, then in the order of the parts
//   rows:    at a time of the grid u, v and contacts of all parts, energies summed (energy_sum.hpp)
//
//   PartRows rows(whole, parts, t_end, recorder, report);   Loop(part i, ..., rows.of(i));   rows.pass_on(t); ...
//
// All values are in the units of the whole model. A jump of a load is one row, for any number of parts it acts on.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "model/assembly/part_models.hpp"
#include "run/energy_sum.hpp"
#include "run/event_order.hpp"
#include "signorini/result.hpp"

namespace signorini {

/// Rows that a part has recorded and that are not merged yet; contacts have their numbers in the whole model.
class PartRecorder final : public Recorder {
 public:
  struct Row {
    double t = 0.0;
    Vector u, v;
    std::vector<ContactSample> contacts;
    Energy energy;
  };

  PartRecorder(const PartModel& part, bool wants_motion, const std::function<bool()>& progress)
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

  const PartModel& part_;
  bool wants_motion_;
  const std::function<bool()>& progress_;
};

class PartRows {
 public:
  /// All arguments must outlive the object. The report receives events by type, load jumps, and events of unknown
  /// order.
  PartRows(const Model& whole, const std::vector<PartModel>& parts, double t_end, Recorder& recorder,
           Report& report);

  /// Adds a part; called in the order of the parts.
  void add(PartRecorder& recorder) {
    of_.push_back(&recorder);
    energy_lines_.push_back(&recorder.energy_rows);
  }
  /// Passes on rows up to t, and events before it; with `last` also events at t. Returns the number of these events,
  /// including those left out as the same jump of a load.
  std::size_t pass_on(double t, bool last = false);
  /// Ends the merge, after the last event.
  void finish() { order_.finish(); }
  /// Passes on the data of pictures for a run to t, once, from these recorders in the order of the parts.
  void pass_on_motion(double t, const std::vector<PartRecorder*>& from);

 private:
  using Rows = std::deque<PartRecorder::Row> PartRecorder::*;
  std::size_t pass_on_events(double t, bool last);
  void pass_on_rows(double t, Rows rows, void (Recorder::*to)(const Sample&));
  [[nodiscard]] Curves displacements_of(const std::vector<PartRecorder*>& from) const;

  const Model& whole_;
  const std::vector<PartModel>& parts_;
  Recorder& recorder_;
  Report& report_;
  std::vector<PartRecorder*> of_;
  std::vector<EnergyLine*> energy_lines_;
  EnergySum energy_sum_;
  EventOrder order_;
  double jumped_ = -1.0;  // time of the last jump of a load
};

}  // namespace signorini
