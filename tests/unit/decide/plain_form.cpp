#include "decide/guard_signs.hpp"

#include <doctest/doctest.h>

#include <random>

using namespace signorini;

TEST_SUITE_BEGIN("unit/decide/plain_form");

TEST_CASE("values are those of the form to the last bit, whichever terms it has") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-3.0, 3.0);
  int plain = 0;
  for (int i = 0; i < 4096; ++i) {
    double f[13], m[12];
    for (int k = 0; k < 13; ++k) f[k] = k == 12 || (i >> (k % 12) & 1) ? any(random) : 0.0;
    for (double& x : m) x = any(random);
    const Form form{f[0], f[1], f[2], f[3], f[4], f[5], f[6], f[7], f[8], f[9], f[10], f[11], f[12]};
    const ContactMotion motion{m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9], m[10], m[11]};
    const decide::QuickForm quick(form);
    REQUIRE(decide::is_plain(form) == (i >> 6 == 0));
    REQUIRE(quick.value(motion) == form.value(motion));
    REQUIRE(quick.rate(motion) == form.rate(motion));
    REQUIRE(quick.magnitude(motion) == form.magnitude(motion));
    plain += decide::is_plain(form) ? 1 : 0;
  }
  CHECK(plain == 64);
}

TEST_SUITE_END();
