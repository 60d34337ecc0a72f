// track.hpp: one run, as far as it is compared with others.
//
//   Track t = run(model, spec, {200000, 60.0});
//
// t.events end with the run's own stop, if it stopped early. A stop counts as one more event, of the contact
// "(run)" and with its reason as type: engines must stop at the same place for the same reason, and that is
// checked like any event.
#pragma once

#include <string>
#include <vector>

#include "signorini/result.hpp"
#include "signorini/simulate.hpp"
#include "study/compare/alignment.hpp"

namespace signorini::differential {

/// When a run is given up. Steps are counted, so that a verdict is the same on a slow or a busy machine.
struct Bounds {
  long steps = 1000000;   ///< steps of the engine; an event counts as ten
  double seconds = 60.0;  ///< on the clock, a last resort
};

struct Track {
  enum class End { done, stopped, refused, too_long };
  End end = End::done;
  std::string reason;  ///< without names and numbers, as stops of different runs are compared; empty: done
  std::string said;    ///< the whole sentence
  double t = 0.0;      ///< reached
  long steps = 0;      ///< as counted by Bounds
  std::vector<compare::LoggedEvent> events;
  std::vector<Result::Row> rows;
  Report report;
};

/// Never throws for what the engine refuses. Beyond its bounds the run is given up: too_long.
[[nodiscard]] Track run(const Model& model, const RunSpec& spec, const Bounds& bounds = {});

/// A refusal or a stop without its numbers, names in quotes, and what follows the first of ( : ;
[[nodiscard]] std::string reason_class(const std::string& sentence);

}  // namespace signorini::differential
