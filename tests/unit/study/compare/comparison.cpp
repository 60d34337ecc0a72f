// Two made-up runs, small enough to be compared by hand.
#include "study/compare/comparison.hpp"

#include <doctest/doctest.h>
#include <unistd.h>

#include <cstdlib>
#include <deque>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "signorini/error.hpp"
#include "study/compare/comparison_files.hpp"
#include "study/compare/limits.hpp"

using namespace signorini;

namespace {

namespace fs = std::filesystem;

class Folder {
 public:
  Folder() {
    std::string pattern = (fs::temp_directory_path() / "signorini-compare-XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  struct Tables {
    std::string events, history, contacts, energy;
    std::string outcome = R"({"kind": "done", "t": 4, "t_end": 4, "reason": ""})";
  };
  [[nodiscard]] compare::ComparedRun run(const std::string& name, const Tables& tables) const {
    fs::create_directory(path_ / name);
    const auto write = [&](const char* file, const std::string& text) {
      std::ofstream(path_ / name / file, std::ios::binary) << text;
    };
    write("summary.json",
          R"({"title": "", "outcome": )" + tables.outcome +
              R"(, "units": {"force": "N", "mass": "kg", "length": "m", "time": "s"}, "contacts":
                              [{"name": "c", "law": "slider", "static_friction": 1, "kinetic_friction": 1}]})");
    write("events.csv", "t,contact,event,from,to,t_uncertainty\n" + tables.events);
    write("history.csv", tables.history);
    write("contacts.csv", "t,contact,N,T\n" + tables.contacts);
    write("energy.csv", "t,kinetic,balance\n" + tables.energy);
    return compare::read_compared_run(path_ / name, name);
  }

 private:
  fs::path path_;
};

const Folder::Tables reference = {"1.5,c,slip,stick,slip+,1e-9\n2,,time,,,\n3.5,c,stick,slip+,stick,\n",
                                  "t,A.ux,A.rz,A.vx\n0,0,0,0\n1,1,0,0\n2,2,0,0\n3,3,0,0\n4,4,0,0\n",
                                  "0,c,-1,0\n1,c,-1,0\n2,c,-1,0\n3,c,-1,0\n4,c,-1,0\n",
                                  "0,0,0\n1,1,0\n2,2,0\n3,3,0\n4,4,0\n"};

}  // namespace

TEST_SUITE_BEGIN("unit/study/compare/comparison");

TEST_CASE("comparison: greatest differences, when and where") {
  const Folder folder;
  const compare::ComparedRun a = folder.run("a", reference);
  Folder::Tables other = reference;
  other.events = "1.5,c,slip,stick,slip+,\n2,,time,,,\n3.25,c,stick,slip+,stick,\n";
  other.history = "t,A.ux,A.rz,A.vx\n0,0,0,0\n1,1.25,0,0\n2,2,0.5,0\n3,2.5,0,-8\n4,4,0,0\n";
  other.contacts = "0,c,-1,0.125\n1,c,-1,0\n2,c,-3,0\n3,c,-1,0\n4,c,-1,0\n";
  other.energy = "0,0,7\n1,1,0\n2,2,0\n3,4,0\n4,4,0\n";
  const compare::Comparison c = compare::compare_runs(a, folder.run("b", other));
  CHECK_FALSE(c.alignment.split);
  CHECK(c.notes.empty());
  CHECK(c.common_times == 5);
  CHECK(c.event_time.whole.value == 0.25);
  CHECK(c.event_time.whole.t == 3.5);
  CHECK(c.event_time.whole.where == "c stick, slip+ -> stick");
  CHECK(c.displacement.whole.value == 0.5);
  CHECK(c.displacement.whole.t == 3.0);
  CHECK(c.displacement.whole.where == "A.ux");
  CHECK(c.rotation.whole.value == 0.5);
  CHECK(c.velocity.whole.value == 8.0);
  CHECK(c.angular_velocity.count == 0);
  CHECK(c.force.whole.value == 2.0);
  CHECK(c.force.whole.where == "c.N");
  // Every time but the first has an event between its neighbours: 0 alone, 0 to 1, is away from them.
  CHECK(c.force_away.count == 1);
  CHECK(c.force_away.whole.value == 0.125);
  CHECK(c.force_away.whole.where == "c.T");
  CHECK(c.energy.whole.value == 1.0);  // the balance is a sum, and no energy of its own
  CHECK(c.columns.size() == 5);
  CHECK(c.columns.back().first == "c.T");
}

