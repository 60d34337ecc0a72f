// matrix_market.hpp: matrices from files in the Matrix Market format.
//
//   %%MatrixMarket matrix coordinate|array real|integer general|symmetric
//   % comments
//   rows columns [entries]
//   row column value                 (array: values only, column by column)
//
// https://math.nist.gov/MatrixMarket/formats.html. Both halves of a symmetric matrix are stored. Entries are sorted by
// row, then column; duplicates are added and zeros dropped.
#pragma once

#include <istream>
#include <string>

#include "signorini/scene.hpp"

namespace signorini::scene {

inline constexpr int max_dofs = 1'000'000;

/// Sorts the entries by row, then column; adds duplicates and drops zeros.
void tidy(MatrixSpec& matrix);

/// Reads a matrix. Errors: SceneError at the line of the matrix file; `key` begins the message.
[[nodiscard]] MatrixSpec read_matrix_market(std::istream& in, const std::string& file,
                                            const std::string& key);
/// Values of a matrix with one column. Errors: as read_matrix_market().
[[nodiscard]] std::vector<double> read_market_vector(std::istream& in, const std::string& file,
                                                     const std::string& key);

}  // namespace signorini::scene
