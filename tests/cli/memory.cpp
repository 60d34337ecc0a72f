// What a run takes of memory does not grow with its events: 13 masses with 13 sliders, of which every combination of
// sticking and slipping comes by.
#include <doctest/doctest.h>

#include <sys/resource.h>

#include <algorithm>
#include <initializer_list>

#include "program.hpp"

namespace signorini::cli_test {
namespace {

struct Spent {
  int code = -1;
  double megabytes = 0.0;
  std::size_t events = 0;
};

Spent spent(const Shell& shell, const std::string& engine, double t_end) {
  const std::string end = std::to_string(t_end);
  const pid_t child =
      shell.start({"run", SIGNORINI_TEST_DATA "/scenes/robust/sliders13.toml", "-o", "out", "--force",
                   "--no-plots", "--engine", engine, "--set", "run.certify=false", "--set", "run.dt=0.01",
                   "--set", "run.t_end=" + end, "--set", "run.output_dt=" + end});
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  const std::string table = shell.read("out/events.csv");
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, static_cast<double>(usage.ru_maxrss) / 1024.0,
          static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n'))};
}

}  // namespace

TEST_SUITE_BEGIN("slow/cli/memory");

TEST_CASE("cli: the memory of a run does not grow with its events") {
  struct Row {
    const char* engine;
    double once, later;
    std::size_t events;
  };
  for (const Row& row : std::initializer_list<Row>{{"exact", 3500.0, 34500.0, 100'000},
                                                   {"ida", 1200.0, 3600.0, 10'000},
                                                   {"newmark", 1200.0, 3600.0, 10'000},
                                                   {"friction-iteration", 1200.0, 3600.0, 10'000}}) {
    const std::string engine = row.engine;
    CAPTURE(engine);
    const Shell shell;
    const Spent once = spent(shell, engine, row.once), later = spent(shell, engine, row.later);
    CHECK(once.code == 0);
    CHECK(later.code == 0);
    CHECK(later.events > row.events);
    CHECK(later.megabytes < once.megabytes + 2.0);
    CHECK(later.megabytes < 40.0);
  }
}

TEST_SUITE_END();

}  // namespace signorini::cli_test
