#include "study/orbit/branch_files.hpp"

#include <fmt/core.h>
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <fstream>
#include <functional>

#include "base/files.hpp"
#include "base/json.hpp"
#include "base/text.hpp"
#include "orbit/orbit_engine.hpp"
#include "result/csv.hpp"
#include "result/summary_parts.hpp"
#include "result/table.hpp"
#include "scene/resolved_scene.hpp"
#include "study/optional_values.hpp"
#include "study/orbit/orbit_files.hpp"

namespace signorini::orbit_study {

namespace fs = std::filesystem;

BranchWriter::BranchWriter(const std::filesystem::path& directory, const std::vector<std::string>& outputs)
    : file_(directory / "branch.csv") {
  for (const char* name : {"parameter", "period", "amplitude"}) block_.text(name);
  for (const std::string& output : outputs) block_.text(output + " minimum").text(output + " maximum");
  for (const char* name : {"max_multiplier", "stable", "loss", "sequence", "events", "special",
                           "multiplier_error", "residual", "branch"})
    block_.text(name);
  block_.end_row();
  file_.write(block_);
}

void BranchWriter::add(const BranchPoint& point) {
  block_.number(point.parameter).number(point.period).number(point.amplitude);
  for (std::size_t i = 0; i < point.minima.size(); ++i)
    block_.number(point.minima[i]).number(point.maxima[i]);
  block_.number(point.max_multiplier);
  block_.text(!point.stable ? "" : *point.stable ? "true" : "false").text(to_string(point.loss));
  block_.number(point.sequence).number(static_cast<double>(point.events)).text(point.special);
  block_.number(point.multiplier_error).number(point.residual).number(point.branch);
  block_.end_row();
  file_.write(block_);
}

std::vector<BranchPoint> read_branch(const fs::path& directory, std::size_t outputs, std::size_t rows) {
  result::CsvReader reader(directory / "branch.csv");
  const auto at = [&](const char* name) { return reader.column(name); };
  const std::size_t first_output = at("amplitude") + 1;
  std::vector<BranchPoint> points;
  while (points.size() < rows && reader.next()) {
    BranchPoint p;
    p.parameter = reader.number(at("parameter"));
    p.period = reader.number(at("period"));
    p.amplitude = reader.number(at("amplitude"));
    for (std::size_t i = 0; i < outputs; ++i) {
      p.minima.push_back(reader.number(first_output + 2 * i));
      p.maxima.push_back(reader.number(first_output + 2 * i + 1));
    }
    p.max_multiplier = reader.number(at("max_multiplier"));
    p.multiplier_error = reader.number(at("multiplier_error"));
    p.residual = reader.number(at("residual"));
    if (const std::string& stable = reader.cell(at("stable")); !stable.empty()) p.stable = stable == "true";
    for (const OrbitLoss loss : {OrbitLoss::fold, OrbitLoss::flip, OrbitLoss::neimark_sacker})
      if (reader.cell(at("loss")) == to_string(loss)) p.loss = loss;
    p.sequence = static_cast<int>(reader.number(at("sequence")));
    p.events = static_cast<long>(reader.number(at("events")));
    p.branch = static_cast<int>(reader.number(at("branch")));
    p.special = reader.cell(at("special"));
    points.push_back(std::move(p));
  }
  if (points.size() < rows)
    throw FileError((directory / "branch.csv").string(),
                    fmt::format("has {}, expected {} up to the checkpoint in last/",
                                base::count_text(points.size(), "row"), rows));
  return points;
}

namespace {

fs::path checkpoint_folder(const fs::path& directory) {
  const fs::path last = directory / "last", before = directory / "last.before";
  return !fs::exists(last) && fs::exists(before) ? before : last;
}

/// Identifies a branch: the scene at its beginning, and the options that determine the orbit.
scene::ResolvedKeys branch_identity(const SceneReader& read, const BranchOptions& options) {
  scene::ResolvedKeys keys = scene::resolved_keys(orbit::branch_reader(read, options.path, options.from)({}));
  const auto given = [](const std::optional<double>& value) {
    return value ? base::format_number(*value) : "none";
  };
  keys["--times"] = std::to_string(options.orbit.times);
  keys["--period"] = given(options.orbit.period);
  keys["--energy"] = given(options.orbit.energy);
  return keys;
}

base::Json checkpoint_json(const SceneReader& read, const BranchOptions& options,
                           const BranchCheckpoint& mark) {
  return {{"path", options.path},
          {"from", options.from},
          {"to", options.to},
          {"parameter", mark.parameter},
          {"points", mark.point_count},
          {"towards_to", mark.towards_to},
          {"sequences", mark.sequences},
          {"scene", branch_identity(read, options)}};
}

void check_branch_identity(const fs::path& directory, const base::Json& kept, const SceneReader& read,
                           const BranchOptions& options) {
  constexpr std::size_t most = 3;
  const auto differ = scene::differing_keys(kept.get<scene::ResolvedKeys>(), branch_identity(read, options));
  if (differ.empty()) return;
  const std::size_t shown = std::min(most, differ.size());
  std::string text =
      fmt::format("{}", fmt::join(differ.begin(), differ.begin() + static_cast<std::ptrdiff_t>(shown), ", "));
  if (differ.size() > shown) text += fmt::format(", and {} more keys", differ.size() - shown);
  throw UsageError(
      fmt::format("--resume: the branch in {} was computed with another scene or other options; different: "
                  "{}. Resume it with its own scene and options, or follow a new branch with --force",
                  directory.string(), text));
}

}  // namespace

void write_checkpoint(const fs::path& directory, const SceneReader& read, const BranchOptions& options,
                      const BranchCheckpoint& mark) {
  const SceneReader there = orbit::branch_reader(read, options.path, mark.parameter);
  const fs::path last = directory / "last", next = directory / "last.next",
                 before = directory / "last.before";
  std::error_code error;
  fs::remove_all(next, error);
  base::make_directory(next);
  const Scene scene = scene_starting_from(orbit_scene(there, mark.orbit), last);
  write_orbit(next, scene, build_model(scene), mark.orbit);
  result::write_file(next / "mark.json", base::json_text(checkpoint_json(read, options, mark)));
  fs::remove_all(before, error);
  fs::rename(last, before, error);  // last/ may not exist yet
  fs::rename(next, last, error);
  if (error) throw FileError(last.string(), "cannot be written: " + error.message());
  fs::remove_all(before, error);
}

void remove_checkpoint(const fs::path& directory) {
  std::error_code error;
  for (const char* name : {"last", "last.before", "last.next"}) fs::remove_all(directory / name, error);
}

BranchCheckpoint read_checkpoint(const fs::path& directory, const SceneReader& read,
                                 const BranchOptions& options) {
  const fs::path last = checkpoint_folder(directory);
  BranchCheckpoint mark;
  try {
    std::ifstream branch_stream(directory / "branch.json", std::ios::binary);
    if (base::parse_json(branch_stream).value("complete", false))
      throw UsageError(
          fmt::format("--resume: the branch in {} is complete, so it cannot be resumed", directory.string()));
    std::ifstream stream(last / "mark.json", std::ios::binary);
    std::ifstream orbit_stream(last / "orbit.json", std::ios::binary);
    const base::Json saved = base::parse_json(stream);
    if (saved.at("path") != options.path || saved.at("from") != options.from || saved.at("to") != options.to)
      throw UsageError(
          fmt::format("--resume: the branch in {} follows {} from {} to {}; --over requests another branch",
                      directory.string(), saved.at("path").get<std::string>(), saved.at("from").get<double>(),
                      saved.at("to").get<double>()));
    check_branch_identity(directory, saved.at("scene"), read, options);
    mark.parameter = saved.at("parameter");
    mark.towards_to = saved.at("towards_to");
    mark.sequences = saved.at("sequences");
    mark.point_count = saved.at("points");
    const base::Json orbit = base::parse_json(orbit_stream);
    mark.orbit.found = true;
    mark.orbit.period = orbit.at("period");
    mark.orbit.phase = orbit.at("phase");
    mark.orbit.autonomous = orbit.at("autonomous");
  } catch (const base::Json::exception&) {
    throw FileError(directory.string(), "contains no checkpoint from which a branch can be resumed");
  }
  mark.orbit.start = orbit::branch_reader(read, options.path, mark.parameter)(
                         {{"run.initial", "{ run = " + base::Json((last / "start").string()).dump() + " }"}})
                         .initial.saved.value();
  return mark;
}

std::string branch_json(const BranchOptions& options, const Units& units, const Branch& branch) {
  base::Json sides = base::Json::array();
  for (const SideBranch& side : branch.sides)
    sides.push_back({{"branch", side.number},
                     {"from", side.from},
                     {"kind", side.kind},
                     {"parameter", side.parameter},
                     {"complete", side.complete},
                     {"end", side.end}});
  base::Json last;
  if (branch.last) last = {{"parameter", branch.last->parameter}, {"towards_to", branch.last->towards_to}};
  const base::Json json = {{"path", options.path},
                           {"from", options.from},
                           {"to", options.to},
                           {"units", result::units_json(units)},
                           {"points", branch.points.size()},
                           {"complete", branch.complete},
                           {"end", branch.end},
                           {"sequences", branch.sequences},
                           {"sides", sides},
                           {"last", last}};
  return base::json_text(json);
}

namespace {

constexpr std::size_t max_outputs = 6;
constexpr const char* low_colour = "#d95f02";
constexpr const char* high_colour = "#1f77b4";

/// A point of the picture's table. gnuplot breaks a curve at a value that is not a number.
struct DrawnPoint {
  const BranchPoint* point;  // null: a break of the curve
  bool stable, unstable;     // true if the stable or unstable curve contains the point
};

/// Rows of the picture's table. A segment between two points is drawn as unstable if one of its ends is unstable. A point
/// of undecided stability belongs to the curves of both neighbours.
std::vector<DrawnPoint> drawn_points(const Branch& branch) {
  std::vector<const BranchPoint*> order;
  for (const BranchPoint& p : branch.points) order.push_back(&p);
  std::stable_sort(order.begin(), order.end(),
                   [](const auto* a, const auto* b) { return a->branch < b->branch; });
  const auto bad = [&](std::size_t i) { return order[i]->stable.has_value() && !*order[i]->stable; };
  const auto good = [&](std::size_t i) { return order[i]->stable.value_or(false); };
  std::vector<DrawnPoint> list;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool follows = i > 0 && order[i - 1]->branch == order[i]->branch;
    const bool followed = i + 1 < order.size() && order[i + 1]->branch == order[i]->branch;
    if (!follows && i > 0) list.push_back({nullptr, false, false});
    const bool beside_bad = (follows && bad(i - 1)) || (followed && bad(i + 1));
    const bool beside_good = (follows && good(i - 1)) || (followed && good(i + 1));
    const bool unstable = bad(i) || beside_bad;
    list.push_back({order[i], good(i) || (!bad(i) && (beside_good || !unstable)), unstable});
  }
  return list;
}

using Cell = std::function<double(const BranchPoint&)>;

class BranchTable {
 public:
  BranchTable() {
    column("x", [](const BranchPoint& p) { return p.parameter; });
    table_.add("stable", [](const DrawnPoint& p) { return p.stable ? 1 : 0; });
    table_.add("unstable", [](const DrawnPoint& p) { return p.unstable ? 1 : 0; });
    table_.add("special", [](const DrawnPoint& p) {
      return std::string_view(p.point == nullptr ? "" : p.point->special.c_str());
    });
    column("sequence", [](const BranchPoint& p) { return p.sequence; });
    column("multiplier", [](const BranchPoint& p) { return p.max_multiplier; });
    column("amplitude", [](const BranchPoint& p) { return p.amplitude; });
  }
  void column(const std::string& name, const Cell& cell) {
    table_.add_put(name, [cell](result::CsvBlock& block, const DrawnPoint& p) {
      if (p.point == nullptr)
        block.text("NaN");
      else
        block.number(cell(*p.point));
    });
  }
  /// gnuplot columns x:y. y: column `name` where column `kind` ("stable" or "unstable") is 1, and NaN elsewhere.
  [[nodiscard]] std::string parts(const std::string& name, const char* kind) const {
    return fmt::format("{}:({} > 0 ? {} : NaN)", table_.number("x"), table_.value(kind), table_.value(name));
  }
  [[nodiscard]] std::string at(const std::string& name, const std::string& special) const {
    return fmt::format("{}:(strstrt({}, '{}') > 0 ? {} : NaN)", table_.number("x"), table_.word("special"),
                       special, table_.value(name));
  }
  [[nodiscard]] std::string plain(const std::string& name) const {
    return fmt::format("{}:{}", table_.number("x"), table_.number(name));
  }
  [[nodiscard]] std::string text(const std::vector<DrawnPoint>& points) const { return table_.text(points); }

