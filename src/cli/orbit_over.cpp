#include "cli/orbit_over.hpp"

#include <fmt/core.h>

#include <chrono>
#include <limits>
#include <optional>

#include "base/number.hpp"
#include "cli/gnuplot.hpp"
#include "cli/interrupt.hpp"
#include "cli/owned_folder.hpp"
#include "cli/table.hpp"
#include "cli/terminal.hpp"
#include "orbit/reader_at.hpp"
#include "result/plot_folder.hpp"
#include "scene/unit_of_output.hpp"
#include "signorini/output.hpp"
#include "study/orbit/branch_files.hpp"
#include "study/orbit/branch_pictures.hpp"

namespace signorini::cli {
namespace {

namespace fs = std::filesystem;

const OwnedFolder& branch_folder() {
  static const OwnedFolder folder{"branch", "branch.json", {"branch.csv"}};
  return folder;
}

class BranchWatch final : public Recorder {
 public:
  void event(const Event& /*event*/) override {}
  void sample(const Sample& /*sample*/) override {}
  bool progress(double /*t*/) override { return !Interrupt::asked(); }
};

/// Writes last/ while the branch is followed, within a limited fraction of the time.
class MarkWriter {
 public:
  /// before: number of points of the resumed branch.
  MarkWriter(const fs::path& path, const SceneReader& read, const BranchOptions& over, std::size_t before)
      : path_(path), read_(read), over_(over), before_(before) {}

  void see(const std::function<BranchMark()>& mark) {
    const auto begin = Clock::now();
    if (written_ && begin - *written_ < marks_apart * took_) return;
    write(mark());
    written_ = Clock::now();
    took_ = *written_ - begin;
  }
  void write(BranchMark mark) const {
    mark.points += before_;
    write_mark(path_, read_, over_, mark);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr int marks_apart = 20;  // relative to the duration of a mark. Chosen value.

  const fs::path& path_;
  const SceneReader& read_;
  const BranchOptions& over_;
  std::size_t before_;
  std::optional<Clock::time_point> written_;
  Clock::duration took_{};
};

/// Special points, the first and the last one.
std::string branch_table(const BranchOptions& over, const Branch& branch) {
  Table table({over.path, "period", "amplitude", "multiplier", "stable", "events", "special"},
              {true, true, true, true, false, true, false});
  for (std::size_t i = 0; i < branch.points.size(); ++i) {
    const BranchPoint& p = branch.points[i];
    if (p.special.empty() && i > 0 && i + 1 < branch.points.size()) continue;
    table.row({fmt::format("{:.9g}", p.parameter), fmt::format("{:.9g}", p.period), number(p.amplitude),
               number(p.max_multiplier),
               !p.stable   ? "?"
               : *p.stable ? "yes"
                           : std::string("no, ") + to_string(p.loss),
               std::to_string(p.events), p.special});
  }
  std::string text = table.str();
  for (const SideBranch& side : branch.sides)
    text += fmt::format("branch {} leaves branch {} at a {}, {} = {:.9g}: {}\n", side.number, side.from,
                        side.kind, over.path, side.parameter, side.end);
  return text;
}

}  // namespace

void read_over(const std::string& text, BranchOptions& options) {
  const std::size_t equals = text.find('=');
  const std::size_t colon = equals == std::string::npos ? equals : text.find(':', equals);
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const auto value = [&](std::size_t begin, std::size_t end) {
    return colon == std::string::npos ? none : parse_number(text.substr(begin, end - begin)).value_or(none);
  };
  const double from = value(equals + 1, colon), to = value(colon + 1, text.size());
  if (equals == 0 || !(from < to || to < from))
    throw UsageError(fmt::format("--over {}: expected PATH=FROM:TO, two different numbers", text));
  options.path = text.substr(0, equals);
  options.from = from;
  options.to = to;
}

ExitCode run_over(const std::string& scene, const SceneReader& read, BranchOptions over, const fs::path& path,
                  const OutputOptions& options, bool resume) {
  if (!resume) check_folder(path, branch_folder(), options.force, scene);
  const Scene first = branch_reader(read, over.path, over.from)({});
  std::vector<std::string> outputs;
  for (const OutputSpec& output : first.outputs) outputs.push_back(output.name);
  std::vector<BranchPoint> before;
  if (resume) {
    over.resumed = read_mark(path, read, over);
    before = read_branch(path, outputs.size(), over.resumed->points);
  } else {
    begin_folder(path, branch_folder());
    remove_mark(path);
  }
  BranchWriter writer(path, outputs);
  Interrupt interrupt;
  BranchWatch watch;
  for (const BranchPoint& point : before) writer.add(point);
  MarkWriter marks(path, read, over, before.size());
  over.marks = [&marks](const std::function<BranchMark()>& mark) { marks.see(mark); };
  Branch branch = follow(read, over, &watch, [&](const BranchPoint& point) { writer.add(point); });
  branch.points.insert(branch.points.begin(), before.begin(), before.end());
  if (branch.last && !branch.complete) marks.write(*branch.last);
  const std::string json = branch_json(over, first.units, branch);
  write_file(path / "branch.json", json);
  std::vector<std::string> labels;
  for (const OutputSpec& output : first.outputs) {
    const std::string unit = unit_text(unit_of_output(output, first.outputs), first.units);
    labels.push_back(output.name + (unit.empty() ? "" : " [" + unit + "]"));
  }
  clear_plot_folder(path / "plots", is_picture_of_branch);
  const std::vector<fs::path> scripts =
      options.no_plots ? std::vector<fs::path>()
                       : branch_pictures(first.title, first.units, over, labels, branch).write(path);
  if (options.json) print(json);
  if (options.tables())
    print(branch_table(over, branch) +
          fmt::format("\n{} points: {}\nresults: {}/ (branch.csv, branch.json)\n", branch.points.size(),
                      branch.end, path.string()));
  const std::string drawn =
      scripts.empty() ? "" : draw_pictures(path, scripts, " (gnuplot, once installed, draws them)");
  if (options.tables()) print(drawn);
  if (Interrupt::asked()) {
    print_error("interrupted; the points up to here are kept in " + path.string());
    return ExitCode::interrupted;
  }
  if (!branch.complete) print_error("the branch ends early: " + branch.end);
  return branch.complete ? ExitCode::done : ExitCode::stopped;
}

}  // namespace signorini::cli
