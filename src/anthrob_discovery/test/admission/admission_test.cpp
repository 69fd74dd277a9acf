// Recordings that cannot answer, and what the noise in them is.
#include "admission/admission.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "admission/repeats.h"
#include "anthrob_core/errors.h"
#include "arm.h"
#include "axis_recording.h"
#include "fit/model_fit.h"
#include "hypotheses/coarse_step.h"
#include "made_experiment.h"

namespace anthrob {
namespace discovery {
namespace {

std::string refusal(const Question& question) {
  try {
    const Evaluator evaluator(question.model_file, {}, 0.001, 1);
    admit(evaluator, question);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "not refused";
}

TEST(Preparation, RefusesRecordingsThatCannotAnswer) {
  const Arm arm;
  Question good;
  good.model_file = ANTHROB_CONFIG_DIR "/anthrob/model_I.yaml";
  good.train = {arm.record({}, 1, 1)};
  good.test = {arm.record({}, 1, 2)};
  EXPECT_EQ(refusal(good), "not refused");

  Question judged_by_itself = good;
  judged_by_itself.test = good.train;
  EXPECT_NE(refusal(judged_by_itself).find("expected every recording once"), std::string::npos);
  Question repeated_by_itself = good;
  repeated_by_itself.repeats = good.train;
  EXPECT_NE(refusal(repeated_by_itself).find("expected every recording once"), std::string::npos);

  // As a converted bag, moved in time, and with a note.
  Dataset copy = good.train[0];
  std::reverse(copy.tables.begin(), copy.tables.end());
  for (Table& table : copy.tables) {
    std::reverse(table.columns.begin(), table.columns.end());
    for (Nanoseconds& t : table.t) t += 1700000000000000000;
  }
  copy.table("muscles").column("brachialis/ecu_state");  // empty
  copy.meta.other["notes"] = "a copy";
  Question judged_by_a_copy = good;
  judged_by_a_copy.test = {copy};
  EXPECT_NE(refusal(judged_by_a_copy).find("expected every recording once"), std::string::npos);
  copy.table("joints").columns[0].values[3] += 1e-3;
  judged_by_a_copy.test = {copy};
  EXPECT_NE(
      refusal(judged_by_a_copy).find(" % of the shorter one are the same measurements as in "),
      std::string::npos)
      << refusal(judged_by_a_copy);

  Question still = good;
  for (Table& table : still.train[0].tables) {
    for (Column& column : table.columns) {
      std::fill(column.values.begin(), column.values.end(), column.values.front());
    }
  }
  EXPECT_NE(refusal(still).find("no muscle moves, so friction"), std::string::npos)
      << refusal(still);

  Question backwards = good;
  std::swap(backwards.train[0].tables[1].t[5], backwards.train[0].tables[1].t[50]);
  EXPECT_NE(refusal(backwards).find("time runs backwards"), std::string::npos);

  Question broken = good;
  broken.train[0].table("muscles").columns[3].values[7] = std::nan("");
  EXPECT_NE(refusal(broken).find("expected a finite number"), std::string::npos);

  Question late = good;
  for (Nanoseconds& t : late.train[0].table("joints").t) t += 3600000000000;
  EXPECT_NE(refusal(late).find("not synchronised"), std::string::npos) << refusal(late);

  Question brief = good;
  for (Table& table : brief.train[0].tables) {
    for (std::size_t i = 0; i < table.t.size(); ++i) table.t[i] /= 100;
  }
  EXPECT_NE(refusal(brief).find("too short"), std::string::npos);

  Question untested = good;
  untested.test.clear();
  EXPECT_NE(refusal(untested).find("--test"), std::string::npos);
  untested.test = brief.train;
  EXPECT_NE(refusal(untested).find("too short: the --test recordings"), std::string::npos)
      << refusal(untested);
  untested.test = still.train;
  EXPECT_NE(refusal(untested).find("no muscle moves"), std::string::npos) << refusal(untested);

  Question repeated = good;
  repeated.repeats = {arm.record({}, 1, 3)};
  EXPECT_EQ(refusal(repeated), "not refused");
  repeated.repeats = {arm.record({}, 2, 2)};
  EXPECT_NE(refusal(repeated).find("expected a repeat of the commands"), std::string::npos)
      << refusal(repeated);
}

/// Some of the columns of a recording, wherever they are.
template <typename Change>
void change(Dataset& recording, const std::string& quantity, Change change_column) {
  for (Table& table : recording.tables) {
    for (Column& column : table.columns) {
      if (column.quantity() == quantity) change_column(table, column);
    }
  }
}

/// Begins earlier, with the robot as it is at first.
Dataset begun_earlier(Dataset recording, Nanoseconds by) {
  for (Table& table : recording.tables) {
    table.t.insert(table.t.begin(), table.t.front() - by);
    for (Column& column : table.columns) {
      column.values.insert(column.values.begin(), column.values.front());
      column.present.insert(column.present.begin(), 1);
    }
  }
  return recording;
}

/// The commands of one motion after a pause, by a robot that has friction in its elbow.
Dataset recorded_after(Nanoseconds pause, std::uint64_t noise) {
  const Arm arm;
  LoadOptions options;
  options.effects = {{"joint_coulomb", "elbow", {{"torque", 0.06}, {"static_ratio", 1.2}}}};
  MadeRecording made;
  made.noise = noise;
  made.length = 8.0;
  Dataset commands = made.commands(arm.plain);
  commands.meta.settle_s = 8.0;  // pause or none, it is at rest
  Table& table = commands.table("commands");
  for (Nanoseconds& t : table.t) t += pause;
  made.length += seconds(pause);
  if (pause == 0) return made.measure(build_robot_model(arm.config, options), commands);
  table.t.insert(table.t.begin(), 0);
  for (Column& column : table.columns) {
    column.values.insert(column.values.begin(), column.values.front());
    column.present.insert(column.present.begin(), 1);
  }
  return made.measure(build_robot_model(arm.config, options), commands);
}

TEST(Repeats, AreLaidOverTheFirstRecordingByTheirCommands) {
  const Arm arm;
  const Evaluator evaluator(ANTHROB_CONFIG_DIR "/anthrob/model_I.yaml", {}, 0.001, 1);
  const auto floor_of = [&](const Dataset& first, const Dataset& repeat, bool aligned) {
    const double late = lateness_of_repeat(*arm.plain, first, repeat, {});
    const Experiments train = {make_experiment(*arm.plain, first, {})},
                      repeats = {make_experiment(*arm.plain, repeat, {})};
    const std::vector<long> lags = {std::lround(late / train[0]->bin())};
    return measure_scales(evaluator, train, repeats, aligned ? lags : std::vector<long>(), {})
        .at("elbow/position")
        .floor;
  };
  const Dataset first = recorded_after(0, 1), repeat = recorded_after(0, 3),
                late = recorded_after(300000000, 3);
  EXPECT_EQ(lateness_of_repeat(*arm.plain, first, repeat, {}), 0.0);
  const double floor = floor_of(first, repeat, true);
  EXPECT_EQ(floor_of(first, repeat, false), floor);
  EXPECT_NEAR(floor_of(first, late, true), floor, 0.1 * floor);
  EXPECT_NEAR(floor_of(late, first, true), floor, 0.1 * floor);
  EXPECT_GT(floor_of(first, late, false), 2.0 * floor);  // as they are
  // Discovery asks for that.
  Question question;
  question.model_file = ANTHROB_CONFIG_DIR "/anthrob/model_I.yaml";
  question.train = {first};
  question.test = {arm.record({}, 2, 2)};
  question.repeats = {repeat, late};
  EXPECT_EQ(admit(evaluator, question).lags, (std::vector<long>{0, 15}));
}

TEST(Repeats, OfAnAxisAreLaidOverItsMotion) {
  const Question axis = axis_question(20.4, 0.0);
  const Dataset first = axis.train[0], again = axis_recording(20.0, 0.0, 1);
  const auto robot = load_robot_model(axis.model_file);
  EXPECT_EQ(lateness_of_repeat(*robot, first, again, {}), 0.0);
  EXPECT_NEAR(lateness_of_repeat(*robot, first, begun_earlier(again, 400000000), {}), 0.4, 0.03);
  // Bins are of whole steps, and lags of whole bins.
  Question question = axis;
  question.repeats = {begun_earlier(again, 400000000)};
  const Admission recordings = admit(Evaluator(axis.model_file, {}, 0.01, 1), question);
  const double bin = recordings.train[0]->bin();
  EXPECT_NEAR(bin, 0.01 * std::round(bin / 0.01), 1e-12);
  EXPECT_NEAR(static_cast<double>(recordings.lags.at(0)), 0.4 / bin, 1.5);
}

TEST(Repeats, MayLackAMessageAndNotBePlayedAtAnotherSpeed) {
  const Arm arm;
  const Dataset first = arm.record({}, 1, 1), repeat = arm.record({}, 1, 3);
  const auto refusal_of = [&](const Dataset& other) -> std::string {
    try {
      lateness_of_repeat(*arm.plain, first, other, {});
    } catch (const BadInput& error) {
      return error.what();
    }
    return "not refused";
  };
  Dataset lost = repeat;
  Table& commands = lost.table("commands");
  for (const int row : {40, 350}) {  // in the middle of a motion
    commands.t.erase(commands.t.begin() + row);
    for (Column& column : commands.columns) {
      column.values.erase(column.values.begin() + row);
      column.present.erase(column.present.begin() + row);
    }
  }
  EXPECT_EQ(refusal_of(lost), "not refused");
  Dataset slower = repeat;
  for (Table& table : slower.tables) {
    for (Nanoseconds& t : table.t) t += t / 10;
  }
  EXPECT_NE(refusal_of(slower).find("expected a repeat of the commands"), std::string::npos)
      << refusal_of(slower);
}

TEST(Repeats, HaveTheSameModes) {
  const Arm arm;
  Dataset first = arm.record({}, 1, 1), repeat = arm.record({}, 1, 3);
  const auto refusal_of_repeat = [&]() -> std::string {
    try {
      lateness_of_repeat(*arm.plain, first, repeat, {});
    } catch (const BadInput& error) {
      return error.what();
    }
    return "not refused";
  };
  const auto set_mode = [&](Dataset& recording, double mode) {
    Column& column = recording.table("commands").column("brachialis/mode");
    std::fill(column.values.begin(), column.values.end(), mode);
    std::fill(column.present.begin(), column.present.end(), 1);
  };
  set_mode(first, 1.0);  // POSITION, as it is without being said
  EXPECT_EQ(refusal_of_repeat(), "not refused");
  set_mode(repeat, 2.0);
  EXPECT_NE(refusal_of_repeat().find("brachialis/mode: CURRENT at t = 0.00 s"), std::string::npos)
      << refusal_of_repeat();
  // References have the unit of their mode.
  set_mode(first, 3.0);
  set_mode(repeat, 3.0);
  change(repeat, "reference", [](Table&, Column& column) {
    if (column.owner() != "brachialis") return;
    for (double& value : column.values) value += 5.0;
  });
  EXPECT_NE(refusal_of_repeat().find(" N at t = 0.00 s: expected a repeat of the commands"),
            std::string::npos)
      << refusal_of_repeat();
}

TEST(Preparation, RemarksOnATestWithTheCommandsOfATrain) {
  const Arm arm;
  Question question;
  question.model_file = ANTHROB_CONFIG_DIR "/anthrob/model_I.yaml";
  question.train = {arm.record({}, 1, 1)};
  question.test = {arm.record({}, 2, 2)};
  const Evaluator evaluator(question.model_file, {}, 0.001, 1);
  EXPECT_TRUE(admit(evaluator, question).remarks.empty());
  question.test = {arm.record({}, 1, 2)};
  const auto remarks = admit(evaluator, question).remarks;
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_NE(remarks[0].find("has the same commands as"), std::string::npos) << remarks[0];
}

TEST(Preparation, RefusesWhatIsNoOrientation) {
  const Arm arm;
  Question question;
  question.model_file = ANTHROB_CONFIG_DIR "/anthrob/model_I.yaml";
  question.train = {arm.record({}, 1, 1)};
  question.test = {arm.record({}, 2, 2)};
  for (const char* part : {"w", "x", "y", "z"}) {  // as trackers say that they see nothing
    change(question.train[0], part, [](Table&, Column& column) { column.values[200] = 0.0; });
  }
  EXPECT_NE(refusal(question).find("shoulder: no unit quaternion at t = 1.000000 s"),
            std::string::npos)
      << refusal(question);
  for (const char* part : {"w", "x", "y", "z"}) {
    change(question.train[0], part, [](Table&, Column& column) { column.present[200] = 0; });
  }
  EXPECT_EQ(refusal(question), "not refused");
}

TEST(AxisExperiment, WhereNoPositionIsMeasuredNothingIsCompared) {
  const Question axis = axis_question(20.4, 0.0);
  Dataset holed = axis.train[0];
  change(holed, "position", [](Table& table, Column& column) {
    for (std::size_t i = 0; i < table.t.size(); ++i) {
      if (table.t[i] >= 2000000000 && table.t[i] < 2200000000) column.present[i] = 0;
    }
  });
  const auto robot = load_robot_model(axis.model_file);
  ReplayScope scope;
  scope.bin = 0.025;
  const auto whole = make_experiment(*robot, axis.train[0], {}, scope),
             part = make_experiment(*robot, holed, {}, scope);
  const Evaluator evaluator(axis.model_file, {}, 0.001, 1);
  const Differences expected = evaluator.compare({Variant{}}, {whole}).front(),
                    differences = evaluator.compare({Variant{}}, {part}).front();
  int absent = 0;
  for (std::size_t b = 0; b < part->size(); ++b) {
    const double begin = 0.025 * static_cast<double>(b);
    // At the begin, samples lie on one side of the edge only.
    const bool first = b == 0, in_hole = begin > 1.96 && begin < 2.21;
    EXPECT_EQ(whole->present()[b], first ? 0 : 1) << begin;
    EXPECT_EQ(part->present()[b], first || in_hole ? 0 : 1) << begin;
    // The first step of a bin comes from the bin before.
    EXPECT_NEAR(differences[static_cast<long>(b)], in_hole ? 0.0f : expected[static_cast<long>(b)],
                0.01)
        << begin;
    absent += in_hole;
  }
  EXPECT_EQ(absent, 10);
}

TEST(Preparation, RefusesNumbersThatNobodyMeasures) {
  Question axis = axis_question(20.4, 0.0);
  const auto at = [](std::size_t row, double value) {
    return [=](Table&, Column& column) { column.values[row] = value; };
  };
  change(axis.train[0], "effort", at(20, 1e300));
  EXPECT_NE(refusal(axis).find("axis/joints.csv: row 21: axis/effort: expected a finite number"),
            std::string::npos)
      << refusal(axis);
  axis = axis_question(20.4, 0.0);
  change(axis.test[0], "position", [](Table&, Column& column) {
    for (double& value : column.values) value *= 1000.0;  // in millimetres
  });
  EXPECT_NE(refusal(axis).find("row 1: axis/position: "), std::string::npos) << refusal(axis);
  EXPECT_NE(refusal(axis).find("expected a position of a joint that goes from"), std::string::npos);
}

TEST(Preparation, RefusesAPartOfARecordingBesideIt) {
  Question axis = axis_question(20.4, 0.0);
  Dataset part = axis.train[0];
  for (Table& table : part.tables) {
    table.t.erase(table.t.begin(), table.t.begin() + 5000);
    for (Column& column : table.columns) {
      column.values.erase(column.values.begin(), column.values.begin() + 5000);
      column.present.erase(column.present.begin(), column.present.begin() + 5000);
    }
  }
  axis.test = {part};
  EXPECT_NE(refusal(axis).find("100 % of the shorter one are the same measurements as in axis"),
            std::string::npos)
      << refusal(axis);
}

TEST(Preparation, OfAnAxisSaysWhatVelocityAloneNeeds) {
  Question question = axis_question(20.4, 0.0);
  question.test[0].tables[0].columns[0].name = "axis/velocity";
  const std::string line = refusal(question);
  EXPECT_NE(line.find("column 'axis/position' is missing, only axis/velocity was measured"),
            std::string::npos)
      << line;
  EXPECT_NE(line.find("integral"), std::string::npos) << line;
}

TEST(Preparation, OfAnAxisWithADeadEffortSensorIsRefused) {
  Question axis = axis_question(20.4, 0.0);
  change(axis.train[0], "effort", [](Table&, Column& column) {
    std::fill(column.values.begin(), column.values.end(), 0.0);
  });
  EXPECT_NE(refusal(axis).find("axis/effort' is missing"), std::string::npos) << refusal(axis);
}

TEST(Preparation, RemarksOnRepeatedStamps) {
  Question axis = axis_question(20.4, 0.0);
  const Evaluator evaluator(axis.model_file, {}, 0.001, 1);
  EXPECT_TRUE(admit(evaluator, axis).remarks.empty());
  for (Table& table : axis.train[0].tables) {
    for (std::size_t i = 3; i < table.t.size(); i += 3) table.t[i] = table.t[i - 1];
  }
  const std::vector<std::string> remarks = admit(evaluator, axis).remarks;
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_NE(remarks[0].find("33.3 % of its rows have the time of the row before"),
            std::string::npos)
      << remarks[0];
}

TEST(Preparation, RefusesAStepThatIsTooCoarseForAnAxis) {
  const Question axis = axis_question(20.4, 0.0);
  const Evaluator evaluator(axis.model_file, {}, 0.1, 1);
  try {
    admit(evaluator, axis);
    FAIL() << "not refused";
  } catch (const BadInput& error) {
    EXPECT_NE(std::string(error.what()).find("--dt 0.1"), std::string::npos) << error.what();
  }
}

TEST(Preparation, RefusesRepeatsOfAnotherMotion) {
  Question axis = axis_question(20.4, 0.0);
  axis.repeats = {axis_recording(20.0, 0.0, 1)};  // not quite the same, as in another run
  EXPECT_EQ(refusal(axis), "not refused");
  axis.repeats = {axis_recording(20.4, 0.0, 3)};
  EXPECT_NE(refusal(axis).find("axis/position"), std::string::npos) << refusal(axis);
  EXPECT_NE(refusal(axis).find("expected a repeat of its motion"), std::string::npos);
}

TEST(Preparation, RefusesRepeatsOfWhatIsDrivenOtherwise) {
  const Arm arm;
  Question question;
  question.model_file = ANTHROB_CONFIG_DIR "/anthrob/model_I.yaml";
  question.train = {arm.record({}, 1, 1)};
  question.test = {arm.record({}, 1, 2)};
  question.repeats = {arm.record({}, 1, 3)};
  const auto without = [](Dataset& recording, const std::string& quantity) {
    for (Table& table : recording.tables) {
      for (Column& column : table.columns) {
        if (column.quantity() == quantity) column.present.assign(table.t.size(), 0);
      }
    }
  };
  without(question.repeats[0], "reference");
  EXPECT_NE(refusal(question).find("/reference: missing, but"), std::string::npos)
      << refusal(question);
  // Driven by motor positions: by their own, then by those of another motion.
  for (auto* group : {&question.train, &question.test, &question.repeats}) {
    for (const char* quantity : {"reference", "voltage"}) without(group->front(), quantity);
  }
  EXPECT_EQ(refusal(question), "not refused");
  question.repeats = {arm.record({}, 2, 2)};
  for (const char* quantity : {"reference", "voltage"}) without(question.repeats[0], quantity);
  EXPECT_NE(refusal(question).find("/position"), std::string::npos) << refusal(question);
}

TEST(MeasureScales, CountsOfAnEncoderReachTheVoltagesOfItsController) {
  const Arm arm;
  const auto round_motors = [&](Dataset data, const std::string& quantity, double count) {
    for (Table& table : data.tables) {
      for (Column& column : table.columns) {
        if (column.quantity() != quantity || arm.plain->find_muscle(column.owner()) < 0) continue;
        for (double& value : column.values) value = count * std::round(value / count);
      }
    }
    return data;
  };
  constexpr double kCount = 0.02;  // [rad]
  const Dataset fine = arm.record({}, 1, 1), coarse = round_motors(fine, "position", kCount);
  const Evaluator evaluator(ANTHROB_CONFIG_DIR "/anthrob/model_I.yaml", {}, 0.001, 1);
  const auto scales_of = [&](const Dataset& data) {
    return measure_scales(evaluator, {make_experiment(*arm.plain, data, {})}, {}, {}, {});
  };
  const std::string voltage = "biceps_brachii/voltage";
  EXPECT_EQ(scales_of(fine).at(voltage).counts, 0.0);
  // Proportional gain times the error of rounding.
  const double gain =
      arm.plain->muscles[arm.plain->find_muscle("biceps_brachii")].controller.position.proportional;
  const double expected = gain * kCount / std::sqrt(12.0);
  const ChannelScale scale = scales_of(coarse).at(voltage);
  EXPECT_GT(scale.counts, 0.4 * expected);
  EXPECT_LT(scale.counts, 1.6 * expected);
  // Nor does the voltage's own sensor take anything off them.
  const Dataset both = round_motors(coarse, "voltage", expected);
  EXPECT_NEAR(scales_of(both).at(voltage).counts, scale.counts, 1e-3 * scale.counts);
}

/// Every n-th row of all tables.
Dataset thinned(Dataset data, std::size_t every) {
  for (Table& table : data.tables) {
    if (table.name == "commands") continue;
    Table kept;
    kept.name = table.name;
    for (const Column& column : table.columns) kept.columns.push_back({column.name, {}, {}});
    for (std::size_t i = 0; i < table.t.size(); i += every) {
      kept.t.push_back(table.t[i]);
      for (std::size_t c = 0; c < table.columns.size(); ++c) {
        kept.columns[c].values.push_back(table.columns[c].values[i]);
        kept.columns[c].present.push_back(table.columns[c].present[i]);
      }
    }
    table = kept;
  }
  return data;
}

TEST(Floors, OfARecordingWithFewerRowsAreHigher) {
  const Arm arm;
  const Dataset whole = arm.record({}, 1, 1);
  const Evaluator evaluator(ANTHROB_CONFIG_DIR "/anthrob/model_I.yaml", {}, 0.001, 1);
  const auto fast = make_experiment(*arm.plain, whole, {}),
             slow = make_experiment(*arm.plain, thinned(whole, 4), {});  // one row a bin
  const Scales scales = measure_scales(evaluator, {fast}, {}, {}, {});
  const auto gap = [&](const std::shared_ptr<const Experiment>& experiment, const Scales& floors) {
    const Differences differences = evaluator.compare({Variant{}}, {experiment}).front();
    const Eigen::VectorXf w = whitener({experiment}, floors, false);
    return std::sqrt(differences.cwiseProduct(w).squaredNorm() /
                     static_cast<float>((w.array() > 0.0f).count()));
  };
  EXPECT_NEAR(gap(fast, scales), 1.0, 0.1);
  EXPECT_NEAR(gap(slow, scales), 1.0, 0.1);  // 2 if all had the same floor
  // The other way round: slow noise would be in the means of many rows, too.
  EXPECT_LT(gap(fast, measure_scales(evaluator, {slow}, {}, {}, {})), 0.7);
}

TEST(Floors, HoldWhatFilesRound) {
  const Arm arm;
  const Evaluator evaluator(ANTHROB_CONFIG_DIR "/anthrob/model_I.yaml", {}, 0.001, 1);
  const Dataset whole = arm.record({}, 1, 1);
  Dataset printed = whole;
  double squares = 0.0, count = 0.0;
  for (Table& table : printed.tables) {
    for (Column& column : table.columns) {
      if (column.name != "biceps_brachii/position") continue;
      for (double& value : column.values) {
        char text[32];
        std::snprintf(text, sizeof(text), "%.3g", value);
        const double error = std::strtod(text, nullptr) - value;
        squares += error * error;
        count += 1.0;
        value += error;
      }
    }
  }
  const double rounded = std::sqrt(squares / count);
  const auto digits_of = [&](const Dataset& data) {
    for (const Channel& channel : make_experiment(*arm.plain, data, {})->channels()) {
      if (channel.name() == "biceps_brachii/position") return channel.digits;
    }
    return -1.0;
  };
  EXPECT_EQ(digits_of(whole), 0.0);
  EXPECT_NEAR(digits_of(printed) / std::sqrt(12.0), rounded, 0.2 * rounded);
  // Also where most numbers are exact, so that nothing scatters.
  const auto exact = std::make_shared<MadeExperiment>([](double, double, double) { return 0.0; },
                                                      [](double, double, double) { return 0.0; });
  exact->set_step_of_digits(0.5);
  EXPECT_NEAR(measure_scales(evaluator, {exact}, {}, {}, {}).at("elbow/position").floor,
              0.5 / std::sqrt(12.0), 1e-9);
}

TEST(CoarseStep, TellsTheSameChanges) {
  const Arm arm;
  const std::vector<Dataset> recordings = {arm.record({}, 1, 1)};
  const Experiments train = {make_experiment(*arm.plain, recordings.front(), {})};
  const Evaluator evaluator(ANTHROB_CONFIG_DIR "/anthrob/model_I.yaml", {}, 0.001, 1);
  const Scales scales = measure_scales(evaluator, train, {}, {}, {});
  const Eigen::VectorXf factors = whitener(train, scales, false);
  const ModelFit fine(evaluator, train, factors, {});
  const Variant base{};
  const Eigen::VectorXf residual = fine.residual(base);
  const struct {
    LongerStepOptions longer;
    float scaled, otherwise;  // shares of the change by which it may be off
  } steps[] = {{{2.0, 3.0}, 0.03f, 0.2f}, {{4.0, 20.0}, 0.2f, 0.6f}};
  for (const auto& [longer, scaled, otherwise] : steps) {
    const double step = coarse_step(evaluator, train, scales, longer, {});
    EXPECT_EQ(step, 0.001 * longer.times);
    const ModelFit coarse(evaluator, train, factors, {}, step);
    for (const EffectInstance& effect :
         {EffectInstance{"joint_viscous", "elbow", {{"damping", 0.02}}},
          EffectInstance{"force_sensor_offset", "brachialis", {{"offset", 1.0}}},
          EffectInstance{"series_resistance", "teres_major", {{"resistance", 1.0}}}}) {
      Variant moved = base;
      moved.effects = {effect};
      const Eigen::VectorXf exact = fine.changes(base, residual, {moved}).front();
      const Eigen::VectorXf quick = coarse.changes(base, residual, {moved}).front();
      ASSERT_GT(exact.norm(), 0.0f) << effect.id;
      // Alike in size; edges of voltages and currents come a few milliseconds later.
      EXPECT_NEAR(quick.dot(exact), exact.squaredNorm(), scaled * exact.squaredNorm())
          << effect.id << " " << step;
      EXPECT_LT((quick - exact).norm(), otherwise * exact.norm()) << effect.id << " " << step;
      EXPECT_EQ(exact, fine.residual(moved) - residual) << effect.id;
    }
  }
}

TEST(CoarseStep, IsNotUsedWhereItsErrorIsLarger) {
  const Arm arm;
  const std::vector<Dataset> recordings = {arm.record({}, 1, 1)};
  const Experiments train = {make_experiment(*arm.plain, recordings.front(), {})};
  const Evaluator evaluator(ANTHROB_CONFIG_DIR "/anthrob/model_I.yaml", {}, 0.001, 1);
  const Scales scales = measure_scales(evaluator, train, {}, {}, {});
  EXPECT_EQ(coarse_step(evaluator, train, scales, {4.0, 1e3}, {}), 0.004);
  EXPECT_EQ(coarse_step(evaluator, train, scales, {4.0, 1e-3}, {}), 0.0);
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
