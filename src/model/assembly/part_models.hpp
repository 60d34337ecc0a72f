// part_models.hpp: splits a model into uncoupled models.
//
//   M, C, K, n_k, t_k:   block by block (parts.hpp);   P_i: restriction of P(t) to block i
//
// The contacts of one part are coupled with each other; the last part is everything without contacts. A part has the
// loads that act on it; loads that act nowhere belong to the first part. Scales, frequencies and factors are those of
// the whole model, so that decisions are the same as in the whole model.
#pragma once

#include <vector>

#include "signorini/model.hpp"

namespace signorini {

struct PartModel {
  Model model;                        ///< data needed by a run: without outputs, foreign names and drawing
  std::vector<int> dofs;              ///< its degrees of freedom in the whole model, ascending
  std::vector<std::size_t> contacts;  ///< its contacts in the whole model, ascending
};

/// Parts in the order of their first contacts. Empty if all contacts are coupled; if the model is reduced, has rigid
/// bodies or has outputs, which may be sums over parts; or if the histories are too long for one copy per part.
[[nodiscard]] std::vector<PartModel> part_models(const Model& model);

}  // namespace signorini
