#include "differential/relations.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "differential/shrink.hpp"

namespace signorini::differential {
namespace {

constexpr std::array all_classes = {Likeness::Class::same,
                                    Likeness::Class::ended_before,
                                    Likeness::Class::other_order,
                                    Likeness::Class::stopped_alike,
                                    Likeness::Class::too_long,
                                    Likeness::Class::undetermined,
                                    Likeness::Class::stopped_one_side,
                                    Likeness::Class::refused_one_side,
                                    Likeness::Class::understated,
                                    Likeness::Class::unexplained};

}  // namespace

void RelationTally::add(const std::string& relation, const Likeness& found) {
  ++counts_[relation][found.verdict];
  ++runs_;
  events_ += found.events;
  if (!is_explained(found.verdict)) ++unexplained_;
}

void RelationTally::print() const {
  fmt::print("\n| relation |");
  for (const Likeness::Class verdict : all_classes) fmt::print(" {} |", to_string(verdict));
  fmt::print("\n|---|");
  for (std::size_t i = 0; i < all_classes.size(); ++i) fmt::print("---|");
  fmt::print("\n");
  for (const auto& [relation, counts] : counts_) {
    fmt::print("| {} |", relation);
    for (const Likeness::Class verdict : all_classes) {
      const auto it = counts.find(verdict);
      fmt::print(" {} |", it == counts.end() ? 0 : it->second);
    }
    fmt::print("\n");
  }
  fmt::print("\n{} related runs, {} events compared\n", runs_, events_);
}

void examine_relations(const std::string& text, const std::string& name, const RelationSettings& settings,
                       const RelationReport& report) {
  std::optional<RelationJudge> judge;
  const Scene scene = parse_scene(text, name + ".toml");
  const std::size_t count = relation_kinds.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t first = settings.place < 0 ? 0 : static_cast<std::size_t>(settings.place);
    const RelationKind& kind = relation_kinds[(first + i) % count];
    if (!settings.only.empty() && settings.only != kind.name) continue;
    if (!judge) judge.emplace(scene, settings.bounds, settings.peaks);
    const bool refused = judge->run().end == Track::End::refused;
    if (refused && kind.of != related_turned && kind.of != related_mirrored) continue;
    const std::optional<Related> related = kind.of(scene, settings.seed);
    if (!related) continue;
    report(kind.name, *related, judge->compare(*related));
    if (settings.place >= 0) return;
  }
}

namespace {

/// What a smaller scene has to show as well.
bool shows(const std::string& text, const char* relation, const Likeness& found,
           const RelationSettings& settings) {
  RelationSettings one = settings;
  one.only = relation;
  bool same = false;
  try {
    examine_relations(text, "smaller", one, [&](const char*, const Related&, const Likeness& now) {
      same = now.verdict == found.verdict && now.of == found.of;
    });
  } catch (const Error&) {
    return false;
  }
  return same;
}

}  // namespace

void campaign_of_relations(const std::string& text, const std::string& name, const RelationSettings& settings,
                           const KeepSettings& keep, RelationTally& tally) {
  constexpr int attempts = 600;
  try {
    examine_relations(
        text, name, settings, [&](const char* relation, const Related& related, const Likeness& found) {
          tally.add(relation, found);
          if (is_explained(found.verdict) && !keep.all_lines) return;
          fmt::print("{} {} ({}): {}{}{} {} events, to {:.4g}, {:.2g} of allowed{}{}\n", name, related.name,
                     relation, to_string(found.verdict), found.of.empty() ? "" : ", ", found.of, found.events,
                     found.until, found.worst, found.what.empty() ? "" : "  -- ", found.what);
          std::fflush(stdout);
          if (is_explained(found.verdict) || keep.directory.empty()) return;
          std::filesystem::create_directories(keep.directory);
          std::string file = fmt::format("{}-{}.toml", name, relation);
          std::replace(file.begin(), file.end(), ' ', '-');
          std::ofstream(std::filesystem::path(keep.directory) / file)
              << (keep.shrink ? shrink(
                                    text,
                                    [&](const std::string& smaller) {
                                      return shows(smaller, relation, found, settings);
                                    },
                                    attempts)
                              : text);
        });
  } catch (const SceneError& error) {
    fmt::print("{}: no scene: {}\n", name, error.what());
  }
}

}  // namespace signorini::differential
