// reference.hpp: runs a reference case of tests/cases and measures how far an engine is from its answer.
//
//   event list complete and in order; |t - t_ref|; |u - u_ref| / max |u_ref|, likewise v, N, T
//
// Events closer than `simultaneous` count as one instant, within which order means nothing.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "signorini/simulate.hpp"

namespace signorini::tests {

struct Table {
  std::map<std::string, std::vector<std::string>> columns;
  std::size_t rows = 0;
  [[nodiscard]] double number(const std::string& column, std::size_t row) const;
  [[nodiscard]] const std::string& text(const std::string& column, std::size_t row) const;
};
[[nodiscard]] Table read_csv(const std::string& path);

struct EventRow {
  double t;
  std::string contact, from, to;
};

struct Comparison {
  std::size_t expected = 0, found = 0, agreeing = 0;  ///< agreeing: events before the first difference
  std::string first_difference;                       ///< empty: complete list in order
  double event_time = 0.0;                            ///< greatest, over the agreeing ones
  double displacement = 0.0, velocity = 0.0, N = 0.0, T = 0.0;  ///< relative to their scale
  Result result;
};

/// Difference of the displacements at t = 0: a motion without stiffness that only friction holds in a static start. The
/// reference holds it at its first contact, the program shares it among the contacts; later motions differ by it, too.
[[nodiscard]] Vector moved_start(const Model& model, const Table& samples, const Result& result);

/// Runs tests/cases/NAME.toml with overrides; compares what has an answer.
[[nodiscard]] Comparison run_case(const std::string& name, const std::vector<Override>& overrides = {});

}  // namespace signorini::tests
