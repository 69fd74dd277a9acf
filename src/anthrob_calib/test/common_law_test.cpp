#include "anthrob_calib/discovery/search/common_law.h"

#include <gtest/gtest.h>

#include <map>

#include "made_problem.h"

namespace anthrob {
namespace discovery {
namespace {

const std::vector<std::string> kMuscles = {"brachialis", "biceps_brachii", "triceps_brachii"};
constexpr const char* kLaw = "force_sensor_offset";

/// Forces of three muscles that pull with nothing, as offset sensors read them.
class OffsetForces final : public Experiment {
 public:
  using Offsets = std::map<std::string, double>;
  static constexpr std::size_t kBins = 300;

  OffsetForces(Offsets truth, std::uint64_t seed) : truth_(std::move(truth)) {
    for (const std::string& muscle : kMuscles) {
      channels_.push_back({muscle, "force", "N", 0, channels_.size() * kBins, kBins, 0.0});
    }
    present_.assign(channels_.size() * kBins, 1);
    bin_ = 0.02;
    duration_ = bin_ * kBins;
    const CounterRandom random(seed, 1);
    for (std::size_t i = 0; i < present_.size(); ++i) noise_.push_back(random.normal(i));
  }

  void compare(const std::shared_ptr<const RobotModel>& model, Starts&, float* out) const override {
    std::vector<ecu::Measurement> read(model->muscles.size());
    std::vector<double> positions(model->skeleton->position_count),
        velocities(model->skeleton->velocity_count);
    for (const auto& effect : model->reading_effects) {
      std::vector<double> memory(effect->state_size());
      Readings readings{read.data(), positions.data(), velocities.data()};
      effect->apply(readings, StateView(memory.data()));
    }
    for (const Channel& channel : channels_) {
      const double force = read[static_cast<std::size_t>(model->find_muscle(channel.place))].force;
      const double difference = force - truth_.at(channel.place);
      for (std::size_t b = 0; b < channel.count; ++b) {
        const std::size_t i = channel.offset + b;
        out[i] = static_cast<float>(difference + noise_[i]);
      }
    }
  }

 private:
  Offsets truth_;
  std::vector<double> noise_;
};

/// The first two muscles are named, each by itself.
struct TwoNamed {
  explicit TwoNamed(const OffsetForces::Offsets& truth)
      : problem({}, std::make_shared<OffsetForces>(truth, 1),
                std::make_shared<OffsetForces>(truth, 2), {kLaw}),
        with(problem.context.tested(problem.train.start({}, {}))),
        whole(all_of(problem)),
        screening(problem.train, with.fit, problem.candidates, whole, whole),
        common(problem.context, screening) {
    for (std::size_t e = 0; e < 2; ++e) {
      Score score;
      score.candidate = problem.index(kMuscles[e], kLaw);
      score.gain = 1.0;
      score.amount = {1.0, 0.0};
      with = problem.comparison.weigh(with, {score}).entries.at(0);
      parts.push_back({e, score.candidate});
    }
  }

  static Excerpt all_of(const MadeProblem& problem) {
    Excerpt excerpt{problem.train.experiments(), {}};
    for (std::size_t i = 0; i < excerpt.experiments.front()->size(); ++i) {
      excerpt.rows.push_back(static_cast<Eigen::Index>(i));
    }
    return excerpt;
  }

  MadeProblem problem;
  Tested with;
  Excerpt whole;
  Screening screening;
  CommonLaw common;
  std::vector<CommonLaw::Part> parts;
};

TEST(CommonLaw, OneLawAtSeveralPlacesMayBeEverywhere) {
  const TwoNamed two({{"brachialis", 4.0}, {"biceps_brachii", 4.0}, {"triceps_brachii", 4.0}});
  const std::size_t all = two.problem.index("all", kLaw);
  EXPECT_EQ(two.common.everywhere(two.parts), all);
  EXPECT_FALSE(two.common.everywhere({two.parts[0]}));
  EXPECT_FALSE(two.common.everywhere({two.parts[0], {1, all}}));
  const auto instead = two.common.instead(all, two.with, two.parts);
  ASSERT_TRUE(instead);
  EXPECT_TRUE(instead->is_clearly_better());
  const auto& effects = instead->tested.fit.variant.effects;
  ASSERT_EQ(effects.size(), 1u);
  EXPECT_EQ(effects[0].place, "all");
  EXPECT_NEAR(effects[0].parameters.at("offset"), 4.0, 0.1);
  // What it explains is there without it.
  EXPECT_GT(instead->without.squaredNorm(), 2.0f * instead->tested.test.squaredNorm());
}

TEST(CommonLaw, WhatIsAtTwoPlacesOnlyIsNotEverywhere) {
  TwoNamed two({{"brachialis", 4.0}, {"biceps_brachii", 4.0}, {"triceps_brachii", 0.0}});
  const auto instead = two.common.instead(two.problem.index("all", kLaw), two.with, two.parts);
  EXPECT_FALSE(instead && instead->is_better());
}

TEST(CommonLaw, IsNotFittedToTheEndWhereItCannotReachWhatIsNamed) {
  const auto simulations = [](double third) {
    TwoNamed two({{"brachialis", 4.0}, {"biceps_brachii", 4.0}, {"triceps_brachii", third}});
    const auto before = two.problem.evaluator.simulated();
    EXPECT_TRUE(two.common.instead(two.problem.index("all", kLaw), two.with, two.parts));
    return two.problem.evaluator.simulated() - before;
  };
  // To the end, both would take more than three quarters of the latter.
  EXPECT_LT(simulations(1.0), 0.75 * static_cast<double>(simulations(4.0)));
}

TEST(CommonLaw, WhatDiffersFromPlaceToPlaceIsNotOneLaw) {
  TwoNamed two({{"brachialis", 6.0}, {"biceps_brachii", 2.0}, {"triceps_brachii", 0.0}});
  const auto instead = two.common.instead(two.problem.index("all", kLaw), two.with, two.parts);
  EXPECT_FALSE(instead && instead->is_better());
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
