// Recordings that look complete and cannot answer: what discovery refuses, leaves out or remarks
// on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "admission/admission.h"
#include "admission/movement.h"
#include "anthrob_core/errors.h"
#include "arm.h"
#include "measurement/measurement.h"

namespace anthrob {
namespace discovery {
namespace {

const std::string kRig = ANTHROB_CONFIG_DIR "/two_muscle_rig/model_I.yaml";

/// The rig as sensors see it, made by formulas: the hinge follows its motors, but for what the
/// springs give.
struct RigRecording {
  double phase = 0.0;        ///< of all motions
  double length = 20.0;      ///< [s]
  double amount = 1.0;       ///< of all motions; 0: at rest
  double late = 0.0;         ///< by how much joints.csv is stamped too late [s]
  double force_noise = 0.3;  ///< [N]
  bool pulses = false;       ///< only two short movements

  double hinge(double t) const {
    if (pulses) return 0.2 * (std::tanh(8.0 * (t - 6.0)) + std::tanh(8.0 * (t - 11.5)));
    return 0.25 * std::sin(1.3 * t + phase) + 0.15 * std::sin(2.9 * t + 2.0 * phase) +
           0.1 * std::sin(0.7 * t);
  }

  Dataset make() const {
    Dataset data;
    data.folder = "run_" + std::to_string(phase);
    data.meta.robot = "two_muscle_rig";
    const auto rows = static_cast<std::size_t>(length * 200.0);
    std::uint64_t stream = 0;
    const auto add = [&](const std::string& table, const std::string& column, double noise,
                         const auto& value) {
      const CounterRandom random(static_cast<std::uint64_t>(1000.0 * phase) + 1, ++stream);
      Table& to = data.table(table);
      if (to.t.empty()) {
        for (std::size_t i = 0; i < rows; ++i) {
          const double shift = table == "joints" ? late : 0.0;
          to.t.push_back(static_cast<Nanoseconds>(i) * 5000000 +
                         static_cast<Nanoseconds>(std::llround(1e9 * shift)));
        }
      }
      Column& made = to.column(column);
      for (std::size_t i = 0; i < rows; ++i) {
        made.values[i] = value(0.005 * static_cast<double>(i)) + noise * random.normal(i);
      }
      made.present.assign(rows, 1);
    };
    for (const bool flexes : {true, false}) {
      const std::string muscle = flexes ? "flexor" : "extensor";
      const auto force = [=](double t) {
        return 20.0 + (flexes ? 4.0 : 3.0) * amount * std::sin((flexes ? 2.1 : 1.7) * t + phase);
      };
      const auto position = [=](double t) {
        return 2.0 + (flexes ? 3.6 : -3.6) * amount * hinge(t) + (force(t) - 20.0) / 9.75;
      };
      add("commands", muscle + "/reference", 0.0, position);
      add("muscles", muscle + "/position", 5e-4, position);
      add("muscles", muscle + "/current", 5e-3, [](double) { return 0.3; });
      add("muscles", muscle + "/force", force_noise, force);
    }
    add("joints", "hinge/position", 5e-4, [=](double t) { return amount * hinge(t); });
    return data;
  }
};

RigRecording rig(double phase, double length = 20.0) {
  RigRecording recording;
  recording.phase = phase;
  recording.length = length;
  return recording;
}

template <typename Change>
void change_columns(Dataset& recording, const std::string& name, Change change_column) {
  for (Table& table : recording.tables) {
    for (Column& column : table.columns) {
      if (column.name == name || column.quantity() == name) change_column(column);
    }
  }
}

void remove(Dataset& recording, const std::string& name) {
  change_columns(recording, name, [](Column& column) {
    std::fill(column.present.begin(), column.present.end(), 0);
  });
}

void freeze(Dataset& recording, const std::string& name, double value) {
  change_columns(recording, name, [&](Column& column) {
    std::fill(column.values.begin(), column.values.end(), value);
  });
}

Question question_of(Dataset train, Dataset test) {
  Question question;
  question.model_file = kRig;
  question.train = {std::move(train)};
  question.test = {std::move(test)};
  return question;
}

Admission prepared(const Question& question) {
  return admit(Evaluator(question.model_file, {}, 0.001, 1), question);
}

std::string refusal_of(const Question& question) {
  try {
    prepared(question);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "not refused";
}

/// All of them, to search in.
std::string remarks_on(const Question& question) {
  std::string lines;
  for (const std::string& remark : prepared(question).remarks) lines += remark + "\n";
  return lines;
}

Description described(const Question& question) {
  const Evaluator evaluator(question.model_file, {}, 0.001, 1);
  return describe(evaluator, as_stated(*evaluator.model(), question));
}

/// What is told about how the recordings were taken.
std::string told_about(const Question& question) {
  std::string lines;
  for (const std::string& remark :
       described(question).remarks) {
    lines += remark + "\n";
  }
  return lines;
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

bool has_channel(const Experiments& experiments, const std::string& name) {
  const auto channels = channels_of(experiments);
  return std::any_of(channels.begin(), channels.end(),
                     [&](const Channel& channel) { return channel.name() == name; });
}

TEST(UnusableRecordings, GoodOnesGetNoRemark) {
  EXPECT_EQ(remarks_on(question_of(rig(0.0).make(), rig(1.1).make())), "");
  const Arm arm;
  Question question = question_of(arm.record({}, 1, 1), arm.record({}, 2, 2));
  question.model_file = ANTHROB_CONFIG_DIR "/anthrob/model_I.yaml";
  EXPECT_EQ(remarks_on(question), "");
}

// ---- channels that training and held-out recordings share -------------------------------------

TEST(SharedChannels, AreNeeded) {
  Dataset forces = rig(0.0).make(), positions = rig(1.1).make();
  for (const char* other : {"flexor/position", "extensor/position", "hinge/position", "current"}) {
    remove(forces, other);
  }
  for (const char* other : {"force", "current"}) remove(positions, other);
  const std::string line = refusal_of(question_of(forces, positions));
  EXPECT_TRUE(says(line,
                   "the held-out recordings measure none of the channels of the training "
                   "recordings (flexor/force, extensor/force)"))
      << line;
}

TEST(SharedChannels, OthersGetARemark) {
  Dataset train = rig(0.0).make(), test = rig(1.1).make();
  remove(train, "hinge/position");
  remove(test, "extensor/force");
  const auto remarks = prepared(question_of(train, test)).remarks;
  ASSERT_EQ(remarks.size(), 2u);
  EXPECT_TRUE(says(remarks[0], "extensor/force: measured in the --train recordings only"))
      << remarks[0];
  EXPECT_TRUE(says(remarks[1], "hinge/position: measured in the --test recordings only"))
      << remarks[1];
}

// ---- length -----------------------------------------------------------------------------------

TEST(Length, IsOfThreeBlocksAtLeast) {
  const std::string line = refusal_of(question_of(rig(0.0, 2.4).make(), rig(1.1, 2.4).make()));
  EXPECT_TRUE(says(line,
                   "too short: the --train recordings are 2.395 s and the --test recordings "
                   "2.395 s long, together 2 blocks of 2 s; expected at least 3 blocks (6 s)"))
      << line;
  // Blocks of both count together.
  EXPECT_EQ(refusal_of(question_of(rig(0.0, 4.0).make(), rig(1.1, 2.4).make())), "not refused");
  Question repeated = question_of(rig(0.0, 2.4).make(), rig(1.1, 2.4).make());
  repeated.test.push_back(rig(2.2, 2.4).make());
  EXPECT_EQ(refusal_of(repeated), "not refused");
}

TEST(Length, OfOneSideAloneGetsARemark) {
  const std::string short_test = remarks_on(question_of(rig(0.0).make(), rig(1.1, 4.0).make()));
  EXPECT_TRUE(says(short_test, "the --test recordings are only 3.995 s long in all")) << short_test;
  EXPECT_FALSE(says(short_test, "--train")) << short_test;
  const std::string short_train = remarks_on(question_of(rig(0.0, 4.0).make(), rig(1.1).make()));
  EXPECT_TRUE(says(short_train, "the --train recordings are only 3.995 s long in all"))
      << short_train;
}

// ---- clocks -----------------------------------------------------------------------------------

TEST(Clocks, OfJointsAndMusclesAreOne) {
  for (const double late : {1.0, -1.0, 2.0, -0.4}) {
    RigRecording off = rig(0.0);
    off.late = late;
    const std::string line = told_about(question_of(off.make(), rig(1.1).make()));
    EXPECT_TRUE(says(line, "joints.csv: joints seem to be stamped")) << line;
    EXPECT_TRUE(says(line, late > 0.0 ? "s too late" : "s too early")) << line;
    EXPECT_TRUE(says(line, "moved by it")) << line;
    EXPECT_TRUE(says(told_about(question_of(rig(1.1).make(), off.make())), "seem to be stamped"));
  }
}

TEST(Clocks, MayDifferByTheDelayOfMotionCapture) {
  for (const double late : {0.2, -0.1}) {
    RigRecording delayed = rig(0.0);
    delayed.late = late;
    EXPECT_EQ(told_about(question_of(delayed.make(), rig(1.1).make())), "") << late;
  }
  const Arm arm;
  Question question = question_of(arm.record({{"mocap_delay", "global", {{"delay", 0.15}}}}, 1, 1),
                                  arm.record({}, 2, 2));
  question.model_file = ANTHROB_CONFIG_DIR "/anthrob/model_I.yaml";
  EXPECT_EQ(told_about(question), "");
}

TEST(Clocks, AreOnlyRemarkedOnAfterFewMovements) {
  RigRecording off = rig(0.0);
  off.pulses = true;
  EXPECT_EQ(told_about(question_of(off.make(), rig(1.1).make())), "");
  off.late = 1.5;
  const std::string line = told_about(question_of(off.make(), rig(1.1).make()));
  EXPECT_TRUE(says(line, "joints seem to be stamped 1.5 s too late")) << line;
  EXPECT_TRUE(says(line, "too few movements to put it right")) << line;
}

TEST(Clocks, AreNotDoubtedForFrictionBacklashOrResonance) {
  const Arm arm;
  Question question;
  question.model_file = ANTHROB_CONFIG_DIR "/anthrob/model_I.yaml";
  question.test = {arm.record({}, 2, 2)};
  for (const EffectInstance& effect :
       {EffectInstance{"joint_coulomb", "elbow", {{"torque", 0.3}, {"static_ratio", 1.2}}},
        EffectInstance{"joint_viscous", "elbow", {{"damping", 0.3}}},
        EffectInstance{"tendon_elasticity", "brachialis", {{"compliance", 2e-4}}}}) {
    question.train = {arm.record({effect}, 1, 1)};
    EXPECT_EQ(told_about(question), "") << effect.id;
  }
}

TEST(Clocks, OfEachFileOfJointsAreExamined) {
  const Arm arm;
  MadeRecording made;
  made.length = 20.0;
  made.seed = 3;
  Dataset recording = made.measure(arm.plain, made.commands(arm.plain));
  recording.folder = "long";
  Question question;
  question.model_file = ANTHROB_CONFIG_DIR "/anthrob/model_I.yaml";
  question.train = {arm.record({}, 1, 1)};
  question.test = {recording};
  EXPECT_EQ(told_about(question), "");
  for (Nanoseconds& t : question.test[0].table("spherical_joints").t) t += 1000000000;
  const std::string said = told_about(question);
  EXPECT_TRUE(says(said, "long/spherical_joints.csv: joints seem to be stamped")) << said;
  EXPECT_FALSE(says(said, "long/joints.csv")) << said;
}

// ---- stillness --------------------------------------------------------------------------------

TEST(Movement, IsMoreThanNoise) {
  const CounterRandom random(3, 1);
  Series noise, motion;
  for (std::size_t i = 0; i < 4000; ++i) {
    const double t = 0.005 * static_cast<double>(i), error = 0.3 * random.normal(i);
    noise.t.push_back(t);
    noise.values.push_back(20.0 + error);
    motion.t.push_back(t);
    motion.values.push_back(20.0 + std::sin(t) + error);
  }
  EXPECT_GT(range_of(noise), 1.5);
  EXPECT_FALSE(moves(noise, 0.0, {}));
  EXPECT_TRUE(moves(motion, 0.5, {}));
  EXPECT_FALSE(moves(motion, 5.0, {}));
  EXPECT_FALSE(moves({}, 0.0, {}));
}

TEST(Stillness, IsNotHiddenByNoise) {
  RigRecording still = rig(0.0);
  still.amount = 0.0;
  ASSERT_GT(range_of(still.make().series("flexor/force")), 1.0);
  EXPECT_TRUE(says(refusal_of(question_of(still.make(), rig(1.1).make())), "no muscle moves"));
  EXPECT_TRUE(says(refusal_of(question_of(rig(1.1).make(), still.make())), "no muscle moves"));
}

TEST(Stillness, IsNotHiddenByReferencesThatNoMotorFollows) {
  RigRecording still = rig(0.0);
  still.amount = 0.0;
  Dataset recording = still.make();
  change_columns(recording, "reference", [&](Column& column) {
    for (std::size_t i = 0; i < column.values.size(); ++i) {
      column.values[i] += std::sin(0.005 * static_cast<double>(i));
    }
  });
  EXPECT_TRUE(says(refusal_of(question_of(recording, rig(1.1).make())), "no muscle moves"));
  Dataset followed = recording;  // by a motor that sticks, but pulls
  change_columns(followed, "flexor/current", [](Column& column) {
    for (std::size_t i = 0; i < column.values.size(); ++i) {
      column.values[i] += 0.05 * std::sin(0.005 * static_cast<double>(i));
    }
  });
  EXPECT_EQ(refusal_of(question_of(followed, rig(1.1).make())), "not refused");
  // Where no position is measured, the reference is all that is known.
  for (const char* muscle : {"flexor/position", "extensor/position"}) remove(recording, muscle);
  EXPECT_EQ(refusal_of(question_of(recording, rig(1.1).make())), "not refused");
}

// ---- dead sensors -----------------------------------------------------------------------------

TEST(FrozenColumns, AreLeftOut) {
  Dataset dead = rig(0.0).make();
  freeze(dead, "extensor/force", 19.43);
  freeze(dead, "extensor/position", 1.99);
  const Admission recordings = prepared(question_of(dead, rig(1.1).make()));
  EXPECT_FALSE(has_channel(recordings.train, "extensor/force"));
  EXPECT_FALSE(has_channel(recordings.train, "extensor/position"));
  EXPECT_TRUE(has_channel(recordings.train, "extensor/current"));
  EXPECT_TRUE(has_channel(recordings.train, "flexor/force"));
  EXPECT_TRUE(has_channel(recordings.test, "extensor/force"));
  EXPECT_TRUE(recordings.question.train[0].series("extensor/force").empty());
  ASSERT_GE(recordings.remarks.size(), 2u);
  EXPECT_TRUE(says(recordings.remarks[0], "extensor/position never changes"))
      << recordings.remarks[0];
  EXPECT_TRUE(says(recordings.remarks[1], "extensor/force never changes")) << recordings.remarks[1];
  EXPECT_TRUE(says(recordings.remarks[1], "left out")) << recordings.remarks[1];
}

TEST(FrozenColumns, AreLeftOutOfRepeatsToo) {
  Dataset repeat = rig(0.0).make();
  freeze(repeat, "extensor/force", 19.43);
  Question question = question_of(rig(0.0).make(), rig(1.1).make());
  question.repeats = {repeat};
  const Admission recordings = prepared(question);
  EXPECT_FALSE(has_channel(recordings.train, "extensor/force"));
  EXPECT_FALSE(has_channel(recordings.repeats, "extensor/force"));
}

TEST(FrozenColumns, AreKeptWhereNothingSaysThatTheyShouldChange) {
  const auto kept = [](const std::string& column, const Dataset& recording) {
    return has_channel(prepared(question_of(recording, rig(1.1).make())).train, column);
  };
  Dataset recording = rig(0.0).make();
  freeze(recording, "hinge/position", 0.4);  // at its stop
  EXPECT_TRUE(kept("hinge/position", recording));

  recording = rig(0.0).make();  // one motor is not moved
  freeze(recording, "extensor/reference", 2.0);
  freeze(recording, "extensor/position", 1.98);  // a coarse encoder
  freeze(recording, "extensor/current", 0.0);
  EXPECT_TRUE(kept("extensor/position", recording));
  EXPECT_TRUE(kept("extensor/current", recording));

  recording = rig(0.0).make();  // nor is it enabled here
  freeze(recording, "extensor/current", 0.0);
  Column& state = recording.table("muscles").column("extensor/ecu_state");
  std::fill(state.values.begin(), state.values.end(), 1.0);  // IDLE
  std::fill(state.present.begin(), state.present.end(), 1);
  const Admission idle = prepared(question_of(recording, rig(1.1).make()));
  EXPECT_TRUE(has_channel(idle.train, "extensor/current"));

  recording = rig(0.0).make();  // a slack tendon, maybe
  freeze(recording, "extensor/force", 0.0);
  EXPECT_TRUE(kept("extensor/force", recording));
  EXPECT_TRUE(
      says(remarks_on(question_of(recording, rig(1.1).make())), "extensor/force is always 0"));
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
