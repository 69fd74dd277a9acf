// Every robot of the suite is read without a word; inputs of others, where there are any, end as
// their lists say.
#include <cstdlib>

#include "loading/urdf_support.h"

namespace anthrob {
namespace {

namespace fs = std::filesystem;

TEST(RobotsOfTheSuite, AreReadWithoutAWord) {
  int count = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(ANTHROB_CONFIG_DIR)) {
    if (entry.path().extension() != ".urdf") continue;
    SCOPED_TRACE(entry.path().string());
    ++count;
    for (const bool collisions : {false, true}) {
      EXPECT_TRUE(read_urdf(entry.path().string(), collisions).remarks.empty());
    }
  }
  EXPECT_GE(count, 9);
}

struct SharedCase {
  const char* folder;
  bool refused;       ///< otherwise remarked on
  const char* words;  ///< of the message
};

// Outside of the suite, in cases/ of the folder that ANTHROB_SHARED names.
const SharedCase kShared[] = {
    {"urdf_attribute_typo", true, "joint elbow: origin: xzy: unknown attribute"},
    {"urdf_com_in_mm", true, "centre of mass 120 m away"},
    {"urdf_doctype", true, "DOCTYPE and entities are not read"},
    {"urdf_fixed_negative_inertia", true, "link tool: inertia: principal moments"},
    {"urdf_inertia_units", true, "in kg mm^2?"},
    {"urdf_joint_type_ball", true, "joint elbow: type: ball: expected floating"},
    {"urdf_limits_in_degrees", false, "more than a turn"},
    {"urdf_loop", true, "joint loop: closes a loop of links upper_arm and forearm"},
    {"urdf_loop_self", true, "joint second: parent and child are both forearm"},
    {"urdf_newline_in_vector", true, "joint shoulder: origin: xyz: a line end"},
    {"urdf_origin_as_text", true, "joint elbow: origin: xyz: unknown element"},
    {"urdf_quat_xyzw", true, "joint elbow: origin: quat_xyzw: unknown attribute"},
    {"urdf_two_parents", true,
     "link forearm: child of joints elbow and second; expected one parent"},
    {"urdf_two_parents_revolute", true, "link forearm: child of joints elbow and p2; expected one"},
    {"urdf_utf16", true, "UTF-16"},
    {"urdf_xacro_include", true, "xacro:include: expected a URDF; run xacro first"},
    {"urdf_xacro_macro", true, "xacro:solid_ball: expected a URDF; run xacro first"},
};

TEST(SharedCases, EndAsTheirListSays) {
  const char* shared = std::getenv("ANTHROB_SHARED");
  if (!shared) GTEST_SKIP() << "ANTHROB_SHARED names no folder with cases/";
  for (const SharedCase& test : kShared) {
    SCOPED_TRACE(test.folder);
    const fs::path folder = fs::path(shared) / "cases" / test.folder;
    std::string said;
    bool refused = false;
    try {
      const auto model = load_robot_model((folder / "model_I.yaml").string());
      for (const std::string& remark : model->remarks) said += remark + "\n";
    } catch (const BadInput& error) {
      said = error.what();
      refused = true;
      EXPECT_EQ(said.find('\n'), std::string::npos);
    }
    EXPECT_EQ(refused, test.refused);
    EXPECT_NE(said.find(test.words), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace anthrob
