// metamorphic.hpp: does a problem written in another way have the same answer?
//
//   exact   the same events, |t' - t| <= 10 spread(t) + least_time
//           spread: how far runs of the same scene lie apart when all its data are off by one rounding
//   ida     the same events, |t' - t| <= spread(t) + blur t_uncertainty + least_time
//           spread: exact runs of neighbours as far off as ida's steps may be (neighbour.hpp)
//
// Up to where runs of disturbed scenes change their order; what comes after is not the scene's but chance.
//
//   const Metamorphic judge(scene, {});
//   for (const Transformed& other : transformations(scene, 7)) use(judge.compare(other));
#pragma once

#include <memory>

#include "differential/promise.hpp"
#include "differential/transform.hpp"

namespace signorini::differential {

/// Turns (by seeded angles, 45 and 90 degrees), mirror image, orders, reversed members, five systems of
/// units, scales of force, length and time from 1e-20 to 1e20: those of them that the scene can take.
[[nodiscard]] std::vector<Transformed> transformations(const Scene& scene, std::uint64_t seed);

struct MetamorphicSettings {
  Engine engine = Engine::exact;  ///< exact, ida
  double rtol = 1e-10;            ///< ida
  int disturbances = 6;
  double factor = 10.0;  ///< of what they do
  Bounds bounds;         ///< of every run
};

struct Sameness {
  enum class Verdict { same, unlike, refused } verdict = Verdict::same;
  double worst = 0.0;      ///< Finding::worst
  std::size_t events = 0;  ///< compared
  bool to_end = false;     ///< else to where disturbed runs part
  std::string what;
};

/// One scene, computed once, against any number of its transformations.
class Metamorphic {
 public:
  /// The scene's own run and those of its disturbed copies.
  Metamorphic(const Scene& scene, const MetamorphicSettings& settings);
  ~Metamorphic();
  /// Empty, or why the scene itself cannot be computed (refused, too long, Stribeck's friction with exact).
  [[nodiscard]] const std::string& hindrance() const;
  [[nodiscard]] Sameness compare(const Transformed& other) const;

 private:
  struct Members;
  std::unique_ptr<Members> m_;
};

}  // namespace signorini::differential
