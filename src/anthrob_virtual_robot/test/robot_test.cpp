#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "blind_case.h"
#include "channels.h"
#include "dosing.h"
#include "posture_reference.h"
#include "support.h"

namespace anthrob::virtual_robot {
namespace {

CaseSettings settings() {
  CaseSettings s =
      CaseSettings::load(std::string(ANTHROB_CONFIG_DIR) + "/anthrob/virtual_robot.yaml");
  s.train = s.test = 3.0;
  s.recording.settle = 1.0;
  s.ordinary =
      anthrob::ordinary_parameters(std::string(ANTHROB_CONFIG_DIR) + "/anthrob/model_I.yaml");
  return s;
}

Draft plain_draft() {
  Draft draft;
  draft.arm = model_I();
  return draft;
}

TEST(Robot, IsTheReferenceArmUnderItsOwnController) {
  Robot robot(plain_draft(), nullptr, 0);
  reference::Arm arm(model_I());
  arm.set_step(Robot::kStep);
  arm.place(Eigen::Quaterniond::Identity(), 0.0, std::vector<double>(arm.muscle_count(), 0.6));
  robot.place(std::vector<double>(arm.muscle_count(), 0.6));
  for (std::size_t i = 0; i < arm.muscle_count(); ++i) arm.command_position(i, 1.0);
  robot.command(std::vector<double>(arm.muscle_count(), 1.0));
  for (int k = 0; k < 100; ++k) robot.tick();
  for (int k = 0; k < 100; ++k) arm.advance(robot.period());
  EXPECT_EQ(robot.truth().elbow, arm.elbow());
  for (std::size_t i = 0; i < arm.muscle_count(); ++i) {
    EXPECT_EQ(robot.truth().muscles[i].force, arm.muscle(i).force);
    EXPECT_EQ(robot.truth().muscles[i].current, arm.muscle(i).current);
  }
}

TEST(Robot, SameSeedSameBitsOtherSeedOtherNoise) {
  const SensorSettings sensors = settings().sensors;
  Robot a(plain_draft(), &sensors, 5), b(plain_draft(), &sensors, 5), c(plain_draft(), &sensors, 6);
  const Readings first = moved(&a, 0.2);
  EXPECT_TRUE(same(first, moved(&b, 0.2)));
  EXPECT_FALSE(same(first, moved(&c, 0.2)));
}

/// What it measures of tendons that hang slack.
std::vector<double> forces_of_slack_tendons(Draft draft, const SensorSettings* sensors) {
  Robot robot(std::move(draft), sensors, 5);
  const std::vector<double> slack(robot.muscle_count(), -5.0);
  robot.place(slack);
  std::vector<double> forces;
  for (int k = 0; k < 100; ++k) {
    robot.tick();
    for (std::size_t i = 0; i < slack.size(); ++i) {
      EXPECT_EQ(robot.truth().muscles[i].force, 0.0);
      forces.push_back(robot.measured().muscles[i].force);
    }
  }
  return forces;
}

TEST(Robot, MeasuresNoNegativeForces) {
  SensorSettings noisy;
  noisy.force = {0.3, 0.0, 0.0};
  const auto forces = forces_of_slack_tendons(plain_draft(), &noisy);
  EXPECT_EQ(*std::min_element(forces.begin(), forces.end()), 0.0);
  EXPECT_NEAR(std::count(forces.begin(), forces.end(), 0.0), 550, 100);  // of 1100
  Draft low = plain_draft();
  build_in({"force_sensor_offset", "all", {{"offset", -2.0}, {"drift", 0.0}}}, &low);
  EXPECT_EQ(forces_of_slack_tendons(std::move(low), nullptr), std::vector<double>(1100, 0.0));
}

TEST(Robot, LinksNothingOfTheSimulator) {
  std::ifstream maps("/proc/self/maps");
  const std::string all((std::istreambuf_iterator<char>(maps)), {});
  EXPECT_NE(all.find("libanthrob_virtual_robot"), std::string::npos);
  EXPECT_EQ(all.find("libanthrob_sim"), std::string::npos);
  EXPECT_EQ(all.find("libanthrob_calib"), std::string::npos);
}

TEST(Sensors, ErrAsTheySay) {
  SensorSettings sensors;
  sensors.force = {0.3, 0.06, 0.0};
  sensors.current = {0.02, 0.0, 0.05};  // coloured
  Sensors chain(sensors, 1, 1e-3, 4);
  double square = 0.0, coloured = 0.0, neighbour = 0.0, last = 0.0;
  const int count = 200000;
  for (int k = 0; k < count; ++k) {
    Readings readings;
    readings.muscles.resize(1);
    readings.muscles[0].force = 10.02;
    chain.measure(&readings);
    square += std::pow(readings.muscles[0].force - 10.02, 2);
    const double current = readings.muscles[0].current;
    coloured += current * current;
    neighbour += current * last;
    last = current;
    EXPECT_NEAR(std::remainder(readings.muscles[0].force, 0.06), 0.0, 1e-9);
  }
  EXPECT_NEAR(std::sqrt(square / count), sensors.force.sigma(), 0.01);
  EXPECT_NEAR(std::sqrt(coloured / count), 0.02, 0.001);
  EXPECT_NEAR(neighbour / coloured, std::exp(-1e-3 / 0.05), 0.01);
}

TEST(LeastEffort, GivesTheTorqueWithNoForceToSpare) {
  Random random(2);
  for (int trial = 0; trial < 50; ++trial) {
    Eigen::MatrixXd A(4, 11);
    Eigen::VectorXd inside(11);
    for (int i = 0; i < 11; ++i) {
      for (int k = 0; k < 4; ++k) A(k, i) = random.uniform(-0.05, 0.05);
      inside(i) = random.uniform(2.0, 20.0);
    }
    const Eigen::VectorXd f = least_effort(A, A * inside, 1.0);
    EXPECT_LT((A * f - A * inside).norm(), 1e-5);
    EXPECT_GE(f.minCoeff(), 1.0 - 1e-12);
    EXPECT_LE(f.norm(), inside.norm() + 1e-6);
  }
}

TEST(PostureReference, LeadsTheArmThere) {
  Draft draft = plain_draft();
  for (auto& muscle : draft.arm.muscles) {
    muscle.eyelet_friction.static_level = muscle.eyelet_friction.kinetic_level = 0.0;
  }
  PostureReference reference(draft.arm);
  Pose pose;
  pose.shoulder = {0.25, 0.0, -0.3};
  pose.elbow = 0.9;
  pose.lowest_tension = 6.0;
  Pose rest;
  rest.elbow = 0.2;
  rest.lowest_tension = 3.0;
  Robot robot(std::move(draft), nullptr, 0);
  robot.place(reference.positions(rest));
  for (int k = 0; k <= 4000; ++k) {
    if (k <= 1000) robot.command(reference.positions(blend(rest, pose, 1e-3 * k)));
    robot.tick();
  }
  // The gears still hold a little back.
  EXPECT_LT(robot.truth().shoulder.angularDistance(rotation(pose.shoulder)), 0.05);
  EXPECT_NEAR(robot.truth().elbow, pose.elbow, 0.05);
}

TEST(Dose, FindsAFactorOnACurve) {
  const auto change = [](double f) { return 0.7 * std::pow(f, 1.6); };
  const double factor = dose(change, 5.0, 0.01, 100.0);
  EXPECT_NEAR(std::log(change(factor) / 5.0), 0.0, 0.12);
  EXPECT_EQ(dose(change, 1e9, 0.1, 3.0), 3.0);
  // Nothing up to a threshold, then soon much.
  const auto threshold = [](double f) { return 20.0 * std::max(0.0, f - 1.5); };
  EXPECT_NEAR(std::log(threshold(dose(threshold, 5.0, 0.02, 5.0)) / 5.0), 0.0, 0.5);
  const auto low_threshold = [](double f) { return 60.0 * std::max(0.0, f - 0.4); };
  EXPECT_NEAR(std::log(low_threshold(dose(low_threshold, 5.0, 0.02, 5.0)) / 5.0), 0.0, 0.7);
}

TEST(BlindCase, SizeIsWithinTheFloorsAskedForAndTheSameForASeed) {
  const BlindCase blind =
      make_case({{"force_sensor_gain", "lateral_deltoid"}}, 3, model_I(), settings());
  const auto [channel, floors] = worst(blind.change);
  EXPECT_EQ(channel, "lateral_deltoid/force");
  EXPECT_GT(floors, 2.5);
  EXPECT_LT(floors, 11.5);
  const BlindCase again =
      make_case({{"force_sensor_gain", "lateral_deltoid"}}, 3, model_I(), settings());
  EXPECT_EQ(truth_text(blind), truth_text(again));
  EXPECT_EQ(blind.kind, CaseKind::kEffect);
}

TEST(BlindCase, IsOfTheKindThatAScoreTakesItFor) {
  const auto made = [](const std::vector<std::pair<std::string, std::string>>& hidden) {
    return make_case(hidden, 3, model_I(), settings());
  };
  EXPECT_EQ(made({}).kind, CaseKind::kNull);
  EXPECT_EQ(made({{"periodic_push", "elbow"}}).kind, CaseKind::kOutside);
  EXPECT_EQ(made({{"joint_coulomb", "elbow"}, {"payload", "forearm"}}).kind, CaseKind::kPair);
  EXPECT_THROW(made({{"joint_coulomb", "elbow"}, {"joint_coulomb", "elbow"}}),
               std::invalid_argument);
}

/// The ordinary parameter that a hidden thing is the same quantity as; nullptr if none.
const ModelParameter* ordinary_of(const CaseSettings& s, const HiddenLaw& law,
                                  const std::string& place) {
  for (const ModelParameter& p : s.ordinary) {
    if (law.same_as && p.path == law.same_as->path(place)) return &p;
  }
  return nullptr;
}

TEST(BlindCase, WhatACalibrationMayCorrectIsNoEffect) {
  const CaseSettings s = settings();
  ASSERT_FALSE(s.ordinary.empty());
  const HiddenLaw& viscous = hidden_law("joint_viscous");
  for (const std::string& place : viscous.places(model_I())) {
    const ModelParameter* number = ordinary_of(s, viscous, place);
    ASSERT_NE(number, nullptr) << place;
    const BlindCase blind = make_case({{"joint_viscous", place}}, 2, model_I(), s);
    reference::ArmParameters built = blind.built;
    const double itself = viscous.same_as->in(&built, place);
    EXPECT_EQ(itself, number->initial) << place;  // no error of calibration beside it
    const double hidden = blind.hidden.at(0)["damping"];
    EXPECT_GT(itself + hidden, number->upper) << place;
    EXPECT_GE(hidden, 2.0 * (number->upper - number->initial) * (1.0 - 1e-12)) << place;
    EXPECT_LT(worst(blind.change).second, 11.5) << place;
  }
  // Via-points that a calibration may move are errors of calibration; the others are effects.
  const HiddenLaw& shift = hidden_law("via_point_shift");
  for (const std::string& place : shift.places(model_I())) {
    EXPECT_EQ(ordinary_of(s, shift, place), nullptr) << place;
  }
  CaseSettings wide = s;
  const std::string place = shift.places(model_I()).front();
  ModelParameter listed;
  listed.path = shift.same_as->path(place);
  listed.lower = -0.0025, listed.upper = 0.0025;
  wide.ordinary.push_back(listed);
  const BlindCase blind = make_case({{"via_point_shift", place}}, 2, model_I(), wide);
  EXPECT_GE(std::abs(blind.hidden.at(0)["shift"]), 0.005 * (1.0 - 1e-12));
}

TEST(BlindCase, AllMusclesWrapInTheCaseOfTheThesis) {
  const BlindCase blind = draw_case(CaseKind::kWrapped, 0, 1, model_I(), settings());
  EXPECT_EQ(blind.hidden.size(), model_I().muscles.size());
  for (const Hidden& hidden : blind.hidden) EXPECT_EQ(hidden.id, "wrapping_surface");
}

TEST(BlindCase, NumbersGoThroughLawsAndThenThroughPlaces) {
  const auto count = static_cast<std::uint64_t>(catalogue_laws().size());
  const std::uint64_t gain = [] {
    std::uint64_t k = 0;
    while (catalogue_laws()[k].id != "force_sensor_gain") ++k;
    return k;
  }();
  const BlindCase a = draw_case(CaseKind::kEffect, gain, 1, model_I(), settings());
  const BlindCase b = draw_case(CaseKind::kEffect, gain + count, 1, model_I(), settings());
  EXPECT_EQ(a.hidden.at(0).id, "force_sensor_gain");
  EXPECT_EQ(b.hidden.at(0).id, "force_sensor_gain");
  EXPECT_NE(a.hidden[0].place, b.hidden[0].place);
  EXPECT_TRUE(draw_case(CaseKind::kNull, 0, 1, model_I(), settings()).hidden.empty());
}

TEST(BlindCase, SurfaceSitsWhereATendonTouchesIt) {
  const auto& laws = catalogue_laws();
  const auto is_surface = [](const HiddenLaw& law) { return law.id == "wrapping_surface"; };
  const auto number =
      static_cast<std::uint64_t>(std::find_if(laws.begin(), laws.end(), is_surface) - laws.begin());
  // The first place would be the lateral deltoid, where a surface changes nothing.
  std::set<std::string> places;
  for (const std::uint64_t round : {0u, 1u}) {
    const BlindCase blind =
        draw_case(CaseKind::kEffect, number + round * laws.size(), 1, model_I(), settings());
    EXPECT_EQ(blind.hidden.front().id, "wrapping_surface");
    EXPECT_GE(worst(blind.change).second, settings().least_change) << blind.hidden.front().place;
    places.insert(blind.hidden.front().place);
  }
  EXPECT_EQ(places.size(), 2u);
}

TEST(BlindCase, EffectsSitWhereTheirSizeCanBeWhatIsAskedFor) {
  const auto& laws = catalogue_laws();
  const auto is_backlash = [](const HiddenLaw& law) { return law.id == "gear_backlash"; };
  const auto number = static_cast<std::uint64_t>(
      std::find_if(laws.begin(), laws.end(), is_backlash) - laws.begin());
  CaseSettings asked = settings();
  asked.train = 5.0;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const BlindCase drawn = draw_case(CaseKind::kEffect, number, seed, model_I(), asked);
    EXPECT_GE(worst(drawn.change).second, 0.8 * asked.least_change) << drawn.hidden[0].place;
    EXPECT_LE(worst(drawn.change).second, 1.2 * asked.most_change) << drawn.hidden[0].place;
  }
  // There is a muscle at which no play does that: the order of places alone would not do.
  bool all_do = true;
  for (const char* place : {"lateral_deltoid", "infraspinatus", "anterior_deltoid"}) {
    const BlindCase there = make_case({{"gear_backlash", place}}, 1, model_I(), asked);
    all_do = all_do && worst(there.change).second > 0.8 * asked.least_change;
  }
  EXPECT_FALSE(all_do);
  // Where none does there still is a case.
  asked.least_change = asked.most_change = 1e6;
  EXPECT_EQ(draw_case(CaseKind::kEffect, number, 1, model_I(), asked).hidden.size(), 1u);
}

TEST(BlindCase, PairsAreTwoLawsWhateverIsHiddenFirst) {
  CaseSettings brief = settings();
  brief.train = 3.0;
  brief.slow_train = 6.0;
  const BlindCase pair = draw_case(CaseKind::kPair, 0, 1, model_I(), brief);
  ASSERT_EQ(pair.hidden.size(), 2u);
  EXPECT_NE(pair.hidden[0].id, pair.hidden[1].id);
  // A slow one makes recordings longer, by which the quick one is sized, too.
  const std::pair<std::string, std::string> quick{"force_sensor_gain", "lateral_deltoid"},
      slow{"tendon_creep", "biceps_brachii"};
  const BlindCase a = make_case({quick, slow}, 1, model_I(), brief);
  EXPECT_TRUE(a.slow);
  const BlindCase alone = make_case({quick}, 1, model_I(), brief);
  EXPECT_NE(a.hidden[0]["gain"], alone.hidden[0]["gain"]);
}

TEST(BlindCase, LengthThatACalibrationCorrectsIsNoChangeBySurfaces) {
  // In its postures the biceps does not touch, but its tendon is longer for the rest posture.
  const BlindCase blind =
      make_case({{"wrapping_surface", "biceps_brachii"}}, 1, model_I(), settings());
  EXPECT_LT(worst(blind.change).second, 1.0);
  Draft with, ordinary, without;
  for (Draft* draft : {&with, &ordinary, &without}) draft->arm = model_I();
  const Hidden surface{"wrapping_surface", "biceps_brachii", {{"radius", 0.016}}};
  build_in(surface, &with);
  hidden_law(surface.id).ordinary(surface, &ordinary);
  const std::size_t index = with.muscle(surface.place);
  EXPECT_EQ(with.arm.muscles[index].rest_tendon_length,
            ordinary.arm.muscles[index].rest_tendon_length);
  EXPECT_GT(ordinary.arm.muscles[index].rest_tendon_length,
            without.arm.muscles[index].rest_tendon_length + 1e-4);
  EXPECT_EQ(ordinary.arm.muscles[index].path.size(), without.arm.muscles[index].path.size());
}

TEST(BlindCase, LawsOutsideOfTheCatalogueSitAtSeveralMuscles) {
  CaseSettings brief = settings();
  brief.train = 1.0;
  brief.least_change = 1e-9;  // in a second hardly anything shows
  brief.most_change = 1e9;
  std::set<std::string> muscles;
  for (std::uint64_t k = 0; k < outside_laws().size(); ++k) {
    const BlindCase blind = draw_case(CaseKind::kOutside, k, 1, model_I(), brief);
    if (outside_laws()[k].places(model_I()).size() > 5) muscles.insert(blind.hidden[0].place);
  }
  EXPECT_GE(muscles.size(), 4u);
}

TEST(Outside, WhatHappensByChanceIsOtherInEachRun) {
  const auto torque = [](std::uint64_t run) {
    Draft draft;
    draft.arm = model_I();
    draft.run = run;
    build_in({"gusts", "shoulder", {{"strength", 0.3}, {"seed", 7.0}}}, &draft);
    const auto& law = draft.joint_laws.at(0);
    for (int k = 0; k < 1000; ++k) law->settle(1e-3, {}, {});
    return law->torque({}).eval();
  };
  EXPECT_EQ(torque(0), torque(0));
  EXPECT_NE(torque(0), torque(1));
}

TEST(BlindCase, TruthTellsAllErrorsOfCalibration) {
  const BlindCase blind = draw_case(CaseKind::kNull, 0, 1, model_I(), settings());
  const auto truth = nlohmann::json::parse(truth_text(blind))["nuisances"];
  for (std::size_t i = 0; i < blind.built.muscles.size(); ++i) {
    const auto &is = blind.built.muscles[i], &believed = blind.believed.muscles[i];
    const auto& told = truth[is.name];
    EXPECT_NEAR(believed.rest_tendon_length + told["rest_tendon_length"].get<double>(),
                is.rest_tendon_length, 1e-15);
    EXPECT_NEAR(believed.spindle_radius + told["spindle_radius"].get<double>(), is.spindle_radius,
                1e-15);
    for (std::size_t k = 0; k < is.path.size(); ++k) {
      Eigen::Vector3d point = believed.path[k].position;
      if (told["path_point"]["index"] == k) {
        for (int axis = 0; axis < 3; ++axis) {
          point(axis) += told["path_point"]["moved"][static_cast<std::size_t>(axis)].get<double>();
        }
      }
      EXPECT_NEAR((point - is.path[k].position).norm(), 0.0, 1e-15);
    }
  }
  EXPECT_EQ(truth["shoulder"]["viscous"], blind.built.skeleton.shoulder_friction.viscous);
  EXPECT_EQ(truth["elbow"]["viscous"], blind.built.skeleton.elbow_friction.viscous);
}

TEST(BlindCase, RefusesPlacesThatALawCannotHave) {
  EXPECT_THROW(make_case({{"joint_coulomb", "knee"}}, 1, model_I(), settings()),
               std::invalid_argument);
  EXPECT_THROW(hidden_law("poltergeist"), std::invalid_argument);
}

}  // namespace
}  // namespace anthrob::virtual_robot
