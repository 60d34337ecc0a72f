#include <fmt/core.h>

#include "result/plot_parts.hpp"
#include "result/run_tables.hpp"

namespace signorini {

namespace {

std::string friction_text(const PlottedRun& run, const RunFacts::Contact& contact) {
  if (contact.static_friction == 0.0) return say(run, "no friction");
  if (contact.static_friction == contact.kinetic_friction) {
    return say(run, "friction {}", contact.static_friction);
  }
  return say(run, "friction {} static, {} kinetic", contact.static_friction, contact.kinetic_friction);
}

std::vector<std::string> limit_elements(const std::string& data, double friction, const std::string& name,
                                        const std::string& look) {
  const std::string limit = fmt::format("{}*abs({})", friction, contact_table().value("N"));
  return {data + " using 1:(" + limit + ") with lines " + look + " title " + quoted(name),
          data + " using 1:(-" + limit + ") with lines " + look + " notitle"};
}

/// One contact's picture, panel by panel.
class ContactScript {
 public:
  ContactScript(const PlottedRun& run, std::size_t k)
      : run_(run),
        k_(k),
        contact_(run.facts.contacts[k]),
        units_(run.facts.units),
        data_(contact_rows(run, k)),
        ranges_(run.ranges[k]),
        scales_(scales_of(run.ranges)) {}

  /// From the top: states, N, T (not without friction), gap (none for sliders), motion along the tangent.
  [[nodiscard]] std::string text() const {
    const std::vector<Part> rows = parts();
    constexpr double space = 21.0;
    double height = room_above + room_below - space;
    std::vector<double> weights;
    for (const Part& row : rows) {
      weights.push_back(row.weight);
      height += row.weight + space;
    }
    const Canvas canvas = canvas_of(run_.look, height, true);
    const std::vector<PanelEdges> edges = stacked(weights, canvas, space);
    std::string s = begin_script(
        run_, {"contact-" + run_.slugs[k_] + run_.suffix,
               say(run_, "Contact '{}'", contact_.name) + ", " + friction_text(run_, contact_), canvas});
    for (std::size_t i = 0; i < rows.size(); ++i)
      s += panel(run_, canvas, edges[i], rows[i].axis, i + 1 == rows.size()) + (this->*rows[i].plot)();
    return s + end_script();
  }

 private:
  struct Part {
    double weight;     ///< of the height
    std::string axis;  ///< its name
    std::string (ContactScript::*plot)() const;
  };

  [[nodiscard]] std::vector<Part> parts() const {
    const std::string force = " [" + units_.force + "]", length = "[" + units_.length + "]";
    const bool rubs = contact_.static_friction > 0.0;
    std::vector<Part> list = {{26.0, "", &ContactScript::states},
                              {177.0, "N" + force, &ContactScript::normal_force}};
    if (rubs) list.push_back({213.0, "T" + force, &ContactScript::friction_force});
    // On its own scale: a lift-off is small beside the sliding.
    if (!contact_.slider) list.push_back({192.0, "g " + length, &ContactScript::gap});
    // A wheel or a guide moves along its tangent, too; one that only rounding moves says nothing there.
    if (rubs || !is_rounding(ranges_.ut, scales_.length))
      list.push_back({208.0, length, &ContactScript::sliding});
    return list;
  }

  [[nodiscard]] std::string states() const {
    return "unset ytics\nset grid noxtics noytics\nset yrange [0:1]\n" +
           plot_command(band_elements(run_, k_, 1.0)) + "set grid xtics ytics\n";
  }

  [[nodiscard]] std::string normal_force() const {
    auto elements = bands();
    elements.push_back(curve("N", "#1a1a1a", "N"));
    const auto legend = band_legend(run_, k_);
    elements.insert(elements.end(), legend.begin(), legend.end());
    // N <= 0; a constant one stands below zero
    const bool none = is_rounding(ranges_.N, scales_.force);
    return (none ? steady(ranges_.N, scales_.force) : "set yrange [*:0] noextend\n") + plot_command(elements);
  }

