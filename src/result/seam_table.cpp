#include "result/seam_table.hpp"

namespace signorini {

const CsvTable<SeamRow>& seam_table() {
  using R = SeamRow;
  static const CsvTable<R> table = {{"t", &R::t},       {"seam", &R::seam},     {"N", &R::N},
                                    {"T", &R::T},       {"moment", &R::moment}, {"stick", &R::stick},
                                    {"slip", &R::slip}, {"open", &R::open}};
  return table;
}

SeamRow seam_row(const SeamSpec& seam, double t, const std::vector<ContactSample>& contacts) {
  SeamRow row{t, seam.name};
  double length = 0.0, x = 0.0, y = 0.0;
  for (const SeamNode& k : seam.nodes) {
    length += k.length;
    x += k.length * k.at[0];
    y += k.length * k.at[1];
  }
  x /= length;
  y /= length;
  for (std::size_t i = 0; i < seam.nodes.size(); ++i) {
    const SeamNode& k = seam.nodes[i];
    const ContactSample& c = contacts[seam.first_contact + i];
    row.N += c.N;
    row.T += c.T;
    const auto [nx, ny] = k.normal;  // the tangent is (ny, -nx)
    const double fx = -c.N * nx - c.T * ny, fy = -c.N * ny + c.T * nx;
    row.moment += (k.at[0] - x) * fy - (k.at[1] - y) * fx;
    (is_open(c.state) ? row.open : kind_of(c.state) == State::stick ? row.stick : row.slip) += k.length;
  }
  return row;
}

}  // namespace signorini
