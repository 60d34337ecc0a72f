// coupled.hpp: rigid contacts that move each other: each decision of a run against all that could follow.
//
//   at the start and after events   the accelerations under the run's contact forces are those of the
//                                   only continuation (continuations.hpp)
//   where the run stops for want    the motion just before has none, several, or rows that are dependent;
//   of states                       or its condition is above 1e8
//
//   const CoupledFinding found = examine_coupled(parse_scene(draw_coupled_scene(7), "coupled.toml"));
#pragma once

#include <cstdint>
#include <string>

#include "signorini/scene.hpp"

namespace signorini::differential {

/// One to five rigid contacts on a full mass matrix, with forms at random, or on a chain of beams, in any
/// direction; the same text on every machine.
[[nodiscard]] std::string draw_coupled_scene(std::uint64_t seed);

/// Above this condition a refusal is not called wrong.
inline constexpr double greatest_condition = 1e8;

struct CoupledFinding {
  enum class Verdict {
    agrees,    ///< to the end, or until it was given up
    rightly,   ///< it stops, and what could follow says why
    unclear,   ///< it stops, and what could follow does not say
    refused,   ///< it stops where one motion goes on
    unlike,    ///< it goes on otherwise than the only motion
    broken,    ///< it ends, but not since states are refused: a law is broken, or a step failed
    forbidden  ///< the scene itself is refused
  } verdict = Verdict::agrees;
  std::string cause;   ///< of a stop: its kind, and what could follow
  std::string what;    ///< the first difference, or the run's own sentence
  long instants = 0;   ///< looked at
  long confirmed = 0;  ///< with one continuation, which the run follows
  long as_told = 0;    ///< of these: with speeds below what rounding may have summed up
  long unclear = 0;    ///< several, or within rounding of another, or something nearly touches
  long undecided = 0;  ///< what rounding left open, by the run's own account
  double t = 0.0;      ///< of the difference or the stop
  double worst = 0.0;  ///< difference of accelerations, of their size
};

[[nodiscard]] const char* to_string(CoupledFinding::Verdict verdict);

/// most_instants: events that are looked at.
[[nodiscard]] CoupledFinding examine_coupled(const Scene& scene, std::size_t most_instants = 12);

}  // namespace signorini::differential
