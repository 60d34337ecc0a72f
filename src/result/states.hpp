// states.hpp: whole states of a run, from which another may go on (docs/output.md).
//
//   states.csv   t, displacements of all degrees of freedom, their velocities; motions of supports, their
//                velocities; T and state of contacts with friction
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
  const Model& model_;
  CsvBlock block_;
  CsvFile file_;
  std::vector<const Load*> supports_;  // that move
  double last_ = -1.0;
};

}  // namespace signorini
