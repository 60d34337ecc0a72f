// member_cuts.hpp: N, V, M and stresses along a piece of a member.
//
//   stress = N / area -+ i M / modulus      - on the left of the way, + on its right, where M > 0 is tensile
//
// i: stress intensification, as given, or that of the member's bend.
#pragma once

#include "model/assembly/pieces.hpp"

namespace signorini {

/// A way from node to node; the piece may have the opposite direction.
struct Way {
  const MeshPiece* piece = nullptr;
  bool backwards = false;
};

struct Wanted {
  OutputQuantity quantity = OutputQuantity::N;  ///< stress, or N, V, M
  Fibre fibre = Fibre::both;                    ///< fibre of a stress: left or right
  double of_N = 1.0, of_M = 1.0;                ///< factors of the two parts of a stress
  std::optional<double> intensification = {};
};

/// The quantity that an output requests, for one fibre.
[[nodiscard]] Wanted wanted_by(const OutputSpec& spec, Fibre fibre);

/// Number of points of an element whose interpolation polynomial is the quantity (base/along.hpp).
[[nodiscard]] std::size_t points_of(OutputQuantity quantity);

class MemberCuts {
 public:
  MemberCuts(const Scene& scene, const DofMap& map) : scene_(scene), map_(map) {}

  /// The k-th element on the way.
  [[nodiscard]] static std::size_t element_of(const Way& way, std::size_t k);
  /// Cut at a position x of the k-th element on the way, 0 to 1. Errors: SceneError under `key` for a section with
  /// unknown stress properties.
  [[nodiscard]] Cut cut(const Way& way, std::size_t k, double x, const Wanted& wanted,
                        const SourcePlace& place, const std::string& key) const;
  /// k and x at a station of the whole piece.
  [[nodiscard]] static std::pair<std::size_t, double> place_of(const Way& way, double station);

 private:
  [[nodiscard]] Cut force(const Way& way, std::size_t k, double x, OutputQuantity quantity) const;

  const Scene& scene_;
  const DofMap& map_;
};

}  // namespace signorini
