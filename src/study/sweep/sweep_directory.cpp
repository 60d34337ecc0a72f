#include "study/sweep/sweep_directory.hpp"

#include <fmt/core.h>

#include <fstream>
#include <system_error>
#include "base/json.hpp"
#include "base/output_directory.hpp"

#include "base/number.hpp"
#include "base/version.hpp"
#include "result/csv.hpp"
#include "result/run_directory.hpp"
#include "result/units_json.hpp"
#include "study/sweep/strobe_files.hpp"
#include "study/sweep/sweep_plots.hpp"
#include "study/sweep/sweep_table.hpp"

namespace signorini {

namespace fs = std::filesystem;

namespace {

Json spec_json(const SweepSpec& spec) {
  Json json = {{"sweep", 1},
               {"signorini", version},
               {"scene", spec.scene},
               {"fingerprint", spec.fingerprint},
               {"title", spec.title},
               {"units", units_json(spec.units)},
               {"settings", spec.settings}};
  json["vary"] = Json::array();
  for (const Vary& vary : spec.vary)
    json["vary"].push_back({{"path", vary.path},
                            {"text", vary.text},
                            {"values", vary.values},
                            {"group", vary.group},
                            {"sampled", vary.sampled}});
  json["responses"] = spec.responses;
  json["response_units"] = spec.response_units;
  if (!spec.strobe.text.empty()) {
    json["strobe"] = {{"text", spec.strobe.text}, {"period", spec.strobe.period}, {"columns", Json::array()}};
    if (spec.strobe.settle) json["strobe"]["settle"] = *spec.strobe.settle;
    for (const StrobeColumn& column : spec.strobe.columns)
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

std::string text_of(const std::vector<Vary>& varied) {
  std::vector<std::string> list;
  for (const Vary& vary : varied) list.push_back(vary.path + "=" + vary.text);
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
    throw FileError(path.string(), "is not empty and holds no sweep (no sweep.json) to go on with");
}

/// As row_file() and run_directory() number them: six digits, more only where they are needed.
bool is_row_number(const std::string& text) {
  return text.size() >= 6 && text.find_first_not_of("0123456789") == std::string::npos &&
         (text.size() == 6 || text[0] != '0');
}

bool is_row_file(const fs::directory_entry& entry) {
  const fs::path name = entry.path().filename();
  const bool draft = name.extension() == ".part";  // of a sweep that was killed
  const fs::path row = draft ? name.stem() : name;
  return entry.symlink_status().type() == fs::file_type::regular && row.extension() == ".json" &&
         is_row_number(row.stem().string());
}

/// A folder of the sweep's own; what a link leads to is somebody else's.
bool is_own_folder(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::symlink_status(path, error);
  if (!fs::exists(status)) return false;
  if (fs::is_directory(status)) return true;
  throw FileError(path.string(), "is no folder of a sweep; --force removes nothing there");
}

std::vector<fs::path> old_rows(const fs::path& rows) {
  std::vector<fs::path> files;
  if (!is_own_folder(rows)) return files;
  for (const auto& entry : fs::directory_iterator(rows)) {
    if (!is_row_file(entry))
      throw FileError(entry.path().string(), "is no row of a sweep; --force removes nothing beside it");
    files.push_back(entry.path());
  }
  return files;
}

/// Folders with other files than those of a run stay with them.
std::vector<fs::path> old_runs(const fs::path& runs) {
  std::vector<fs::path> folders;
  if (!is_own_folder(runs)) return folders;
  for (const auto& entry : fs::directory_iterator(runs))
    if (entry.symlink_status().type() == fs::file_type::directory &&
        is_row_number(entry.path().filename().string()))
      folders.push_back(entry.path());
  return folders;
}

/// Only what a sweep writes. Looks at everything before it removes anything.
void remove_old(const fs::path& path) {
  std::error_code error;
  std::vector<fs::path> ours = old_rows(path / "rows");
  for (const fs::path& run : old_runs(path / "runs")) {
    remove_run(run);
    if (fs::is_empty(run, error)) ours.push_back(run);
  }
  for (const char* name :
       {"sweep.csv", "results.json", "quantiles.csv", "exceedance.csv", "strobe.csv", "report.html"})
    ours.push_back(path / name);
  for (const fs::path& file : ours) {
    fs::remove(file, error);
    if (error) throw FileError(file.string(), "cannot be removed: " + error.message());
  }
  remove_sweep_plots(path);
}

}  // namespace

SweepDirectory::SweepDirectory(fs::path path, SweepSpec spec, bool force)
    : path_(std::move(path)), spec_(std::move(spec)), points_(signorini::points(spec_.vary)) {
  check_directory(path_);
  make_directory(path_);
  if (!lock_.take(path_)) throw FileError(path_.string(), "another sweep is running in it");
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
  make_directory(path_ / "rows");
  check_rows();
  write_file(path_ / "sweep.json", json_text(spec_json(spec_)));
  read_rows();
}

fs::path SweepDirectory::row_file(std::size_t index) const {
  return path_ / "rows" / fmt::format("{:06}.json", index + 1);
}

fs::path SweepDirectory::run_directory(std::size_t index) const {
  return path_ / "runs" / fmt::format("{:06}", index + 1);
}

void SweepDirectory::check_rows() const {
  for (const auto& entry : fs::directory_iterator(path_ / "rows")) {
    if (!is_row_file(entry)) continue;
    const fs::path& file = entry.path();
    const auto number = parse_integer(file.stem().string());
    if (number && static_cast<std::size_t>(*number) > points_.size())
      throw FileError(file.string(), fmt::format("is no row of this sweep, which has {}", points_.size()));
  }
}

void SweepDirectory::read_rows() {
  std::error_code error;
  for (std::size_t index = 0; index < points_.size(); ++index) {
    if (!spec_.share.holds(index) || !fs::exists(row_file(index), error)) continue;
    take(index);
    if (rows_.at(index).outcome == "crashed") rows_.erase(index);  // another try may fare better
  }
}

void SweepDirectory::take(std::size_t index) { rows_[index] = row_of_sweep(row_file(index), index); }

void SweepDirectory::take(std::size_t index, const std::string& text) { rows_[index] = parse_row(text); }

SweepRow SweepDirectory::row_of_sweep(const fs::path& file, std::size_t index) const {
  SweepRow row = read_row(file);
  const auto& point = points_.at(index);
  bool ours = row.index == index && row.values.size() == point.size();
  for (std::size_t i = 0; ours && i < point.size(); ++i) ours = row.values[i] == point[i].value;
  if (!ours) throw FileError(file.string(), "is not the row of this sweep with that number");
  return row;
}

void SweepDirectory::add(const SweepRow& row) {
  write_file(row_file(row.index), row_text(row));
  rows_[row.index] = row;
}

void SweepDirectory::write_table() const { write_file(path_ / "sweep.csv", sweep_csv(spec_, rows_)); }

void SweepDirectory::write_results() const {
  write_table();
  write_file(path_ / "results.json", sweep_json(spec_, rows_));
  if (!spec_.strobe.text.empty()) write_file(path_ / "strobe.csv", strobe_csv(spec_, rows_));
}

SweepSpec read_sweep_spec(const fs::path& directory) {
  const fs::path file = directory / "sweep.json";
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw FileError(file.string(), "cannot be read; expected the directory of a sweep");
  try {
    const Json json = parse_json(stream);
    SweepSpec spec;
    spec.scene = json.at("scene");
    spec.fingerprint = json.at("fingerprint");
    spec.title = json.at("title");
    spec.units = units_from(json.at("units"));
    spec.settings = json.at("settings").get<std::vector<std::string>>();
    for (const Json& vary : json.at("vary"))
      spec.vary.push_back({vary.at("path"), vary.at("text"),
                           vary.at("values").get<std::vector<std::string>>(), vary.at("group"),
                           vary.at("sampled")});
    spec.responses = json.at("responses").get<std::vector<std::string>>();
    spec.response_units = json.at("response_units").get<std::vector<std::string>>();
    if (const auto found = json.find("strobe"); found != json.end()) {
      spec.strobe = {found->at("text"), found->at("period"), {}, {}};
      if (found->contains("settle")) spec.strobe.settle = found->at("settle").get<double>();
      for (const Json& column : found->at("columns"))
        spec.strobe.columns.push_back({column.at("name"), column.at("unit"), column.at("output")});
    }
    if (const auto found = json.find("carry"); found != json.end()) spec.carry = {true, found->at("back")};
    spec.sampling = json.at("sampling");
    spec.share = parse_share(json.at("share").get<std::string>(),
                             [](const char*) -> std::optional<std::string> { return std::nullopt; });
    const std::string by = json.at("signorini");
    if (by != version)
      throw FileError(file.string(), "was written by Signorini " + by + ", this is " + version);
    return spec;
  } catch (const Json::exception& error) {
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
    return a == b ? "--together was another" : differ("--vary", a, b);
  }
  if (was.responses != is.responses)
    return differ("--response", text_of(was.responses), text_of(is.responses));
  const auto strobe = [](const SweepSpec& s) {
    return (s.strobe.text.empty() ? "(none)" : s.strobe.text) +
           (s.strobe.settle ? " --settle " + shortest(*s.strobe.settle) : "");
  };
  if (strobe(was) != strobe(is)) return differ("--strobe", strobe(was), strobe(is));
  const auto carry = [](const SweepSpec& s) {
    return std::string(!s.carry.on ? "(none)" : s.carry.back ? "there and back" : "there");
  };
  if (was.carry != is.carry) return differ("--carry", carry(was), carry(is));
  if (was.settings != is.settings) return differ("--set", text_of(was.settings), text_of(is.settings));
  if (was.fingerprint != is.fingerprint)
    return fmt::format("the scene {} has another content now ({})", is.scene, was.scene);
  return "";
}

std::vector<std::size_t> merge_sweeps(const std::vector<fs::path>& from, SweepDirectory& to) {
  const std::size_t count = to.points().size();
  for (const fs::path& directory : from) {
    const SweepSpec spec = read_sweep_spec(directory);
    const std::string differs = difference(to.spec(), spec);
    if (!differs.empty()) throw FileError(directory.string(), "is no share of the same sweep: " + differs);
    std::error_code error;
    for (std::size_t index = 0; index < count; ++index) {
      const fs::path file = directory / "rows" / to.row_file(index).filename();
      if (!fs::exists(fs::symlink_status(file, error))) continue;
      const SweepRow row = to.row_of_sweep(file, index);
      if (row.outcome == "crashed") continue;
      const auto known = to.rows().find(index);
      if (known == to.rows().end())
        to.add(row);
      else if (!same_result(known->second, row))
        throw FileError(file.string(), "contradicts another share's row of that number");
    }
  }
  std::vector<std::size_t> missing;
  for (std::size_t index = 0; index < count; ++index)
    if (!to.rows().contains(index)) missing.push_back(index);
  return missing;
}

}  // namespace signorini
