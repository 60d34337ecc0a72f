// node_movers.hpp: displacement of the nodes of a scene: by a degree of freedom, a support, or none.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "signorini/result.hpp"
#include "signorini/scene.hpp"

namespace signorini {

class NodeMovers {
 public:
  NodeMovers(const Scene& scene, const Model& model);
  /// Displacement (order 0) or velocity (1) of a node of the scene along an axis (0: x).
  [[nodiscard]] double value(std::size_t node, std::size_t axis, const Sample& sample, int order = 0) const;

 private:
  struct Mover {
    int dof = -1;
    std::optional<History> given = {};
  };
  std::vector<std::array<Mover, 2>> movers_;
};

}  // namespace signorini
