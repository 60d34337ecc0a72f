// branch_continuation.hpp: follows one branch of orbits, point by point.
//
// Predictor: a step along the direction of the branch. Corrector: Newton's method orthogonal to this
// direction (branch_newton.hpp). Test functions find special points between two points (special_points.hpp).
//
// If orbits form a family, the continuation follows the orbit in the middle of the family (branch_newton.hpp).
//
// If even the shortest step fails, for instance where a guard grazes, the continuation searches for an orbit
// at a slightly further value of the key: first by Newton's method with damped steps, then by a transient
// run. Where another branch begins, the continuation stores a junction:
//
//   flip            (Phi + I) v = 0: the branch of orbits with twice the period begins along v
//   branch point    dG/dy t = dG/dy w = 0 for two directions t, w: the branch has the direction t, the other w and -w
#pragma once

#include "orbit/branch_newton.hpp"

namespace signorini::orbit {

/// Point of a branch at which another branch begins.
struct Junction {
  BranchMap map;      ///< map of the other branch
  CorrectedPoint at;  ///< the junction, as a point of the first of the two branches
  /// Direction of the other branch at the junction: coordinates at the section; dT/T if T is an unknown; s.
  Vector away;
  std::string kind;
  int from = 1;        ///< number of the branch on which the junction was found
  int generation = 1;  ///< number of branch switches between the first branch and the other branch
};

class BranchContinuation {
 public:
  /// Adds points and sequences to `branch`. options, branch and seen must outlive the object. number: as in
  /// BranchPoint::branch; generation: as in Junction.
  BranchContinuation(const BranchOptions& options, BranchMap map, Branch& branch, int number, int generation,
                     const std::function<void(const BranchPoint&)>& seen)
      : options_(options),
        map_(std::move(map)),
        branch_(branch),
        number_(number),
        generation_(generation),
        seen_(seen) {}
  BranchContinuation(const BranchContinuation&) = delete;
  BranchContinuation& operator=(const BranchContinuation&) = delete;

  /// Follows the branch from the map's first orbit.
  void follow();
  /// Follows the branch from a junction.
  void follow_from(const Junction& junction);

  [[nodiscard]] const std::string& end() const { return end_; }
  [[nodiscard]] bool complete() const { return complete_; }
  /// Checkpoint of the last point, from which the branch can be resumed.
  [[nodiscard]] std::optional<BranchCheckpoint> mark();
  [[nodiscard]] std::vector<Junction>& junctions() { return junctions_; }