  [[nodiscard]] std::string friction_force() const {
    auto elements = bands();
    const bool one = contact_.static_friction == contact_.kinetic_friction;
    const std::string red = "linecolor '#c0182b' linewidth 1.0";
    const auto outer =
        limit_elements(data_, contact_.static_friction, say(run_, one ? "limits" : "static") + " ±f|N|", red);
    elements.insert(elements.end(), outer.begin(), outer.end());
    if (!one) {
      const auto inner = limit_elements(data_, contact_.kinetic_friction,
                                        say(run_, "kinetic limit") + " ±f|N|", red + " dashtype 2");
      elements.insert(elements.end(), inner.begin(), inner.end());
    }
    elements.push_back(curve("T", "#1a1a1a", "T"));
    Range range = ranges_.T;
    const double limit = contact_.static_friction * ranges_.N.size();
    range.take(limit);
    range.take(-limit);
    return steady(range, scales_.force) + plot_command(elements);
  }

  [[nodiscard]] std::string gap() const {
    auto elements = bands();
    elements.push_back(curve("gap", "#2166ac", say(run_, "gap g")));
    return steady(ranges_.gap, scales_.length) + plot_command(elements);
  }

  [[nodiscard]] std::string sliding() const {
    auto elements = bands();
    elements.push_back(curve("ut", "#1a1a1a", say(run_, "motion ut")));
    Range range = ranges_.ut;
    if (contact_.static_friction > 0.0) {
      elements.push_back(curve("slip", "#b35806", say(run_, "slip p"), " dashtype 2"));
      range.take(ranges_.slip);
    }
    return steady(range, scales_.length) + plot_command(elements);
  }

  [[nodiscard]] std::vector<std::string> bands() const { return band_elements(run_, k_, 0.28); }
  /// Of a column of the contact's table.
  [[nodiscard]] std::string curve(std::string_view column, const char* colour, const std::string& title,
                                  const char* look = "") const {
    return fmt::format("{} using 1:{} with lines linewidth 1.4 linecolor '{}'{} title {}", data_,
                       contact_table().number(column), colour, look, quoted(title));
  }

  const PlottedRun& run_;
  std::size_t k_;
  const RunFacts::Contact& contact_;
  const Units& units_;
  std::string data_;
  const ContactRanges& ranges_;
  ContactScales scales_;
};

}  // namespace

std::string contact_script(const PlottedRun& run, std::size_t k) { return ContactScript(run, k).text(); }

std::string states_script(const PlottedRun& run) {
  const std::size_t count = run.facts.contacts.size();
  const double row = row_height(34.0, count, run.look);
  const Canvas canvas =
      canvas_of(run.look, room_above + room_below + 24.0 + row * static_cast<double>(count), true, true);
  std::string s = begin_script(run, {"states", say(run, "States of the contacts"), canvas});
  s += panel(run, canvas, stacked(0, 1, canvas), "", true);
  s += fmt::format("set yrange [{}.5:-0.5]\nset y2range [{}.5:-0.5]\nset grid noxtics noytics\n", count - 1,
                   count - 1);
  s += row_ticks(run.facts.contacts, row);
  std::vector<std::string> elements;
  for (const std::string& state : state_names()) {
    bool named = false;
    for (std::size_t k = 0; k < count; ++k) {
      bool occurs = false;
      for (const auto& band : run.bands[k]) occurs = occurs || band.state == state;
      if (!occurs) continue;
      elements.push_back(quoted("states-" + run.slugs[k] + ".csv") + " skip 1 using " + band_at(state) +
                         fmt::format(":({0}):1:2:({0}-0.38):({0}+0.38)", k) +
                         " with boxxy fillstyle solid 1.0 noborder linecolor '" + state_colour(state) + "' " +
                         (named ? "notitle" : "title " + quoted(say(run, state))));
      named = true;
    }
  }
  s += plot_command(elements);
  return s + end_script();
}

}  // namespace signorini
