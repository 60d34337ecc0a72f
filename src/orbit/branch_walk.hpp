// branch_walk.hpp: one branch of orbits, point by point.
//
//   predictor along the direction, corrector across it (branch_newton.hpp); test functions between two points
//   (special_points.hpp)
//
// Of a family of orbits the walk follows the one in its middle (family_middle.hpp).
//
// Where no step is short enough, as where a guard grazes, the orbit a little further on is looked for by a transient.
// Where another branch begins the walk keeps a junction:
//
//   flip            (Phi + I) v = 0: the orbit of twice the period leaves along v
//   branch point    two directions t, w with dG/dy t = dG/dy w = 0: the other branch leaves along w and -w
#pragma once

#include "orbit/branch_newton.hpp"

namespace signorini {

/// Where another branch begins.
struct Junction {
  BranchMap map;  ///< of the other branch
  Corrected at;   ///< the point of the branch that it leaves
  Vector away;    ///< coordinates at the section, dT/T where T is unknown, s
  std::string kind;
  int from = 1;        ///< number of the branch that it leaves
  int generation = 1;  ///< so many switches led there
};

class BranchWalk {
 public:
  /// Points and sequences are added to `branch`. All but map must outlive it.
  BranchWalk(const BranchOptions& options, BranchMap map, Branch& branch, int number, int generation,
             const std::function<void(const BranchPoint&)>& seen)
      : options_(options),
        map_(std::move(map)),
        branch_(branch),
        number_(number),
        generation_(generation),
        seen_(seen) {}
  BranchWalk(const BranchWalk&) = delete;
  BranchWalk& operator=(const BranchWalk&) = delete;

  /// From the map's first orbit on.
  void follow();
  /// From a junction on.
  void leave(const Junction& junction);

  [[nodiscard]] const std::string& end() const { return end_; }
  [[nodiscard]] bool complete() const { return complete_; }
  /// Of the last point.
  [[nodiscard]] std::optional<BranchMark> mark();
  [[nodiscard]] std::vector<Junction>& junctions() { return junctions_; }

 private:
  [[nodiscard]] bool begin(Corrected& here);
  [[nodiscard]] bool depart(const Junction& junction, Corrected& here, Vector& t);
  void walk_from_start();
  void walk(Corrected here, Vector t);
  [[nodiscard]] Corrected step(const Corrected& here, const Vector& t, double ds, bool last) const;
  [[nodiscard]] bool only_shifts(const Corrected& here, const Vector& t) const;
  [[nodiscard]] bool restart(Corrected& here, double sign);
  [[nodiscard]] bool has_passed(const Corrected& at);
  [[nodiscard]] bool keeps_going(const Corrected& here, const Corrected& next, double along);
  void tell_end(const Corrected& here, double along);
  [[nodiscard]] bool beyond(const Corrected& here, Corrected& next, Vector& t);
  [[nodiscard]] bool returns(const Corrected& here);
  bool centre(Corrected& here, const Vector& t);
  void look_ahead(const std::optional<BranchPlace>& place, Corrected& next);
  void cut_anew(Corrected& here, std::optional<BranchPlace>& before);
  [[nodiscard]] Vector direction(const std::optional<BranchPlace>& place, Corrected& here,
                                 const Vector& before);
  bool add(const Corrected& here, const std::string& special);
  /// A point between two others, and where.
  struct Located {
    double part = 0.0;  // of the step
    std::string kind;
    Corrected at;
    Vector t;
    /// Of a change of the sequence, where yet another one follows within the step: the farthest place found before that.
    std::optional<Corrected> behind = {};
    double behind_part = 1.0;
  };
  [[nodiscard]] std::vector<Located> located(const Corrected& here, Corrected& next, const Vector& t,
                                             double& length);
  [[nodiscard]] std::vector<Located> between(const Corrected& here, Corrected& next, const Vector& t,
                                             double& length);
  [[nodiscard]] bool changes_unseen(const Corrected& here, const Corrected& next,
                                    const std::vector<Located>& points) const;
  [[nodiscard]] bool bends(const BranchPlace& from, Corrected& to, const Vector* before, bool onward) const;
  [[nodiscard]] bool too_long(const Corrected& here, Corrected& next, const Vector& t, double length,
                              std::vector<Located>& points) const;
  [[nodiscard]] std::optional<BranchPlace> cross(std::vector<Located> points, const Corrected& here,
                                                 Corrected& next, const Vector& t, double& length);
  [[nodiscard]] std::optional<Located> zero_of(const SpecialKind& kind, const Corrected& here,
                                               const Corrected& next, const Vector& t, double ds) const;
  [[nodiscard]] std::optional<Located> end_of_sequence(const Corrected& here, const Corrected& next,
                                                       const Vector& t, double ds) const;
  void keep_mark(const Corrected& here, const Vector& t);
  void offer_mark();
  void keep_junction(const Located& point);
  [[nodiscard]] std::string sequence_of(const OrbitPass& pass) const;
  [[nodiscard]] int number_of_sequence(const OrbitPass& pass);
  [[nodiscard]] double value(const Corrected& at) const { return map_.parameter(at.state.s); }
  /// Runs a walk; a scene that is refused on the way ends it.
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
  /// The last orbit that was found behind a gap or a change of the sequence, and where the walk came from.
  struct FoundBeyond {
    Corrected at;
    double section, sign;
  };
  std::optional<FoundBeyond> found_beyond_;
  // Steps in a row that ended at another branch, as beside a graze where a multiplier without bound leaves Newton's method no
  // room: after so many the branch is sought further on. Chosen.
  static constexpr int most_jumps = 4;
  int jumps_ = 0;
  bool crossed_gap_ = false;  // it was found anew at least once
  bool turned_back_ = false;  // it goes from found_beyond_ the other way
  std::optional<BranchState> last_;
  double last_section_ = 0.0;
  std::size_t last_points_ = 0;
  bool towards_to_ = true;
  int points_ = 0;
  bool located_ = false;  // the last point is a located one
  bool folds_ = false;    // the parameter turns between the last two points, and no fold was located
  bool turning_ = false;  // the tangent is not the way of the branch (direction())
  double ahead_ =
      0.0;  // t_s of the tangent at the last point, in the section of the step that led there; 0: not known
  bool doubled_ = false;  // it began at a flip
  double half_section_ = 0.0;
  Vector half_;  // of a doubled branch: z(T/2) - z at the last point
};

}  // namespace signorini
