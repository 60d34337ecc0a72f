// klu.hpp: sparse LU by KLU on one pattern.
//
//   A x = b        symbolic analysis once, factor with fresh pivots, refactor with the pivots kept
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace signorini::linear {

// KLU's factors packed for many solves.
//
//   R \ (P A Q) = L U + F       block upper triangular: L, U on the diagonal blocks, F above them
//   U = D U',  u'_ii = 1        pivots are stored as reciprocals, applied once, not between columns
//
// KLU uses 16 bytes for each entry, and divides by pivots and scales. It processes columns in the order of
// elimination, where most columns depend on the previous one. This format uses 12 bytes, and places
// independent columns next to each other. Solves outnumber factorisations: an IDA step takes one solve, a
// step of the series thirty.

class TriangularFactors {
 public:
  /// b := A^-1 b; both of length size(), work: scratch.
  void solve(double* b, double* work) const;
  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  /// Memory in use.
  [[nodiscard]] std::size_t bytes() const;

 private:
  friend class FactorReader;  // linear/klu.cpp
  /// Entries column after column; those of the i-th column end at end[i].
  struct Columns {
    std::vector<int> column, end, row;  // column: in the order of a sweep
    std::vector<double> value;
    [[nodiscard]] std::size_t bytes() const;
  };
  static void sweep(const Columns& c, std::size_t begin, std::size_t end, double* x);

  Columns lower_, upper_, off_;
  std::vector<int> rows_, columns_, blocks_;  // permutations; beginnings of blocks
  std::vector<double> inverse_scale_, inverse_pivot_;
};

class Klu {
 public:
  /// Analyses a square pattern in compressed columns; both vectors must outlive the object.
  Klu(const std::vector<std::int64_t>& column_start, const std::vector<std::int64_t>& row);
  ~Klu();
  Klu(const Klu&) = delete;
  Klu& operator=(const Klu&) = delete;

  /// Factors with fresh pivots. False: singular to working precision.
  bool factor(const std::vector<double>& values);
  /// Factors with the last pivots; falls back to fresh ones where these have become poor.
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
  double fresh_rcond_ = 0.0;
};

}  // namespace signorini::linear
