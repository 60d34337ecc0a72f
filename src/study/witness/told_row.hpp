// told_row.hpp: reads the rows of contacts.csv and motion.csv.
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
  /// False for tables of older runs, which lack the column.
  [[nodiscard]] bool has_ratios() const { return ratios_; }
  /// True if a last line without its line break was omitted.
  [[nodiscard]] bool is_cut() const { return reader_.is_cut(); }
  /// Throws a FileError with the line, for a table that ends too early.
  [[noreturn]] void refuse_as_cut(const std::string& lacks) const;

 private:
  [[nodiscard]] double number(std::size_t column) const;

  std::filesystem::path file_;
  ContactNames names_;
  CsvReader reader_;
  bool ratios_ = false;
};

}  // namespace signorini
