#include "study/sweep/sweep_directory.hpp"

#include <fmt/core.h>

#include <fstream>
#include <system_error>
#include "base/files.hpp"
#include "base/json.hpp"

#include "base/text.hpp"
#include "base/version.hpp"
#include "result/csv.hpp"
#include "result/run_directory.hpp"
#include "result/summary_parts.hpp"
#include "study/sweep/sweep_plots.hpp"
#include "study/sweep/sweep_table.hpp"

namespace signorini::sweep {

namespace fs = std::filesystem;

namespace {

constexpr int format = 2;  // version of the directory format; in the first version each row had a file
constexpr const char* rows_name = "rows.jsonl";

base::Json spec_json(const SweepSpec& spec) {
  base::Json json = {{"sweep", format},          {"signorini", version},
                     {"scene", spec.scene},      {"fingerprint", spec.fingerprint},
                     {"title", spec.title},      {"units", result::units_json(spec.units)},
                     {"settings", spec.settings}};
  json["vary"] = base::Json::array();
  for (const ParameterRange& vary : spec.vary)
    json["vary"].push_back({{"path", vary.path},
                            {"text", vary.text},
                            {"values", vary.values},
                            {"group", vary.group},
                            {"sampled", vary.sampled}});
  json["responses"] = spec.responses;
  json["response_units"] = spec.response_units;
  if (!spec.strobe.text.empty()) {
    json["strobe"] = {
        {"text", spec.strobe.text}, {"period", spec.strobe.period}, {"columns", base::Json::array()}};
    if (spec.strobe.settle) json["strobe"]["settle"] = *spec.strobe.settle;
    for (const StroboscopicColumn& column : spec.strobe.columns)
      json["strobe"]["columns"].push_back(
          {{"name", column.name}, {"unit", column.unit}, {"output", column.output}});
  }
  if (spec.carry.on) json["carry"] = {{"back", spec.carry.back}};
  json["sampling"] = spec.sampling;
  json["share"] = spec.share.text();
  return json;
}

std::string text_of(const std::vector<std::string>& settings) {
  std::string text;
  for (const std::string& setting : settings) text += (text.empty() ? "" : " ") + setting;
  return text.empty() ? "(none)" : text;
}

std::string text_of(const std::vector<ParameterRange>& varied) {
  std::vector<std::string> list;
  for (const ParameterRange& vary : varied) list.push_back(vary.path + "=" + vary.text);
  return text_of(list);
}

bool is_sweep(const fs::path& path) {
  std::error_code error;
  return fs::exists(path / "sweep.json", error);
}

void check_directory(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(path, error))) return;
  if (!fs::is_directory(path, error)) throw FileError(path.string(), "exists and is not a directory");
  if (!fs::is_empty(path, error) && !is_sweep(path))
    throw FileError(
        path.string(),
        "is not empty and has no sweep.json, so it contains no sweep to continue; choose another directory");
}

/// True for numbers as run_directory() writes them: six digits, more only if needed.
bool is_row_number(const std::string& text) {
  return text.size() >= 6 && text.find_first_not_of("0123456789") == std::string::npos &&
         (text.size() == 6 || text[0] != '0');
}

/// True if the folder exists and is not a link; the target of a link is foreign. Errors: FileError.
bool is_own_folder(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::symlink_status(path, error);
  if (!fs::exists(status)) return false;
  if (fs::is_directory(status)) return true;
  throw FileError(path.string(), "was not created by a sweep, so --force removes nothing in it");
}

/// Folders of the runs of an earlier sweep.
std::vector<fs::path> old_runs(const fs::path& runs) {
  std::vector<fs::path> folders;
  if (!is_own_folder(runs)) return folders;
  for (const auto& entry : fs::directory_iterator(runs))
    if (entry.symlink_status().type() == fs::file_type::directory &&
        is_row_number(entry.path().filename().string()))
      folders.push_back(entry.path());
  return folders;
}

