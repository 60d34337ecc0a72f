// states.hpp: complete states of a run, from which another run can continue (docs/output.md).
//
//   states.csv   t, displacements of all degrees of freedom, their velocities; motions of supports, their
//                 velocities; positions p of the sliding points of shear elements, p = slip + motion of the surface;
//                 motions of surfaces; T and state of contacts with friction; state and memory of user laws
//
// One row at each time of run.frames, and one at t_end. scene/saved_state.hpp reads the file. Errors: FileError.
#pragma once

#include <filesystem>
#include <string>

#include "result/csv.hpp"
#include "signorini/model.hpp"
#include "signorini/result.hpp"

namespace signorini::result {

class StateWriter {
 public:
  StateWriter(const std::filesystem::path& directory, const Model& model);
  /// Writes a row; ignores a second sample at the time of the last row.
  void write(const Sample& sample);

 private:
  void write_header();

  const Model& model_;
  // Number of degrees of freedom without sliding points.
  std::size_t structural_ = 0;
  std::vector<std::size_t> sliding_, surfaces_, frictional_, user_laws_;  // indices of contacts
  CsvBlock block_;
  CsvFile file_;
  std::vector<const Load*> supports_;  // loads of moving supports
  double last_ = -1.0;
};

/// Text of geometric.csv (scene/saved_state.hpp).
[[nodiscard]] std::string prestress_csv(const Prestress& forces);

}  // namespace signorini::result
