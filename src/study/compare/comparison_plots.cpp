#include "study/compare/comparison_plots.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "base/files.hpp"
#include "base/text.hpp"
#include "result/picture_files.hpp"
#include "result/plot_parts.hpp"
#include "result/run_tables.hpp"
#include "study/compare/comparison_files.hpp"

namespace signorini::compare {

namespace fs = std::filesystem;

namespace {

constexpr std::array<const char*, 6> colours = {"#1a1a1a", "#d95f02", "#1f77b4",
                                                "#1b9e77", "#e7298a", "#7b3294"};
constexpr std::size_t max_contacts = 24;  // limit for pictures of single contacts

/// Line style of a run. Later runs are drawn on top with thinner, dashed lines, so that coinciding curves
/// remain visible.
std::string look(std::size_t run) {
  const std::string colour = colours[run % colours.size()];
  if (run == 0) return "linewidth 2.6 linecolor '" + colour + "'";
  return fmt::format("linewidth 1.3 dashtype {} linecolor '{}'", run + 1, colour);
}

std::string plain(const std::string& name) { return base::file_name(name, 60, "-", '_'); }

/// Path relative to the folder of the scripts.
std::string path_from(const fs::path& folder, const fs::path& file) {
  std::error_code error;
  const fs::path base = fs::canonical(folder, error), target = fs::weakly_canonical(file, error);
  return error ? file.string() : target.lexically_proximate(base).string();
}

/// A panel for one quantity of a contact.
struct ContactCurve {
  std::string label;
  const char* column;  ///< column of contacts.csv
  result::Range result::ContactRanges::*range;
  double result::ContactScales::*scale;
};

/// A panel of differences.
struct DifferenceCurve {
  std::string label, name;
  std::size_t column;
};

class Pictures {
 public:
  Pictures(fs::path folder, const ComparisonReport& report, const result::PictureStyle& look)
      : folder_(std::move(folder)), report_(report) {
    double t_end = 0.0;
    for (const ComparedRun& run : report.runs) t_end = std::max(t_end, run.figures.t);
    std::vector<std::string> names;
    for (const ComparedRun& run : report.runs) {
      runs_.push_back(
          result::read_compared(result::TableFolder(run.figures.directory), run.figures.facts, t_end));
      names.push_back(run.figures.name);
    }
    for (result::PlottedRun& run : runs_) {
      run.legend = result::legend_width(names);
      run.look = look;
    }
  }

  [[nodiscard]] bool any() const { return runs_.front().times >= 2; }

  [[nodiscard]] result::Picture contact(std::size_t k, const std::string& name) const {
    const result::PlottedRun& first = runs_.front();
    const result::RunFacts::Contact& contact = first.facts.contacts[k];
    const Units& units = first.facts.units;
    const std::string length = " [" + units.length + "]", force = " [" + units.force + "]";
    std::vector<ContactCurve> curves = {
        {"ut" + length, "ut", &result::ContactRanges::ut, &result::ContactScales::length}};
    if (!contact.slider)
      curves.push_back({"gap" + length, "gap", &result::ContactRanges::gap, &result::ContactScales::length});
    curves.push_back({"N" + force, "N", &result::ContactRanges::N, &result::ContactScales::force});
    curves.push_back({"T" + force, "T", &result::ContactRanges::T, &result::ContactScales::force});
    result::Picture picture{name, "Contact '" + contact.name + "': motion and forces", canvas(curves.size())};
    for (const ContactCurve& curve : curves) {
      result::Panel panel{curve.label, {}, axis(contact.name, curve)};
      for (std::size_t r = 0; r < runs_.size(); ++r) {
        const auto& contacts = runs_[r].facts.contacts;
        const auto found = std::find_if(contacts.begin(), contacts.end(),
                                        [&](const auto& c) { return c.name == contact.name; });
        if (found == contacts.end() || runs_[r].times < 2) continue;
        const auto index = static_cast<std::size_t>(found - contacts.begin());
        panel.curves.push_back(
            {result::contact_rows(runs_[r], index, path_from(folder_, report_.runs[r].figures.directory)),
             fmt::format("{}:{}", result::contact_table().number("t"),
                         result::contact_table().number(curve.column)),
             "with lines " + look(r), result::legend_name(report_.runs[r].figures.name)});
      }
      picture.panels.push_back(panel);
    }
    return picture;
  }

