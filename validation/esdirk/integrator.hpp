// integrator.hpp: an integrator that goes over one stretch at a time, starting afresh on each.
#pragma once

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "flow.hpp"
#include "stretches.hpp"

namespace signorini::esdirk {

struct Tally {
  long steps = 0, failures = 0;  ///< failures: of the error test and of Newton's method
  long to_order = 0;   ///< IDA: steps before the first one of the highest order that the stretch reaches
  long to_length = 0;  ///< steps up to the first one of half the length of the longest
};

class Integrator {
 public:
  Integrator() = default;
  virtual ~Integrator() = default;
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;
  /// y of length 2 n: the state at the end of the stretch. `through`: steps do not stop there, and y is
  /// interpolated inside the one that passes it, as where an event is found. Errors: std::runtime_error.
  virtual void run(const Stretch& stretch, bool through, std::vector<double>& y, Tally& tally) = 0;
};

/// SUNDIALS' ARKStep with an ESDIRK table of order 3, 4 or 5. linear: one Newton iteration a stage without a
/// test, which is exact on a linear mode.
[[nodiscard]] std::unique_ptr<Integrator> make_esdirk(ModeFlow& flow, int order, bool linear);
/// SUNDIALS' IDA on [u, v, N, T], N and T outside its error norm.
[[nodiscard]] std::unique_ptr<Integrator> make_bdf(ModeFlow& flow);

/// The step that keeps h^q/q! |y^(q)| at 0.4^q of the tolerance, at most the whole stretch; 0 (the
/// integrator's own choice) for motions that are not linear.
[[nodiscard]] double first_step(ModeFlow& flow, const Stretch& stretch, int from_order, int to_order);

/// Tally::to_length of one stretch, from the lengths of its steps.
[[nodiscard]] long steps_to_length(const std::vector<double>& steps);

inline void check(int flag, const char* what) {
  if (flag < 0) throw std::runtime_error(std::string(what) + " failed (" + std::to_string(flag) + ")");
}

}  // namespace signorini::esdirk
