// What docs/output.md says of events.csv is what the tables of signorini/event.hpp say.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <algorithm>

#include "base/run_files.hpp"
#include "result/certificate_files.hpp"
#include "signorini/event.hpp"
#include "unit/result/made_up.hpp"

using namespace signorini;

TEST_SUITE_BEGIN("unit/result/documentation");

TEST_CASE("docs/output.md: the columns of events.csv, and the types of events") {
  std::string columns = "| column | unit | meaning |\n|---|---|---|\n";
  for (const EventColumn& c : event_columns)
    columns += fmt::format("| `{}` | {} | {} |\n", c.name, c.unit, c.meaning);
  std::string certified = "| column | unit | meaning |\n|---|---|---|\n";
  for (const result::CertificateColumn& c : result::certificate_columns)
    certified += fmt::format("| `{}` | {} | {} |\n", c.name, c.unit, c.meaning);
  std::string types = "| event | what happens |\n|---|---|\n";
  for (const EventTypeName& type : all_event_types)
    types += fmt::format("| `{}` | {} |\n", type.name, type.meaning);
  const std::string text = made_up::slurp(SIGNORINI_MODELS "/../docs/output.md");
  for (const std::string& table : {columns, certified, types}) {
    INFO("docs/output.md should hold:\n", table);
    CHECK(text.find("\n\n" + table + "\n") != std::string::npos);
  }
}

TEST_CASE("docs/output.md: the files of a manifest, in their order") {
  std::string text = made_up::slurp(SIGNORINI_MODELS "/../docs/output.md");
  std::replace(text.begin(), text.end(), '\n', ' ');
  std::string files;
  for (const std::string_view file : base::result_files) files += fmt::format("{}, ", file);
  files.replace(files.size() - 2, 2, ".");
  for (std::size_t at; (at = text.find(",   ")) != std::string::npos;) text.replace(at, 4, ", ");
  INFO("docs/output.md should hold: ", files);
  CHECK(text.find("in this order: " + files) != std::string::npos);
}

TEST_SUITE_END();
