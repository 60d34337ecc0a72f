// Where a run left its contacts, read from tables of every version.
#include <doctest/doctest.h>

#include "scene/saved_state.hpp"
#include "unit/result/made_up.hpp"

using namespace signorini;
using namespace signorini::made_up;

TEST_SUITE_BEGIN("unit/scene/saved_state");

TEST_CASE("contacts.csv with and without the column ratio") {
  const Folder folder;
  const auto read = [&](const std::string& text) {
    spill(folder / "contacts.csv", text);
    return scene::read_final_contacts(folder / "contacts.csv", 0.5);
  };
  for (const char* text :
       {"t,contact,state,gap,ut,vt,slip,N,T\n0,a,open,1,0,0,0,0,0\n0.5,a,stick,,1,2,3,-4,1\n",
        "t,contact,state,gap,ut,vt,slip,N,T,ratio\n0,a,open,1,0,0,0,0,0,\n"
        "0.5,a,stick,,1,2,3,-4,1,0.25\n"}) {
    CAPTURE(text);
    const std::vector<SavedState::FinalContact> rows = read(text);
    REQUIRE(rows.size() == 1);
    CHECK(rows[0].contact == "a");
    CHECK(rows[0].state == "stick");
    CHECK_FALSE(rows[0].gap);
    CHECK(rows[0].ut == 1.0);
    CHECK(rows[0].N == -4.0);
    CHECK(rows[0].T == 1.0);
  }
  CHECK(read("t,contact,state,gap,ut,vt,slip,T,N\n0.5,a,stick,,1,2,3,1,-4\n").empty());
  CHECK(read("t,contact,state,gap,ut,vt,slip,N\n0.5,a,stick,,1,2,3,-4\n").empty());
}

TEST_SUITE_END();
