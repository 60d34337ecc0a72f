// mortar.hpp: contact of two boundaries by dual mortar, in the undeformed geometry.
//
//   psi_k:  int psi_k N_j ds = delta_kj D_k,   D_k = int N_k ds         over the covered part of the slave edge
//   M_kl  = int psi_k N_l^m ds                                          over the overlaps, exact on straight edges
//   g_k   = n_k . (u_k - sum_l w_kl u_l) + g0_k,   w_kl = M_kl / D_k,   g0_k = n_k . (x_k - sum_l w_kl x_l)
//   n_k   = - int N_k nu ds / |...|                                     nu: outward normal of the slave
//
// Points of the slave are projected to the master along the normal of the slave edge's chord; the nearest of
// several master edges is used. A master edge behind the slave edge is an interference if it lies within the
// depth of the slave's body; edges beyond that depth are ignored. On a straight seam a constant pressure,
// force N_k = p D_k, is transmitted exactly, for any pair of meshes.
// Source: Wohlmuth, SIAM J. Numer. Anal. 38 (2000) 989; Popp, Gee, Wall, Int. J. Numer. Meth. Eng. 79 (2009)
// 1354; covered parts: Cichosz, Bischoff, Comput. Methods Appl. Mech. Eng. 200 (2011) 1317.
#pragma once

#include <array>
#include <functional>
#include <utility>
#include <vector>

#include "signorini/plane_mesh.hpp"

namespace signorini::mesh {

using PlanePoint = std::array<double, 2>;
using NodePosition = std::function<PlanePoint(int node)>;

struct MortarNode {
  int node = 0;
  double length = 0.0;                              ///< D_k
  PlanePoint normal{0.0, 0.0};                      ///< n_k
  std::vector<std::pair<int, double>> master = {};  ///< w_kl
  double gap = 0.0;  ///< g0_k; exactly zero if below the rounding of coordinates
};

/// Result: nodes of the slave that the master covers, in order along the slave.
struct MortarSeam {
  std::vector<MortarNode> nodes;
  std::vector<int> negative;  ///< nodes with D_k <= 0, which partly covered quadratic edges may have
  std::vector<int> corners;   ///< nodes whose two edges have normals that differ by more than 45 degrees
};

/// Contact of the slave with the master. outline: all known edges of the slave's body, which give its depth.
[[nodiscard]] MortarSeam mortar_between(const std::vector<PlaneMesh::Edge>& slave,
                                        const std::vector<PlaneMesh::Edge>& master, const NodePosition& place,
                                        const std::vector<PlaneMesh::Edge>& outline = {});
/// Contact with a ground that coincides with the slave: full coverage, zero gap.
[[nodiscard]] MortarSeam mortar_on_ground(const std::vector<PlaneMesh::Edge>& slave,
                                          const NodePosition& place);
/// Contact with a line through `point` with unit `normal`: g0_k = normal . (x_k - point).
[[nodiscard]] MortarSeam mortar_on_line(const std::vector<PlaneMesh::Edge>& slave, const PlanePoint& point,
                                        const PlanePoint& normal, const NodePosition& place);

}  // namespace signorini::mesh
