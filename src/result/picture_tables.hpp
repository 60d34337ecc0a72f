// picture_tables.hpp: motion.csv, curves.csv and loads.csv, the data of pictures and of the page.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "result/run_tables.hpp"
#include "signorini/model.hpp"

namespace signorini::result {

/// Writes motion.csv and curves.csv. Errors of all members: FileError.
class PictureTables {
 public:
  /// The directory must exist. The model must outlive the tables.
  PictureTables(std::filesystem::path directory, const Model& model)
      : directory_(std::move(directory)), model_(model) {}

  /// Take the data of Recorder::motion, which is called once for each contact, and of Recorder::curves, called once.
  void motion(int contact, const std::vector<MotionRow>& rows);
  void curves(const Curves& curves);

 private:
  std::filesystem::path directory_;
  const Model& model_;
  std::unique_ptr<TableFile<ContactRow>> motion_;
};

// Loads over time, as a table for pictures (docs/output.md).
//
//   loads.csv  t,NAME,...   f_i(t) of every load that is not constant, amplitude included,
//                           and the acceleration of the base; both sides of breakpoints

/// Text of loads.csv from 0 to t_end; empty if no load varies.
[[nodiscard]] std::string load_table(const Model& model, double t_end);

}  // namespace signorini::result