  [[nodiscard]] result::Picture differences() const {
    const result::PlottedRun& first = runs_.front();
    const Units& units = first.facts.units;
    std::vector<DifferenceCurve> curves = {
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
    result::Picture picture{"differences", "Greatest differences from " + report_.runs.front().figures.name,
                            canvas(curves.size())};
    picture.setup = "set logscale y\n";
    for (const DifferenceCurve& curve : curves) {
      result::Panel panel{curve.label, {}};
      for (std::size_t r = 1; r < runs_.size(); ++r) panel.curves.push_back(difference(curve, r));
      panel.axes = "set format y '%.0e'\n" + y_range(curve, panel.curves);
      for (std::size_t r = 1; r < runs_.size(); ++r)
        if (const auto& split = report_.comparisons[r - 1].alignment.split)
          panel.axes += result::vertical_line(
              r, split->t, fmt::format("dashtype 3 linecolor '{}'", colours[r % colours.size()]));
      picture.panels.push_back(panel);
    }
    return picture;
  }

  [[nodiscard]] const result::PlottedRun& first() const { return runs_.front(); }

 private:
  [[nodiscard]] result::Canvas canvas(std::size_t panels) const {
    return result::canvas_of(runs_.front().look, 142.0 + 230.0 * static_cast<double>(panels), true);
  }

  /// gnuplot command for a fixed axis if the curves of all runs are nearly constant; otherwise for an automatic axis.
  [[nodiscard]] std::string axis(const std::string& contact, const ContactCurve& curve) const {
    result::Range all;
    result::ContactScales scales;
    for (const result::PlottedRun& run : runs_) {
      const result::ContactScales own = result::scales_of(run.ranges);
      scales = {std::max(scales.length, own.length), std::max(scales.force, own.force)};
      for (std::size_t k = 0; k < run.facts.contacts.size(); ++k) {
        if (run.facts.contacts[k].name == contact) all.take(run.ranges[k].*curve.range);
      }
    }
    return result::constant_axis(all, scales.*curve.scale);
  }

  /// Range of the logarithmic axis: at most 12 decades below the largest value. If all runs agree exactly, an
  /// invisible positive curve is added, because a logarithmic axis needs a positive value.
  [[nodiscard]] std::string y_range(const DifferenceCurve& curve, std::vector<result::Curve>& curves) const {
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
      return "set yrange [" + base::format_number(greatest * 1e-12) + "<*:*]\n";
    }
    curves.push_back({"1e-18", "", "with lines linecolor '#ffffff'"});
    return "set yrange [1e-20:1e-10]\n";
  }

  [[nodiscard]] result::Curve difference(const DifferenceCurve& curve, std::size_t r) const {
    const std::string name = report_.runs[r].figures.name;
    const std::string colour = fmt::format("linecolor '{}'", colours[r % colours.size()]);
    if (curve.name == "events") {
      const auto& table = event_pair_table();
      return {"'../events.csv' skip 1",
              fmt::format("{2}:({3} eq {0} && {1} != 0 ? abs({1}) : NaN)", result::quoted(name),
                          table.value("difference"), table.number("t_reference"), table.word("run")),
              "with points pointtype 7 pointsize 0.7 " + colour, result::legend_name(name)};
    }
    const std::size_t time =
        curve.name == "motion" ? motion_difference_table().number("t") : force_difference_table().number("t");
    return {result::rows_over_time(curve.name + "-" + run_slug(name, r) + ".csv", runs_[r].times),
            fmt::format("{0}:(${1} > 0 ? ${1} : NaN)", time, curve.column),
            "with lines linewidth 1.1 " + colour, result::legend_name(name)};
  }

  fs::path folder_;
  const ComparisonReport& report_;
  std::vector<result::PlottedRun> runs_;
};

bool is_picture_of_comparison(const fs::path& file) {
  const std::string stem = file.stem().string();
  if (result::is_picture(file)) return stem == "differences" || stem.starts_with("contact-");
  return file.extension() == ".csv" && (stem.starts_with("motion-") || stem.starts_with("forces-"));
}

}  // namespace

std::string run_slug(const std::string& name, std::size_t i) {
  return std::to_string(i + 1) + "-" + plain(name);
}

void begin_comparison_plots(const fs::path& directory) {
  result::begin_plot_folder(directory / "plots", is_picture_of_comparison);
}

std::vector<fs::path> write_comparison_plots(const fs::path& directory, const ComparisonReport& report,
                                             const result::PictureStyle& look) {
  const Pictures pictures(directory / "plots", report, look);
  result::PictureFiles files;  // the tables of the pictures exist already
  if (!pictures.any()) return {};
  const auto& contacts = report.runs.front().figures.facts.contacts;
  for (std::size_t k = 0; k < std::min(contacts.size(), max_contacts); ++k)
    files.add(pictures.first(),
              pictures.contact(k, fmt::format("contact-{}-{}", k + 1, plain(contacts[k].name))));
  if (!report.comparisons.empty()) files.add(pictures.first(), pictures.differences());
  return files.write(directory);
}

}  // namespace signorini::compare