 private:
  result::CsvTable<DrawnPoint> table_;
};

const std::string rows = "'branch.csv' skip 1";

/// Adds a curve with solid stable and dashed unstable parts. unstable_too: true if the legend names the dashed parts.
void add_line(const BranchTable& table, const std::string& name, const std::string& colour,
              const std::string& title, bool unstable_too, result::Panel& panel) {
  const std::string dashed = "with lines linewidth 1.4 dashtype (6,5) linecolor '" + colour + "'";
  panel.curves.push_back(
      {rows, table.parts(name, "stable"), "with lines linewidth 1.8 linecolor '" + colour + "'", title});
  panel.curves.push_back({rows, table.parts(name, "unstable"), dashed,
                          unstable_too ? std::optional<std::string>("unstable") : std::nullopt});
}

bool has_unstable(const Branch& branch) {
  return std::any_of(branch.points.begin(), branch.points.end(),
                     [](const BranchPoint& p) { return p.stable.has_value() && !*p.stable; });
}

struct SpecialPointStyle {
  const char *special, *look;
};
constexpr std::array marks{
    SpecialPointStyle{"fold", "with points pointtype 9 pointsize 1.1 linecolor '#1a1a1a'"},
    SpecialPointStyle{"flip", "with points pointtype 5 pointsize 0.9 linecolor '#c0182b'"},
    SpecialPointStyle{"neimark-sacker", "with points pointtype 7 pointsize 1.0 linecolor '#7b3294'"},
    SpecialPointStyle{"branch point", "with points pointtype 13 pointsize 1.2 linecolor '#1b9e77'"},
    SpecialPointStyle{"end", "with points pointtype 3 pointsize 1.1 linecolor '#1a1a1a'"},
    SpecialPointStyle{"restart", "with points pointtype 2 pointsize 1.0 linecolor '#666666'"}};

/// Adds symbols for all kinds of special points on the branch. first: true if the legend names the symbols.
void add_special_points(const BranchTable& table, const Branch& branch, const std::string& name, bool first,
                        result::Panel& panel) {
  for (const SpecialPointStyle& mark : marks) {
    const bool occurs = std::any_of(branch.points.begin(), branch.points.end(), [&](const BranchPoint& p) {
      return p.special.find(mark.special) != std::string::npos;
    });
    if (!occurs) continue;
    panel.curves.push_back({rows, table.at(name, mark.special), mark.look,
                            first ? std::optional<std::string>(mark.special) : std::nullopt});
  }
}

/// Grey bands for every second sequence of events; none if the branch has a fold, where bands would overlap.
std::string bands(const Branch& branch) {
  std::string s;
  int object = 10;
  bool turns = false;
  for (const BranchPoint& p : branch.points)
    turns = turns || p.branch != 1 || p.special.find("fold") != std::string::npos;
  if (turns) return s;
  for (std::size_t i = 0; i < branch.points.size();) {
    std::size_t j = i;
    while (j + 1 < branch.points.size() && branch.points[j + 1].sequence == branch.points[i].sequence) ++j;
    const double from = branch.points[i].parameter;
    const double to = branch.points[std::min(j + 1, branch.points.size() - 1)].parameter;
    if (branch.points[i].sequence % 2 == 0)
      s += fmt::format(
          "set object {} rectangle from first {},graph 0 to first {},graph 1 behind fillstyle solid noborder "
          "fillcolor '#f0f0f0'\n",
          object++, base::format_number(std::min(from, to)), base::format_number(std::max(from, to)));
    i = j + 1;
  }
  return s;
}

result::Panel multiplier_panel(const BranchTable& table, const Branch& branch) {
  result::Panel panel{"greatest multiplier", {}, "set yrange [0:*]\n", 0.7};
  add_line(table, "multiplier", "#1a1a1a", "stable", has_unstable(branch), panel);
  panel.curves.push_back({"1", "", "with lines linewidth 0.8 linecolor '#c0182b'", "unit circle"});
  add_special_points(table, branch, "multiplier", false, panel);
  return panel;
}

result::Panel sequence_panel(const BranchTable& table, const Branch& branch, const std::string& x_name) {
  result::Panel panel{"sequence",
                      {{rows, table.plain("sequence"),
                        "with points pointtype 7 pointsize 0.4 linecolor '#1b9e77'", "sequence"}},
                      fmt::format("set yrange [0:{}]\nset ytics 1\nset xlabel {}\n",
                                  branch.sequences.size() + 1, signorini::result::quoted(x_name)),
                      0.5};
  return panel;
}

}  // namespace

