#include "scope/scope_model.h"

#include <gtest/gtest.h>

#include "scope/fake_sources.h"

namespace anthrob {
namespace {

const char* const kFlexor = "/robot/muscle_states/force/flexor";

class ScopeModelTest : public testing::Test {
 protected:
  std::shared_ptr<FakeTopics> topics_ = std::make_shared<FakeTopics>();
  ScopeModel model_{std::make_unique<FakeLive>(topics_), open_fake};
};

TEST_F(ScopeModelTest, ATopicIsHeardWhileItIsNeeded) {
  model_.poll();
  EXPECT_TRUE(topics_->heard.empty());
  model_.look_into({"/robot/muscle_states"});
  EXPECT_EQ(topics_->heard.size(), 1U);
  topics_->send(1, {"flexor", "extensor"}, {1.0, 2.0});
  model_.poll();
  EXPECT_EQ(model_.quantities().size(), 2U);
  EXPECT_TRUE(model_.curves().empty());
  model_.tick({kFlexor}, true);
  model_.look_into({});
  EXPECT_EQ(topics_->heard.size(), 1U);
  model_.tick({kFlexor}, false);
  EXPECT_TRUE(topics_->heard.empty());
}

TEST_F(ScopeModelTest, WhatIsTickedBeforeItsTopicIsThereIsHeardThen) {
  topics_->master.topics.clear();
  model_.tick({kFlexor}, true);
  model_.poll();
  EXPECT_TRUE(topics_->heard.empty());
  topics_->master.topics = {"/robot/muscle_states"};
  model_.poll();
  topics_->send(1000000000, {"flexor"}, {7.0});
  topics_->send(2000000000, {"flexor"}, {8.0});
  EXPECT_TRUE(model_.poll());
  const auto curves = model_.curves();
  ASSERT_EQ(curves.size(), 1U);
  EXPECT_EQ(curves[0].samples.back().value, 8.0);
  EXPECT_EQ(curves[0].seconds_of(curves[0].samples.back().t), 1.0);
}

TEST_F(ScopeModelTest, FrozenCurvesStayAndNothingIsLost) {
  model_.tick({kFlexor}, true);
  topics_->send(1, {"flexor"}, {1.0});
  model_.poll();
  model_.freeze(true);
  topics_->send(2, {"flexor"}, {2.0});
  model_.poll();
  EXPECT_EQ(model_.curves().at(0).samples.size(), 1U);
  model_.freeze(false);
  EXPECT_EQ(model_.curves().at(0).samples.size(), 2U);
}

TEST_F(ScopeModelTest, RecordingsLieUponEachOther) {
  model_.open("/data/a.bag");
  model_.tick({kFlexor}, true);
  model_.open("/data/b.bag");
  auto curves = model_.curves();
  ASSERT_EQ(curves.size(), 2U);
  EXPECT_EQ(curves[0].seconds_of(curves[0].samples.front().t), 0.0);
  EXPECT_EQ(curves[1].seconds_of(curves[1].samples.front().t), 0.0);
  auto pairs = pairs_of(curves);
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_NEAR(pairs[0].comparison.rms, 2.0, 1e-12);
  EXPECT_EQ(pairs[0].comparison.difference.size(), 1001U);
  // A second later, the rising force of b is lower by 1 N.
  model_.shift(2, 1.0);
  pairs = pairs_of(model_.curves());
  EXPECT_NEAR(pairs[0].comparison.rms, 1.0, 1e-9);
  EXPECT_EQ(pairs[0].comparison.difference.size(), 901U);
  model_.show(1, false);
  EXPECT_EQ(model_.curves().size(), 1U);
  model_.close(1);
  EXPECT_EQ(model_.sources().at(1).name, "b.bag");
  EXPECT_EQ(model_.curves().size(), 1U);
}

TEST_F(ScopeModelTest, ABadRecordingChangesNothing) {
  EXPECT_THROW(model_.open("/data/none.bag"), BadInput);
  EXPECT_EQ(model_.sources().size(), 1U);
}

}  // namespace
}  // namespace anthrob
