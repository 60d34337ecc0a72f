// Sweeps in shares: merged, and under launchers.
#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "sweep_rows.hpp"

using nlohmann::json;
using signorini::cli_test::belt;
using signorini::cli_test::Ending;
using signorini::cli_test::exists;
using signorini::cli_test::has;
using signorini::cli_test::line;
using signorini::cli_test::on_path;
using signorini::cli_test::rows;
using signorini::cli_test::Shell;
using signorini::cli_test::vary;

TEST_SUITE_BEGIN("cli/sweep_shares");

TEST_CASE("cli sweep: shares are merged, what is missing is named") {
  const Shell shell;
  shell.write("belt.toml", belt(10));
  REQUIRE(shell.run({"sweep", "belt.toml", "--vary", vary, "--no-plots", "-o", "whole"}).code == 0);
  for (const char* share : {"1/3", "2/3", "3/3"})
    REQUIRE(shell.run({"sweep", "belt.toml", "--vary", vary, "--no-plots", "--share", share}).code == 0);
  CHECK(rows(shell, "belt-sweep-1-of-3").size() == 2);
  const Ending part =
      shell.run({"sweep", "--merge", "belt-sweep-1-of-3", "belt-sweep-3-of-3", "-o", "part", "--no-plots"});
  CHECK(part.code == 4);
  CHECK(has(part.err, "2 of 5 rows missing (2, 5)") == true);
  CHECK(shell.run({"sweep", "belt.toml", "--vary", vary, "--no-plots", "-o", "part"}).code == 0);
  CHECK(rows(shell, "part") == rows(shell, "whole"));
  const Ending all = shell.run({"sweep", "--merge", "belt-sweep-1-of-3", "belt-sweep-2-of-3",
                                "belt-sweep-3-of-3", "-o", "all", "--no-plots"});
  CHECK(all.code == 0);
  CHECK(rows(shell, "all") == rows(shell, "whole"));

  REQUIRE(
      shell.run({"sweep", "belt.toml", "--vary", "run.rtol=1e-7,1e-8", "-o", "foreign", "--no-plots"}).code ==
      0);
  const Ending foreign = shell.run({"sweep", "--merge", "belt-sweep-1-of-3", "foreign", "-o", "mixed"});
  CHECK(foreign.code == 6);
  CHECK(has(foreign.err, "foreign: is not a share of the same sweep"));
  CHECK_FALSE(exists(shell, "mixed"));
}

TEST_CASE("cli sweep: spread by GNU parallel") {
  // moreutils has another program of that name
  if (std::system("parallel --version 2>/dev/null | grep -q GNU") != 0) {
    MESSAGE("skipped: no GNU parallel on PATH (Debian package parallel)");
    return;
  }
  const Shell shell;
  shell.write("belt.toml", belt(10));
  REQUIRE(line(shell, "$SIGNORINI sweep belt.toml --vary " + vary + " --no-plots --quiet -o whole") == 0);
  REQUIRE(line(shell, "parallel --will-cite -j 2 $SIGNORINI sweep belt.toml --vary " + vary +
                          " --jobs 1 --no-plots --quiet --share {}/3 ::: 1 2 3") == 0);
  REQUIRE(line(shell, "$SIGNORINI sweep --merge belt-sweep-*-of-3 -o joined --no-plots --quiet") == 0);
  CHECK(rows(shell, "joined") == rows(shell, "whole"));
}

TEST_CASE("cli sweep: spread by mpirun") {
  if (!on_path("mpirun")) {
    MESSAGE("skipped: no mpirun on PATH (Debian package openmpi-bin)");
    return;
  }
  const Shell shell;
  shell.write("belt.toml", belt(10));
  const std::string quoted =
      "$SIGNORINI sweep belt.toml --sample 'contacts.belt.friction.static=uniform(1.1,1.9)' --samples 6 "
      "--response residual:belt --no-plots --quiet ";
  REQUIRE(line(shell, quoted + "-o whole") == 0);
  REQUIRE(line(shell, "mpirun --allow-run-as-root --oversubscribe -n 2 " + quoted +
                          "--share auto 2>/dev/null") == 0);
  REQUIRE(line(shell, "$SIGNORINI sweep --merge belt-sweep-*-of-2 -o joined --no-plots --quiet") == 0);
  CHECK(rows(shell, "joined") == rows(shell, "whole"));
  CHECK(shell.read("joined/quantiles.csv") == shell.read("whole/quantiles.csv"));
}

TEST_CASE("cli sweep: a rank takes its share from the environment") {
  const Shell shell;
  shell.write("belt.toml", belt(10));
  for (const char* rank : {"0", "1"})
    REQUIRE(line(shell, std::string("OMPI_COMM_WORLD_RANK=") + rank +
                            " OMPI_COMM_WORLD_SIZE=2 $SIGNORINI sweep " + "belt.toml --vary " + vary +
                            " --share auto --no-plots --quiet") == 0);
  CHECK(rows(shell, "belt-sweep-1-of-2").size() == 3);
  CHECK(rows(shell, "belt-sweep-2-of-2").size() == 2);
}

TEST_SUITE_END();
