// klu.hpp: sparse LU factors by KLU, for many matrices with the same pattern.
//
//   A x = b        one symbolic analysis of the pattern; factor() chooses pivots; refactor() uses the same pivots again
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace signorini::linear {

// KLU's factors, packed in a format that is faster for many solves.
//
//   R \ (P A Q) = L U + F       R: row scales; P, Q: permutations; L, U: factors of the diagonal blocks, F: entries above them
//   U = D U',  u'_ii = 1        D: pivots, stored as reciprocals, so that a solve contains no division
//
// KLU uses 16 bytes for each entry, divides by pivots and scales, and processes columns in the order of elimination, in which
// most columns depend on the previous one. This format uses 12 bytes, and places independent columns next to each other.
// Solves are more frequent than factorisations: an IDA step needs one solve, a step of the Taylor series thirty.

class TriangularFactors {
 public:
  /// b := A^-1 b; b and work have length size(); work: scratch.
  void solve(double* b, double* work) const;
  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  /// Memory in use, in bytes.
  [[nodiscard]] std::size_t bytes() const;

 private:
  friend class FactorReader;  // defined in linear/klu.cpp
  /// Entries of a triangular factor, column by column in the order of a sweep; those of the i-th column end before end[i].
  struct Columns {
    std::vector<int> column, end, row;  // column[i]: number of the i-th column of the sweep
    std::vector<double> value;
    [[nodiscard]] std::size_t bytes() const;
  };
  static void sweep(const Columns& c, std::size_t begin, std::size_t end, double* x);

  Columns lower_, upper_, off_;               // L, U' and F
  std::vector<int> rows_, columns_, blocks_;  // permutations P and Q; starts of the diagonal blocks
  std::vector<double> inverse_scale_, inverse_pivot_;
};

class Klu {
 public:
  /// Analyses a square pattern in compressed columns; both vectors must outlive the object.
  Klu(const std::vector<std::int64_t>& column_start, const std::vector<std::int64_t>& row);
  ~Klu();
  Klu(const Klu&) = delete;
  Klu& operator=(const Klu&) = delete;

  /// Factors with fresh pivots. False: the matrix is singular to working precision.
  bool factor(const std::vector<double>& values);
  /// Factors with the pivots of the last factorisation, or with fresh pivots if the old ones lose too many digits. False: the
  /// matrix is singular to working precision.
  bool refactor(const std::vector<double>& values);
  /// b := A^-1 b.
  void solve(double* b);
  /// Factors of the last successful factorisation.
  [[nodiscard]] const TriangularFactors& factors() const;

  long factorisations = 0, refactorisations = 0;

 private:
  struct Handles;
  std::unique_ptr<Handles> h_;
  const std::vector<std::int64_t>& column_start_;
  const std::vector<std::int64_t>& row_;
  double fresh_rcond_ = 0.0;  // reciprocal condition of the last factorisation with fresh pivots
};

}  // namespace signorini::linear
