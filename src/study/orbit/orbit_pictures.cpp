#include "study/orbit/orbit_pictures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "result/csv_read.hpp"
#include "result/table.hpp"

namespace signorini {
namespace {

constexpr std::size_t most_portraits = 3;
constexpr const char* portrait_colours[] = {"#1f77b4", "#d95f02", "#1b9e77"};

/// Columns of history.csv for one degree of freedom.
struct Portrait {
  std::string u_name;
  std::size_t u, v;  // columns
  double least = 0.0, greatest = 0.0;
  [[nodiscard]] double range() const { return greatest - least; }
};

/// "A.ux" and "A.vx", "d0.u" and "d0.v": a name, a dot, u or v, a direction.
std::vector<Portrait> portraits_of(const std::vector<std::string>& header) {
  std::vector<Portrait> list;
  for (std::size_t i = 0; i < header.size(); ++i) {
    const std::size_t point = header[i].rfind('.');
    if (point == std::string::npos || point + 1 >= header[i].size() || header[i][point + 1] != 'u') continue;
    std::string rate = header[i];
    rate[point + 1] = 'v';
    const auto found = std::find(header.begin(), header.end(), rate);
    if (found != header.end())
      list.push_back({header[i], i, static_cast<std::size_t>(found - header.begin())});
  }
  return list;
}

/// The phase portraits with the largest ranges.
std::vector<Portrait> greatest_portraits(const std::filesystem::path& directory) {
  CsvReader reader(directory / "history.csv");
  std::vector<Portrait> list = portraits_of(reader.header());
  for (bool first = true; reader.next(); first = false)
    for (Portrait& p : list) {
      const double u = reader.number(p.u);
      p.least = first ? u : std::min(p.least, u);
      p.greatest = first ? u : std::max(p.greatest, u);
    }
  std::stable_sort(list.begin(), list.end(),
                   [](const Portrait& a, const Portrait& b) { return a.range() > b.range(); });
  if (list.size() > most_portraits) list.resize(most_portraits);
  return list;
}

Picture phase_picture(const std::vector<Portrait>& portraits, const Units& units, const PictureLook& look) {
  Picture picture{"phase", "Velocity over displacement, one period",
                  canvas_of(look, 120.0 + 420.0 * static_cast<double>(portraits.size()), false), false};
  picture.space = 70.0;
  for (const Portrait& p : portraits) {
    const std::size_t i = static_cast<std::size_t>(&p - portraits.data());
    std::string rate = p.u_name;
    rate[rate.rfind('.') + 1] = 'v';
    Panel panel{
        rate + " [" + units.length + "/" + units.time + "]",
        {{"'../history.csv' skip 1", fmt::format("{}:{}", p.u + 1, p.v + 1),
          fmt::format("with lines linewidth 1.6 linecolor '{}'", portrait_colours[i]),
          p.u_name.substr(0, p.u_name.rfind('.'))}},
        "set xrange [*:*]\nset xlabel " + signorini::quoted(p.u_name + " [" + units.length + "]") + "\n"};
    panel.own_axis = true;
    picture.panels.push_back(panel);
  }
  return picture;
}

std::vector<std::complex<double>> unit_circle() {
  constexpr int pieces = 180;
  std::vector<std::complex<double>> list;
  for (int i = 0; i <= pieces; ++i)
    list.push_back(std::polar(1.0, 2.0 * std::numbers::pi * static_cast<double>(i) / pieces));
  return list;
}

Picture multiplier_picture(const Orbit& orbit, const PictureLook& look) {
  const double greatest =
      std::max(1.0, orbit.multipliers.empty() ? 0.0 : std::abs(orbit.multipliers.front()));
  Picture picture{"multipliers", "Floquet multipliers and the unit circle", canvas_of(look, 760.0, false),
                  false};
  Panel panel{"imaginary part",
              {{"'circle.csv' skip 1", "1:2", "with lines linewidth 1.0 linecolor '#888888'", "unit circle"},
               {"'multipliers.csv' skip 1", "1:2",
                "with points pointtype 7 pointsize 1.0 linecolor '#c0182b'", "multipliers"}},
              "set size ratio -1\n" + range_of('x', -1.1 * greatest, 1.1 * greatest) +
                  range_of('y', -1.1 * greatest, 1.1 * greatest) + "set xlabel 'real part'\n"};
  panel.after = "set size noratio\n";
  picture.panels.push_back(panel);
  return picture;
}

}  // namespace

bool is_picture_of_orbit(const std::filesystem::path& file) {
  return file.stem() == "multipliers" || file.stem() == "circle" || file.stem() == "phase";
}

PictureFiles orbit_pictures(const std::filesystem::path& directory, const std::string& title,
                            const Units& units, const Orbit& orbit, const PictureLook& look) {
  PictureFiles files(is_picture_of_orbit);
  const PlottedRun run = untold_run(title, units, look);
  if (!orbit.multipliers.empty()) {
    using Row = std::complex<double>;
    const CsvTable<Row> table = {{"real", [](const Row& mu) { return mu.real(); }},
                                 {"imaginary", [](const Row& mu) { return mu.imag(); }}};
    files.add_table("multipliers", table.text(orbit.multipliers));
    files.add_table("circle", table.text(unit_circle()));
    files.add(run, multiplier_picture(orbit, look));
  }
  const std::vector<Portrait> portraits = greatest_portraits(directory);
  if (!portraits.empty()) files.add(run, phase_picture(portraits, units, look));
  return files;
}

}  // namespace signorini
