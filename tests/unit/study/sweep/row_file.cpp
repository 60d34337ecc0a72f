#include "study/sweep/row_file.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "own_folder.hpp"
#include "signorini/error.hpp"

using namespace signorini;

namespace {

namespace fs = std::filesystem;

sweep::SweepRow made(std::size_t index, const std::string& outcome, double t) {
  sweep::SweepRow out;
  out.index = index;
  out.values = {"0.3", "\"a, \\ b\""};
  out.outcome = outcome;
  out.reason = outcome == "done" ? "" : "what was \"checksum\": said";
  out.t = t;
  out.events = {{"slip", 2}, {"stick", 1}};
  out.contacts = {{"floor", 0.1, 1.0 / 3.0, -6.02e23, 1e-310, -0.7}};
  out.sequence = "slip@floor";
  return out;
}

std::string text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string why_refused(const fs::path& file) {
  try {
    (void)sweep::read_rows(file);
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_SUITE_BEGIN("unit/study/sweep/row_file");

TEST_CASE("row file: rows come back as they were, the later of two with one number") {
  const tests::OwnFolder folder;
  const fs::path file = folder.path() / "rows.jsonl";
  CHECK(sweep::read_rows(file).empty());
  {
    sweep::RowFile rows(file);
    rows.append(sweep::row_line(made(2, "crashed", 0.0)) + sweep::row_line(made(0, "done", 0.1)));
    rows.append(sweep::row_line(made(2, "stopped", 1.0 / 3.0)));
  }
  sweep::RowFile(file).append(sweep::row_line(made(1, "refused", 2.0)));  // goes on
  const auto rows = sweep::read_rows(file);
  REQUIRE(rows.size() == 3);
  for (const auto& [index, found] : rows) CHECK(found.row.index == index);
  CHECK(rows.at(0).line == 2);
  CHECK(rows.at(2).line == 3);
  CHECK(rows.at(1).line == 4);
  CHECK(sweep::same_result(rows.at(0).row, made(0, "done", 0.1)));
  CHECK(sweep::same_result(rows.at(1).row, made(1, "refused", 2.0)));
  CHECK(sweep::same_result(rows.at(2).row, made(2, "stopped", 1.0 / 3.0)));
}

TEST_CASE("row file: half a line at the end is no row, and the next one does not lengthen it") {
  const tests::OwnFolder folder;
  const fs::path file = folder.path() / "rows.jsonl";
  const std::string first = sweep::row_line(made(0, "done", 1.0)),
                    second = sweep::row_line(made(1, "done", 1.0));
  for (const std::size_t cut : {std::size_t{1}, second.size() / 2, second.size() - 1}) {
    CAPTURE(cut);
    std::ofstream(file, std::ios::binary) << first << second.substr(0, cut);
    CHECK(sweep::read_rows(file).size() == 1);
    sweep::RowFile(file).append(second);
    CHECK(text(file) == first + second);
    CHECK(sweep::read_rows(file).size() == 2);
  }
}

TEST_CASE("row file: every byte of a row counts") {
  const tests::OwnFolder folder;
  const fs::path file = folder.path() / "rows.jsonl";
  const std::string good = sweep::row_line(made(0, "stopped", 1.0));
  for (std::size_t i = 0; i + 1 < good.size(); ++i) {
    std::string bad = good;
    bad[i] = bad[i] == 'x' ? 'y' : 'x';
    std::ofstream(file, std::ios::binary) << good << bad;
    CAPTURE(i);
    REQUIRE(why_refused(file) == file.string() + ": line 2 has been altered since it was written");
  }
}

TEST_CASE("row file: what is no file of its own is refused, by name") {
  const tests::OwnFolder folder;
  const auto refused = [&](const fs::path& file, const std::string& why) {
    const std::string message = file.string() + ": " + why + ", expected a file with the rows of a sweep";
    CHECK(why_refused(file) == message);
    CHECK_THROWS_WITH_AS(sweep::RowFile{file}, message.c_str(), FileError);
  };
  fs::create_directory(folder.path() / "folder");
  refused(folder.path() / "folder", "is a directory");
  std::ofstream(folder.path() / "mine") << "mine";
  fs::create_symlink(folder.path() / "mine", folder.path() / "link");
  refused(folder.path() / "link", "is a symbolic link");
  CHECK(text(folder.path() / "mine") == "mine");
  CHECK_THROWS_AS(sweep::RowFile{folder.path() / "nowhere" / "rows.jsonl"}, FileError);
}

TEST_SUITE_END();
