#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "anthrob_core/errors.h"
#include "skeleton/urdf.h"
#include "support.h"

namespace anthrob {
namespace testing_support {

/// An arm of two links; the tests below change one thing of it.
inline const std::string kArmUrdf = R"(<robot name="arm">
  <link name="base"/>
  <joint name="shoulder" type="revolute">
    <parent link="base"/>
    <child link="upper_arm"/>
    <origin xyz="0 0 0.6"/>
    <axis xyz="0 -1 0"/>
    <limit lower="-1" upper="1.5" effort="0" velocity="0"/>
  </joint>
  <link name="upper_arm">
    <inertial>
      <origin xyz="0 0 -0.12"/>
      <mass value="0.4"/>
      <inertia ixx="2.1e-3" ixy="0" ixz="0" iyy="2.1e-3" iyz="0" izz="8e-5"/>
    </inertial>
    <visual>
      <origin xyz="0 0 -0.125"/>
      <geometry><box size="0.025 0.015 0.25"/></geometry>
    </visual>
  </link>
  <joint name="elbow" type="revolute">
    <parent link="upper_arm"/>
    <child link="forearm"/>
    <origin xyz="0 0 -0.25"/>
    <axis xyz="0 -1 0"/>
    <limit lower="0" upper="2" effort="0" velocity="0"/>
  </joint>
  <link name="forearm">
    <inertial>
      <origin xyz="0 0 -0.1"/>
      <mass value="0.2"/>
      <inertia ixx="7e-4" ixy="0" ixz="0" iyy="7e-4" iyz="0" izz="3e-5"/>
    </inertial>
  </link>
</robot>
)";

/// The arm with a piece of its text replaced, where it stands first.
inline std::string arm_with(const std::string& from, const std::string& to) {
  std::string text = kArmUrdf;
  const auto at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the arm has no " + from);
  return text.replace(at, from.size(), to);
}

/// The arm with more at its end, in line 35.
inline std::string arm_and(const std::string& more) {
  return arm_with("</robot>", more + "\n</robot>");
}

/// What is said about a URDF, without the folder: "robot.urdf:12: ...".
struct Said {
  std::optional<std::string> refusal;
  std::vector<std::string> remarks;
};

inline std::string without_folder(const std::string& message) {
  const auto at = message.find("robot.urdf");
  return at == std::string::npos ? message : message.substr(at);
}

inline Said said_about(const std::string& urdf, bool collisions = false) {
  const TemporaryRobot folder(urdf, "");
  const std::string model = folder.file();
  Said said;
  try {
    const std::string file = model.substr(0, model.rfind('/')) + "/robot.urdf";
    for (const std::string& remark : read_urdf(file, collisions).remarks) {
      said.remarks.push_back(without_folder(remark));
    }
  } catch (const BadInput& error) {
    said.refusal = without_folder(error.what());
  }
  return said;
}

inline void expect_refused(const std::string& urdf, const std::string& message) {
  const Said said = said_about(urdf);
  EXPECT_EQ(said.refusal.value_or("accepted"), "robot.urdf:" + message);
}

inline void expect_remark(const std::string& urdf, const std::string& message) {
  const Said said = said_about(urdf);
  EXPECT_EQ(said.refusal, std::nullopt) << *said.refusal;
  ASSERT_EQ(said.remarks.size(), 1u);
  EXPECT_EQ(said.remarks[0], "robot.urdf:" + message);
}

inline void expect_silence(const std::string& urdf) {
  const Said said = said_about(urdf);
  EXPECT_EQ(said.refusal, std::nullopt) << *said.refusal;
  EXPECT_TRUE(said.remarks.empty()) << said.remarks[0];
}

}  // namespace testing_support
}  // namespace anthrob