TEST_CASE("comparison: before and after the sequences part") {
  const Folder folder;
  Folder::Tables other = reference;
  other.events = "1.5,c,slip,stick,slip+,\n2.5,c,reversal,slip+,slip-,\n";
  other.history = "t,A.ux,A.rz,A.vx\n0,0,0,0\n1,1.25,0,0\n2,2,0,0\n3,9,0,0\n4,4,0,0\n";
  const compare::ComparedRun a = folder.run("a", reference), b = folder.run("b", other);
  const compare::Comparison c = compare::compare_runs(a, b);
  REQUIRE(c.alignment.split);
  CHECK(c.alignment.split->t == 2.5);
  CHECK(c.displacement.whole.value == 6.0);
  CHECK(c.displacement.until_split.value == 0.25);
  CHECK(c.displacement.until_split.t == 1.0);

  const auto broken = [&](const std::vector<std::string>& limits) {
    return compare::exceeded(compare::parse_limits(limits), a.figures, b.figures, c).size();
  };
  CHECK(broken({}) == 0);
  CHECK(broken({"displacement=6"}) == 0);
  CHECK(broken({"displacement=5.9"}) == 1);
  CHECK(broken({"sequence=0"}) == 1);
  CHECK(broken({"sequence=1"}) == 0);
  CHECK(broken({"event_time=1"}) == 1);  // of the events that have no partner
  CHECK(broken({"event_time=1", "sequence=1"}) == 0);
}

TEST_CASE("comparison: other output times, other columns, a run that is cut off") {
  const Folder folder;
  const compare::ComparedRun a = folder.run("a", reference);
  Folder::Tables other = reference;
  other.outcome = R"({"kind": "running", "t_end": 4})";
  other.events = "1.5,c,slip,stick,slip+,\n";
  other.history = "t,A.ux,B.ux\n0,0,0\n0.5,77,0\n1,1,0\n2,2.5,0\n3,3";
  other.contacts = "0,c,-1,0\n0.5,c,-77,0\n2,c,-2,0\n";
  other.energy = "0,0,0\n2,2,0\n";
  const compare::ComparedRun b = folder.run("b", other);
  CHECK(b.figures.t == 2.0);  // the last whole row
  const compare::Comparison c = compare::compare_runs(a, b);
  CHECK(c.t_end == 2.0);
  CHECK_FALSE(c.alignment.split);  // the reference's next event lies beyond
  CHECK(c.common_times == 3);
  CHECK(c.displacement.whole.value == 0.5);
  CHECK(c.force.whole.value == 1.0);
  REQUIRE(c.notes.size() == 2);
  CHECK(c.notes[0] == "compared up to t = 2, the end of b; a ends at 4");
  CHECK(c.notes[1] == "history.csv: 3 columns occur in only one of the two runs; the first is \"A.rz\"");
  CHECK(compare::exceeded(compare::parse_limits({"displacement=1"}), a.figures, b.figures, c).size() == 1);
}

