// seen_run.hpp: all that a run says, as far as two runs are compared: a table and lists, by names.
//
//   SeenRun a = see(scene, bounds);           certified: events with t_error, and until when they are certain
//   SeenRun b = see_plainly(scene, bounds);   the same without a companion
//
// Columns: N, T, gap and slip of contacts, outputs, stored energy, losses, works.
#pragma once

#include <string>
#include <vector>

#include "differential/track.hpp"
#include "run/fault_injector.hpp"
#include "signorini/certify.hpp"
#include "signorini/scene.hpp"

namespace signorini::differential {

struct SeenColumn {
  enum class Of { force, gap, slip, output, stored, spent };
  std::string name;
  Of of = Of::output;
  Unit unit;
  std::string contact = {};  ///< whose it is; or of an output the contact's
  bool jumps = true;         ///< at events: all but displacements and energies
  bool sums = false;         ///< since t = 0
};

struct SeenRun {
  Track::End end = Track::End::done;
  std::string reason, said;                  ///< as of Track
  bool open_start = false;                   ///< its start says what the data leave open
  bool shared = false;                       ///< it says that friction forces on one motion are not unique
  double t = 0.0;                            ///< reached
  double until = 0.0;                        ///< certain until then; not certified: t
  std::vector<compare::LoggedEvent> events;  ///< uncertainty: t_error; not a number where it is not certain
  std::vector<double> instants;              ///< at which loads or surfaces change, whatever contacts do
  std::vector<SeenColumn> columns;
  struct Row {
    double t = 0.0;
    std::vector<double> values;
  };
  std::vector<Row> rows;
  std::vector<std::string> outputs;
  std::vector<OutputExtremes> extremes;  ///< one an output
  std::vector<std::string> contacts;
  std::vector<Peak> peaks;                       ///< one a contact
  std::vector<std::optional<Peak>> peak_bounds;  ///< of a certified run
};

[[nodiscard]] SeenRun see(const Scene& scene, const Bounds& bounds);
[[nodiscard]] SeenRun see_plainly(const Scene& scene, const Bounds& bounds);
/// Without a companion, with errors that a test plants.
[[nodiscard]] SeenRun see_injected(const Scene& scene, const Bounds& bounds, run::FaultInjector& faults);

}  // namespace signorini::differential
