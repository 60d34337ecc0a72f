#include "study/prepared_run.hpp"

#include <fmt/core.h>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "base/json.hpp"
#include "base/run_files.hpp"
#include "base/version.hpp"
#include "result/body_frames.hpp"
#include "result/picture_tables.hpp"
#include "signorini/error.hpp"
#include "signorini/simulate.hpp"
#include "study/reduction/find_cutoff.hpp"

namespace signorini::study {
namespace {

PreparedRun built(Scene scene) {
  Model model = build_model(scene);
  return {std::move(scene), std::move(model)};
}

}  // namespace

PreparedRun prepare_run(const std::string& file, const std::vector<Override>& changes,
                        const std::function<bool()>& go_on) {
  return built(reduction::find_cutoff(read_scene(file, changes), go_on));
}

PreparedRun prepare_run(Scene scene, const std::optional<ReductionSpec>& found) {
  return built(reduction::find_cutoff(std::move(scene), found));
}

Report PreparedRun::run_in_memory(Recorder& recorder) const {
  return simulate(model, without_rows(scene.run), recorder);
}

StoredRun PreparedRun::run_to_disk(result::RunDirectory& directory, run::ForwardingRecorder& watch,
                                   const std::optional<CertifyOptions>& certified) const {
  StoredRun kept;
  try {
    if (certified)
      kept.certified = simulate_certified(model, scene.run, watch, *certified);
    else
      kept.certified.report = simulate(model, scene.run, watch);
  } catch (const FileError& error) {
    if (!directory.started()) throw;
    directory.abandon(watch.reached(), error.what());
    throw FileError(error,
                    fmt::format("; the run stopped at t = {:.9g} {}; the results until then are kept in {}",
                                watch.reached(), model.units.time, directory.path().string()));
  }
  kept.summary = directory.finish(kept.certified);
  return kept;
}

RunSpec without_rows(RunSpec run) {
  run.output_dt.reset();
  run.output_times = std::vector<double>{0.0};
  run.frames.clear();
  return run;
}

namespace fs = std::filesystem;

namespace {

bool file_exists(const fs::path& file) {
  std::error_code none;
  return fs::exists(file, none);
}

/// True if the file exists and is complete: the manifest, if there is one, lists only complete files.
bool was_written(const fs::path& directory, const std::optional<base::Manifest>& manifest,
                 std::string_view file) {
  return file_exists(directory / file) && (!manifest || manifest->find(file) != nullptr);
}

/// Collects events and picture data in memory: files are written only if the events equal the stored ones.
class PictureRows final : public Recorder {
 public:
  PictureRows(const PreparedRun& prepared, bool instants, const std::function<bool()>& go_on)
      : table_(result::event_table(prepared.model)),
        instants_(instants),
        go_on_(go_on),
        motions_(prepared.model.contacts.size()) {
    if (!prepared.scene.bodies.empty()) bodies_.emplace(prepared.scene, prepared.model);
    table_.put_header(events_);
  }

  void event(const Event& event) override { table_.put_row(events_, event); }
  void sample(const Sample& sample) override {
    if (bodies_) bodies_->add(sample);
  }
  [[nodiscard]] bool wants_motion() const override { return true; }
  void motion(int contact, const std::vector<MotionRow>& rows) override {
    motions_[static_cast<std::size_t>(contact)] = rows;
  }
  void curves(const Curves& curves) override { curves_ = curves; }
  /// Instants are not used here. They are requested if the stored run has them, because a run that delivers
  /// instants is not split into parts (run/independent_parts.hpp).
  [[nodiscard]] bool wants_instants() const override { return instants_; }
  bool progress(double /*t*/) override { return go_on_(); }

  [[nodiscard]] const std::string& events() const { return events_.str(); }
  void write(const fs::path& directory, const Model& model) const {
    result::PictureTables tables(directory, model);
    for (std::size_t k = 0; k < motions_.size(); ++k) tables.motion(static_cast<int>(k), motions_[k]);
    tables.curves(curves_);
    if (bodies_) bodies_->write(directory);
  }

 private:
  result::CsvTable<Event> table_;
  bool instants_;
  const std::function<bool()>& go_on_;
  result::CsvBlock events_;
  std::vector<std::vector<MotionRow>> motions_;
  Curves curves_;
  std::optional<result::BodyMotionFile> bodies_;
};

/// True if events.csv, `file`, has the rows `events`. Columns that a certificate has appended are ignored.
bool same_events(const std::string& events, const fs::path& file) {
  std::istringstream expected(events);
  std::ifstream found(file, std::ios::binary);
  std::string a, b;
  while (std::getline(expected, a))
    if (!std::getline(found, b) || !(b == a || b.starts_with(a + ","))) return false;
  return !std::getline(found, b);
}

}  // namespace

bool lacks_picture_rows(const fs::path& directory) {
  const std::optional<base::Manifest> manifest = base::read_manifest(directory);
  for (const char* table : {"motion.csv", "curves.csv"})
    if (was_written(directory, manifest, table)) return false;
  std::ifstream stream(directory / "summary.json", std::ios::binary);
  try {
    const base::Json summary = base::parse_json(stream);
    const std::string kind = summary.at("outcome").at("kind");
    // A run that ended because the disk was full would not end at the same time again.
    const bool by_itself = summary.at("outcome").value("exit_code", 0) != static_cast<int>(ExitCode::file);
    return (kind == "done" || kind == "stopped") && by_itself &&
           summary.at("versions").at("signorini") == version;
  } catch (const base::Json::exception&) {
    return false;  // the function that draws the pictures reports the error
  }
}

bool add_picture_rows(const fs::path& directory, const std::function<bool()>& go_on) {
  const PreparedRun prepared = prepare_run((directory / "run.toml").string(), {}, go_on);
  PictureRows rows(prepared, file_exists(directory / "instants.csv"), go_on);
  const Report report = simulate(prepared.model, prepared.scene.run, rows);
  if (report.outcome.kind == Outcome::Kind::interrupted) return false;
  if (!same_events(rows.events(), directory / "events.csv"))
    throw FileError((directory / "events.csv").string(),
                    "the run was computed again for its pictures (it was made with --no-plots), and its "
                    "events differ: the program, or a file that run.toml reads, has changed");
  std::optional<base::Manifest> manifest = base::read_manifest(directory);
  if (manifest) {
    for (const std::string_view table : base::picture_rows) manifest->remove(table);
    result::write_file(directory / base::manifest_file, manifest->text());
  }
  std::error_code ignored;
  for (const std::string_view table : base::picture_rows)
    fs::remove(directory / table, ignored);  // if the path is a named pipe, opening it would block
  rows.write(directory, prepared.model);
  if (manifest) {
    for (const std::string_view table : base::picture_rows) manifest->add(directory, table);
    result::write_file(directory / base::manifest_file, manifest->text());
  }
  return true;
}

}  // namespace signorini::study
