#include <fmt/core.h>

#include "result/plot_parts.hpp"

namespace signorini {

namespace {

std::string friction_text(const RunFacts::Contact& contact) {
  if (contact.static_friction == 0.0) return "no friction";
  if (contact.static_friction == contact.kinetic_friction) {
    return fmt::format("friction {}", contact.static_friction);
  }
  return fmt::format("friction {} static, {} kinetic", contact.static_friction, contact.kinetic_friction);
}

// A column of this contact's rows of contacts.csv.
std::string rows(const PlottedRun& run, std::size_t k) {
  return "'../contacts.csv' skip 1" + every(run, run.facts.contacts.size(), k);
}

std::vector<std::string> limit_elements(const std::string& data, double friction, const std::string& name,
                                        const std::string& look) {
  const std::string limit = fmt::format("{}*abs($8)", friction);
  return {data + " using 1:(" + limit + ") with lines " + look + " title " + quoted(name),
          data + " using 1:(-" + limit + ") with lines " + look + " notitle"};
}

}  // namespace

std::string contact_script(const PlottedRun& run, std::size_t k) {
  const RunFacts::Contact& contact = run.facts.contacts[k];
  const Units& units = run.facts.units;
  const std::string data = rows(run, k);
  const std::string curve = " with lines linewidth 1.4 linecolor '#1a1a1a' title ";

  // From the top, as parts of the height: states, N, T, gap (none for sliders), sliding.
  const bool slider = contact.slider;
  const std::vector<double> edges = slider ? std::vector<double>{0.885, 0.635, 0.345, 0.0, 0.075}
                                           : std::vector<double>{0.905, 0.715, 0.49, 0.285, 0.065};
  const std::vector<double> tops = slider ? std::vector<double>{0.915, 0.86, 0.61, 0.0, 0.32}
                                          : std::vector<double>{0.93, 0.885, 0.695, 0.47, 0.265};

  std::string s =
      begin_script(run, {"contact-" + run.slugs[k] + run.suffix,
                         "Contact '" + contact.name + "', " + friction_text(contact), slider ? 860 : 1040});

  s += panel(run, edges[0], tops[0], "", false);
  s += "unset ytics\nset grid noxtics noytics\n";
  s += "set yrange [0:1]\n" + plot_command(band_elements(run, k, 1.0));
  s += "set grid xtics ytics\n";

  s += panel(run, edges[1], tops[1], "N [" + units.force + "]", false);
  s += "set yrange [*:0] noextend\n";  // N <= 0; a constant one stands below zero
  auto elements = band_elements(run, k, 0.28);
  elements.push_back(data + " using 1:8" + curve + quoted("N"));
  const auto legend = band_legend(run, k);
  elements.insert(elements.end(), legend.begin(), legend.end());
  s += plot_command(elements);

  s += panel(run, edges[2], tops[2], "T [" + units.force + "]", false);
  elements = band_elements(run, k, 0.28);
  if (contact.static_friction > 0.0) {
    const bool one = contact.static_friction == contact.kinetic_friction;
    const std::string red = "linecolor '#c0182b' linewidth 1.0";
    const auto outer =
        limit_elements(data, contact.static_friction, one ? "limits ±f|N|" : "static ±f|N|", red);
    elements.insert(elements.end(), outer.begin(), outer.end());
    if (!one) {
      const auto inner = limit_elements(data, contact.kinetic_friction, "kinetic ±f|N|", red + " dashtype 2");
      elements.insert(elements.end(), inner.begin(), inner.end());
    }
  }
  elements.push_back(data + " using 1:9" + curve + quoted("T"));
  s += plot_command(elements);

  if (!slider) {  // its own scale: a lift-off is small beside the sliding
    s += panel(run, edges[3], tops[3], "g [" + units.length + "]", false);
    elements = band_elements(run, k, 0.28);
    elements.push_back(data + " using 1:4 with lines linewidth 1.4 linecolor '#2166ac' title " +
                       quoted("gap g"));
    s += plot_command(elements);
  }
  s += panel(run, edges[4], tops[4], "[" + units.length + "]", true);
  elements = band_elements(run, k, 0.28);
  elements.push_back(data + " using 1:5 with lines linewidth 1.4 linecolor '#1a1a1a' title " +
                     quoted("motion ut"));
  elements.push_back(data + " using 1:7 with lines linewidth 1.4 linecolor '#b35806' dashtype 2 title " +
                     quoted("slip p"));
  s += plot_command(elements);
  return s + end_script();
}

std::string states_script(const PlottedRun& run) {
  const std::size_t count = run.facts.contacts.size();
  const int height = 150 + static_cast<int>(34 * count);
  std::string s = begin_script(run, {"states", "States of the contacts", height});
  const double line = 1.0 / height;
  s += panel(run, 62.0 * line, 1.0 - 64.0 * line, "", true);
  s += fmt::format("set yrange [{}.5:-0.5]\nset y2range [{}.5:-0.5]\nset grid noxtics noytics\n", count - 1,
                   count - 1);
  s += "set ytics (";
  for (std::size_t k = 0; k < count; ++k) {
    s += (k > 0 ? ", " : "") + quoted(run.facts.contacts[k].name) + fmt::format(" {}", k);
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
                         (named ? "notitle" : "title " + quoted(state)));
      named = true;
    }
  }
  s += plot_command(elements);
  return s + end_script();
}

}  // namespace signorini
