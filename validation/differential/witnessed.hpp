// witnessed.hpp: a scene through all engines, each before its witness (src/law_check): correct runs give no alarm.
//
//   exact by series, exact in modes, ida 1e-9 and 1e-6, newmark dt and 8 dt, friction-iteration dt and 8 dt
//
//   for (const Alarm& alarm : before_the_witness(scene, 20000).alarms) print(alarm);
//
// Scenes that an engine refuses are left out; so are accidental stops. What a run broke before it was given up counts.
#pragma once

#include <string>
#include <vector>

#include "signorini/result.hpp"
#include "signorini/scene.hpp"

namespace signorini::differential {

/// The violations of one run by one law.
struct Alarm {
  std::string way, law, contact;
  long count = 0;
  Violation worst;  ///< the one with the greatest value over limit
};

struct Witnessed {
  long runs = 0, checked = 0;  ///< runs that were not refused; instants and stretches of theirs
  std::vector<Alarm> alarms;
};

/// steps: that one run may take.
[[nodiscard]] Witnessed before_the_witness(const Scene& scene, long steps);

}  // namespace signorini::differential
