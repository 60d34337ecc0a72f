#include "study/sweep/sweep_directory.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "base/version.hpp"
#include "result/csv.hpp"
#include "result/run_directory.hpp"
#include "result/units_json.hpp"
#include "study/sweep/sweep_plots.hpp"
#include "study/sweep/sweep_table.hpp"

namespace signorini {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

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
    json["vary"].push_back({{"path", vary.path}, {"text", vary.text}, {"values", vary.values}});
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
  if (!fs::is_directory(path, error)) throw FileError(path.string(), "is there already and is no directory");
  if (!fs::is_empty(path, error) && !is_sweep(path))
    throw FileError(path.string(), "is not empty and holds no sweep (no sweep.json) to go on with");
}

void create(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw FileError(path.string(), "cannot be created: " + error.message());
}

bool is_number(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

/// Only what a sweep writes; a folder that holds other files stays with them.
void remove_old(const fs::path& path) {
  std::error_code error;
  std::vector<fs::path> ours;
  for (const auto& entry : fs::directory_iterator(path / "rows", error))
    if (is_number(entry.path().stem().string())) ours.push_back(entry.path());
  for (const auto& entry : fs::directory_iterator(path / "runs", error)) {
    if (!is_number(entry.path().filename().string())) continue;
    remove_run(entry.path());
    if (fs::is_empty(entry.path(), error)) ours.push_back(entry.path());
  }
  for (const char* name : {"sweep.csv", "results.json"}) ours.push_back(path / name);
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
  create(path_);
  lock();
  if (is_sweep(path_) && !force) {
    const SweepSpec was = read_sweep_spec(path_);
    std::string differs = difference(was, spec_);
    if (differs.empty() && !(was.share == spec_.share))
      differs = "--share was " + was.share.text() + ", is " + spec_.share.text();
    if (!differs.empty())
      throw FileError(path_.string(), "holds another sweep: " + differs +
                                          "; give another directory, or --force to replace that sweep");
  } else if (force) {
    remove_old(path_);
  }
  create(path_ / "rows");
  write_file(path_ / "sweep.json",
             spec_json(spec_).dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  read_rows();
}

SweepDirectory::~SweepDirectory() {
  if (lock_ >= 0) close(lock_);
}

void SweepDirectory::lock() {
  lock_ = open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ < 0)
    throw FileError(path_.string(), "cannot be opened: " + std::generic_category().message(errno));
  // Some network file systems know no locks; there the rows, written whole, are protection enough.
  if (flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    close(lock_);
    lock_ = -1;
    throw FileError(path_.string(), "another sweep is running in it");
  }
}

fs::path SweepDirectory::row_file(std::size_t index) const {
  return path_ / "rows" / fmt::format("{:06}.json", index + 1);
}

fs::path SweepDirectory::run_directory(std::size_t index) const {
  return path_ / "runs" / fmt::format("{:06}", index + 1);
}

void SweepDirectory::read_rows() {
  std::error_code error;
  for (std::size_t index = 0; index < points_.size(); ++index) {
    if (!spec_.share.holds(index) || !fs::exists(row_file(index), error)) continue;
    take(index);
    if (rows_.at(index).outcome == "crashed") rows_.erase(index);  // another try may fare better
  }
}

void SweepDirectory::take(std::size_t index) {
  SweepRow row = read_row(row_file(index));
  const auto& point = points_.at(index);
  bool ours = row.index == index && row.values.size() == point.size();
  for (std::size_t i = 0; ours && i < point.size(); ++i) ours = row.values[i] == point[i].value;
  if (!ours) throw FileError(row_file(index).string(), "is not the row of this sweep with that number");
  rows_[index] = std::move(row);
}

void SweepDirectory::add(const SweepRow& row) {
  write_file(row_file(row.index), row_json(row));
  rows_[row.index] = row;
}

void SweepDirectory::write_table() const { write_file(path_ / "sweep.csv", sweep_csv(spec_, rows_)); }

void SweepDirectory::write_results() const {
  write_table();
  write_file(path_ / "results.json", sweep_json(spec_, rows_));
}

SweepSpec read_sweep_spec(const fs::path& directory) {
  const fs::path file = directory / "sweep.json";
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw FileError(file.string(), "cannot be read; expected the directory of a sweep");
  try {
    const Json json = Json::parse(stream);
    SweepSpec spec;
    spec.scene = json.at("scene");
    spec.fingerprint = json.at("fingerprint");
    spec.title = json.at("title");
    const Json& units = json.at("units");
    spec.units = {units.at("force"), units.at("mass"), units.at("length"), units.at("time")};
    spec.settings = json.at("settings").get<std::vector<std::string>>();
    for (const Json& vary : json.at("vary"))
      spec.vary.push_back(
          {vary.at("path"), vary.at("text"), vary.at("values").get<std::vector<std::string>>()});
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
  if (was.vary != is.vary) return differ("--vary", text_of(was.vary), text_of(is.vary));
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
      if (to.rows().contains(index) || !fs::exists(file, error)) continue;
      const SweepRow row = read_row(file);
      if (row.outcome == "crashed") continue;
      to.add(row);
    }
  }
  std::vector<std::size_t> missing;
  for (std::size_t index = 0; index < count; ++index)
    if (!to.rows().contains(index)) missing.push_back(index);
  return missing;
}

}  // namespace signorini
