// Recordings of slower sensors are compared where they are fresh.
#include "measurement/hold_correction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "config.h"

namespace anthrob {
namespace discovery {
namespace {

/// The hinge of the rig by a camera, beside a force that is fresh in every row.
Dataset seen_by_camera(double rate) {
  Dataset data;
  data.folder = "run";
  data.tables.resize(2);
  Table &muscles = data.tables[0], &joints = data.tables[1];
  muscles.name = "muscles", joints.name = "joints";
  Column& force = muscles.column("flexor/force");
  Column& hinge = joints.column("hinge/position");
  for (int i = 0; i < 2000; ++i) {
    const double time = 0.005 * i, taken = std::floor(time * rate + 1e-9) / rate;
    const auto stamp = static_cast<Nanoseconds>(i) * 5000000;
    muscles.t.push_back(stamp), joints.t.push_back(stamp);
    force.values.push_back(10.0 + std::sin(time)), force.present.push_back(1);
    hinge.values.push_back(std::sin(2.0 * taken)), hinge.present.push_back(1);
  }
  return data;
}

Description of_rig(double rate) {
  Description description;
  description.question.train = {seen_by_camera(rate)};
  description.question.test = {seen_by_camera(rate)};
  correct_holds(*load_robot_model(kConfig + "/two_muscle_rig/model_I.yaml"), description);
  return description;
}

TEST(HoldCorrection, LeavesWhatIsFreshAtTheTimesOfFrames) {
  const Description description = of_rig(60.0);
  EXPECT_TRUE(description.corrected);
  for (const auto* group : {&description.question.train, &description.question.test}) {
    const Series hinge = group->front().series("hinge/position");
    ASSERT_NEAR(static_cast<double>(hinge.t.size()), 600.0, 3.0);
    for (std::size_t i = 0; i < hinge.t.size(); ++i) {
      EXPECT_NEAR(hinge.values[i], std::sin(2.0 * hinge.t[i]), 1e-6);
    }
    EXPECT_EQ(group->front().series("flexor/force").t.size(), 2000u);
    EXPECT_EQ(group->front().begin(), 0);
  }
}

TEST(HoldCorrection, IsReportedWithAnIntervalAndRemarkedOnce) {
  const Description description = of_rig(60.0);
  ASSERT_EQ(description.measurement.size(), 1u);
  const MeasurementProperty& hold = description.measurement[0];
  EXPECT_EQ(hold.what, "hold");
  EXPECT_EQ(hold.place, "hinge");
  EXPECT_EQ(hold.unit, "Hz");
  EXPECT_EQ(hold.source, "found");
  EXPECT_LE(hold.ci95[0], 60.0);
  EXPECT_GE(hold.ci95[1], 60.0);
  ASSERT_EQ(description.remarks.size(), 1u);
  EXPECT_NE(description.remarks[0].find("hinge/joint position: fresh only 60 times a second"),
            std::string::npos)
      << description.remarks[0];
}

TEST(HoldCorrection, LeavesFreshRowsAlone) {
  const Description description = of_rig(200.0);
  EXPECT_FALSE(description.corrected);
  EXPECT_TRUE(description.measurement.empty());
  EXPECT_TRUE(description.remarks.empty());
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