TEST_CASE("comparison: a limit fails where what is compared is not the whole of both runs") {
  const Folder folder;
  const compare::ComparedRun a = folder.run("a", reference);
  struct Case {
    std::string what, limit, said;
    Folder::Tables tables;
  };
  std::deque<Case> cases;
  const auto add = [&](const std::string& what, const std::string& limit, const std::string& said) {
    cases.push_back({what, limit, said, reference});
    return &cases.back().tables;
  };
  add("no such column in both", "displacement=1",
      "only one of the two runs has A.ux, B.ux; columns in both runs: A.rz, A.vx")
      ->history = "t,B.ux,A.rz,A.vx\n0,0,0,0\n1,1,0,0\n2,2,0,0\n3,3,0,0\n4,4,0,0\n";
  add("no such column in either", "angular_velocity=1",
      "neither run has such a column; columns in both runs: A.ux, A.rz, A.vx and 2 more");
  add("forces cut off", "force=1", "contacts.csv of b has 1 row, expected 5 at the times of its history.csv")
      ->contacts = "0,c,-1,0\n";
  add("forces cut off", "force_away=1", "contacts.csv of b has 1 row")->contacts = "0,c,-1,0\n";
  add("energies cut off", "energy=1", "energy.csv of b has 2 rows, expected 5")->energy = "0,0,0\n1,1,0\n";
  Folder::Tables* const other_times =
      add("other times", "displacement=1",
          "only 2 rows of history.csv were compared; a has 5 rows, and b has 3 rows");
  other_times->history = "t,A.ux,A.rz,A.vx\n0,0,0,0\n1.5,1.5,0,0\n4,4,0,0\n";
  other_times->contacts = "0,c,-1,0\n1.5,c,-1,0\n4,c,-1,0\n";
  other_times->energy = "0,0,0\n1.5,1.5,0\n4,4,0\n";
  cases.push_back({"the same", "force=1", "only 2 rows of history.csv were compared", *other_times});
  Folder::Tables* const longer =
      add("longer", "displacement=1", "b: compared up to t = 4, but b continues to 5");
  longer->outcome = R"({"kind": "done", "t": 5, "t_end": 5, "reason": ""})";
  longer->history += "5,5,0,0\n";
  longer->contacts += "5,c,-1,0\n";
  longer->energy += "5,5,0\n";
  for (const Case& one : cases) {
    CAPTURE(one.what);
    CAPTURE(one.limit);
    const compare::ComparedRun b = folder.run("b", one.tables);
    const std::vector<std::string> list = compare::exceeded(compare::parse_limits({one.limit}), a.figures,
                                                            b.figures, compare::compare_runs(a, b));
    REQUIRE(list.size() == 1);
    CAPTURE(list[0]);
    CHECK(list[0].find(one.said) != std::string::npos);
  }
  const compare::ComparedRun b = folder.run("b", *other_times);
  const compare::Comparison c = compare::compare_runs(a, b);
  CHECK(c.rows.history == compare::RowCount{2, 5, 3});
  CHECK(compare::rows_compared(c) ==
        "history.csv 2 (reference 5, run 3), contacts.csv 2 (reference 5, run 3), energy.csv 2 (reference 5, "
        "run 3)");
  const compare::ComparedRun same = folder.run("same", reference);
  CHECK(compare::rows_compared(compare::compare_runs(a, same)) ==
        "history.csv 5, contacts.csv 5, energy.csv 5");
  CHECK(compare::exceeded(compare::parse_limits({"displacement=0", "rotation=0", "force=0", "force_away=0",
                                                 "energy=0", "event_time=0"}),
                          a.figures, same.figures, compare::compare_runs(a, same))
            .empty());
}

TEST_CASE("comparison: what is no number is greater than any limit") {
  compare::MaxDifference greatest;
  greatest.update(1.0, 1.0, "a");
  greatest.update(std::nan(""), 2.0, "b");
  greatest.update(3.0, 3.0, "c");
  CHECK(std::isnan(greatest.value));
  CHECK(greatest.where == "b");
  CHECK_FALSE(greatest.value <= 1e300);
}

TEST_CASE("compare: the JSON names the event of either run where the sequences part") {
  const Folder folder;
  Folder::Tables other = reference;
  other.events = "1.5,c,slip,stick,slip+,1e-9\n2.25,c,stick,slip+,stick,\n";
  Folder::Tables third = reference;
  third.events = "1.5,c,slip,stick,slip+,1e-9\n2.75,c,reversal,slip+,slip-,\n";
  compare::ComparisonReport report;
  report.runs = {folder.run("a", reference), folder.run("b", other), folder.run("c", third)};
  report.comparisons = {compare::compare_runs(report.runs[0], report.runs[1]),
                        compare::compare_runs(report.runs[0], report.runs[2])};
  const auto json = nlohmann::json::parse(compare::comparison_json(report));
  const auto& parted = json["comparisons"][1]["first_difference"];
  CHECK(parted["t"] == 2.75);
  CHECK(parted["reference"]["t"] == 3.5);
  CHECK(parted["run"]["t"] == 2.75);
  CHECK(parted["run"]["event"] == "reversal");
}

TEST_SUITE_END();
