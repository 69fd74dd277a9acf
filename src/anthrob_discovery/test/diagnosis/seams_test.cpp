// Where an error arises: replays fed at seams, measured postures and their noise.
#include "diagnosis/seams.h"

#include <gtest/gtest.h>

#include <cmath>

#include "anthrob_core/random.h"
#include "anthrob_recording/orientation_series.h"
#include "arm.h"
#include "diagnosis/wrap_angle.h"
#include "experiment/posture_noise.h"
#include "experiment/regimes.h"

namespace anthrob {
namespace discovery {
namespace {

TEST(Seams, AGapThatGoesWithTheMotorsIsTheirsHoweverTheRobotWasDriven) {
  const auto part = [](std::optional<double> commands, double voltages, double positions) {
    const SeamGap gap{"biceps_brachii", "force", false, commands, voltages, positions, {}};
    return subsystem_of(gap, {});
  };
  EXPECT_EQ(part(5.0, 5.0, 0.8), "power stage, motor or gear");
  EXPECT_EQ(part(std::nullopt, 5.0, 0.8), "power stage, motor or gear");
  EXPECT_EQ(part(5.0, 1.0, 0.8), "controller");
  EXPECT_EQ(part(std::nullopt, 5.0, 4.8), "spindle, tendon, spring, path or force sensor");
  // Noise is no gap.
  EXPECT_EQ(part(1.6, 1.6, 1.0), "power stage, motor or gear");
}

TEST(Seams, AForceThatIsRightInTheMeasuredPostureIsWrongByThePosture) {
  SeamGap gap{"biceps_brachii", "force", false, 4.0, 5.0, 4.0, 3.5};
  EXPECT_EQ(subsystem_of(gap, {}), "spindle, tendon, spring, length of the path or force sensor");
  gap.postures = 1.2;
  EXPECT_EQ(subsystem_of(gap, {}), "friction along the path, skeleton, joints or their sensors");
  gap = {"biceps_brachii", "force", false, 3.0, std::nullopt, 20.0, 4.0};  // an arm that ran away
  EXPECT_EQ(subsystem_of(gap, {}), "spindle, tendon, spring, length of the path or force sensor");
  gap.postures = 6.5;  // errors of the postures must be in it
  EXPECT_EQ(subsystem_of(gap, {}), "spindle, tendon, spring, path or force sensor");
  gap = {"biceps_brachii", "force", false, 4.0, 5.0, 4.0, 1.2};
  gap.positions = 0.9;  // right whatever the posture: then it is right there, too
  EXPECT_EQ(subsystem_of(gap, {}), "power stage, motor or gear");
}

/// Of the force of one muscle, of an arm with an effect that its model lacks.
SeamGap gap_of(const EffectInstance& effect, const std::string& muscle) {
  const Arm arm;
  const Evaluator evaluator(ANTHROB_CONFIG_DIR "/anthrob/model_I.yaml", {}, 1e-3, 2);
  Question question;
  question.train = {arm.record({effect}, 1, 1)};
  question.test = {arm.record({effect}, 2, 2)};
  const Admission recordings = admit(evaluator, question);
  const Scales scales = measure_scales(evaluator, recordings.train, {}, {}, {});
  for (const SeamGap& gap : seam_gaps(evaluator, recordings, scales, {})) {
    if (gap.place == muscle && gap.channel == "force") return gap;
  }
  return {};
}

TEST(Seams, AJointThatResistsIsCutOffByTheMeasuredPosture) {
  const SeamGap gap = gap_of({"joint_viscous", "elbow", {{"damping", 0.3}}}, "brachialis");
  EXPECT_GT(gap.positions, 3.0);
  EXPECT_LT(*gap.postures, 0.3 * *gap.positions);
  EXPECT_EQ(subsystem_of(gap, {}), "friction along the path, skeleton, joints or their sensors");
}

TEST(Seams, ATendonThatGivesIsNot) {
  const SeamGap gap =
      gap_of({"tendon_elasticity", "brachialis", {{"compliance", 2e-4}}}, "brachialis");
  EXPECT_GT(gap.positions, 3.0);
  EXPECT_GT(*gap.postures, 0.5 * *gap.positions);
  EXPECT_EQ(subsystem_of(gap, {}), "spindle, tendon, spring, length of the path or force sensor");
}

TEST(WrapAngles, AreThoseOfTheMeasuredPosture) {
  const Arm arm;
  const Evaluator evaluator(ANTHROB_CONFIG_DIR "/anthrob/model_I.yaml", {}, 1e-3, 1);
  const std::vector<Dataset> recordings = {arm.record({}, 1, 1)};
  const Experiments experiments = {make_experiment(*arm.plain, recordings[0], {})};
  const auto angles = wrap_angles(evaluator, recordings, experiments, {}, {});
  EXPECT_GE(angles.size(), 8u);
  Simulation placed(arm.plain);
  for (const double share : {0.2, 0.5, 0.9}) {
    const auto bin = static_cast<std::size_t>(share * 8.0 / experiments[0]->bin());
    std::vector<double> q = placed.configuration();
    OrientationSeries::read(recordings[0], "shoulder").at(experiments[0]->bin_time(bin), &q[0]);
    q[4] = recordings[0].series("elbow/position").at(experiments[0]->bin_time(bin));
    placed.place(q, std::vector<double>(11, 0.0));
    for (const MeasuredVariable& angle : angles) {
      ASSERT_EQ(angle.values.front().size(), experiments[0]->channels().front().count);
      double turning = 0.0;
      const Muscle& muscle = placed.muscle(arm.plain->find_muscle(angle.owner()));
      for (const auto& obstacle : muscle.path().obstacles()) turning += obstacle.turning;
      EXPECT_NEAR(angle.values.front()[bin], turning, 0.01) << angle.name << " " << share;
    }
  }
  // And a row of the map.
  const Eigen::VectorXf ones =
      Eigen::VectorXf::Ones(static_cast<Eigen::Index>(total_size(experiments)));
  const auto rows = regime_gaps(experiments, angles, ones, ones, {});
  EXPECT_EQ(rows.size(), angles.size());
  EXPECT_EQ(rows.front().word, "wrap angle");
  Dataset blind = recordings[0];
  for (Table& table : blind.tables) {  // nobody measured the shoulder
    if (table.name == "spherical_joints") table.columns.clear();
  }
  EXPECT_TRUE(wrap_angles(evaluator, {blind}, experiments, {}, {}).empty());
}

/// Rows of an arm at 50 Hz: the elbow's position and the shoulder's orientation about z.
Dataset posture(const std::vector<double>& elbow, const std::vector<double>& shoulder) {
  Dataset recording;
  Table& joints = recording.table("joints");
  for (std::size_t i = 0; i < elbow.size(); ++i) {
    joints.t.push_back(static_cast<Nanoseconds>(20000000 * i));
  }
  const std::vector<char> all(elbow.size(), 1);
  joints.columns = {{"elbow/position", elbow, all},
                    {"shoulder/w", {}, all},
                    {"shoulder/x", std::vector<double>(elbow.size(), 0.0), all},
                    {"shoulder/y", std::vector<double>(elbow.size(), 0.0), all},
                    {"shoulder/z", {}, all}};
  for (const double angle : shoulder) {
    joints.columns[1].values.push_back(std::cos(0.5 * angle));
    joints.columns[4].values.push_back(std::sin(0.5 * angle));
  }
  return recording;
}

TEST(PostureNoise, AParabolaStaysAndNoiseShrinks) {
  const Arm arm;
  constexpr std::size_t kRows = 2000;
  constexpr double kSigma = 0.004;
  const CounterRandom random(3);
  std::vector<double> curve, noisy;
  for (std::size_t i = 0; i < kRows; ++i) {
    const double t = 0.02 * static_cast<double>(i);
    curve.push_back(0.3 + 0.2 * t - 0.004 * t * t);
    noisy.push_back(curve.back() + kSigma * random.normal(i));
  }
  const auto elbow = [&](const Dataset& recording) {
    return with_smooth_postures(*arm.plain, recording, {}).series("elbow/position").values;
  };
  const std::vector<double> still(kRows, 0.1);
  const auto same = elbow(posture(curve, still)), smooth = elbow(posture(noisy, still));
  double squares = 0.0;
  for (std::size_t i = 0; i < kRows; ++i) {
    ASSERT_NEAR(same[i], curve[i], 1e-9) << i;
    squares += std::pow(smooth[i] - curve[i], 2);
  }
  // A parabola through seven rows: a third of the variance is left.
  EXPECT_NEAR(squares / kRows / (kSigma * kSigma), 1.0 / 3.0, 0.04);

  // Noise once more is as strong as what is there.
  const Dataset recording = posture(noisy, still);
  const auto more = with_noisier_postures(*arm.plain, recording, 7).series("elbow/position").values;
  double added = 0.0;
  for (std::size_t i = 0; i < kRows; ++i) added += std::pow(more[i] - noisy[i], 2);
  EXPECT_NEAR(std::sqrt(added / kRows), kSigma, 0.1 * kSigma);
  EXPECT_EQ(with_noisier_postures(*arm.plain, recording, 7).series("elbow/position").values, more);
  EXPECT_NE(with_noisier_postures(*arm.plain, recording, 8).series("elbow/position").values, more);
}

TEST(PostureNoise, NothingIsBridgedAndSignsDoNotMatter) {
  const Arm arm;
  std::vector<double> jump(40, 0.2), turn;
  for (std::size_t i = 20; i < 40; ++i) jump[i] = 0.9;
  for (std::size_t i = 0; i < 40; ++i) turn.push_back(0.1 + 0.01 * static_cast<double>(i));
  Dataset recording = posture(jump, turn);
  // Nobody looked for a second between the two.
  for (std::size_t i = 20; i < 40; ++i) recording.tables[0].t[i] += 1000000000;
  for (const char* number : {"shoulder/w", "shoulder/z"}) {
    double& value = recording.tables[0].column(number).values[7];
    value = -value;
  }
  const Dataset smooth = with_smooth_postures(*arm.plain, recording, {});
  const std::vector<double> elbow = smooth.series("elbow/position").values;
  for (std::size_t i = 0; i < 40; ++i) EXPECT_NEAR(elbow[i], jump[i], 1e-9) << i;
  const std::vector<double> w = smooth.series("shoulder/w").values,
                            z = smooth.series("shoulder/z").values;
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_NEAR(2.0 * std::atan2(z[i], w[i]), turn[i], 1e-6) << i;
  }
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
