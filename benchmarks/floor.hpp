// floor.hpp: what a step of IDA costs when the problem costs nothing.
//
//   0 = y_i' - cos t,  i = 1..n      J = cj I
//
// Same length of vectors, same vector implementation, same kind of error weights and as many root functions
// as an engine with that many unknowns; a diagonal solver, and a residual that only reads and writes.
#pragma once

#include <sundials/sundials_types.h>

#include <memory>

namespace signorini::benchmarks {

class Floor {
 public:
  /// packaged: SUNDIALS' own serial vector instead of the project's.
  Floor(sunindextype unknowns, int roots, double rtol, bool packaged = false);
  ~Floor();
  Floor(const Floor&) = delete;
  Floor& operator=(const Floor&) = delete;
  void steps(long count);
  /// Mean order of all steps so far.
  [[nodiscard]] double order() const;

 private:
  struct Memory;
  std::unique_ptr<Memory> m_;
};

}  // namespace signorini::benchmarks
