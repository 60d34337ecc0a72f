#include "differential/pairs.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>

#include "differential/shrink.hpp"
#include "signorini/error.hpp"

namespace signorini::differential {
namespace {

using State = PairRow::State;

bool named(const char* pattern, const Feature& f) {
  return std::string(pattern) == "*" || std::string(pattern) == f.name;
}
template <class Row>
bool is_about(const Row& row, const Feature& a, const Feature& b) {
  return (named(row.a, a) && named(row.b, b)) || (named(row.a, b) && named(row.b, a));
}

/// Two engines are held against each other by a check of their own.
std::string check_of_engines(const Feature& a, const Feature& b) {
  if (std::string(a.group) != "engine" || std::string(b.group) != "engine") return "";
  const auto any = [&](const std::string& name) { return a.name == name || b.name == name; };
  if (any("friction-iteration")) return "";
  if (!any("exact, modes")) return "engines";
  return any("exact, series") ? "flows" : "";
}

const PairRefusal* refusal_of(const Feature& a, const Feature& b, const std::string& message) {
  for (const PairRefusal& row : all_refusals())
    if (is_about(row, a, b) && message.find(row.says) != std::string::npos) return &row;
  return nullptr;
}

const OpenDefect* defect_of(const Feature& a, const Feature& b, const Checked& found) {
  for (const OpenDefect& row : open_defects())
    if (is_about(row, a, b) && found.how.find(row.how) != std::string::npos &&
        found.what.find(row.shows) != std::string::npos)
      return &row;
  return nullptr;
}

std::string file_name(std::string name) {
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '-';
  return name;
}

class Examination {
 public:
  explicit Examination(const PairSettings& settings)
      : s_(settings),
        features_(settings.features != nullptr ? *settings.features : all_features()),
        start_(std::chrono::steady_clock::now()) {}

  PairTable run() {
    for (std::size_t i = 0; i < features_.size(); ++i)
      for (std::size_t j = i + 1; j < features_.size(); ++j)
        if (wanted(features_[i], features_[j]))
          rows_.push_back(
              {&features_[i], &features_[j], State::not_reached, 0, {}, {}, i * features_.size() + j});
    // A cut reaches pairs of all features.
    Random draw(s_.from);
    std::vector<std::size_t> order(rows_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    for (std::size_t i = order.size(); i > 1; --i)
      std::swap(order[i - 1], order[static_cast<std::size_t>(draw.integer(0, static_cast<int>(i) - 1))]);
    for (int round = 0; round < s_.rounds && in_time(); ++round)
      for (const std::size_t i : order) {
        if (!in_time()) break;
        visit(rows_[i], round);
      }
    return PairTable(std::move(rows_));
  }

 private:
  [[nodiscard]] bool in_time() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count() <
           60.0 * s_.minutes;
  }

  [[nodiscard]] bool wanted(const Feature& a, const Feature& b) const {
    if (s_.only.empty()) return true;
    const auto asked = [&](const Feature& f) {
      return std::find(s_.only.begin(), s_.only.end(), f.name) != s_.only.end();
    };
    return s_.only.size() == 2 ? asked(a) && asked(b) : asked(a) || asked(b);
  }

  void visit(PairRow& row, int round) {
    if (row.state == State::alternatives || row.state == State::refused) return;
    const std::string engines = check_of_engines(*row.a, *row.b);
    if (are_alternatives(*row.a, *row.b) && engines.empty()) {
      row.state = State::alternatives;
      return;
    }
    std::string refused;
    const PairRefusal* listed = nullptr;
    for (int attempt = 0; attempt < (row.scenes == 0 ? s_.tries : 1) && in_time(); ++attempt) {
      const std::uint64_t seed =
          s_.from * 1000003U + row.place * 4099U + static_cast<std::uint64_t>(64 * round + attempt);
      const PairScene scene =
          draw_pair(features_, *row.a, *row.b, seed, round == 0 ? 0 : static_cast<int>(seed % 3));
      if (scene.text.empty()) {
        row.what = scene.why;
        continue;
      }
      CheckRequest request;
      request.text = scene.text;
      request.parameter = scene.parameter;
      request.seed = seed;
      request.bounds = s_.bounds;
      request.only = engines;
      for (const Feature* f : {row.a, row.b})
        if (f->check != Check::related) request.checks.push_back(f->check);
      if (s_.planted) request.planted = s_.planted(*row.a, *row.b);
      if (take(row, request, refused, listed)) return;
    }
    if (row.scenes > 0 || row.state == State::failed || row.state == State::open || !in_time()) return;
    row.state = listed != nullptr ? State::refused : State::nothing;
    if (listed != nullptr) {
      row.what = fmt::format("{}: {}", listed->doc, listed->line);
      return;
    }
    if (!refused.empty()) row.what = refused;
  }

  [[nodiscard]] std::vector<Checked> checked(const CheckRequest& request) const {
    return s_.apart ? check_scene_apart(request) : check_scene(request);
  }

