// record_file.hpp: reads files of strong-motion records (record_header.hpp).
#pragma once

#include <optional>

#include "scene/table_lines.hpp"
#include "scene/time_table.hpp"

namespace signorini::scene {

/// Reads a record; nullopt, without advancing, if the file is none. Errors: SceneError at the line of the file.
[[nodiscard]] std::optional<TimeTable> read_record(TableLines& lines, const TableLayout& layout);

/// Adds a row. Errors: SceneError at the current line for too many rows.
void append(const TableLines& lines, double t, double value, TimeTable& table);
/// Adds the words as values at multiples of the time step. Errors: SceneError at a word that is no finite number.
void append_values(const TableLines& lines, const std::vector<TableWord>& words, double time_step,
                   TimeTable& table);

}  // namespace signorini::scene
