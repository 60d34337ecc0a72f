// trace_writer.hpp: the rounds of all decisions, one JSON object per line (docs/output.md).
//
//   {"t":0.3,"round":1,"fired":[...],"touching":["A"],"impact":false,
//    "tried":{"A":"slip+","B":"open"},"failed":[{"contact":"A","guard":"slip rate","order":1,"excess":7.5}],
//    "holds":false}
//
// The last round of an instant holds, unless the run stops there. Errors: FileError.
#pragma once

#include <filesystem>
#include <fstream>

#include "signorini/model.hpp"
#include "signorini/trace.hpp"

namespace signorini {

class TraceWriter {
 public:
  TraceWriter(const std::filesystem::path& path, const Model& model);
  void write(const Round& round);

 private:
  const Model& model_;
  std::filesystem::path path_;
  std::ofstream file_;
};

}  // namespace signorini
