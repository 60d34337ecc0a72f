#include "study/compare/comparison_plots.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "base/file_name.hpp"
#include "base/number.hpp"
#include "result/csv.hpp"
#include "result/csv_read.hpp"
#include "result/plot_folder.hpp"
#include "result/plot_parts.hpp"
#include "result/plot_rows.hpp"
#include "result/run_tables.hpp"
#include "study/compare/comparison_tables.hpp"

namespace signorini {

namespace fs = std::filesystem;

namespace {

constexpr std::array<const char*, 6> colours = {"#1a1a1a", "#d95f02", "#1f77b4",
                                                "#1b9e77", "#e7298a", "#7b3294"};
constexpr std::size_t most_contacts = 24;  // pictures; more would bury the folder

/// The later runs are thinner and dashed, on top: curves that coincide show through.
std::string look(std::size_t run) {
  const std::string colour = colours[run % colours.size()];
  if (run == 0) return "linewidth 2.6 linecolor '" + colour + "'";
  return fmt::format("linewidth 1.3 dashtype {} linecolor '{}'", run + 1, colour);
}

std::string plain(const std::string& name) { return file_name(name, 60, "-", '_'); }

PlottedRun plotted(const RunFigures& figures, double t_end) {
  PlottedRun run;
  run.facts = figures.facts;
  CsvReader history(figures.directory / "history.csv");
  while (history.next()) {
    run.t_last = history.t();
    if (run.times++ == 0) run.t_first = run.t_last;
  }
  // What is killed may lack the last row in contacts.csv, or have a part of it.
  if (run.times > 0 && run.facts.outcome == "running") --run.times;
  run.from = run.t_first;
  run.to = std::max(run.t_last, t_end);
  run.greatest_compression.assign(run.facts.contacts.size(), 0.0);
  read_motion(figures.directory, contact_numbers(run.facts), run);
  read_ranges(figures.directory, run);
  return run;
}

/// As seen from the folder of the scripts.
std::string path_from(const fs::path& folder, const fs::path& file) {
  std::error_code error;
  const fs::path base = fs::canonical(folder, error), target = fs::weakly_canonical(file, error);
  return error ? file.string() : target.lexically_proximate(base).string();
}

/// A panel of a contact.
struct ContactCurve {
  std::string label;
  const char* column;  ///< of contacts.csv
  Range ContactRanges::*range;
  double ContactScales::*scale;
};

/// A panel of differences.
struct Curve {
  std::string label, name;
  std::size_t column;
};

class Pictures {
 public:
  Pictures(fs::path folder, const ComparisonReport& report, const PictureLook& look)
      : folder_(std::move(folder)), report_(report) {
    double t_end = 0.0;
    for (const ComparedRun& run : report.runs) t_end = std::max(t_end, run.figures.t);
    std::vector<std::string> names;
    for (const ComparedRun& run : report.runs) {
      runs_.push_back(plotted(run.figures, t_end));
      names.push_back(run.figures.name);
    }
    for (PlottedRun& run : runs_) {
      run.legend = room_for(names);
      run.look = look;
    }
  }

  [[nodiscard]] bool any() const { return runs_.front().times >= 2; }

  [[nodiscard]] std::string contact(std::size_t k, const std::string& name) const {
    const PlottedRun& first = runs_.front();
    const RunFacts::Contact& contact = first.facts.contacts[k];
    const Units& units = first.facts.units;
    const std::string length = " [" + units.length + "]", force = " [" + units.force + "]";
    std::vector<ContactCurve> curves = {{"ut" + length, "ut", &ContactRanges::ut, &ContactScales::length}};
    if (!contact.slider)
      curves.push_back({"gap" + length, "gap", &ContactRanges::gap, &ContactScales::length});
    curves.push_back({"N" + force, "N", &ContactRanges::N, &ContactScales::force});
    curves.push_back({"T" + force, "T", &ContactRanges::T, &ContactScales::force});
    const Canvas canvas = canvas_of(first.look, 142.0 + 230.0 * static_cast<double>(curves.size()), true);
    std::string s = begin_script(first, {name, "Contact '" + contact.name + "': motion and forces", canvas});
    for (std::size_t i = 0; i < curves.size(); ++i) {
      s += panel(first, canvas, stacked(i, curves.size(), canvas), curves[i].label, i + 1 == curves.size());
      s += axis(contact.name, curves[i]);
      std::vector<std::string> elements;
      for (std::size_t r = 0; r < runs_.size(); ++r) {
        const auto& contacts = runs_[r].facts.contacts;
        const auto found = std::find_if(contacts.begin(), contacts.end(),
                                        [&](const auto& c) { return c.name == contact.name; });
        if (found == contacts.end() || runs_[r].times < 2) continue;
        const auto index = static_cast<std::size_t>(found - contacts.begin());
        elements.push_back(
            fmt::format("{} using 1:{} with lines {} title {}",
                        contact_rows(runs_[r], index, path_from(folder_, report_.runs[r].figures.directory)),
                        contact_table().number(curves[i].column), look(r),
                        quoted(legend_name(report_.runs[r].figures.name))));
      }
      s += plot_command(elements);
    }
    return s + end_script();
  }

