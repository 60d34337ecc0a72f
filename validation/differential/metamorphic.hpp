// metamorphic.hpp: does a problem written in another way have the same answer?
//
//   exact, newmark
//           the same events, |t' - t| <= 10 spread(t) + least_time
//           spread: how far runs of the same scene lie apart when all its data are off by one rounding, or
//           its motion, each displacement and velocity by that of the greatest of its kind (neighbour.hpp)
//   ida     the same events, |t' - t| <= spread(t) + blur t_uncertainty + least_time
//           spread: exact runs of neighbours as far off as ida's steps may be (neighbour.hpp)
//
// Up to where runs of disturbed scenes change their order, or the last of infinitely many hits fly lower than
// rounding, which turned contacts have and those along the axes have not; what comes after is chance.
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

/// Turned by each of so many angles around; forces, lengths and times (in turn) times scales over 40 decades.
[[nodiscard]] std::vector<Transformed> angles_and_scales(const Scene& scene, int angles, int scales);

struct MetamorphicSettings {
  Engine engine = Engine::exact;  ///< exact, ida, newmark (with the scene's dt)
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
  bool ended = false;      ///< as the scene itself: at t_end, or for the same reason
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
