#include "result/run_directory.hpp"

#include <array>
#include <string_view>
#include <system_error>

#include "result/csv.hpp"
#include "result/frames.hpp"
#include "result/plots.hpp"
#include "result/summary.hpp"
#include "result/writers.hpp"
#include "signorini/error.hpp"

namespace signorini {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 8> run_files = {"events.csv",   "history.csv", "contacts.csv",
                                                       "energy.csv",   "frames.csv",  "frame_contacts.csv",
                                                       "summary.json", "run.toml"};

void remove_old_run(const fs::path& path) {
  std::error_code error;
  for (const std::string_view name : run_files) {
    fs::remove(path / name, error);
    if (error) throw FileError((path / name).string(), "cannot be removed: " + error.message());
    fs::remove(path / (std::string(name) + ".part"), error);
  }
  remove_plots(path);
}

}  // namespace

void check_run_directory(const fs::path& path, bool force) {
  std::error_code error;
  const fs::file_status status = fs::symlink_status(path, error);
  if (!fs::exists(status)) {
    if (error && error != std::errc::no_such_file_or_directory) {
      throw FileError(path.string(), "cannot be looked at: " + error.message());
    }
    return;
  }
  if (!fs::is_directory(path, error)) throw FileError(path.string(), "is there already and is no directory");
  const bool empty = fs::is_empty(path, error);
  if (error) throw FileError(path.string(), "cannot be looked into: " + error.message());
  if (!empty && !force) {
    throw FileError(path.string(), "is there already and not empty; --force replaces the run in it");
  }
}

struct RunDirectory::Writers {
  Writers(const fs::path& path, const Model& model)
      : events(path / "events.csv", model),
        history(path / "history.csv", model),
        contacts(path / "contacts.csv", model),
        energy(path / "energy.csv") {}

  EventWriter events;
  HistoryWriter history;
  ContactWriter contacts;
  EnergyWriter energy;
  std::unique_ptr<FrameWriter> frames;
};

RunDirectory::RunDirectory(fs::path path, const Scene& scene, const Model& model, RunDirectoryOptions options)
    : path_(std::move(path)), scene_(scene), model_(model), options_(std::move(options)) {
  check_run_directory(path_, options_.force);
}

RunDirectory::~RunDirectory() = default;

RunDirectory::Writers& RunDirectory::writers() {
  if (writers_) return *writers_;
  check_run_directory(path_, options_.force);  // again: it may have appeared since
  std::error_code error;
  fs::create_directories(path_, error);
  if (error) throw FileError(path_.string(), "cannot be created: " + error.message());
  if (options_.force) remove_old_run(path_);
  write_file(path_ / "run.toml", scene_.resolved);
  write_file(path_ / "summary.json", running_json(scene_, model_, options_.command_line));
  writers_ = std::make_unique<Writers>(path_, model_);
  return *writers_;
}

void RunDirectory::event(const Event& event) { writers().events.write(event); }

void RunDirectory::sample(const Sample& sample) {
  Writers& w = writers();
  w.history.write(sample);
  w.contacts.write(sample);
  w.energy.write(sample);
}

void RunDirectory::frame(const Sample& sample) {
  Writers& w = writers();
  if (!w.frames) w.frames = std::make_unique<FrameWriter>(path_, model_);
  w.frames->write(sample);
}

bool RunDirectory::progress(double /*t*/) {
  writers();
  return true;
}

std::string RunDirectory::finish(const Report& report) {
  writers();
  std::string text = summary_json(scene_, model_, report, options_.command_line);
  write_file(path_ / "summary.json", text);
  return text;
}

}  // namespace signorini
