// IDA against newmark at three steps: agreement where both are right, a planted error found.
#include <doctest/doctest.h>

#include "behaviour/reference.hpp"
#include "study/verify/verify.hpp"

using namespace signorini;

namespace {

Scene case_called(const std::string& name, std::vector<Override> overrides = {}) {
  overrides.push_back({"run.engine", "ida"});
  return read_scene(std::string(SIGNORINI_TEST_DATA) + "/cases/" + name + ".toml", overrides);
}

verify::Verification verified(const Scene& scene, const Scene& own) {
  verify::VerifyRequest request;
  request.run = scene.run;
  request.dt = scene.run.dt;
  request.max_seconds = 2.0;
  return verify::verify(build_model(scene), build_model(own), request);
}

verify::Verification verified(const Scene& scene) { return verified(scene, scene); }

}  // namespace

TEST_SUITE_BEGIN("slow/behaviour/verify");

TEST_CASE("verify: cases agree, with order two") {
  for (const char* name : {"01b_coulomb_decay_compliant", "02b_belt_fs_gt_fk", "03b_den_hartog_2stop",
                           "05g_two_mass_compliant"}) {
    CAPTURE(name);
    const verify::Verification v = verified(case_called(name));
    INFO(v.sentence);
    CHECK(v.verdict == verify::Agreement::agree);
    for (const verify::VerifiedKind& kind : v.kinds) {
      CAPTURE(kind.name);
      if (kind.order) CHECK(*kind.order == doctest::Approx(2.0).epsilon(0.05));
      CHECK(kind.disagreeing == 0);
    }
    CHECK(v.paper_dt);
  }
}

TEST_CASE("verify: an error of 1e-4 in IDA's friction alone is found, and named") {
  const std::string name = "01b_coulomb_decay_compliant";
  const Scene scene = case_called(name);
  Scene off = scene;
  off.contacts.at(0).friction.static_ *= 1.0001;
  off.contacts.at(0).friction.kinetic *= 1.0001;
  const verify::Verification v = verified(scene, off);
  INFO(v.sentence);
  CHECK(v.verdict == verify::Agreement::differ);
  CHECK(v.sentence.find("ida") != std::string::npos);
}

TEST_CASE("verify: steps that are too coarse decide nothing, and say which would") {
  const Scene scene = case_called("03b_den_hartog_2stop", {{"run.dt", "3.0"}});
  const verify::Verification v = verified(scene);
  INFO(v.sentence);
  CHECK(v.verdict == verify::Agreement::undecided);
  CHECK(v.sentence.find("--set run.dt=") != std::string::npos);
}
