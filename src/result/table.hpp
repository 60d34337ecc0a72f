// table.hpp: a table of results as a list of columns, from which rows are written and column numbers are found.
//
//   const CsvTable<Wave> waves = {{"t", &Wave::t}, {"height", [](const Wave& w) { return w.top - w.bottom; }}};
//   waves.text(list)              header and rows
//   waves.number("height")        2: number of this column for gnuplot, which counts from 1
//
// A column provides a number, an optional number (an empty cell if absent), or a text. number(), value() and word()
// throw std::logic_error for an unknown column.
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

/// Adds a value as a cell of a block: a text by CsvBlock::text(), a number by CsvBlock::number().
template <class Value>
void put_cell(CsvBlock& block, const Value& value) {
  if constexpr (std::convertible_to<Value, std::string_view>)
    block.text(value);
  else
    block.number(static_cast<double>(value));
}
/// Adds a value as a cell of a block; an empty cell for nullopt.
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
    /// cell: a member of Row, or a function of a Row, that gives the value of the cell.
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
  /// Adds a column for which `put` writes the cell of a row, because the type of the cell depends on the row.
  void add_put(std::string name, std::function<void(CsvBlock&, const Row&)> put) {
    columns_.emplace_back(std::move(name), std::move(put), nullptr);
  }

  [[nodiscard]] const std::vector<Column>& columns() const { return columns_; }
  /// Column number for gnuplot, from 1.
  [[nodiscard]] std::size_t number(std::string_view name) const {
    for (std::size_t i = 0; i < columns_.size(); ++i)
      if (columns_[i].name == name) return i + 1;
    throw std::logic_error("the table has no column '" + std::string(name) + "'");
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
  /// Text of a table: header and all rows. Only for short tables, because the text is kept in memory.
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
  /// Buffers the row. The rows are written when the buffer exceeds flush_bytes, or by flush().
  void add(const Row& row) {
    table_.put_row(block_, row);
    if (block_.str().size() > flush_bytes) flush();
  }
  /// Writes all buffered rows to the file.
  void flush() { file_.write(block_); }

 private:
  static constexpr std::size_t flush_bytes = 1 << 16;  // bytes

  CsvTable<Row> table_;
  CsvBlock block_;
  CsvFile file_;
};

}  // namespace signorini::result
