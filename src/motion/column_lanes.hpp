// column_lanes.hpp: two small dense products at once, by columns.
//
//   y_i = sum_j ( a_ij u_j + b_ij factor w_j ),      a, b: rows x columns, one column after the other
//
// Rows are summed four at a time, each in the order of j: the results are bitwise those of the plain loop.
#pragma once

#include <cstddef>

namespace signorini {

void both_products(const double* a, const double* b, std::size_t rows, std::size_t columns, const double* u,
                   const double* w, double factor, double* y);

}  // namespace signorini