  [[nodiscard]] std::string differences() const {
    const PlottedRun& first = runs_.front();
    const Units& units = first.facts.units;
    std::vector<Curve> curves = {
        {"displacement [" + units.length + "]", "motion", motion_difference_table().number("displacement")}};
    for (const char* force : {"N", "T"})
      if (!first.facts.contacts.empty())
        curves.push_back(
            {force + (" [" + units.force + "]"), "forces", force_difference_table().number(force)});
    const bool events = std::any_of(report_.comparisons.begin(), report_.comparisons.end(),
                                    [](const Comparison& c) { return !c.alignment.pairs.empty(); });
    if (events)
      curves.push_back(
          {"event time [" + units.time + "]", "events", event_pair_table().number("difference")});
    const Canvas canvas = canvas_of(first.look, 142.0 + 230.0 * static_cast<double>(curves.size()), true);
    std::string s = begin_script(
        first, {"differences", "Greatest differences from " + report_.runs.front().figures.name, canvas});
    s += "set logscale y\n";
    for (std::size_t i = 0; i < curves.size(); ++i) {
      s += panel(first, canvas, stacked(i, curves.size(), canvas), curves[i].label, i + 1 == curves.size());
      s += "set format y '%.0e'\n";
      std::vector<std::string> elements;
      for (std::size_t r = 1; r < runs_.size(); ++r) elements.push_back(difference(curves[i], r));
      s += y_range(curves[i], elements);
      for (std::size_t r = 1; r < runs_.size(); ++r)
        if (const auto& split = report_.comparisons[r - 1].alignment.split)
          s += fmt::format(
              "set arrow {0} from first {1}, graph 0 to first {1}, graph 1 nohead dashtype 3 "
              "linecolor '{2}'\n",
              r, shortest(split->t), colours[r % colours.size()]);
      s += plot_command(elements);
    }
    return s + end_script();
  }

 private:
  /// Where the curves of all runs together hardly move.
  [[nodiscard]] std::string axis(const std::string& contact, const ContactCurve& curve) const {
    Range all;
    ContactScales scales;
    for (const PlottedRun& run : runs_) {
      const ContactScales own = scales_of(run.ranges);
      scales = {std::max(scales.length, own.length), std::max(scales.force, own.force)};
      for (std::size_t k = 0; k < run.facts.contacts.size(); ++k) {
        if (run.facts.contacts[k].name == contact) all.take(run.ranges[k].*curve.range);
      }
    }
    return steady(all, scales.*curve.scale);
  }

  /// At most 12 decades below the greatest one. A logarithmic axis needs something positive, also where all
  /// runs agree to the last digit.
  [[nodiscard]] std::string y_range(const Curve& curve, std::vector<std::string>& elements) const {
    double greatest = 0.0;
    for (const Comparison& c : report_.comparisons) {
      if (curve.name == "motion") greatest = std::max(greatest, c.displacement.whole.value);
      if (curve.name == "events") greatest = std::max(greatest, c.event_time.whole.value);
      if (curve.name != "forces") continue;
      const std::string end = curve.column == force_difference_table().number("N") ? ".N" : ".T";
      for (const auto& [column, deviation] : c.columns)
        if (column.ends_with(end)) greatest = std::max(greatest, deviation.whole.value);
    }
    if (greatest > 0.0 && greatest < 1e300) {
      return "set yrange [" + shortest(greatest * 1e-12) + "<*:*]\n";
    }
    elements.push_back(fmt::format("{} with lines linecolor '#ffffff' notitle", 1e-18));
    return "set yrange [1e-20:1e-10]\n";
  }

  [[nodiscard]] std::string difference(const Curve& curve, std::size_t r) const {
    const std::string name = report_.runs[r].figures.name;
    if (curve.name == "events") {
      const auto& table = event_pair_table();
      return fmt::format(
          "'../events.csv' skip 1 using {3}:({4} eq {0} && {5} != 0 ? abs({5}) : NaN) with points "
          "pointtype 7 "
          "pointsize 0.7 linecolor '{1}' title {2}",
          quoted(name), colours[r % colours.size()], quoted(legend_name(name)), table.number("t_reference"),
          table.word("run"), table.value("difference"));
    }
    return fmt::format(
        "'{}-{}.csv' skip 1{} using 1:(${} > 0 ? ${} : NaN) with lines linewidth 1.1 linecolor '{}' "
        "title {}",
        curve.name, run_slug(name, r), every(runs_[r], 1, 0), curve.column, curve.column,
        colours[r % colours.size()], quoted(legend_name(name)));
  }

  fs::path folder_;
  const ComparisonReport& report_;
  std::vector<PlottedRun> runs_;
};

bool is_picture_of_comparison(const fs::path& file) {
  const std::string stem = file.stem().string();
  if (is_picture(file)) return stem == "differences" || stem.starts_with("contact-");
  return file.extension() == ".csv" && (stem.starts_with("motion-") || stem.starts_with("forces-"));
}

}  // namespace

std::string run_slug(const std::string& name, std::size_t i) {
  return std::to_string(i + 1) + "-" + plain(name);
}

void begin_comparison_plots(const fs::path& directory) {
  begin_plot_folder(directory / "plots", is_picture_of_comparison);
}

std::vector<fs::path> write_comparison_plots(const fs::path& directory, const ComparisonReport& report,
                                             const PictureLook& look) {
  const fs::path folder = directory / "plots";
  const Pictures pictures(folder, report, look);
  if (!pictures.any()) return {};
  std::vector<fs::path> scripts;
  const auto add = [&](const std::string& name, const std::string& text) {
    scripts.push_back(folder / (name + ".gp"));
    write_file(scripts.back(), text);
  };
  const auto& contacts = report.runs.front().figures.facts.contacts;
  for (std::size_t k = 0; k < std::min(contacts.size(), most_contacts); ++k) {
    const std::string name = fmt::format("contact-{}-{}", k + 1, plain(contacts[k].name));
    add(name, pictures.contact(k, name));
  }
  if (!report.comparisons.empty()) add("differences", pictures.differences());
  return scripts;
}

}  // namespace signorini
