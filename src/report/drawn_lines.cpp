#include "report/drawn_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "result/frame_data.hpp"

namespace signorini {
namespace {

constexpr int parts = 10;  // segments of a bent line

Json row_of(double s, const LineShapes& h) { return {s, h.a, h.turn_a, h.b, h.turn_b}; }

Json rows_of(int count, bool hinged_a, bool hinged_b) {
  Json rows = Json::array();
  for (int i = 0; i <= count; ++i) {
    const double s = static_cast<double>(i) / count;
    rows.push_back(row_of(s, cubic_at(s, hinged_a, hinged_b)));
  }
  return rows;
}

/// Range from the smallest to the largest coordinate; 1 for a single node.
double extent_of(const Json& nodes, const char* coordinate) {
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  for (const Json& node : nodes) {
    least = std::min(least, node[coordinate].get<double>());
    greatest = std::max(greatest, node[coordinate].get<double>());
  }
  return nodes.size() < 2 ? 1.0 : greatest - least;
}

}  // namespace

Json shapes_json() {
  return {rows_of(1, true, true), rows_of(parts, false, false), rows_of(parts, true, false),
          rows_of(parts, false, true)};
}

int shape_of(const MemberLine& line) {
  if (!line.bends || (line.hinged_from && line.hinged_to)) return 0;
  return line.hinged_from ? 2 : line.hinged_to ? 3 : 1;
}

LineShapes across_of(const Json& row) {
  return {row[1].get<double>(), row[2].get<double>(), row[3].get<double>(), row[4].get<double>()};
}

double fitting_magnification(const Json& nodes, const Json& curve, double greatest) {
  for (const Json& node : nodes)
    for (const std::size_t c : {0U, 1U})
      if (const int column = node["u"][c].get<int>(); column >= 0)
        for (const Json& u : curve["columns"][static_cast<std::size_t>(column)]["u"])
          if (u.is_number()) greatest = std::max(greatest, std::abs(u.get<double>()));
  return magnification_of(std::max(extent_of(nodes, "x"), extent_of(nodes, "y")), greatest);
}

}  // namespace signorini
