// klu.hpp: sparse LU by KLU on one pattern.
//
//   A x = b        symbolic analysis once, factor with fresh pivots, refactor with the pivots kept
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "linear/triangular_factors.hpp"

namespace signorini {

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

}  // namespace signorini