  /// True: no further attempt is needed.
  bool take(PairRow& row, const CheckRequest& request, std::string& refused, const PairRefusal*& listed) {
    bool held = false;
    for (const Checked& found : checked(request)) {
      if (s_.verbose) say(row, request, found);
      if (found.kind == Checked::Kind::refused) {
        if (const PairRefusal* line = refusal_of(*row.a, *row.b, found.what); line != nullptr) listed = line;
        refused = found.what;
      }
      if (found.kind == Checked::Kind::idle && refused.empty())
        row.what = row.scenes > 0 ? row.what : found.how + ": " + found.what;
      if (found.kind == Checked::Kind::broken) broken(row, request, found);
      if (found.kind != Checked::Kind::held && found.kind != Checked::Kind::broken) continue;
      ++row.how[found.how];
      held = true;
      if (row.state != State::failed && row.state != State::open) {
        row.state = State::checked;
        row.what.clear();
      }
    }
    row.scenes += held ? 1 : 0;
    return held;
  }

  void broken(PairRow& row, const CheckRequest& request, const Checked& found) {
    const OpenDefect* known = defect_of(*row.a, *row.b, found);
    if (row.state == State::failed && known != nullptr) return;
    const bool first = row.state != State::failed;
    row.state = known != nullptr ? State::open : State::failed;
    row.what = known != nullptr ? fmt::format("open: {}", known->name)
                                : fmt::format("{}: {}", found.how, found.what);
    if (known != nullptr || !first) return;
    if (!s_.verbose) say(row, request, found);
    if (!s_.keep.empty()) keep(row, request, found);
  }

  static void say(const PairRow& row, const CheckRequest& request, const Checked& found) {
    constexpr std::array names = {"held", "BROKEN", "refused", "nothing to compare"};
    fmt::print("{} + {}, seed {}: {} {}{}{}\n", row.a->name, row.b->name, request.seed, found.how,
               names[static_cast<std::size_t>(found.kind)], found.what.empty() ? "" : " -- ", found.what);
    std::fflush(stdout);
  }

  /// What a smaller scene has to show as well: the same check is broken, in the same way up to its numbers.
  void keep(const PairRow& row, const CheckRequest& request, const Checked& found) const {
    const auto kind = [](const std::string& what) { return what.substr(0, what.find(':')); };
    const std::filesystem::path directory(s_.keep);
    std::filesystem::create_directories(directory);
    std::string text = request.text;
    const auto shows = [&](const std::string& smaller) {
      CheckRequest again = request;
      again.text = smaller;
      if (again.checks.empty() && again.only.empty()) again.only = found.how;
      const std::vector<Checked> now = checked(again);
      return std::any_of(now.begin(), now.end(), [&](const Checked& c) {
        return c.kind == Checked::Kind::broken && c.how == found.how &&
               kind(c.what).substr(0, 12) == kind(found.what).substr(0, 12);
      });
    };
    constexpr int attempts = 150;
    if (s_.shrink && shows(text)) text = differential::shrink(text, shows, attempts);
    const std::string name =
        file_name(fmt::format("{}+{}-{}", row.a->name, row.b->name, request.seed)) + ".toml";
    std::ofstream(directory / name) << text;
    std::ofstream(directory / "README.md", std::ios::app)
        << fmt::format("| {} | {} | {} | {} | {} |\n", name, row.a->name, row.b->name, found.how, found.what);
  }

  const PairSettings& s_;
  const std::vector<Feature>& features_;
  std::chrono::steady_clock::time_point start_;
  std::vector<PairRow> rows_;
};

}  // namespace

const char* to_string(State state) {
  constexpr std::array names = {"checked", "refused", "alternatives", "open",
                                "FAILED",  "NOTHING", "not reached"};
  return names[static_cast<std::size_t>(state)];
}

long PairTable::count(State state) const {
  return std::count_if(rows_.begin(), rows_.end(), [&](const PairRow& row) { return row.state == state; });
}

const PairRow* PairTable::row(const std::string& a, const std::string& b) const {
  for (const PairRow& row : rows_)
    if ((row.a->name == a && row.b->name == b) || (row.a->name == b && row.b->name == a)) return &row;
  return nullptr;
}

void PairTable::print() const {
  fmt::print("\n| feature | feature | scenes | how | |\n|---|---|---|---|---|\n");
  for (const PairRow& row : rows_) {
    std::string how;
    for (const auto& [name, count] : row.how)
      how += fmt::format("{}{} {}", how.empty() ? "" : ", ", name, count);
    fmt::print("| {} | {} | {} | {} | {}{}{} |\n", row.a->name, row.b->name, row.scenes, how,
               row.state == State::checked ? "" : to_string(row.state), row.what.empty() ? "" : ": ",
               row.what);
  }
  long scenes = 0;
  for (const PairRow& row : rows_) scenes += row.scenes;
  fmt::print(
      "\n{} pairs: {} checked, {} refused by name, {} of one key, {} open; {} FAILED, {} NOTHING, {} not "
      "reached; {} scenes\n",
      rows_.size(), count(State::checked), count(State::refused), count(State::alternatives),
      count(State::open), count(State::failed), count(State::nothing), count(State::not_reached), scenes);
}

int PairTable::exit_code() const { return count(State::failed) + count(State::nothing) > 0 ? 1 : 0; }

PairTable examine_pairs(const PairSettings& settings) { return Examination(settings).run(); }

}  // namespace signorini::differential