/// Removes only files that a sweep writes; a run's folder that contains other files is kept.
void remove_old(const fs::path& path) {
  std::error_code error;
  std::vector<fs::path> ours;
  for (const fs::path& run : old_runs(path / "runs")) {
    result::remove_run(run);
    if (fs::is_empty(run, error)) ours.push_back(run);
  }
  for (const char* name : {rows_name, "sweep.csv", "results.json", "quantiles.csv", "exceedance.csv",
                           "strobe.csv", "report.html"})
    ours.push_back(path / name);
  for (const fs::path& file : ours) {
    fs::remove(file, error);
    if (error) throw FileError(file.string(), "cannot be removed: " + error.message());
  }
  remove_sweep_plots(path);
}

}  // namespace

SweepDirectory::SweepDirectory(fs::path path, SweepSpec spec, bool force)
    : path_(std::move(path)), spec_(std::move(spec)), points_(signorini::sweep::points(spec_.vary)) {
  check_directory(path_);
  base::make_directory(path_);
  if (!lock_.take(path_))
    throw FileError(path_.string(), "is in use: another sweep is running in this directory");
  if (is_sweep(path_) && !force) {
    const SweepSpec was = read_sweep_spec(path_);
    std::string differs = difference(was, spec_);
    if (differs.empty() && !(was.share == spec_.share))
      differs = "--share was " + was.share.text() + ", is " + spec_.share.text();
    if (!differs.empty())
      throw FileError(path_.string(), "contains another sweep: " + differs +
                                          "; choose another directory, or use --force to replace that sweep");
  } else if (force) {
    remove_old(path_);
  }
  for (auto& [index, found] : rows_in(path_ / rows_name)) rows_[index] = std::move(found.row);
  result::write_file(path_ / "sweep.json", base::json_text(spec_json(spec_)));
  file_.emplace(path_ / rows_name);
}

fs::path SweepDirectory::run_directory(std::size_t index) const {
  return path_ / "runs" / fmt::format("{:06}", index + 1);
}

std::map<std::size_t, NumberedRow> SweepDirectory::rows_in(const fs::path& file) const {
  std::map<std::size_t, NumberedRow> rows = read_rows(file);
  for (const auto& [index, found] : rows) {
    const auto wrong = [&](const std::string& what) {
      return FileError(file.string(), fmt::format("line {}: row {} is {}", found.line, index + 1, what));
    };
    if (index >= points_.size())
      throw wrong(fmt::format("not a row of this sweep, which has {} rows", points_.size()));
    if (!spec_.share.holds(index)) throw wrong("not part of share " + spec_.share.text());
    const auto& point = points_[index];
    bool ours = found.row.values.size() == point.size();
    for (std::size_t i = 0; ours && i < point.size(); ++i) ours = found.row.values[i] == point[i].value;
    if (!ours) throw wrong("not from this sweep: its values of the varied keys differ");
  }
  // A crashed row is computed again.
  std::erase_if(rows, [](const auto& entry) { return entry.second.row.outcome == "crashed"; });
  return rows;
}

void SweepDirectory::add(const SweepRow& row) { add(row_line(row)); }

void SweepDirectory::add(const std::string& lines) {
  file_->append(lines);
  for (std::size_t begin = 0, end = 0; begin < lines.size(); begin = end + 1) {
    end = lines.find('\n', begin);
    SweepRow row = parse_row(lines.substr(begin, end - begin));
    const std::size_t index = row.index;
    rows_[index] = std::move(row);
  }
}

void SweepDirectory::write_table() const { result::write_file(path_ / "sweep.csv", sweep_csv(spec_, rows_)); }

void SweepDirectory::write_results() const {
  write_table();
  result::write_file(path_ / "results.json", sweep_json(spec_, rows_));
  if (!spec_.strobe.text.empty()) result::write_file(path_ / "strobe.csv", strobe_csv(spec_, rows_));
}

