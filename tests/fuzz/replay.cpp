// Every file that a fuzzer was fed with, or that once broke something, again.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "fuzz/targets.hpp"

using namespace signorini;

TEST_SUITE_BEGIN("fuzz/replay");

TEST_CASE("the corpora: nothing but an Error comes out") {
  for (const fuzz::Target& target : fuzz::targets) {
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(SIGNORINI_TEST_DATA) /
                                                                 "fuzz" / "corpus" / target.name)) {
      INFO(entry.path().string());
      std::ifstream file(entry.path(), std::ios::binary);
      const std::string bytes{std::istreambuf_iterator<char>(file), {}};
      CHECK_NOTHROW(target.run(bytes));
      ++files;
    }
    INFO(target.name);
    CHECK(files > 0);
  }
}

TEST_SUITE_END();
