// instants.hpp: states on both sides of every instant of a run, so that the run can be checked from files
// alone; and the rounds of its decisions (docs/output.md).
//
//   instants.csv   t, side ("before", "after"), resolution, start, breakpoint, load_jumps, located, forgiven,
//                  dependence (StepFacts::eigenvector_condition);
//                  displacements, velocities and accelerations of all degrees of freedom of the model;
//                  of each contact c: c.state, c.p, c.N, c.T, c.blows, c.capture_n, c.capture_t, c.released
//
// Each instant has two rows, written in one block; the file of a killed run may lack the second row of its last instant.
// Cells without meaning on a side are empty. c.blows: impulses on the contact, "turn:Pn:Pt" separated by blanks; turn is
// the number of the impact, Pn and Pt its impulses along the normal and the tangent. States of user laws are numbers.
// Errors: FileError.
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "result/csv.hpp"
#include "signorini/model.hpp"
#include "signorini/result.hpp"
#include "signorini/trace.hpp"

namespace signorini::result {

inline constexpr const char* instants_file = "instants.csv";

class InstantWriter {
 public:
  InstantWriter(const std::filesystem::path& directory, const Model& model);
  void write(const InstantRow& row);

 private:
  void side(const InstantRow& row, bool after);

  const Model& model_;
  CsvBlock block_;
  CsvFile file_;
};

class InstantReader {
 public:
  /// Opens the file and compares its columns with the model. Errors: FileError if they differ.
  InstantReader(const std::filesystem::path& directory, const Model& model);
  /// The next instant; nullopt at the end of the file.
  [[nodiscard]] std::optional<InstantRow> next();
  /// The reader of the file; its line() is the line read last, or after the end of the file the line after the last row.
  [[nodiscard]] const CsvReader& rows() const { return reader_; }

 private:
  [[noreturn]] void fail(std::size_t column, const std::string& expected) const;
  [[nodiscard]] double number(std::size_t column) const;
  [[nodiscard]] bool flag(std::size_t column) const;
  [[nodiscard]] Vector vector(std::size_t column) const;
  [[nodiscard]] ContactState state(std::size_t contact, std::size_t column) const;
  void take_side(InstantSide& side, bool after) const;
  void take_impulses(std::size_t contact, std::size_t column, InstantRow& row) const;
  [[nodiscard]] std::size_t of_contact(std::size_t contact) const;

  std::filesystem::path path_;
  const Model& model_;
  std::vector<std::string> header_;
  CsvReader reader_;
};

// The rounds of all decisions, one JSON object per line (docs/output.md).
//
//   {"t":0.3,"round":1,"fired":[...],"touching":["A"],"impact":false,
//    "tried":{"A":"slip+","B":"open"},"failed":[{"contact":"A","guard":"slip rate","order":1,"excess":7.5}],
//    "holds":false}
//
// The last round of an instant has "holds": true, unless the run stops there. Errors: FileError.

class TraceWriter {
 public:
  TraceWriter(const std::filesystem::path& path, const Model& model);
  void write(const DecisionRound& round);

 private:
  const Model& model_;
  std::filesystem::path path_;
  std::ofstream file_;
};

}  // namespace signorini::result
