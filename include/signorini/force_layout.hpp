// force_layout.hpp: index of a contact's forces in the vector of all forces, and of its guards in that of all guards.
//
//   forces   N_1, T_1, N_2, T_2, ..., 0    for each contact in turn: the normal force, then the tangential forces;
//                                          at the end the force zero, if a contact has no tangential force
//   guards   G_11, G_12, ...,  G_21, ...   for each contact in turn: the guards, in the order of the contact's law
//
// Residual rows of contacts have the order of the forces. The law of a contact defines its number of tangents and of guards
// (LawCapabilities); only ForceLayout computes indices from these numbers. A `place` is the index of a force, a `slot` the
// index of a guard. part() makes the layout of a subset of the contacts.
//
// All contacts without a tangential force share the last place as the place of T. Their tangent row is T = 0, so what is read
// there is zero, and what is written there is zero or the row T = 0 again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace signorini {

class ForceLayout {
 public:
  /// Number of tangential forces and of guards of one contact, and number of unused entries.
  struct Counts {
    std::uint32_t tangents = 1, guards = 3;
    std::uint32_t unused_forces = 0;  ///< number of places after the tangents, whose force is zero
    std::uint32_t unused_guards = 0;  ///< number of slots after the guards, which have no guard
  };

  /// Layout without contacts.
  ForceLayout() = default;
  explicit ForceLayout(const std::vector<Counts>& contacts) {
    auto table = std::make_shared<Table>();
    table->counts = contacts;
    table->starts.reserve(contacts.size() + 1);
    std::uint32_t place = 0, slot = 0;
    for (std::uint32_t c = 0; c < contacts.size(); ++c) {
      const Counts& n = contacts[c];
      table->starts.push_back({place, place + 1, n.tangents, slot, n.guards});
      place += 1 + n.tangents + n.unused_forces;
      slot += n.guards + n.unused_guards;
      table->contact_of_place.resize(place, c);
      table->contact_of_guard.resize(slot, c);
    }
    bool any_without_tangent = false;
    for (Start& start : table->starts)
      if (start.tangents == 0) {
        start.tangent = place;
        any_without_tangent = true;
      }
    if (any_without_tangent) {
      ++place;
      table->contact_of_place.push_back(static_cast<std::uint32_t>(contacts.size() - 1));
    }
    table->starts.push_back({place, place, 0, slot, 0});
    starts_ = table->starts.data();
    contacts_ = contacts.size();
    table_ = std::move(table);
  }
  /// Layout of this number of contacts, each with the default Counts.
  explicit ForceLayout(std::size_t contacts) : ForceLayout(std::vector<Counts>(contacts)) {}

  /// Layout of the listed contacts alone, in the order of the list.
  [[nodiscard]] ForceLayout part(const std::vector<std::size_t>& contacts) const {
    std::vector<Counts> counts;
    counts.reserve(contacts.size());
    for (const std::size_t c : contacts) counts.push_back(table_->counts[c]);
    return ForceLayout(counts);
  }

  [[nodiscard]] std::size_t contacts() const { return contacts_; }
  [[nodiscard]] const Counts& counts(std::size_t contact) const { return table_->counts[contact]; }

  /// Number of places of all contacts together.
  [[nodiscard]] std::size_t size() const { return contacts_ == 0 ? 0 : starts_[contacts_].place; }
  [[nodiscard]] std::size_t tangents(std::size_t contact) const { return starts_[contact].tangents; }
  /// Place of the normal force N of a contact.
  [[nodiscard]] std::size_t normal(std::size_t contact) const { return starts_[contact].place; }
  /// Place of the i-th tangential force of a contact. Without a tangential force: the last place, whose force is zero.
  [[nodiscard]] std::size_t tangent(std::size_t contact, std::size_t i = 0) const {
    return starts_[contact].tangent + i;
  }
  /// Contact to which the force at a place belongs.
  [[nodiscard]] std::size_t contact_of(std::size_t place) const { return table_->contact_of_place[place]; }
  [[nodiscard]] bool is_normal(std::size_t place) const { return place == normal(contact_of(place)); }
  /// False for an unused place after the tangents of a contact, and for the place of the force zero.
  [[nodiscard]] bool is_used(std::size_t place) const {
    const Start& start = starts_[contact_of(place)];
    return place <= start.place + start.tangents;
  }

  /// Number of slots of all contacts together.
  [[nodiscard]] std::size_t guard_count() const { return contacts_ == 0 ? 0 : starts_[contacts_].slot; }
  [[nodiscard]] std::size_t guards(std::size_t contact) const { return starts_[contact].guards; }
  /// Slot of the i-th guard of a contact.
  [[nodiscard]] std::size_t guard(std::size_t contact, std::size_t i = 0) const {
    return starts_[contact].slot + i;
  }
  /// Slot after the last guard of a contact, unused slots included.
  [[nodiscard]] std::size_t guard_end(std::size_t contact) const { return starts_[contact + 1].slot; }
  [[nodiscard]] std::size_t contact_of_guard(std::size_t slot) const {
    return table_->contact_of_guard[slot];
  }
  /// Index of a guard among the guards of its contact, from its slot.
  [[nodiscard]] std::size_t guard_within(std::size_t slot) const {
    return slot - starts_[contact_of_guard(slot)].slot;
  }

 private:
  struct Start {
    std::uint32_t place = 0, tangent = 0, tangents = 0, slot = 0, guards = 0;
  };
  struct Table {
    std::vector<Start> starts;  // one entry more than contacts: the last one is the end
    std::vector<std::uint32_t> contact_of_place, contact_of_guard;
    std::vector<Counts> counts;
  };
  std::shared_ptr<const Table> table_;  // shared by copies
  const Start* starts_ = nullptr;
  std::size_t contacts_ = 0;
};

}  // namespace signorini
