#include "result/seam_table.hpp"

namespace signorini {

const CsvTable<SeamRow>& seam_table() {
  using R = SeamRow;
  static const CsvTable<R> table = {{"t", &R::t},       {"seam", &R::seam},     {"N", &R::N},
                                    {"T", &R::T},       {"moment", &R::moment}, {"stick", &R::stick},
                                    {"slip", &R::slip}, {"open", &R::open}};
  return table;
}

SeamRow seam_row(const Scene& scene, const SeamSpec& seam, double t,
                 const std::vector<ContactSample>& contacts) {
  SeamRow row{t, seam.name};
  double length = 0.0, x = 0.0, y = 0.0;
  const auto place = [&](const SeamNode& k) -> const Node& {
    return scene.nodes[static_cast<std::size_t>(k.node)];
  };
  for (const SeamNode& k : seam.nodes) {
    length += k.length;
    x += k.length * place(k).x;
    y += k.length * place(k).y;
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
    row.moment += (place(k).x - x) * fy - (place(k).y - y) * fx;
    (is_open(c.state) ? row.open : kind_of(c.state) == State::stick ? row.stick : row.slip) += k.length;
  }
  return row;
}

}  // namespace signorini
