#include "study/orbit/branch_files.hpp"

#include "base/json.hpp"
#include "result/units_json.hpp"

namespace signorini {

BranchWriter::BranchWriter(const std::filesystem::path& directory, const std::vector<std::string>& outputs)
    : file_(directory / "branch.csv") {
  for (const char* name : {"parameter", "period", "amplitude"}) block_.text(name);
  for (const std::string& output : outputs) block_.text(output + " minimum").text(output + " maximum");
  for (const char* name : {"max_multiplier", "stable", "loss", "sequence", "events", "special",
                           "multiplier_error", "residual", "branch"})
    block_.text(name);
  block_.end_row();
  file_.write(block_);
}

void BranchWriter::add(const BranchPoint& point) {
  block_.number(point.parameter).number(point.period).number(point.amplitude);
  for (std::size_t i = 0; i < point.minima.size(); ++i)
    block_.number(point.minima[i]).number(point.maxima[i]);
  block_.number(point.max_multiplier);
  block_.text(!point.stable ? "" : *point.stable ? "true" : "false").text(to_string(point.loss));
  block_.number(point.sequence).number(static_cast<double>(point.events)).text(point.special);
  block_.number(point.multiplier_error).number(point.residual).number(point.branch);
  block_.end_row();
  file_.write(block_);
}

std::string branch_json(const BranchOptions& options, const Units& units, const Branch& branch) {
  Json sides = Json::array();
  for (const SideBranch& side : branch.sides)
    sides.push_back({{"branch", side.number},
                     {"from", side.from},
                     {"kind", side.kind},
                     {"parameter", side.parameter},
                     {"complete", side.complete},
                     {"end", side.end}});
  const Json json = {
      {"path", options.path},       {"from", options.from},           {"to", options.to},
      {"units", units_json(units)}, {"points", branch.points.size()}, {"complete", branch.complete},
      {"end", branch.end},          {"sequences", branch.sequences},  {"sides", sides}};
  return json_text(json);
}

}  // namespace signorini
