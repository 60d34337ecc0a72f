// table.hpp: a table of results: list of columns, one writer, column numbers by name.
//
//   const CsvTable<Wave> waves = {{"t", &Wave::t}, {"height", [](const Wave& w) { return w.top - w.bottom; }}};
//   waves.text(list)              header and rows
//   waves.number("height")        2: number of this column for gnuplot, which counts from 1
//
// A column provides a number, an optional number (an empty cell if absent), or a text. A request for an
// unknown name is an error of the program, not of a file.
#pragma once

#include <concepts>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "result/csv.hpp"

namespace signorini::result {

/// Puts a value into a block: texts unchanged, numbers by shortest().
template <class Value>
void put_cell(CsvBlock& block, const Value& value) {
  if constexpr (std::convertible_to<Value, std::string_view>)
    block.text(value);
  else
    block.number(static_cast<double>(value));
}
/// Puts an empty cell for nullopt.
template <class Value>
void put_cell(CsvBlock& block, const std::optional<Value>& value) {
  if (value)
    put_cell(block, *value);
  else
    block.empty();
}

template <class Row>
class CsvTable {
 public:
  struct Column {
    /// cell: a member of Row, or a function of it.
    template <class Cell>
    Column(std::string column, Cell cell)
        : name(std::move(column)), put([cell = std::move(cell)](CsvBlock& block, const Row& row) {
            put_cell(block, std::invoke(cell, row));
          }) {}
    Column(std::string column, std::function<void(CsvBlock&, const Row&)> put_in, std::nullptr_t)
        : name(std::move(column)), put(std::move(put_in)) {}
    std::string name;
    std::function<void(CsvBlock&, const Row&)> put;
  };

  CsvTable() = default;
  CsvTable(std::initializer_list<Column> columns) : columns_(columns) {}
  template <class Cell>
  void add(std::string name, Cell cell) {
    columns_.emplace_back(std::move(name), std::move(cell));
  }
  /// Adds a column whose rows put cells of different types.
  void add_put(std::string name, std::function<void(CsvBlock&, const Row&)> put) {
    columns_.emplace_back(std::move(name), std::move(put), nullptr);
  }

  [[nodiscard]] const std::vector<Column>& columns() const { return columns_; }
  /// Column number for gnuplot, from 1.
  [[nodiscard]] std::size_t number(std::string_view name) const {
    for (std::size_t i = 0; i < columns_.size(); ++i)
      if (columns_[i].name == name) return i + 1;
    throw std::logic_error("a table without a column '" + std::string(name) + "'");
  }
  /// "$3": the column's value in gnuplot expressions.
  [[nodiscard]] std::string value(std::string_view name) const { return "$" + std::to_string(number(name)); }
  /// "strcol(3)": the column's text.
  [[nodiscard]] std::string word(std::string_view name) const {
    return "strcol(" + std::to_string(number(name)) + ")";
  }

  void put_header(CsvBlock& block) const {
    for (const Column& column : columns_) block.text(column.name);
    block.end_row();
  }
  void put_row(CsvBlock& block, const Row& row) const {
    for (const Column& column : columns_) column.put(block, row);
    block.end_row();
  }
  /// Text of a whole short table.
  template <class Rows>
  [[nodiscard]] std::string text(const Rows& rows) const {
    CsvBlock block;
    put_header(block);
    for (const Row& row : rows) put_row(block, row);
    return block.str();
  }

 private:
  std::vector<Column> columns_;
};

/// A table that is written during the run. Errors of all members: FileError.
template <class Row>
class TableFile {
 public:
  /// Writes the header.
  TableFile(const std::filesystem::path& path, CsvTable<Row> table) : table_(std::move(table)), file_(path) {
    table_.put_header(block_);
    flush();
  }
  /// Buffers the row until there are enough of them, or until flush().
  void add(const Row& row) {
    table_.put_row(block_, row);
    if (block_.str().size() > flush_bytes) flush();
  }
  /// Passes all rows to the system.
  void flush() { file_.write(block_); }

 private:
  static constexpr std::size_t flush_bytes = 1 << 16;  // bytes

  CsvTable<Row> table_;
  CsvBlock block_;
  CsvFile file_;
};

}  // namespace signorini::result
