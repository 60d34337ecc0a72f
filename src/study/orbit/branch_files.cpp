#include "study/orbit/branch_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "base/json.hpp"
#include "base/number.hpp"
#include "base/output_directory.hpp"
#include "orbit/reader_at.hpp"
#include "result/csv_read.hpp"
#include "result/units_json.hpp"
#include "scene/resolved_keys.hpp"
#include "study/orbit/orbit_files.hpp"

namespace signorini {

namespace fs = std::filesystem;

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

std::vector<BranchPoint> read_branch(const fs::path& directory, std::size_t outputs, std::size_t rows) {
  CsvReader reader(directory / "branch.csv");
  const auto at = [&](const char* name) { return reader.column(name); };
  const std::size_t first_output = at("amplitude") + 1;
  std::vector<BranchPoint> points;
  while (points.size() < rows && reader.next()) {
    BranchPoint p;
    p.parameter = reader.number(at("parameter"));
    p.period = reader.number(at("period"));
    p.amplitude = reader.number(at("amplitude"));
    for (std::size_t i = 0; i < outputs; ++i) {
      p.minima.push_back(reader.number(first_output + 2 * i));
      p.maxima.push_back(reader.number(first_output + 2 * i + 1));
    }
    p.max_multiplier = reader.number(at("max_multiplier"));
    p.multiplier_error = reader.number(at("multiplier_error"));
    p.residual = reader.number(at("residual"));
    if (const std::string& stable = reader.cell(at("stable")); !stable.empty()) p.stable = stable == "true";
    for (const OrbitLoss loss : {OrbitLoss::fold, OrbitLoss::flip, OrbitLoss::neimark_sacker})
      if (reader.cell(at("loss")) == to_string(loss)) p.loss = loss;
    p.sequence = static_cast<int>(reader.number(at("sequence")));
    p.events = static_cast<long>(reader.number(at("events")));
    p.branch = static_cast<int>(reader.number(at("branch")));
    p.special = reader.cell(at("special"));
    points.push_back(std::move(p));
  }
  if (points.size() < rows)
    throw FileError((directory / "branch.csv").string(),
                    fmt::format("has {} rows, expected {} up to the point in last/", points.size(), rows));
  return points;
}

namespace {

fs::path mark_folder(const fs::path& directory) {
  const fs::path last = directory / "last", before = directory / "last.before";
  return !fs::exists(last) && fs::exists(before) ? before : last;
}

/// Identifies a branch: the scene at its beginning, and the options that determine the orbit.
ResolvedKeys owner_of(const SceneReader& read, const BranchOptions& options) {
  ResolvedKeys keys = resolved_keys(branch_reader(read, options.path, options.from)({}));
  const auto given = [](const std::optional<double>& value) { return value ? shortest(*value) : "none"; };
  keys["--times"] = std::to_string(options.orbit.times);
  keys["--period"] = given(options.orbit.period);
  keys["--energy"] = given(options.orbit.energy);
  return keys;
}

Json mark_json(const SceneReader& read, const BranchOptions& options, const BranchMark& mark) {
  return {{"path", options.path},
          {"from", options.from},
          {"to", options.to},
          {"parameter", mark.parameter},
          {"points", mark.points},
          {"towards_to", mark.towards_to},
          {"sequences", mark.sequences},
          {"scene", owner_of(read, options)}};
}

void check_owner(const fs::path& directory, const Json& kept, const SceneReader& read,
                 const BranchOptions& options) {
  constexpr std::size_t most = 3;
  const auto differ = differing_keys(kept.get<ResolvedKeys>(), owner_of(read, options));
  if (differ.empty()) return;
  const std::size_t shown = std::min(most, differ.size());
  std::string text =
      fmt::format("{}", fmt::join(differ.begin(), differ.begin() + static_cast<std::ptrdiff_t>(shown), ", "));
  if (differ.size() > shown) text += fmt::format(", and {} more keys", differ.size() - shown);
  throw UsageError(
      fmt::format("--resume: the branch in {} belongs to another scene, or to other options: {}. "
                  "Resume it with its own, or follow a new branch with --force",
                  directory.string(), text));
}

}  // namespace

void write_mark(const fs::path& directory, const SceneReader& read, const BranchOptions& options,
                const BranchMark& mark) {
  const SceneReader there = branch_reader(read, options.path, mark.parameter);
  const fs::path last = directory / "last", next = directory / "last.next",
                 before = directory / "last.before";
  std::error_code error;
  fs::remove_all(next, error);
  make_directory(next);
  const Scene scene = scene_beginning_in(orbit_scene(there, mark.orbit), last);
  write_orbit(next, scene, build_model(scene), mark.orbit);
  write_file(next / "mark.json", json_text(mark_json(read, options, mark)));
  fs::remove_all(before, error);
  fs::rename(last, before, error);  // there may be none yet
  fs::rename(next, last, error);
  if (error) throw FileError(last.string(), "cannot be written: " + error.message());
  fs::remove_all(before, error);
}

void remove_mark(const fs::path& directory) {
  std::error_code error;
  for (const char* name : {"last", "last.before", "last.next"}) fs::remove_all(directory / name, error);
}

BranchMark read_mark(const fs::path& directory, const SceneReader& read, const BranchOptions& options) {
  const fs::path last = mark_folder(directory);
  BranchMark mark;
  try {
    std::ifstream branch_stream(directory / "branch.json", std::ios::binary);
    if (parse_json(branch_stream).value("complete", false))
      throw UsageError(fmt::format("--resume: the branch in {} is complete", directory.string()));
    std::ifstream stream(last / "mark.json", std::ios::binary);
    std::ifstream orbit_stream(last / "orbit.json", std::ios::binary);
    const Json saved = parse_json(stream);
    if (saved.at("path") != options.path || saved.at("from") != options.from || saved.at("to") != options.to)
      throw UsageError(fmt::format("--resume: {} follows {} from {} to {}", directory.string(),
                                   saved.at("path").get<std::string>(), saved.at("from").get<double>(),
                                   saved.at("to").get<double>()));
    check_owner(directory, saved.at("scene"), read, options);
    mark.parameter = saved.at("parameter");
    mark.towards_to = saved.at("towards_to");
    mark.sequences = saved.at("sequences");
    mark.points = saved.at("points");
    const Json orbit = parse_json(orbit_stream);
    mark.orbit.found = true;
    mark.orbit.period = orbit.at("period");
    mark.orbit.phase = orbit.at("phase");
    mark.orbit.autonomous = orbit.at("autonomous");
  } catch (const Json::exception&) {
    throw FileError(directory.string(), "has no point of a branch to continue from");
  }
  mark.orbit.start = branch_reader(read, options.path, mark.parameter)(
                         {{"run.initial", "{ run = " + Json((last / "start").string()).dump() + " }"}})
                         .initial.saved.value();
  return mark;
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
  Json last;
  if (branch.last) last = {{"parameter", branch.last->parameter}, {"towards_to", branch.last->towards_to}};
  const Json json = {{"path", options.path},
                     {"from", options.from},
                     {"to", options.to},
                     {"units", units_json(units)},
                     {"points", branch.points.size()},
                     {"complete", branch.complete},
                     {"end", branch.end},
                     {"sequences", branch.sequences},
                     {"sides", sides},
                     {"last", last}};
  return json_text(json);
}

}  // namespace signorini
