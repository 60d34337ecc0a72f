// told_row.hpp: rows of contacts.csv and motion.csv, one after the other.
//
//   ToldRowReader reader(directory / "contacts.csv", model);
//   while (const auto row = reader.next()) ...
//
// Errors: FileError with line and column.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "result/csv_read.hpp"
#include "study/witness/told_run.hpp"

namespace signorini {

struct ToldRow {
  double t = 0.0;
  std::size_t contact = 0;
  std::string state;
  std::optional<double> gap, ratio;
  double ut = 0.0, vt = 0.0, slip = 0.0, N = 0.0, T = 0.0;
};

class ToldRowReader {
 public:
  ToldRowReader(const std::filesystem::path& file, const Model& model);

  [[nodiscard]] std::optional<ToldRow> next();
  /// Tables of older runs lack it.
  [[nodiscard]] bool has_ratios() const { return ratios_; }
  /// A last line without its line break was left out.
  [[nodiscard]] bool is_cut() const { return reader_.is_cut(); }
  /// What this table lacks at its end: a FileError that says so, with its line.
  [[noreturn]] void refuse_as_cut(const std::string& lacks) const;

 private:
  [[nodiscard]] double number(std::size_t column) const;

  std::filesystem::path file_;
  ContactNames names_;
  CsvReader reader_;
  bool ratios_ = false;
};

}  // namespace signorini
