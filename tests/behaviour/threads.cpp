// Simulations side by side: the library has no state of its own, so threads do not change a bit.
#include <doctest/doctest.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "signorini/simulate.hpp"

using namespace signorini;

namespace {

struct Job {
  std::string scene, engine;
};

std::vector<Event> events_of(const Job& job) {
  const Scene scene = read_scene(std::string(SIGNORINI_TEST_DATA) + "/cases/" + job.scene + ".toml",
                                 {{"run.engine", job.engine}});
  return simulate(build_model(scene), scene.run).events;
}

std::vector<Job> twenty_jobs() {
  std::vector<Job> jobs;
  for (const char* scene : {"01b_coulomb_decay_compliant", "05g_two_mass_compliant", "06_point_rigid_e0.5",
                            "08b_lumped_singular_M", "11_painleve_regular_rigid"})
    for (const char* engine : {"ida", "exact", "ida", "exact"}) jobs.push_back({scene, engine});
  return jobs;
}

}  // namespace

TEST_SUITE_BEGIN("behaviour/threads");

TEST_CASE("twenty simulations in eight threads give the bits of one after another") {
  const std::vector<Job> jobs = twenty_jobs();
  std::vector<std::vector<Event>> alone, together(jobs.size());
  for (const Job& job : jobs) alone.push_back(events_of(job));
  std::atomic<std::size_t> next = 0;
  std::vector<std::jthread> threads(8);
  for (std::jthread& thread : threads)
    thread = std::jthread([&] {
      for (std::size_t i = next++; i < jobs.size(); i = next++) together[i] = events_of(jobs[i]);
    });
  threads.clear();  // joins
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    CAPTURE(jobs[i].scene);
    CAPTURE(jobs[i].engine);
    REQUIRE(!alone[i].empty());
    REQUIRE(together[i].size() == alone[i].size());
    for (std::size_t k = 0; k < alone[i].size(); ++k) {
      CHECK(together[i][k].t == alone[i][k].t);
      CHECK(together[i][k].contact == alone[i][k].contact);
      CHECK(together[i][k].to == alone[i][k].to);
      CHECK(together[i][k].N_after == alone[i][k].N_after);
      CHECK(together[i][k].T_after == alone[i][k].T_after);
    }
  }
}

TEST_SUITE_END();
