// part_models.hpp: a model as several that nothing couples.
//
//   M, C, K, n_k, t_k:   block by block (parts.hpp);   P_i: what of P(t) acts on the block i
//
// A part has contacts that reach each other; what no contact reaches is one part more, the last. Each has a load if that
// acts on it; one that acts on nothing is the first's. Scales, frequencies and factors are those of the whole, so that
// what is decided by them is decided as there.
#pragma once

#include <vector>

#include "signorini/model.hpp"

namespace signorini {

struct PartModel {
  Model model;            ///< what runs of a model need: no outputs, no names but its own, nothing drawn
  std::vector<int> dofs;  ///< its own in the whole, ascending
  std::vector<std::size_t> contacts;  ///< the same
};

/// In the order of their first contacts. Empty: contacts reach each other, or the model is one of amplitudes, of rigid
/// bodies, or asks for outputs, which may be sums over parts; or its loads are histories too long for a copy a part.
[[nodiscard]] std::vector<PartModel> part_models(const Model& model);

}  // namespace signorini
