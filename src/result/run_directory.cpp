#include "result/run_directory.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <string_view>
#include <system_error>

#include "base/files.hpp"
#include "base/run_files.hpp"
#include "result/body_frames.hpp"
#include "result/certificate_files.hpp"
#include "result/csv.hpp"
#include "result/frames.hpp"
#include "result/instants.hpp"
#include "result/picture_files.hpp"
#include "result/picture_tables.hpp"
#include "result/plots.hpp"
#include "result/run_tables.hpp"
#include "result/states.hpp"
#include "result/summary.hpp"
#include "scene/saved_state.hpp"
#include "signorini/error.hpp"

namespace signorini::result {

DirectoryLock::~DirectoryLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

bool DirectoryLock::take(const std::filesystem::path& directory) {
  descriptor_ = open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor_ < 0)
    throw FileError(directory.string(), "cannot be opened: " + std::generic_category().message(errno));
  return flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

namespace fs = std::filesystem;

namespace {

/// Files of a run in the order of removal. The manifest is removed first: without it no file is taken as complete.
std::vector<std::string_view> run_files() {
  std::vector<std::string_view> files = {base::manifest_file, "report.html"};
  files.insert(files.end(), base::result_files.begin(), base::result_files.end());
  return files;
}

/// Refuses to replace a run if that would remove the scene file of the new run.
void check_scene_is_kept(const fs::path& path, const std::string& scene) {
  std::error_code missing;
  for (const std::string_view name : run_files()) {
    if (!fs::equivalent(path / name, scene, missing) || missing) continue;
    throw FileError(path.string(), "--force would replace " + (path / name).string() +
                                       ", the scene of this run; give another directory, or copy the scene");
  }
}

}  // namespace

void remove_run(const fs::path& path, bool summary) {
  std::error_code error;
  for (const std::string_view name : run_files()) {
    if (!summary && name == "summary.json") continue;
    fs::remove(path / name, error);
    if (error) throw FileError((path / name).string(), "cannot be removed: " + error.message());
    fs::remove(path / (std::string(name) + ".part"), error);
  }
  remove_plots(path);
  clear_plot_folder(path / "paraview", is_paraview);
}

void check_run_directory(const fs::path& path, bool force) {
  base::check_output_directory(path, {"run", "summary.json"}, force);
}

struct RunDirectory::Writers {
  Writers(const fs::path& path, const Scene& scene, const Model& model, bool for_pictures)
      : events(path / "events.csv", event_table(model)),
        history(path / "history.csv", history_table(model)),
        contacts(path / "contacts.csv", contact_table()),
        energy(path / "energy.csv", energy_table()) {
    if (!model.outputs.empty()) response.emplace(path / "response.csv", response_table(model));
    if (!scene.seams.empty()) seams.emplace(path / "seams.csv", seam_table());
    if (for_pictures && !scene.bodies.empty()) body_motion.emplace(scene, model);
  }

  void add_seams(const Scene& scene, const Sample& sample) {
    for (const SeamSpec& seam : scene.seams) seams->add(seam_row(seam, sample.t, sample.contacts));
    if (seams) seams->flush();
  }

  TableFile<Event> events;
  TableFile<Sample> history;
  TableFile<ContactRow> contacts;
  TableFile<Sample> energy;
  std::optional<TableFile<ResponseRow>> response;
  std::optional<TableFile<SeamRow>> seams;
  std::optional<BodyMotionFile> body_motion;
  std::unique_ptr<FrameWriter> frames;
  std::unique_ptr<BodyFrameWriter> body_frames;
  std::unique_ptr<StateWriter> states;
  std::unique_ptr<PictureTables> pictures;
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
  check_run_directory(path_, options_.force);  // again, because another process may have created it
  const fs::path created = base::make_directory(path_);
  if (!lock_.take(path_))
    throw FileError(path_.string(), "another process is writing a run to this directory");
  try {
    base::remove_manifest(path_);
    // summary.json is written first: a directory without it is no run, and a later --force would refuse to replace the
    // directory.
    write_file(path_ / "summary.json", running_json(scene_, model_, options_.command_line));
    if (options_.force) remove_run(path_, false);
    write_file(path_ / "run.toml", scene_.resolved);
    if (model_.geometric) write_file(path_ / scene::prestress_file, prestress_csv(model_.geometric->forces));
    writers_ = std::make_unique<Writers>(path_, scene_, model_, options_.pictures);
  } catch (const FileError&) {
    std::error_code ignored;
    for (const std::string_view name : run_files()) fs::remove(path_ / name, ignored);
    base::remove_created_directories(path_, created);
    throw;
  }
  return *writers_;
}

void RunDirectory::event(const Event& event) {
  Writers& w = writers();
  w.events.add(event);
  w.events.flush();
}

void RunDirectory::sample(const Sample& sample) {
  Writers& w = writers();
  w.history.add(sample);
  w.history.flush();
  for (std::size_t k = 0; k < sample.contacts.size(); ++k)
    w.contacts.add({sample.t, model_.contacts[k], sample.contacts[k]});
  w.contacts.flush();
  w.add_seams(scene_, sample);
  if (w.body_motion) w.body_motion->add(sample);
  w.energy.add(sample);
  w.energy.flush();
  if (sample.t == scene_.run.t_end) write_state(sample);
}

void RunDirectory::write_state(const Sample& sample) {
  Writers& w = writers();
  if (!w.states) w.states = std::make_unique<StateWriter>(path_, model_);
  w.states->write(sample);
}

void RunDirectory::frame(const Sample& sample) {
  Writers& w = writers();
  if (!w.frames) w.frames = std::make_unique<FrameWriter>(path_, model_);
  w.frames->write(sample);
  if (!scene_.bodies.empty()) {
    if (!w.body_frames) w.body_frames = std::make_unique<BodyFrameWriter>(path_, scene_, model_);
    w.body_frames->write(sample);
  }
  write_state(sample);
}

PictureTables& RunDirectory::pictures() {
  Writers& w = writers();
  if (!w.pictures) w.pictures = std::make_unique<PictureTables>(path_, model_);
  return *w.pictures;
}

void RunDirectory::motion(int contact, const std::vector<MotionRow>& rows) {
  pictures().motion(contact, rows);
}

void RunDirectory::curves(const Curves& curves) { pictures().curves(curves); }

void RunDirectory::response(double t, const std::vector<double>& values) {
  TableFile<ResponseRow>& file = *writers().response;
  file.add({t, values});
  file.flush();
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
    write_manifest(Outcome::Kind::stopped);
  } catch (const FileError&) {  // the disk may be full; summary.json still has the outcome "running"
  }
}

std::string RunDirectory::finish(const Report& report) { return finish({report, std::nullopt, "", {}}); }

std::string RunDirectory::finish(const CertifiedReport& run) {
  if (const Writers& w = writers(); w.body_motion) w.body_motion->write(path_);
  if (run.certificate) write_certificate(path_, model_, *run.certificate);
  if (const std::string loads = load_table(model_, scene_.run.t_end); !loads.empty())
    write_file(path_ / "loads.csv", loads);
  std::string text = summary_json(scene_, model_, run, options_.command_line);
  write_file(path_ / "summary.json", text);
  write_manifest(run.report.outcome.kind);
  return text;
}

void RunDirectory::write_manifest(Outcome::Kind outcome) const {
  write_file(path_ / base::manifest_file, base::manifest_of(path_, to_string(outcome)).text());
}

}  // namespace signorini::result
