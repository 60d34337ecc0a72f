// sweep_tasks.hpp: the rows of a sweep as tasks for workers: one row each or, if rows continue each other, all rows
// along the last range.
#pragma once

#include <string>
#include <vector>

#include "cli/workers.hpp"
#include "study/sweep/sweep_directory.hpp"

namespace signorini::cli {

class SweepTasks {
 public:
  /// common: settings of all rows. keep: also keep the run of each row. directory: must outlive the object.
  SweepTasks(SweepDirectory& directory, RowTask common, bool keep);

  /// Missing tasks, by the index of their first row.
  [[nodiscard]] const std::vector<std::size_t>& list() const { return list_; }
  [[nodiscard]] std::size_t rows() const { return list_.size() * length_; }

  /// Runs in a worker: computes the rows and sends their lines; the last line is the return value.
  [[nodiscard]] std::string work(std::size_t first, const Tell& tell) const;
  /// Takes the rows of a finished task; rows lost by a crash become rows with that message.
  void take(const WorkerEnd& end);

 private:
  [[nodiscard]] RowTask task(std::size_t index) const;

  SweepDirectory& directory_;
  RowTask common_;
  bool keep_;
  std::size_t length_ = 1;
  std::vector<std::size_t> list_;
};

}  // namespace signorini::cli
