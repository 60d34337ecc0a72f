// draft.hpp: a scene file while features add to it.
//
//   Draft draft(7, Kit::chain);
//   DraftContact* foot = draft.contact({"rigid"}, {"restitution"});   // one that can have the key, or a new one
//   if (foot) foot->keys.set("restitution", 0.5);
//   parse_scene(draft.text(), "drawn.toml");
//
//   kit       structure that features begin with
//   chain     two masses between springs
//   frame     a portal of three beams
//   block     a rigid body on two feet, held by springs
//   mesh      a plane body of two elements, held by springs
//   matrices  three degrees of freedom
#pragma once

#include <fmt/core.h>

#include <cmath>
#include <deque>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "differential/random.hpp"

namespace signorini::differential {

enum class Kit { chain, frame, block, mesh, matrices };

/// Keys of one table, each at most once, in the order in which they were first set.
class DraftTable {
 public:
  explicit DraftTable(std::string header) : header_(std::move(header)) {}
  DraftTable& set(const char* key, double value) { return set(key, fmt::format("{}", value)); }
  /// A value as it stands in the file.
  DraftTable& set(const char* key, const std::string& value);
  /// A string.
  DraftTable& name(const char* key, const std::string& value) { return set(key, "\"" + value + "\""); }
  [[nodiscard]] bool has(const std::string& key) const;
  [[nodiscard]] const std::string& header() const { return header_; }
  [[nodiscard]] bool empty() const { return keys_.empty(); }
  [[nodiscard]] std::string text() const;

 private:
  std::string header_;
  std::vector<std::pair<std::string, std::string>> keys_;
};

/// Where a contact may act.
struct DraftPlace {
  std::string node;             ///< empty: degrees of freedom
  std::string normal, tangent;  ///< as they stand in the file
  bool massless = false;
};

struct DraftContact {
  std::string name, law;  ///< law empty: open to all
  DraftPlace place;
  DraftTable keys{"[[contacts]]"};
};

class Draft {
 public:
  Draft(std::uint64_t seed, Kit kit);

  Random draw;
  Kit kit;
  double t_end = 0.4;
  DraftTable top{""}, run{"[run]"}, damping{"[damping]"}, reduction{"[reduction]"}, nodes{"[nodes]"};
  DraftTable load{"[[loads]]"};     ///< what drives the scene
  std::string history;              ///< its; empty: drawn
  std::deque<DraftTable> tables;    ///< all others; references stay valid
  std::vector<std::string> stages;  ///< loads of a frictional start
  bool needs_ida = false;           ///< a law is not linear
  std::string parameter;            ///< a key that a feature has set, for derivatives
  std::string main;                 ///< node that parts are joined to; empty: [matrices]
  double x = 0.0, y = 0.0;          ///< where it is

  /// A circular frequency; all have a common period.
  [[nodiscard]] double omega(int low, int high) { return std::round(4.0 / t_end) * draw.integer(low, high); }
  [[nodiscard]] bool has_nodes() const { return kit != Kit::matrices; }
  DraftTable& table(const std::string& header);
  /// The first table of this header; nullptr: there is none.
  DraftTable* find(const std::string& header);
  /// A contact with one of the laws that has none of the keys yet: one that is there, or else a new one; nullptr: no place is left.
  DraftContact* contact(std::initializer_list<const char*> laws, std::initializer_list<const char*> free);
  /// Contacts claim places from the front.
  void put_first(const DraftPlace& place) { places_.push_front(place); }
  /// What no contact has claimed yet at this node has no mass.
  void take_mass_from(const std::string& node) {
    for (DraftPlace& place : places_)
      if (place.node == node) place.massless = true;
  }
  /// Two springs, along x and y, between a node and the main one.
  void join(const std::string& node, double stiffness);
  /// The member that joins the main node to a fixed one.
  DraftTable& beam();
  /// The plane body "pad".
  void body();

  /// Contacts without a law get one, what they need is drawn, and so are engine, start and load where nobody has chosen them.
  [[nodiscard]] std::string text();

 private:
  void chain();
  void frame();
  void block();
  void mesh();
  void matrices();
  void finish(DraftContact& contact);
  void body_at(double left, double bottom);

  std::deque<DraftPlace> places_;
  std::deque<DraftContact> contacts_;
};

}  // namespace signorini::differential