bool is_picture_of_branch(const std::filesystem::path& file) { return file.stem() == "branch"; }

result::PictureFiles branch_pictures(const std::string& title, const Units& units,
                                     const BranchOptions& options, const std::vector<std::string>& outputs,
                                     const Branch& branch, const result::PictureStyle& look) {
  result::PictureFiles files(is_picture_of_branch);
  if (branch.points.size() < 2) return files;
  const result::PlottedRun run = result::empty_plotted_run(title, units, look);
  BranchTable table;
  const std::size_t shown = std::min(outputs.size(), max_outputs);
  for (std::size_t i = 0; i < shown; ++i) {
    table.column(fmt::format("low {}", i), [i](const BranchPoint& p) { return p.minima[i]; });
    table.column(fmt::format("high {}", i), [i](const BranchPoint& p) { return p.maxima[i]; });
  }
  files.add_table("branch", table.text(drawn_points(branch)));
  const std::size_t panels = std::max<std::size_t>(1, shown);
  result::Picture picture{"branch",
                          "Orbits over " + study::key_with_unit(options.path, units) + ": " + branch.end,
                          result::canvas_of(look, 420.0 + 260.0 * static_cast<double>(panels), false), false};
  picture.space = 24.0;
  picture.setup =
      "set offsets 0,0,graph 0.05,graph 0.05\n" +
      result::range_of('x', std::min(options.from, options.to), std::max(options.from, options.to)) +
      bands(branch);
  for (std::size_t i = 0; i < shown; ++i) {
    result::Panel panel{outputs[i], {}, "set yrange [*:*]\n"};
    add_line(table, fmt::format("high {}", i), high_colour, "greatest", has_unstable(branch), panel);
    add_line(table, fmt::format("low {}", i), low_colour, "least", false, panel);
    add_special_points(table, branch, fmt::format("high {}", i), i == 0, panel);
    picture.panels.push_back(panel);
  }
  if (shown == 0) {
    result::Panel panel{"amplitude [" + units.length + "]", {}, "set yrange [0:*]\n"};
    add_line(table, "amplitude", high_colour, "stable", has_unstable(branch), panel);
    add_special_points(table, branch, "amplitude", true, panel);
    picture.panels.push_back(panel);
  }
  picture.panels.push_back(multiplier_panel(table, branch));
  picture.panels.push_back(sequence_panel(table, branch, study::key_with_unit(options.path, units)));
  files.add(run, picture);
  return files;
}

}  // namespace signorini::orbit_study
