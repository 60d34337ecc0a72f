#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "result/plots.hpp"
#include "result/run_directory.hpp"
#include "result/summary.hpp"
#include "signorini/error.hpp"
#include "unit/result/made_up.hpp"

using namespace signorini;
using namespace signorini::made_up;
using nlohmann::json;

TEST_SUITE_BEGIN("unit/result/run_directory");

TEST_CASE("run directory: nothing is there before the run starts") {
  const Folder folder;
  const Scene s = scene();
  const Model m = model();
  {
    result::RunDirectory directory(folder / "run", s, m);
    CHECK_FALSE(directory.started());
  }
  CHECK_FALSE(std::filesystem::exists(folder / "run"));
}

TEST_CASE("run directory: all files of a run, and a summary that says running until it ends") {
  const Folder folder;
  const Scene s = scene();
  const Model m = model();
  result::RunDirectory directory(folder / "deep" / "run", s, m,
                                 {.force = false, .command_line = {"signorini", "run"}});
  feed(directory, 0.0);
  const auto path = directory.path();
  CHECK(json::parse(slurp(path / "summary.json"))["outcome"]["kind"] == "running");
  CHECK(slurp(path / "run.toml") == s.resolved);
  directory.event(slip(0.5));
  feed(directory, 1.0);
  const std::string text = directory.finish(report());
  CHECK(text == slurp(path / "summary.json"));
  for (const char* name : {"events.csv", "history.csv", "contacts.csv", "energy.csv"}) {
    CHECK(std::filesystem::exists(path / name));
  }
}

TEST_CASE("run directory: a run that fails at its first decision leaves its directory") {
  const Folder folder;
  const Scene s = scene();
  const Model m = model();
  result::RunDirectory directory(folder / "run", s, m);
  Report r = report(Outcome::Kind::stopped);
  r.outcome.reason = "no consistent state at t = 0";
  (void)directory.finish(r);
  const json summary = json::parse(slurp(folder / "run" / "summary.json"));
  CHECK(summary["outcome"]["kind"] == "stopped");
  CHECK(summary["outcome"]["exit_code"] == 4);
  CHECK(summary["outcome"]["reason"] == "no consistent state at t = 0");
  CHECK(std::filesystem::exists(folder / "run" / "events.csv"));
}

TEST_CASE("run directory: an existing one is refused unless empty or forced") {
  const Folder folder;
  const Scene s = scene();
  const Model m = model();
  const auto path = folder / "run";
  std::filesystem::create_directory(path);
  CHECK_NOTHROW(result::RunDirectory(path, s, m));
  spill(path / "notes.txt", "mine");
  CHECK_THROWS_WITH_AS(
      result::RunDirectory(path, s, m),
      (path.string() + ": directory exists and is not empty; use --force to replace the run in it").c_str(),
      FileError);
}

TEST_CASE("run directory: force removes what Signorini wrote and nothing else") {
  const Folder folder;
  const Scene s = scene();
  const Model m = model();
  const auto path = folder / "run";
  {
    result::RunDirectory first(path, s, m);
    feed(first, 0.0);
    feed(first, 1.0);
    (void)first.finish(report());
    CHECK(result::write_plots(path).size() == 6);
  }
  spill(path / "notes.txt", "mine");
  spill(path / "plots" / "mine.png", "mine");
  spill(path / "plots" / "contact-gone.svg", "old");
  {
    result::RunDirectory second(path, s, m, {.force = true, .command_line = {}});
    CHECK(std::filesystem::exists(path / "plots" / "energy.gp"));  // not before the run starts
    (void)second.progress(0.0);
  }
  CHECK(slurp(path / "notes.txt") == "mine");
  CHECK(slurp(path / "plots" / "mine.png") == "mine");
  CHECK_FALSE(std::filesystem::exists(path / "plots" / "contact-gone.svg"));
  CHECK_FALSE(std::filesystem::exists(path / "plots" / "energy.gp"));
  CHECK(slurp(path / "history.csv") == "t,A.ux,A.uy,A.vx,A.vy\n");
}

TEST_CASE("run directory: a file of that name is refused, forced or not") {
  const Folder folder;
  spill(folder / "run", "a file");
  const Scene s = scene();
  const Model m = model();
  CHECK_THROWS_AS(result::RunDirectory(folder / "run", s, m, {.force = true, .command_line = {}}), FileError);
  CHECK(slurp(folder / "run") == "a file");
}

TEST_CASE("summary: holds what a reader needs") {
  const json j = json::parse(
      result::summary_json(scene(), model(), {report(), {}, "", {}}, {"signorini", "run", "made-up.toml"}));
  CHECK(j["outcome"]["kind"] == "done");
  CHECK(j["engine"] == "ida");
  CHECK(j["units"]["energy"] == "kN m");
  CHECK(j["events"]["total"] == 3);
  CHECK(j["events"]["by_type"]["slip"] == 2);
  CHECK(j["settings"]["rtol"] == 1e-8);
  CHECK(j["counters"]["steps_by_order"]["5"] == 90);
  CHECK(j["audit"]["friction"]["relative"].get<double>() == doctest::Approx(1e-11));
  CHECK(j["audit"]["friction"]["contact"] == "pad, left");
  CHECK_FALSE(j["audit"]["gap"].contains("contact"));
  CHECK(j["contacts"][0]["static_reaction"] == 58.86);
  CHECK(j["contacts"][1]["friction_work"] == 0.25);
  CHECK_FALSE(j["contacts"][1].contains("gap"));
  CHECK(j["model"]["free_motions"].size() == 1);
  CHECK(j["command_line"].size() == 3);
  CHECK_FALSE(j["versions"]["signorini"].get<std::string>().empty());
}

TEST_CASE("summary: an odd byte in a name does not cost the summary") {
  Scene s = scene();
  s.title = "na\xefve";
  CHECK(json::parse(result::summary_json(s, model(), {report(), {}, "", {}}, {})).contains("title"));
}

TEST_CASE("run directory: two runs at once do not share it") {
  const Folder folder;
  const Scene s = scene();
  const Model m = model();
  {
    result::RunDirectory first(folder / "run", s, m);
    result::RunDirectory second(folder / "run", s, m);
    feed(first, 0.0);
    (void)first.finish(report());
    result::RunDirectory third(folder / "run", s, m, {.force = true, .command_line = {}});
    CHECK_THROWS_WITH_AS(feed(third, 0.0),
                         doctest::Contains("another process is writing a run to this directory"), FileError);
    CHECK_THROWS_AS(feed(second, 0.0), FileError);
    CHECK(json::parse(slurp(folder / "run" / "summary.json"))["outcome"]["kind"] == "done");
  }
  result::RunDirectory later(folder / "run", s, m, {.force = true, .command_line = {}});
  feed(later, 0.0);
  CHECK(json::parse(slurp(folder / "run" / "summary.json"))["outcome"]["kind"] == "running");
}

TEST_CASE("run directory: a summary that names a contact twice is none") {
  const Folder folder;
  const Scene s = scene();
  Model m = model();
  m.contacts[1].name = m.contacts[0].name;
  result::RunDirectory directory(folder / "run", s, m);
  feed(directory, 0.0);
  feed(directory, 1.0);
  (void)directory.finish(report());
  CHECK_THROWS_WITH_AS((void)result::write_plots(folder / "run"),
                       doctest::Contains("names the contact 'foot' twice"), FileError);
}

TEST_SUITE_END();
