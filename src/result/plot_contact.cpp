#include <fmt/core.h>

#include "result/plot_parts.hpp"

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
  const std::string limit = fmt::format("{}*abs($8)", friction);
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
        data_(contact_rows(run, k)) {}

  [[nodiscard]] std::string text() const {
    // From the top, as parts of the height: states, N, T, gap (none for sliders), sliding.
    const bool slider = contact_.slider;
    const std::vector<double> edges = slider ? std::vector<double>{0.885, 0.635, 0.345, 0.0, 0.075}
                                             : std::vector<double>{0.905, 0.715, 0.49, 0.285, 0.065};
    const std::vector<double> tops = slider ? std::vector<double>{0.915, 0.86, 0.61, 0.0, 0.32}
                                            : std::vector<double>{0.93, 0.885, 0.695, 0.47, 0.265};
    std::string s =
        begin_script(run_, {"contact-" + run_.slugs[k_] + run_.suffix,
                            say(run_, "Contact '{}'", contact_.name) + ", " + friction_text(run_, contact_),
                            slider ? 860 : 1040});
    s += states(edges[0], tops[0]) + normal_force(edges[1], tops[1]) + friction_force(edges[2], tops[2]);
    if (!slider) s += gap(edges[3], tops[3]);
    return s + sliding(edges[4], tops[4]) + end_script();
  }

 private:
  [[nodiscard]] std::string states(double bottom, double top) const {
    return panel(run_, bottom, top, "", false) + "unset ytics\nset grid noxtics noytics\nset yrange [0:1]\n" +
           plot_command(band_elements(run_, k_, 1.0)) + "set grid xtics ytics\n";
  }

  [[nodiscard]] std::string normal_force(double bottom, double top) const {
    auto elements = bands();
    elements.push_back(curve(8, "#1a1a1a", "N"));
    const auto legend = band_legend(run_, k_);
    elements.insert(elements.end(), legend.begin(), legend.end());
    // N <= 0; a constant one stands below zero
    return panel(run_, bottom, top, "N [" + units_.force + "]", false) + "set yrange [*:0] noextend\n" +
           plot_command(elements);
  }

  [[nodiscard]] std::string friction_force(double bottom, double top) const {
    auto elements = bands();
    if (contact_.static_friction > 0.0) {
      const bool one = contact_.static_friction == contact_.kinetic_friction;
      const std::string red = "linecolor '#c0182b' linewidth 1.0";
      const auto outer = limit_elements(data_, contact_.static_friction,
                                        say(run_, one ? "limits" : "static") + " ±f|N|", red);
      elements.insert(elements.end(), outer.begin(), outer.end());
      if (!one) {
        const auto inner = limit_elements(data_, contact_.kinetic_friction,
                                          say(run_, "kinetic limit") + " ±f|N|", red + " dashtype 2");
        elements.insert(elements.end(), inner.begin(), inner.end());
      }
    }
    elements.push_back(curve(9, "#1a1a1a", "T"));
    return panel(run_, bottom, top, "T [" + units_.force + "]", false) + plot_command(elements);
  }

  /// On its own scale: a lift-off is small beside the sliding.
  [[nodiscard]] std::string gap(double bottom, double top) const {
    auto elements = bands();
    elements.push_back(curve(4, "#2166ac", say(run_, "gap g")));
    return panel(run_, bottom, top, "g [" + units_.length + "]", false) + plot_command(elements);
  }

  [[nodiscard]] std::string sliding(double bottom, double top) const {
    auto elements = bands();
    elements.push_back(curve(5, "#1a1a1a", say(run_, "motion ut")));
    elements.push_back(curve(7, "#b35806", say(run_, "slip p"), " dashtype 2"));
    return panel(run_, bottom, top, "[" + units_.length + "]", true) + plot_command(elements);
  }

  [[nodiscard]] std::vector<std::string> bands() const { return band_elements(run_, k_, 0.28); }
  /// Of a column of the contact's table, counted from 1.
  [[nodiscard]] std::string curve(int column, const char* colour, const std::string& title,
                                  const char* look = "") const {
    return fmt::format("{} using 1:{} with lines linewidth 1.4 linecolor '{}'{} title {}", data_, column,
                       colour, look, quoted(title));
  }

  const PlottedRun& run_;
  std::size_t k_;
  const RunFacts::Contact& contact_;
  const Units& units_;
  std::string data_;
};

}  // namespace

std::string contact_script(const PlottedRun& run, std::size_t k) { return ContactScript(run, k).text(); }

std::string states_script(const PlottedRun& run) {
  const std::size_t count = run.facts.contacts.size();
  const int height = 150 + static_cast<int>(34 * count);
  std::string s = begin_script(run, {"states", say(run, "States of the contacts"), height});
  const double line = 1.0 / height;
  s += panel(run, 62.0 * line, 1.0 - 64.0 * line, "", true);
  s += fmt::format("set yrange [{}.5:-0.5]\nset y2range [{}.5:-0.5]\nset grid noxtics noytics\n", count - 1,
                   count - 1);
  s += "set ytics (";
  for (std::size_t k = 0; k < count; ++k) {
    s += (k > 0 ? ", " : "") + quoted_tick(run.facts.contacts[k].name) + fmt::format(" {}", k);
  }
  s += ") scale 0\n";
  std::vector<std::string> elements;
  for (const std::string& state : state_names()) {
    bool named = false;
    for (std::size_t k = 0; k < count; ++k) {
      bool occurs = false;
      for (const auto& band : run.bands[k]) occurs = occurs || band.state == state;
      if (!occurs) continue;
      elements.push_back(quoted("states-" + run.slugs[k] + ".csv") + " skip 1 using (strcol(3) eq " +
                         quoted(state) + fmt::format(" ? $1 : NaN):({0}):1:2:({0}-0.38):({0}+0.38)", k) +
                         " with boxxy fillstyle solid 1.0 noborder linecolor '" + state_colour(state) + "' " +
                         (named ? "notitle" : "title " + quoted(say(run, state))));
      named = true;
    }
  }
  s += plot_command(elements);
  return s + end_script();
}

}  // namespace signorini
