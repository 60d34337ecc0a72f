#include "fuzz/targets.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "result/plots.hpp"
#include "scene/matrix_market.hpp"
#include "scene/time_table.hpp"
#include "signorini/error.hpp"
#include "study/check/check.hpp"
#include "study/sweep/parameter_range.hpp"
#include "study/sweep/sweep_directory.hpp"

namespace signorini::fuzz {
namespace {

namespace fs = std::filesystem;

/// What takes long because it is large is no finding.
bool is_small(const Scene& scene) {
  constexpr int most_elements = 60;
  constexpr std::size_t most = 20;
  constexpr double most_rows = 1e5;
  int elements = 0;
  for (const Member& member : scene.members)
    for (const int n : member.elements) {
      if (n > most_elements) return false;
      elements += n;
    }
  const double rows = scene.run.output_dt ? scene.run.t_end / *scene.run.output_dt : 0.0;
  return elements <= most_elements && scene.contacts.size() <= most && scene.masses.size() <= most &&
         (!scene.matrices || scene.matrices->mass.size <= static_cast<int>(most)) && rows <= most_rows;
}

void build_and_check(const Scene& scene) {
  if (is_small(scene)) (void)check::check(scene, build_model(scene));
}

/// A directory of its own, gone with its owner.
class Folder {
 public:
  Folder() {
    std::string pattern = (fs::temp_directory_path() / "signorini-fuzz-XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// Only names that a run or a sweep has.
bool is_known(const std::string& name) {
  for (const char* known :
       {"events.csv", "history.csv", "contacts.csv", "energy.csv", "frames.csv", "motion.csv", "curves.csv",
        "loads.csv", "frame_contacts.csv", "summary.json", "sweep.json", "rows.jsonl"})
    if (name == known) return true;
  return false;
}

void unpack(std::string_view bytes, const fs::path& folder) {
  fs::create_directories(folder);
  std::istringstream in{std::string(bytes)};
  std::ofstream file;
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("==> ")) {
      if (file.is_open()) file << line << (in.eof() ? "" : "\n");
      continue;
    }
    file.close();
    if (const std::string name = line.substr(4); is_known(name)) file.open(folder / name, std::ios::binary);
  }
}

template <class Work>
void tolerate_errors(const Work& work) {
  try {
    work();
  } catch (const Error&) {
  }
}

}  // namespace

void scene(std::string_view bytes) {
  if (bytes.find("file") != std::string_view::npos) return;  // other files are no part of the input
  tolerate_errors([&] { build_and_check(parse_scene(std::string(bytes), "fuzz.toml")); });
}

void matrix(std::string_view bytes) {
  std::istringstream in{std::string(bytes)};
  tolerate_errors([&] { (void)scene::read_matrix_market(in, "fuzz.mtx", "matrices.mass"); });
}

void table(std::string_view bytes) {
  std::istringstream in{std::string(bytes)};
  tolerate_errors([&] { (void)scene::read_time_table(in, "fuzz.csv", "loads.1.history"); });
  scene::TableLayout record;
  record.time_step = 0.01;
  record.wanted = scene::RecordQuantity::acceleration;
  record.unit_given = true;
  std::istringstream again{std::string(bytes)};
  tolerate_errors([&] { (void)scene::read_time_table(again, "fuzz.csv", "loads.1.history", record); });
}

void setting(std::string_view bytes) {
  if (bytes.find("file") != std::string_view::npos) return;
  const std::string text(bytes);
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) return;
  const Override change{text.substr(0, equals), text.substr(equals + 1)};
  tolerate_errors([&] { build_and_check(read_scene(SIGNORINI_MODELS "/belt.toml", {change})); });
  tolerate_errors([&] { (void)sweep::parse_vary(text); });
}

void results(std::string_view bytes) {
  const Folder from, to;
  unpack(bytes, from.path());
  tolerate_errors([&] { (void)result::write_plots(from.path()); });
  tolerate_errors([&] {
    constexpr std::size_t most_points = 1000;
    const sweep::SweepSpec spec = sweep::read_sweep_spec(from.path());
    if (sweep::points(spec.vary).size() > most_points) return;
    sweep::SweepDirectory merged(to.path() / "merged", spec, false);
    (void)sweep::merge_sweeps({from.path()}, merged);
    merged.write_results();
  });
}

}  // namespace signorini::fuzz
