// [matrices]: mass, damping and stiffness matrices of any finite-element program, from files or rows.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/text.hpp"
#include "scene/data_file.hpp"
#include "scene/matrix_market.hpp"
#include "scene/readers.hpp"

namespace signorini::scene {

namespace {

// Limit of the rows in run.toml; for a larger matrix run.toml names the file.
constexpr int most_inline_rows = 100;

MatrixSpec from_file(const Table& table, std::string_view key, const std::filesystem::path& path) {
  std::ifstream in = open_data_file(table, key, path);
  return read_matrix_market(in, path.string(), table.path(key));
}

MatrixSpec from_rows(const Table& table, std::string_view key, const toml::array& rows) {
  MatrixSpec matrix;
  matrix.size = static_cast<int>(std::min<std::size_t>(rows.size(), max_dofs));
  if (rows.empty()) table.wrong(key, "at least one row");
  int i = 0;
  for (const toml::node& node : rows) {
    const std::vector<double> row = number_array(node, table.path(key), "a row of numbers");
    if (row.size() != rows.size()) {
      refuse(place_of(node), table.path(key),
             fmt::format("found a row of {} in a matrix of {}, expected a square matrix",
                         base::count_text(row.size(), "number"), base::count_text(rows.size(), "row")));
    }
    for (int j = 0; j < matrix.size; ++j) matrix.entries.push_back({i, j, row[static_cast<std::size_t>(j)]});
    ++i;
  }
  tidy(matrix);
  return matrix;
}

std::string rows_text(const MatrixSpec& matrix) {
  const auto n = static_cast<std::size_t>(matrix.size);
  std::vector<std::vector<double>> rows(n, std::vector<double>(n, 0.0));
  for (const auto& e : matrix.entries)
    rows[static_cast<std::size_t>(e.row)][static_cast<std::size_t>(e.column)] = e.value;
  std::vector<std::string> texts;
  for (const auto& row : rows) texts.push_back(toml_numbers(row));
  return toml_array(texts);
}

MatrixSpec read_matrix(Table& table, std::string_view key, const std::filesystem::path& directory) {
  const toml::node* node = table.raw(key);
  if (!node) table.require(key, "");
  MatrixSpec matrix;
  std::string text;
  if (const auto name = node->value<std::string>()) {
    const std::filesystem::path path = directory / *name;
    matrix = from_file(table, key, path);
    text = toml_string(std::filesystem::absolute(path).lexically_normal().string());
  } else if (node->is_array()) {
    matrix = from_rows(table, key, *node->as_array());
  } else {
    table.wrong(key, describe_type(*find_key("matrices", key)));
  }
  matrix.place = table.place(key);
  table.record(key, matrix.size <= most_inline_rows || text.empty() ? rows_text(matrix) : text);
  return matrix;
}

double matrix_entry(const MatrixSpec& matrix, int row, int column) {
  const auto found =
      std::lower_bound(matrix.entries.begin(), matrix.entries.end(), std::pair(row, column),
                       [](const auto& e, const auto& p) { return std::pair(e.row, e.column) < p; });
  const bool there = found != matrix.entries.end() && found->row == row && found->column == column;
  return there ? found->value : 0.0;
}

/// Refuses a matrix that is not symmetric; the message names the two degrees of freedom.
void check_symmetric(const Table& table, std::string_view key, const MatrixSpec& matrix,
                     const std::vector<std::string>& dofs) {
  double greatest = 0.0;
  for (const auto& e : matrix.entries) greatest = std::max(greatest, std::abs(e.value));
  for (const auto& e : matrix.entries) {
    const double mirrored = matrix_entry(matrix, e.column, e.row);
    if (std::abs(e.value - mirrored) > 1e-10 * greatest) {
      const std::string& a = dofs[static_cast<std::size_t>(e.row)];
      const std::string& b = dofs[static_cast<std::size_t>(e.column)];
      table.fail(key, fmt::format("found {} at ({}, {}) and {} at ({}, {}), expected a symmetric matrix",
                                  base::format_number(e.value), a, b, base::format_number(mirrored), b, a));
    }
  }
}

void check_mass(const Table& table, const MatrixSpec& mass, const std::vector<std::string>& dofs) {
  std::vector<double> diagonal(dofs.size(), 0.0);
  for (const auto& e : mass.entries) {
    if (e.row == e.column) diagonal[static_cast<std::size_t>(e.row)] = e.value;
  }
  for (const auto& e : mass.entries) {
    const auto row = static_cast<std::size_t>(e.row);
    if (diagonal[row] < 0.0 || (diagonal[row] == 0.0 && e.row != e.column)) {
      table.fail("mass",
                 fmt::format("found {} on the diagonal of \"{}\", expected a mass {}",
                             base::format_number(diagonal[row]), dofs[row],
                             diagonal[row] < 0.0 ? ">= 0" : "> 0, because its row has off-diagonal entries"));
    }
  }
}

std::vector<std::string> read_dofs(Table& table, int size) {
  std::vector<std::string> dofs;
  if (table.has("dofs")) {
    dofs = table.texts("dofs");
    std::set<std::string> seen;
    for (const std::string& name : dofs) {
      check_name(name, table.place("dofs"), table.path("dofs"));
      if (!seen.insert(name).second)
        table.fail("dofs", fmt::format("found \"{}\" twice, expected different names", name));
    }
    if (dofs.size() != static_cast<std::size_t>(size)) {
      table.fail("dofs", fmt::format("found {}, expected {}, one for each row of the mass matrix",
                                     base::count_text(dofs.size(), "name"), size));
    }
    return dofs;
  }
  for (int i = 0; i < size; ++i) dofs.push_back(fmt::format("d{}", i));
  table.record("dofs", toml_strings(dofs));
  return dofs;
}

}  // namespace

void read_matrices(Table& top, Scene& scene, ResolvedScene& record) {
  const std::filesystem::path directory = directory_of(scene);
  Table table = top.child("matrices");
  for (const char* other : {"gravity", "nodes", "lines", "members", "masses", "rigid", "springs", "damping",
                            "supports", "sections"}) {
    if (top.has(other)) {
      const auto entries = entries_of(top.node());
      const auto entry =
          std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.name == other; });
      refuse(entry->place(), other, "cannot be combined with [matrices]; give only one of them");
    }
  }
  MatricesSpec matrices;
  matrices.mass = read_matrix(table, "mass", directory);
  matrices.dofs = read_dofs(table, matrices.mass.size);
  if (table.has("damping")) {
    matrices.damping = read_matrix(table, "damping", directory);
  } else {
    matrices.damping.size = matrices.mass.size;
    matrices.damping.place = table.place();
  }
  matrices.stiffness = read_matrix(table, "stiffness", directory);
  table.finish();
  const std::pair<const char*, const MatrixSpec*> all[] = {
      {"mass", &matrices.mass}, {"damping", &matrices.damping}, {"stiffness", &matrices.stiffness}};
  for (const auto& [key, matrix] : all) {
    if (matrix->size != matrices.mass.size) {
      table.fail(key, fmt::format("found {}, expected {} as in the mass matrix",
                                  base::count_text(static_cast<std::size_t>(matrix->size), "row"),
                                  matrices.mass.size));
    }
    check_symmetric(table, key, *matrix, matrices.dofs);
  }
  check_mass(table, matrices.mass, matrices.dofs);
  scene.matrices = std::move(matrices);
  record.add("matrices", "[matrices]", table.record());
}

}  // namespace signorini::scene
