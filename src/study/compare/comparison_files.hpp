// comparison_files.hpp: tables of a comparison of several runs (docs/command-line.md).
//
//   runs.csv         one row per run: outcome, events, cost, audit
//   differences.csv  run,quantity,unit,value,t,where,value_until_split,t_until_split,where_until_split
//   columns.csv      run,column,value,t,value_until_split,t_until_split
//   events.csv       run,t_reference,t,difference,contact,event,from,to,swapped   one row per aligned pair
//   compare.json     the same data except the rows of events.csv
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "result/table.hpp"
#include "study/compare/alignment.hpp"
#include "study/compare/limits.hpp"

namespace signorini::compare {

// Tables of a comparison that its pictures read.
//
//   plots/motion-RUN.csv  t,displacement,velocity     largest difference of any column from the reference at t
//   plots/forces-RUN.csv  t,N,T                       largest difference of any contact from the reference at t
//   events.csv            run,t_reference,t,difference,contact,event,from,to,swapped   one row per aligned pair

/// Row of motion-RUN.csv. Units: length, length/time.
struct MotionDifference {
  double t, displacement, velocity;
};
[[nodiscard]] inline const result::CsvTable<MotionDifference>& motion_difference_table() {
  using D = MotionDifference;
  static const result::CsvTable<D> table = {
      {"t", &D::t}, {"displacement", &D::displacement}, {"velocity", &D::velocity}};
  return table;
}

/// Row of forces-RUN.csv. Unit: force.
struct ForceDifference {
  double t, N, T;
};
[[nodiscard]] inline const result::CsvTable<ForceDifference>& force_difference_table() {
  using D = ForceDifference;
  static const result::CsvTable<D> table = {{"t", &D::t}, {"N", &D::N}, {"T", &D::T}};
  return table;
}

/// An event of the reference and its partner in another run.
struct EventPair {
  const std::string& run;
  const LoggedEvent& reference;
  double t;  ///< time of the event in the other run
  bool swapped;
};
/// Columns of events.csv.
[[nodiscard]] inline const result::CsvTable<EventPair>& event_pair_table() {
  using P = EventPair;
  static const result::CsvTable<P> table = {
      {"run", [](const P& p) { return std::string_view(p.run); }},
      {"t_reference", [](const P& p) { return p.reference.t; }},
      {"t", &P::t},
      {"difference", [](const P& p) { return p.t - p.reference.t; }},
      {"contact", [](const P& p) { return p.reference.contact; }},
      {"event", [](const P& p) { return p.reference.type; }},
      {"from", [](const P& p) { return p.reference.from; }},
      {"to", [](const P& p) { return p.reference.to; }},
      {"swapped", [](const P& p) { return p.swapped ? "true" : "false"; }}};
  return table;
}

struct ComparisonReport {
  std::vector<ComparedRun> runs;        ///< readable runs; the first is the reference
  std::vector<Comparison> comparisons;  ///< runs[1], runs[2], ... compared with the reference
  std::vector<Limit> limits;
  std::vector<std::string> exceeded;  ///< result of exceeded() (limits.hpp)
  /// Engines that refused the scene: name and reason.
  std::vector<std::pair<std::string, std::string>> refused;
};

/// First difference of two sequences as text: "exact has no more events; ida has first slip, stick -> slip+
/// at t = 0.31".
[[nodiscard]] std::string split_text(const ComparedRun& reference, const ComparedRun& other,
                                     const Alignment::Split& split);

/// Text of compare.json.
[[nodiscard]] std::string comparison_json(const ComparisonReport& report);

/// Writes all tables and compare.json into the directory. Errors: FileError.
void write_comparison(const std::filesystem::path& directory, const ComparisonReport& report);

}  // namespace signorini::compare
