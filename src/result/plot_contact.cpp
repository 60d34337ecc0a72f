#include <fmt/core.h>

#include <algorithm>
#include <utility>

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

/// Picture of one contact, panel by panel.
class ContactPicture {
 public:
  ContactPicture(const PlottedRun& run, std::size_t k)
      : run_(run),
        k_(k),
        contact_(run.facts.contacts[k]),
        rows_(contact_rows(run, k)),
        ranges_(run.ranges[k]),
        scales_(scales_of(run.ranges)) {}

  /// From the top: states, N, T (only with friction), gap (not for sliders), tangential motion.
  [[nodiscard]] Picture picture() const {
    Picture p{"contact-" + run_.slugs[k_] + run_.suffix,
              say(run_, "Contact '{}'", contact_.name) + ", " + friction_text(run_, contact_),
              {}};
    p.space = 21.0;
    const bool rubs = contact_.static_friction > 0.0;
    p.panels = {states(), normal_force()};
    if (rubs) p.panels.push_back(friction_force());
    // on its own scale: a lift-off is small compared with the sliding
    if (!contact_.slider)
      p.panels.push_back(panel(192.0, "g " + length(), {curve("gap", "#2166ac", say(run_, "gap g"))},
                               steady(ranges_.gap, scales_.length)));
    // A wheel or a guide also moves along its tangent; a motion of rounding size is not drawn.
    if (rubs || !is_rounding(ranges_.ut, scales_.length)) p.panels.push_back(sliding());
    double height = room_above + room_below - p.space;
    for (const Panel& panel : p.panels) height += panel.weight + p.space;
    p.canvas = canvas_of(run_.look, height, true);
    return p;
  }

 private:
  [[nodiscard]] std::string length() const { return "[" + run_.facts.units.length + "]"; }
  [[nodiscard]] std::string force() const { return " [" + run_.facts.units.force + "]"; }

  /// A panel with curves in front of the states.
  [[nodiscard]] Panel panel(double weight, const std::string& label, const std::vector<Curve>& curves,
                            const std::string& axes) const {
    Panel p{label, bands_of(run_, k_, 0.28), axes, weight};
    p.curves.insert(p.curves.end(), curves.begin(), curves.end());
    return p;
  }

  [[nodiscard]] Panel states() const {
    return {"", bands_of(run_, k_, 1.0), "unset ytics\nset grid noxtics noytics\nset yrange [0:1]\n", 26.0,
            "set grid xtics ytics\n"};
  }

  [[nodiscard]] Panel normal_force() const {
    std::vector<Curve> curves = band_legend(run_, k_);
    curves.insert(curves.begin(), curve("N", "#1a1a1a", "N"));
    // N <= 0; a constant N is drawn below zero
    const bool none = is_rounding(ranges_.N, scales_.force);
    return panel(177.0, "N" + force(), curves,
                 none ? steady(ranges_.N, scales_.force) : "set yrange [*:0] noextend\n");
  }

  [[nodiscard]] Panel friction_force() const {
    std::vector<Curve> curves;
    const auto limits = [&](double f, const std::string& name, const std::string& dash) {
      const std::string at = fmt::format("{}:", contact_table().number("t"));
      const std::string limit = fmt::format("{}*abs({})", f, contact_table().value("N"));
      const std::string look = "with lines linecolor '#c0182b' linewidth 1.0" + dash;
      curves.push_back({rows_, at + "(" + limit + ")", look, name + " ±f|N|"});
      curves.push_back({rows_, at + "(-" + limit + ")", look});
    };
    const bool one = contact_.static_friction == contact_.kinetic_friction;
    limits(contact_.static_friction, say(run_, one ? "limits" : "static"), "");
    if (!one) limits(contact_.kinetic_friction, say(run_, "kinetic limit"), " dashtype 2");
    curves.push_back(curve("T", "#1a1a1a", "T"));
    Range range = ranges_.T;
    const double limit = contact_.static_friction * ranges_.N.size();
    range.take(limit);
    range.take(-limit);
    return panel(213.0, "T" + force(), curves, steady(range, scales_.force));
  }

  [[nodiscard]] Panel sliding() const {
    std::vector<Curve> curves = {curve("ut", "#1a1a1a", say(run_, "motion ut"))};
    Range range = ranges_.ut;
    if (contact_.static_friction > 0.0) {
      curves.push_back(curve("slip", "#b35806", say(run_, "slip p"), " dashtype 2"));
      range.take(ranges_.slip);
    }
    return panel(208.0, length(), curves, steady(range, scales_.length));
  }

  /// Curve of a column of the contact's table.
  [[nodiscard]] Curve curve(std::string_view column, const char* colour, const std::string& title,
                            const char* look = "") const {
    return {rows_, fmt::format("{}:{}", contact_table().number("t"), contact_table().number(column)),
            fmt::format("with lines linewidth 1.4 linecolor '{}'{}", colour, look), title};
  }

  const PlottedRun& run_;
  std::size_t k_;
  const RunFacts::Contact& contact_;
  std::string rows_;
  const ContactRanges& ranges_;
  ContactScales scales_;
};

}  // namespace

Picture contact_picture(const PlottedRun& run, std::size_t k) { return ContactPicture(run, k).picture(); }

Picture states_picture(const PlottedRun& run) {
  const std::size_t count = run.facts.contacts.size();
  const double row = row_height(34.0, count, run.look);
  Panel panel{"", {}};
  panel.axes = fmt::format("set yrange [{0}.5:-0.5]\nset y2range [{0}.5:-0.5]\nset grid noxtics noytics\n",
                           count - 1) +
               row_tics(run.facts.contacts, row);
  for (const std::string& state : state_names()) {
    std::optional<std::string> name = say(run, state);
    for (std::size_t k = 0; k < count; ++k) {
      const double y = static_cast<double>(k);
      std::optional<Curve> curve = band_curve(run, k, state, y - 0.38, y + 0.38, 1.0);
      if (!curve) continue;
      curve->name = std::exchange(name, std::nullopt);
      panel.curves.push_back(*curve);
    }
  }
  return {"states",
          say(run, "States of the contacts"),
          canvas_of(run.look, room_above + room_below + 24.0 + row * static_cast<double>(count), true, true),
          true,
          {panel}};
}

}  // namespace signorini
