// run_directory.hpp: the Recorder that writes a run to disk, and the lock of its directory.
//
//   RunDirectory directory("pipeline-run", scene, model, {.force = false, .command_line = ...});
//   directory.finish(simulate(model, scene.run, directory));
//
// The constructor writes nothing. The directory is created by the first row, by progress() or by finish(), so a run that
// never starts leaves no files. Existing files are never overwritten without `force`. With `force` the directory must
// contain a run; only files that Signorini writes are removed, and never the scene file. From its creation on, the
// directory is locked against other processes of Signorini. A manifest (base/run_files.hpp) is written after all other
// files, and removed before them.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "signorini/certify.hpp"
#include "signorini/scene.hpp"

namespace signorini::result {

// A lock that allows one writer per directory.
//
//   DirectoryLock lock;   if (!lock.take("pipeline-run")) throw FileError(...);
//
// The lock is a system lock (flock). It ends when the object and all child processes that inherited the lock have ended,
// even if they are killed.

class DirectoryLock {
 public:
  DirectoryLock() = default;
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

  /// Takes the lock; returns false if another process has it. Returns true on network file systems without locks. Errors:
  /// FileError if the directory cannot be opened.
  [[nodiscard]] bool take(const std::filesystem::path& directory);

 private:
  int descriptor_ = -1;
};

class PictureTables;

struct RunDirectoryOptions {
  bool force = false;
  std::vector<std::string> command_line;  ///< recorded in summary.json
  bool instants = false;                  ///< also write instants.csv
  bool pictures = true;                   ///< also write motion.csv, curves.csv and body_motion.csv
};

/// Writes a run to its directory. Errors of all members: FileError.
class RunDirectory : public Recorder {
 public:
  /// Scene and model must outlive the directory.
  RunDirectory(std::filesystem::path path, const Scene& scene, const Model& model,
               RunDirectoryOptions options = {});
  ~RunDirectory() override;

  void event(const Event& event) override;
  void sample(const Sample& sample) override;
  void frame(const Sample& sample) override;
  [[nodiscard]] bool wants_motion() const override { return options_.pictures; }
  void motion(int contact, const std::vector<MotionRow>& rows) override;
  void curves(const Curves& curves) override;
  void response(double t, const std::vector<double>& values) override;
  [[nodiscard]] bool wants_instants() const override { return options_.instants; }
  void instant(const InstantRow& row) override;
  bool progress(double t) override;
  /// Writes the final summary.json, then the manifest. Returns the text of summary.json, which has the certificate of a
  /// certified run.
  std::string finish(const Report& report);
  std::string finish(const CertifiedReport& run);
  /// Must be called after a FileError: writes the time and the reason of the stop to summary.json; does nothing if this
  /// fails too.
  void abandon(double t, const std::string& reason);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// True if anything has been written.
  [[nodiscard]] bool started() const { return writers_ != nullptr; }

 private:
  struct Writers;
  /// Writes the complete state, from which another run may continue.
  void write_state(const Sample& sample);
  Writers& writers();
  PictureTables& pictures();
  /// Writes the manifest, after all other files.
  void write_manifest(Outcome::Kind outcome) const;

  std::filesystem::path path_;
  const Scene& scene_;
  const Model& model_;
  RunDirectoryOptions options_;
  DirectoryLock lock_;  // taken when the directory is created
  std::unique_ptr<Writers> writers_;
};

/// Removes the files of a run and no other files; the directory itself stays. summary: also remove summary.json. Errors:
/// FileError.
void remove_run(const std::filesystem::path& path, bool summary = true);

/// Throws FileError unless a run may be written to this path. force: a run that exists there may be replaced.
void check_run_directory(const std::filesystem::path& path, bool force);

}  // namespace signorini::result
