// member_cuts.hpp: N, V, M and stresses on the way along a piece of a member.
//
//   stress = N / area -+ i M / modulus      - to the left of the way, + to its right, which M > 0 stretches
//
// i: intensification, as given, or that of the member's bend.
#pragma once

#include "model/assembly/pieces.hpp"

namespace signorini {

/// From node to node; the piece may run the other way.
struct Way {
  const MeshPiece* piece = nullptr;
  bool backwards = false;
};

struct Wanted {
  OutputQuantity quantity = OutputQuantity::N;  ///< stress, or N, V, M
  Fibre fibre = Fibre::both;                    ///< of a stress: left or right
  double of_N = 1.0, of_M = 1.0;                ///< of a stress: factors of its parts
  std::optional<double> intensification = {};
};

/// What of a stress is asked for, as an output says it.
[[nodiscard]] Wanted wanted_by(const OutputSpec& spec, Fibre fibre);

/// Points of an element through which the quantity goes as a polynomial along it (base/along.hpp).
[[nodiscard]] std::size_t points_of(OutputQuantity quantity);

class MemberCuts {
 public:
  MemberCuts(const Scene& scene, const DofMap& map) : scene_(scene), map_(map) {}

  /// The k-th element on the way.
  [[nodiscard]] static std::size_t element_of(const Way& way, std::size_t k);
  /// At a part x of the k-th element on the way, 0 to 1. Errors: SceneError under `key` for a section whose stresses are
  /// not known.
  [[nodiscard]] Cut cut(const Way& way, std::size_t k, double x, const Wanted& wanted,
                        const SourcePlace& place, const std::string& key) const;
  /// At a station of the whole piece: k and x.
  [[nodiscard]] static std::pair<std::size_t, double> place_of(const Way& way, double station);

 private:
  [[nodiscard]] Cut force(const Way& way, std::size_t k, double x, OutputQuantity quantity) const;

  const Scene& scene_;
  const DofMap& map_;
};

}  // namespace signorini
