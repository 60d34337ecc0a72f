// states.hpp: whole states of a run, from which another may go on (docs/output.md).
//
//   states.csv   t, displacements of all degrees of freedom, their velocities; motions of supports, their
//                velocities; places p of the sliding points of shear elements, p = slip + motion of the surface;
//                motions of surfaces; T and state of contacts with friction; state and memory of laws of one's own
//
// One row at each time of run.frames, and one at t_end. Read by scene/saved_state.hpp. Errors: FileError.
#pragma once

#include <filesystem>

#include "result/csv.hpp"
#include "signorini/result.hpp"

namespace signorini {

class StateWriter {
 public:
  StateWriter(const std::filesystem::path& directory, const Model& model);
  /// Once for each time.
  void write(const Sample& sample);

 private:
  void head();

  const Model& model_;
  std::size_t structural_ = 0;                                   // degrees of freedom but sliding points
  std::vector<std::size_t> sliding_, surfaces_, rubbing_, own_;  // contacts
  CsvBlock block_;
  CsvFile file_;
  std::vector<const Load*> supports_;  // that move
  double last_ = -1.0;
};

}  // namespace signorini
