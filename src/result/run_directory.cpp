#include "result/run_directory.hpp"

#include <array>
#include <string_view>
#include <system_error>

#include "result/certificate_files.hpp"
#include "result/csv.hpp"
#include "result/frames.hpp"
#include "result/instants.hpp"
#include "result/load_table.hpp"
#include "result/plot_folder.hpp"
#include "result/plots.hpp"
#include "result/states.hpp"
#include "result/summary.hpp"
#include "result/writers.hpp"
#include "signorini/error.hpp"

namespace signorini {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 16> run_files = {
    "events.csv", "history.csv", "errors.csv",   "contacts.csv",       "motion.csv",   "curves.csv",
    "loads.csv",  "energy.csv",  "frames.csv",   "frame_contacts.csv", "summary.json", "run.toml",
    "states.csv", "report.html", "response.csv", "instants.csv"};

/// Replacing the run must not take the scene that is to be computed with it.
void check_scene_is_kept(const fs::path& path, const std::string& scene) {
  std::error_code missing;
  for (const std::string_view name : run_files) {
    if (!fs::equivalent(path / name, scene, missing) || missing) continue;
    throw FileError(path.string(), "--force would replace " + (path / name).string() +
                                       ", the scene of this run; give another directory, or copy the scene");
  }
}

/// Creates a directory; the outermost that had to be created.
fs::path create_path(const fs::path& path) {
  fs::path first;
  std::error_code error;
  for (fs::path p = fs::absolute(path).lexically_normal(); !fs::exists(p, error) && p != p.parent_path();
       p = p.parent_path())
    if (!p.filename().empty()) first = p;
  fs::create_directories(path, error);
  if (error) throw FileError(path.string(), "cannot be created: " + error.message());
  return first;
}

/// Removes the directory and those above it down from `first`, as far as they are empty.
void remove_path(const fs::path& path, const fs::path& first) {
  if (first.empty()) return;
  std::error_code error;
  fs::path p = fs::absolute(path).lexically_normal();
  if (p.filename().empty()) p = p.parent_path();
  for (;; p = p.parent_path()) {
    fs::remove(p, error);
    if (error || p == first) return;
  }
}

}  // namespace

void remove_run(const fs::path& path, bool summary) {
  std::error_code error;
  for (const std::string_view name : run_files) {
    if (!summary && name == "summary.json") continue;
    fs::remove(path / name, error);
    if (error) throw FileError((path / name).string(), "cannot be removed: " + error.message());
    fs::remove(path / (std::string(name) + ".part"), error);
  }
  remove_plots(path);
  clear_plot_folder(path / "paraview", is_paraview);
}

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
  if (!empty && !fs::exists(path / "summary.json", error)) {
    throw FileError(path.string(),
                    "is not empty and holds no run (no summary.json) that --force could replace");
  }
}

struct RunDirectory::Writers {
  Writers(const fs::path& path, const Model& model)
      : events(path / "events.csv", model),
        history(path / "history.csv", model),
        contacts(path / "contacts.csv", model),
        energy(path / "energy.csv") {
    if (!model.outputs.empty()) response.emplace(path / "response.csv", model);
  }

  EventWriter events;
  HistoryWriter history;
  ContactWriter contacts;
  EnergyWriter energy;
  std::optional<ResponseWriter> response;
  std::unique_ptr<FrameWriter> frames;
  std::unique_ptr<StateWriter> states;
  std::unique_ptr<ContactWriter> motion;
  std::unique_ptr<InstantWriter> instants;
};

RunDirectory::RunDirectory(fs::path path, const Scene& scene, const Model& model, RunDirectoryOptions options)
    : path_(std::move(path)), scene_(scene), model_(model), options_(std::move(options)) {
  check_run_directory(path_, options_.force);
  if (options_.force) check_scene_is_kept(path_, scene_.file);
}

RunDirectory::~RunDirectory() = default;

RunDirectory::Writers& RunDirectory::writers() {
  if (writers_) return *writers_;
  check_run_directory(path_, options_.force);  // again: it may have appeared since
  const fs::path created = create_path(path_);
  if (!lock_.take(path_)) throw FileError(path_.string(), "another run is being written to it");
  try {
    // First, and over an earlier one: a folder without it is no run, which --force would not replace.
    write_file(path_ / "summary.json", running_json(scene_, model_, options_.command_line));
    if (options_.force) remove_run(path_, false);
    write_file(path_ / "run.toml", scene_.resolved);
    writers_ = std::make_unique<Writers>(path_, model_);
  } catch (const FileError&) {
    std::error_code ignored;
    for (const std::string_view name : run_files) fs::remove(path_ / name, ignored);
    remove_path(path_, created);
    throw;
  }
  return *writers_;
}

void RunDirectory::event(const Event& event) { writers().events.write(event); }

void RunDirectory::sample(const Sample& sample) {
  Writers& w = writers();
  w.history.write(sample);
  w.contacts.write(sample);
  w.energy.write(sample);
  if (sample.t == scene_.run.t_end) keep_state(sample);
}

void RunDirectory::keep_state(const Sample& sample) {
  Writers& w = writers();
  if (!w.states) w.states = std::make_unique<StateWriter>(path_, model_);
  w.states->write(sample);
}

void RunDirectory::frame(const Sample& sample) {
  Writers& w = writers();
  if (!w.frames) w.frames = std::make_unique<FrameWriter>(path_, model_);
  w.frames->write(sample);
  keep_state(sample);
}

void RunDirectory::motion(int contact, const std::vector<MotionRow>& rows) {
  Writers& w = writers();
  if (!w.motion) w.motion = std::make_unique<ContactWriter>(path_ / "motion.csv", model_);
  w.motion->write(contact, rows);
}

void RunDirectory::curves(const Curves& curves) {
  writers();
  CsvFile file(path_ / "curves.csv");
  CsvBlock block;
  block.text("curve").text("t").text("value").end_row();
  file.write(block);
  for (std::size_t i = 0; i < curves.names.size(); ++i) {
    for (const CurvePoint& point : curves.points[i])
      block.text(curves.names[i]).number(point.t).number(point.value).end_row();
    file.write(block);  // one by one: the text of all takes more memory than the run
  }
}

void RunDirectory::response(double t, const std::vector<double>& values) {
  writers().response->write(t, values);
}

void RunDirectory::instant(const InstantRow& row) {
  Writers& w = writers();
  if (!w.instants) w.instants = std::make_unique<InstantWriter>(path_, model_);
  w.instants->write(row);
}

bool RunDirectory::progress(double /*t*/) {
  writers();
  return true;
}

void RunDirectory::abandon(double t, const std::string& reason) {
  if (!started()) return;
  try {
    write_file(path_ / "summary.json", abandoned_json(scene_, model_, options_.command_line, t, reason));
  } catch (const FileError&) {  // the disk may be full: it still says "running"
  }
}

std::string RunDirectory::finish(const Report& report) { return finish({report, std::nullopt, ""}); }

std::string RunDirectory::finish(const CertifiedReport& run) {
  writers();
  if (run.certificate) write_certificate(path_, model_, *run.certificate);
  if (const std::string loads = load_table(model_, scene_.run.t_end); !loads.empty())
    write_file(path_ / "loads.csv", loads);
  std::string text = summary_json(scene_, model_, run, options_.command_line);
  write_file(path_ / "summary.json", text);
  return text;
}

}  // namespace signorini