 private:
  [[nodiscard]] bool begin(CorrectedPoint& here);
  [[nodiscard]] bool begin_from(const Junction& junction, CorrectedPoint& here, Vector& t);
  void follow_from_start();
  void continue_branch(CorrectedPoint here, Vector t);
  [[nodiscard]] CorrectedPoint step(const CorrectedPoint& here, const Vector& t, double ds, bool last) const;
  [[nodiscard]] bool is_time_shift(const CorrectedPoint& here, const Vector& t) const;
  [[nodiscard]] bool restart(CorrectedPoint& here, double sign);
  [[nodiscard]] bool has_passed(const CorrectedPoint& at);
  [[nodiscard]] bool may_continue(const CorrectedPoint& here, const CorrectedPoint& next, double along);
  void report_end(const CorrectedPoint& here, double along);
  [[nodiscard]] bool search_beyond_gap(const CorrectedPoint& here, CorrectedPoint& next, Vector& t);
  [[nodiscard]] bool returns(const CorrectedPoint& here);
  bool move_to_representative(CorrectedPoint& here, const Vector& t);
  void store_parameter_direction(const std::optional<SecantPoint>& place, CorrectedPoint& next);
  void choose_new_section(CorrectedPoint& here, std::optional<SecantPoint>& before);
  [[nodiscard]] Vector direction(const std::optional<SecantPoint>& place, CorrectedPoint& here,
                                 const Vector& before);
  bool add(const CorrectedPoint& here, const std::string& special);
  /// A special point within a step, and its position.
  struct LocatedPoint {
    double part = 0.0;  // position of the point, as a fraction of the step
    std::string kind;
    CorrectedPoint at;
    Vector t;
    /// If another change of the sequence follows within the step: a point between both changes, and its fraction.
    std::optional<CorrectedPoint> behind = {};
    double behind_part = 1.0;
  };
  [[nodiscard]] std::vector<LocatedPoint> located(const CorrectedPoint& here, CorrectedPoint& next,
                                                  const Vector& t, double& length);
  [[nodiscard]] std::vector<LocatedPoint> between(const CorrectedPoint& here, CorrectedPoint& next,
                                                  const Vector& t, double& length);
  [[nodiscard]] bool has_unlocated_change(const CorrectedPoint& here, const CorrectedPoint& next,
                                          const std::vector<LocatedPoint>& points) const;
  /// True if the chord between the points `from` and `to` deviates from the branch's direction at `from`,
  /// given as `direction`, or, if at_to is true, from the direction at `to`.
  [[nodiscard]] bool chord_deviates(const SecantPoint& from, CorrectedPoint& to, const Vector* direction,
                                    bool at_to) const;
  [[nodiscard]] bool too_long(const CorrectedPoint& here, CorrectedPoint& next, const Vector& t,
                              double length, std::vector<LocatedPoint>& points) const;
  [[nodiscard]] std::optional<SecantPoint> cross(std::vector<LocatedPoint> points, const CorrectedPoint& here,
                                                 CorrectedPoint& next, const Vector& t, double& length);
  [[nodiscard]] std::optional<LocatedPoint> zero_of(const SpecialKind& kind, const CorrectedPoint& here,
                                                    const CorrectedPoint& next, const Vector& t,
                                                    double ds) const;
  [[nodiscard]] std::optional<LocatedPoint> end_of_sequence(const CorrectedPoint& here,
                                                            const CorrectedPoint& next, const Vector& t,
                                                            double ds) const;
  void store_checkpoint(const CorrectedPoint& here, const Vector& t);
  void report_checkpoint();
  void keep_junction(const LocatedPoint& point);
  [[nodiscard]] std::string sequence_of(const OrbitPass& pass) const;
  [[nodiscard]] int number_of_sequence(const OrbitPass& pass);
  [[nodiscard]] double value(const CorrectedPoint& at) const { return map_.parameter(at.state.s); }
  /// Runs `walk`. If the scene is refused for a value of the key, the branch ends there.
  void guarded(const std::function<void()>& walk);

  const BranchOptions& options_;
  BranchMap map_;
  BranchNewton newton_{map_};
  Branch& branch_;
  int number_, generation_;
  const std::function<void(const BranchPoint&)>& seen_;
  std::vector<Junction> junctions_;
  std::string end_;
  bool complete_ = false;
  /// The last orbit found beyond a gap or a change of the sequence. section: section of the map at this
  /// orbit; sign: 1 or -1, the direction along the key in which this orbit was found.
  struct FoundBeyond {
    CorrectedPoint at;
    double section, sign;
  };
  std::optional<FoundBeyond> found_beyond_;
  // Limit for the number of successive steps that end at another branch. Such steps occur near a graze, where
  // an unbounded multiplier prevents convergence of Newton's method. Beyond the limit, the branch is searched
  // at a further value of the key. Chosen value.
  static constexpr int max_jumps = 4;
  int jumps_ = 0;
  bool crossed_gap_ = false;  // the branch was found again beyond a gap at least once
  bool turned_back_ = false;  // the continuation has restarted from found_beyond_ in the opposite direction
  std::optional<BranchState> last_;
  double last_section_ = 0.0;
  std::size_t last_points_ = 0;
  bool towards_to_ = true;
  int points_ = 0;
  bool located_ = false;  // the last point is a special point located within a step
  bool folds_ = false;    // the parameter reverses between the last two points, without a located fold
  bool tangent_deviates_ = false;  // the tangent deviates from the secant of the last step (direction())
  // Component along the parameter of the tangent at the last point, in the section of the step that led to
  // this point; 0: unknown.
  double parameter_component_ = 0.0;
  bool doubled_ = false;  // the branch began at a flip
  double half_section_ = 0.0;
  Vector half_;  // for a doubled branch: z(T/2) - z at the last point
};

}  // namespace signorini::orbit
