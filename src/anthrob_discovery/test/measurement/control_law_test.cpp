// Voltages of controllers that follow another law than the model's.
#include "measurement/control_law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "anthrob_core/random.h"
#include "config.h"
#include "measurement/controller_algebra.h"
#include "measurement/law_correction.h"
#include "measurement/measurement.h"
#include "measurement/stamp_correction.h"

namespace anthrob {
namespace discovery {
namespace {

constexpr double kLawTick = 0.001;  // [s]

std::shared_ptr<const RobotModel> law_rig() {
  static const auto robot = load_robot_model(kConfig + "/two_muscle_rig/model_I.yaml");
  return robot;
}

const ConfigNode& law_config() {
  static const ConfigNode config = ConfigNode::load(kConfig + "/two_muscle_rig/model_I.yaml");
  return config;
}

/// The controllers of a made robot: they compute as such units do, tick by tick.
struct LawController {
  ecu::PositionGains gains = law_rig()->muscles[0].controller.position;
  double derivative_filter = 0.0, voltage_filter = 0.0;  ///< time constants [s]
  double reference_late = 0.0;                           ///< [s]
  double bend = 0.0;                                     ///< [1/V], as nobody looks for it
  double position_late = 0.0;                            ///< stamps, and those of velocities [s]
  double voltage_late = 0.0;  ///< by so much its recording is, between two ticks, too [s]
  bool derivative_on_error = false, after_tick = false;
};

/// What is measured obeys no physics, only the control law.
Dataset law_recording(const LawController& how, bool smooth_reference = false) {
  const CounterRandom random(11, 1);
  std::uint64_t index = 0;
  const auto noise = [&](double size) { return size * random.normal(index++); };
  const auto position = [](double t) { return std::sin(2.0 * t) + 0.3 * std::sin(7.1 * t); };
  const auto velocity = [](double t) { return 2.0 * std::cos(2.0 * t) + 2.13 * std::cos(7.1 * t); };
  const auto force = [](double t) { return 30.0 + 20.0 * std::sin(3.3 * t + 1.0); };
  const double hold = smooth_reference ? kLawTick : 0.01;
  const auto reference = [&](double t) {
    const double asked = hold * std::floor(std::max(0.0, t) / hold + 1e-6);
    return position(asked) + 0.2 * std::sin(11.0 * asked);
  };
  Dataset data;
  data.folder = "run";
  Table commands, muscles;
  commands.name = "commands", muscles.name = "muscles";
  commands.column("flexor/reference");
  for (const char* quantity : {"position", "velocity", "force", "voltage"}) {
    muscles.column(std::string("flexor/") + quantity);
  }
  const auto add = [](Table& table, double t, const std::vector<double>& values) {
    table.t.push_back(static_cast<Nanoseconds>(std::llround(1e9 * t)));
    for (std::size_t k = 0; k < values.size(); ++k) {
      table.columns[k].values.push_back(values[k]), table.columns[k].present.push_back(1);
    }
  };
  double voltage = 0.0, slow_rate = 0.0;
  std::vector<double> voltages;
  const auto recorded = [&](double now) {
    voltages.push_back(now);
    const double at = static_cast<double>(voltages.size()) - 1.0 - how.voltage_late / kLawTick;
    const auto first = static_cast<std::size_t>(std::max(0.0, at));
    const double share = std::max(0.0, at) - static_cast<double>(first);
    const std::size_t next = std::min(first + 1, voltages.size() - 1);
    return (1.0 - share) * voltages[first] + share * voltages[next];
  };
  for (int tick = 0; tick < 12000; ++tick) {
    const double t = kLawTick * tick;
    if (std::fmod(t + 1e-9, hold) < 1e-6) add(commands, t, {reference(t)});
    const double before = voltage, asked = reference(t - how.reference_late);
    double rate = -velocity(t) - noise(0.02);
    if (how.derivative_on_error && tick > 0) {
      rate += (asked - reference(t - how.reference_late - kLawTick)) / kLawTick;
    }
    slow_rate +=
        (how.derivative_filter > 0.0 ? kLawTick / (how.derivative_filter + kLawTick) : 1.0) *
        (rate - slow_rate);
    double law = how.gains.proportional * (asked - position(t) - noise(1e-3)) +
                 how.gains.derivative * slow_rate +
                 how.gains.force_feedforward * (force(t) + noise(0.1));
    law += how.bend * law * std::abs(law);
    voltage += (how.voltage_filter > 0.0 ? kLawTick / (how.voltage_filter + kLawTick) : 1.0) *
               (law - voltage);
    const double written = recorded(how.after_tick ? voltage : before);
    if (tick % 5 != 3) continue;
    add(muscles, t,
        {position(t - how.position_late) + noise(1e-3),
         velocity(t - how.position_late) + noise(0.02), force(t) + noise(0.1), written});
  }
  data.tables = {commands, muscles};
  return data;
}

ControllerAlgebraOptions law_rows() {
  ControllerAlgebraOptions options;
  options.most_rows = 1500;
  return options;
}

Description law_described(const LawController& how, bool smooth_reference = false) {
  Description description;
  description.question.options.measurement.controller = law_rows();
  description.question.train = {law_recording(how, smooth_reference)};
  correct_controller_stamps(*law_rig(), law_config(), description);
  return description;
}

const MeasurementProperty* law_row(const Description& description, const std::string& law) {
  for (const MeasurementProperty& property : description.measurement) {
    if (property.what == "controller" && property.law == law) return &property;
  }
  return nullptr;
}

std::string law_told(const Description& description) {
  std::string lines;
  for (const std::string& remark : description.remarks) lines += remark + "\n";
  for (const MeasurementProperty& row : description.measurement) {
    lines += row.what + " " + row.law + " " + std::to_string(row.value) + " [" +
             std::to_string(row.ci95[0]) + ", " + std::to_string(row.ci95[1]) + "]\n";
  }
  return lines;
}

/// That this is the only row, with this number.
void expect_only_law(const Description& description, const std::string& law, double value,
                     double off) {
  const MeasurementProperty* row = law_row(description, law);
  ASSERT_NE(row, nullptr) << law_told(description);
  EXPECT_NEAR(row->value, value, off) << law_told(description);
  EXPECT_EQ(row->place, "all");
  EXPECT_EQ(description.measurement.size(), 1u) << law_told(description);
}

TEST(ControlLaw, TheModelsOwnIsNotNamed) {
  for (const bool after_tick : {false, true}) {
    LawController how;
    how.after_tick = after_tick;
    const Dataset recording = law_recording(how);
    const auto law = find_control_law(ControlledMuscles(*law_rig(), {&recording}, law_rows()));
    EXPECT_FALSE(law) << static_cast<int>(law->form) << " " << law->muscles[0].found[0].value << " "
                      << law->muscles[0].found[1].value << " " << law->muscles[0].found[2].value;
    EXPECT_FALSE(law_described(how).question.feed);
  }
}

TEST(ControlLaw, OtherGainsAreFoundWithoutTheBiasOfNoise) {
  LawController how;
  how.gains.proportional *= 1.3;
  how.gains.derivative *= 0.6;
  how.gains.force_feedforward = 0.0;
  const Description description = law_described(how);
  const struct {
    const char* name;
    double truth;
  } gains[] = {{"K_P", how.gains.proportional}, {"K_D", how.gains.derivative}, {"K_f", 0.0}};
  for (const auto& gain : gains) {
    const MeasurementProperty* row = law_row(description, gain.name);
    ASSERT_NE(row, nullptr) << gain.name << "\n" << law_told(description);
    const double half = 0.5 * (row->ci95[1] - row->ci95[0]);
    // Lines between rows leave 0.3 %.
    EXPECT_NEAR(row->value, gain.truth, 1.6 * half + 0.003 * gain.truth) << law_told(description);
    EXPECT_LT(half, 0.02 * std::max(0.3, gain.truth));
  }
  EXPECT_EQ(description.measurement.size(), 3u) << law_told(description);
  // The search goes on with them.
  EXPECT_FALSE(description.question.feed);
  const auto& known = description.question.train[0].meta.model;
  ASSERT_EQ(known.size(), 3u);
  EXPECT_NEAR(known.at("controllers.pd.position.derivative"), how.gains.derivative, 0.01);
  EXPECT_GE(known.at("controllers.pd.position.force_feedforward"), 0.0);
  ASSERT_EQ(description.remarks.size(), 1u);
  EXPECT_EQ(description.remarks[0].find("controller: the voltages follow another law"), 0u);
}

TEST(ControlLaw, FilterOfTheDerivativeIsNamed) {
  LawController how;
  how.derivative_filter = 0.03;
  expect_only_law(law_described(how), "derivative filter", 0.03, 0.003);
}

TEST(ControlLaw, FilterOfTheVoltagesIsNoLateVoltage) {
  LawController how;
  how.voltage_filter = 0.02;
  expect_only_law(law_described(how), "voltage filter", 0.02, 0.002);
}

TEST(ControlLaw, LateVoltagesAreNoFilter) {
  for (const double late : {0.003, 0.00425}) {
    LawController how;
    how.voltage_late = late;
    const Description description = law_described(how);
    ASSERT_EQ(description.measurement.size(), 1u) << law_told(description);
    EXPECT_EQ(description.measurement[0].what, "delay");
    EXPECT_NEAR(description.measurement[0].value, late, 0.6 * kLawTick);
    EXPECT_FALSE(description.question.feed);
  }
}

TEST(ControlLaw, DerivativeOnErrorIsNamed) {
  LawController how;
  how.derivative_on_error = true;
  const Description smooth = law_described(how, true);
  expect_only_law(smooth, "derivative on error", 1.0, 0.0);
  // The search goes on with references of which the model's own law gives the same voltages.
  EXPECT_FALSE(smooth.question.feed);
  const Dataset before = law_recording(how, true);
  const auto left = [&](const Dataset& recording) {
    return ControllerAlgebra(*law_rig(), {&recording}, law_rows()).left({});
  };
  EXPECT_GT(left(before), 3.0);
  EXPECT_NEAR(left(smooth.question.train[0]), left(law_recording({}, true)), 0.05);
  // Of references that come in steps, only a filter lets rows show it.
  how.derivative_filter = 0.01;
  const Description filtered = law_described(how);
  ASSERT_NE(law_row(filtered, "derivative filter"), nullptr) << law_told(filtered);
  EXPECT_NEAR(law_row(filtered, "derivative filter")->value, 0.01, 0.001) << law_told(filtered);
  EXPECT_NE(law_row(filtered, "derivative on error"), nullptr) << law_told(filtered);
  EXPECT_EQ(filtered.measurement.size(), 2u) << law_told(filtered);
  EXPECT_EQ(filtered.question.feed, ReplayMode::kPosition);
}

TEST(ControlLaw, ALawAfterTheTickIsBoth) {
  LawController how;
  how.gains.derivative *= 1.5;
  how.after_tick = true;
  const Description description = law_described(how);
  ASSERT_EQ(description.measurement.size(), 2u) << law_told(description);
  ASSERT_NE(law_row(description, "K_D"), nullptr) << law_told(description);
  EXPECT_NEAR(law_row(description, "K_D")->value, how.gains.derivative, 0.01);
  EXPECT_TRUE(std::any_of(description.measurement.begin(), description.measurement.end(),
                          [](const auto& row) { return row.what == "tick_phase"; }))
      << law_told(description);
}

/// The row of such a property, alone.
const MeasurementProperty* row_of(const Description& description, const std::string& what) {
  const auto row = std::find_if(description.measurement.begin(), description.measurement.end(),
                                [&](const auto& one) { return one.what == what; });
  return row == description.measurement.end() ? nullptr : &*row;
}

TEST(ControlLaw, LatePositionsShowAlsoBesideAnotherConvention) {
  for (const bool after_tick : {true, false}) {
    LawController how;
    how.position_late = after_tick ? 0.018 : 0.003;
    how.after_tick = after_tick;
    how.derivative_on_error = !after_tick;
    const Description description = law_described(how, true);
    ASSERT_EQ(description.measurement.size(), 2u) << law_told(description);
    ASSERT_NE(row_of(description, "delay"), nullptr) << law_told(description);
    EXPECT_NEAR(row_of(description, "delay")->value, how.position_late, 0.6 * kLawTick);
    EXPECT_NE(row_of(description, after_tick ? "tick_phase" : "controller"), nullptr);
    EXPECT_FALSE(description.question.feed);
    const auto left = [&](const Dataset& recording) {
      return ControllerAlgebra(*law_rig(), {&recording}, law_rows()).left({});
    };
    EXPECT_LT(left(description.question.train[0]), 0.1 * left(law_recording(how, true)));
  }
}

TEST(ControlLaw, LateReferencesKeepTheControllers) {
  LawController how;
  how.reference_late = 0.012;
  const Description description = law_described(how);
  EXPECT_FALSE(description.question.feed) << law_told(description);
  EXPECT_TRUE(description.measurement.empty()) << law_told(description);
}

TEST(ControlLaw, AnUnknownOneIsTold) {
  LawController how;
  how.bend = 0.2;
  const Description description = law_described(how);
  ASSERT_FALSE(description.remarks.empty());
  EXPECT_NE(description.remarks[0].find("another law, other gains"), std::string::npos)
      << law_told(description);
  EXPECT_FALSE(description.question.feed);
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
