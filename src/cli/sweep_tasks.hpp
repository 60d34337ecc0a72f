// sweep_tasks.hpp: the rows of a sweep as tasks for workers: a row each, or, where rows go on from each other, all of them
// along the last range.
#pragma once

#include <string>
#include <vector>

#include "cli/workers.hpp"
#include "study/sweep/sweep_directory.hpp"

namespace signorini::cli {

class SweepTasks {
 public:
  /// common: of all rows. keep: the run of each, too. directory: must outlive it.
  SweepTasks(SweepDirectory& directory, RowTask common, bool keep);

  /// What is missing, by the index of a task's first row.
  [[nodiscard]] const std::vector<std::size_t>& list() const { return list_; }
  [[nodiscard]] std::size_t rows() const { return list_.size() * length_; }

  /// In a worker: computes the rows and tells their lines, the last one's as what it returns.
  [[nodiscard]] std::string work(std::size_t first, const Tell& tell) const;
  /// Takes the rows of a task that has ended; those that a crash has left out become rows that say so.
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
