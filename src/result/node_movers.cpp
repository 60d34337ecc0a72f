#include "result/node_movers.hpp"

#include "model/assembly/loads.hpp"

namespace signorini {

NodeMovers::NodeMovers(const Scene& scene, const Model& model) : movers_(scene.nodes.size()) {
  for (std::size_t n = 0; n < scene.nodes.size(); ++n)  // they are the first drawn nodes, in the same order
    for (const std::size_t c : {0U, 1U}) movers_[n][c].dof = model.drawn_nodes[n].dofs[c];
  for (const Support& support : scene.supports) {
    if (!support.motion || support.rz) continue;
    for (std::size_t n = 0; n < scene.nodes.size(); ++n)
      if (scene.nodes[n].name == support.node)
        movers_[n][support.ux ? 0 : 1].given = motion_of_support(scene, support);
  }
}

double NodeMovers::value(std::size_t node, std::size_t axis, const Sample& sample, int order) const {
  const Mover& mover = movers_[node][axis];
  if (mover.given) return mover.given->piece(sample.t).value(sample.t, order);
  return mover.dof >= 0 ? (order == 0 ? *sample.u : *sample.v)[mover.dof] : 0.0;
}

}  // namespace signorini