SweepSpec read_sweep_spec(const fs::path& directory) {
  const fs::path file = directory / "sweep.json";
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw FileError(file.string(), "cannot be read; expected the directory of a sweep");
  try {
    const base::Json json = base::parse_json(stream);
    if (json.at("sweep") != format)
      throw FileError(
          file.string(),
          "was written by an earlier version of Signorini; choose another directory, or use --force");
    SweepSpec spec;
    spec.scene = json.at("scene");
    spec.fingerprint = json.at("fingerprint");
    spec.title = json.at("title");
    spec.units = result::units_from(json.at("units"));
    spec.settings = json.at("settings").get<std::vector<std::string>>();
    for (const base::Json& vary : json.at("vary"))
      spec.vary.push_back({vary.at("path"), vary.at("text"),
                           vary.at("values").get<std::vector<std::string>>(), vary.at("group"),
                           vary.at("sampled")});
    spec.responses = json.at("responses").get<std::vector<std::string>>();
    spec.response_units = json.at("response_units").get<std::vector<std::string>>();
    if (const auto found = json.find("strobe"); found != json.end()) {
      spec.strobe = {found->at("text"), found->at("period"), {}, {}};
      if (found->contains("settle")) spec.strobe.settle = found->at("settle").get<double>();
      for (const base::Json& column : found->at("columns"))
        spec.strobe.columns.push_back({column.at("name"), column.at("unit"), column.at("output")});
    }
    if (const auto found = json.find("carry"); found != json.end()) spec.carry = {true, found->at("back")};
    spec.sampling = json.at("sampling");
    spec.share = parse_share(json.at("share").get<std::string>(),
                             [](const char*) -> std::optional<std::string> { return std::nullopt; });
    const std::string by = json.at("signorini");
    if (by != version)
      throw FileError(file.string(),
                      "was written by Signorini " + by + ", but this program is version " + version);
    return spec;
  } catch (const base::Json::exception& error) {
    throw FileError(file.string(), std::string("is not the specification of a sweep: ") + error.what());
  } catch (const UsageError& error) {
    throw FileError(file.string(), error.what());
  }
}

std::string difference(const SweepSpec& was, const SweepSpec& is) {
  const auto differ = [](const char* what, const std::string& a, const std::string& b) {
    return fmt::format("{} was {}, is {}", what, a, b);
  };
  if (was.sampling != is.sampling) return differ("--sample", was.sampling, is.sampling);
  if (was.vary != is.vary) {
    const std::string a = text_of(was.vary), b = text_of(is.vary);
    return a == b ? "--together was different" : differ("--vary", a, b);
  }
  if (was.responses != is.responses)
    return differ("--response", text_of(was.responses), text_of(is.responses));
  const auto strobe = [](const SweepSpec& s) {
    return (s.strobe.text.empty() ? "(none)" : s.strobe.text) +
           (s.strobe.settle ? " --settle " + base::format_number(*s.strobe.settle) : "");
  };
  if (strobe(was) != strobe(is)) return differ("--strobe", strobe(was), strobe(is));
  const auto carry = [](const SweepSpec& s) {
    return std::string(!s.carry.on ? "(none)" : s.carry.back ? "there and back" : "there");
  };
  if (was.carry != is.carry) return differ("--carry", carry(was), carry(is));
  if (was.settings != is.settings) return differ("--set", text_of(was.settings), text_of(is.settings));
  if (was.fingerprint != is.fingerprint)
    return fmt::format("the content of the scene {} has changed (earlier file: {})", is.scene, was.scene);
  // The rest follows from the scene and the options, unless sweep.json was changed: units, columns, title.
  const base::Json before = spec_json(was), now = spec_json(is);
  for (const auto& [key, value] : now.items())
    if (key != "scene" && key != "share" && before.at(key) != value)
      return differ((key + " in sweep.json").c_str(), base::json_line(before.at(key)),
                    base::json_line(value));
  return "";
}

std::vector<std::size_t> merge_sweeps(const std::vector<fs::path>& from, SweepDirectory& to) {
  const std::size_t count = to.points().size();
  for (const fs::path& directory : from) {
    const SweepSpec spec = read_sweep_spec(directory);
    const std::string differs = difference(to.spec(), spec);
    if (!differs.empty()) throw FileError(directory.string(), "is not a share of the same sweep: " + differs);
    const fs::path file = directory / rows_name;
    for (const auto& [index, found] : to.rows_in(file)) {
      const auto known = to.rows().find(index);
      if (known == to.rows().end())
        to.add(found.row);
      else if (!same_result(known->second, found.row))
        throw FileError(file.string(),
                        fmt::format("line {} differs from row {} of another share", found.line, index + 1));
    }
  }
  std::vector<std::size_t> missing;
  for (std::size_t index = 0; index < count; ++index)
    if (!to.rows().contains(index)) missing.push_back(index);
  return missing;
}

}  // namespace signorini::sweep
