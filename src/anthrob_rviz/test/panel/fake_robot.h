#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "readings.h"
#include "robot_connection.h"

namespace anthrob {

/// What a fake robot was told, and what it tells.
struct FakeRobot {
  MuscleReadings muscles = {reading("flexor", 1.0), reading("extensor", -1.0)};
  bool talks = true;
  bool simulated = true;
  std::string connected;
  std::vector<ServiceRequest> calls;
  std::vector<Diagnosis> diagnostics;
  std::vector<CallResult> answers;
  std::vector<MuscleGroup> antagonists;
  std::optional<PlayerReading> player;
  std::optional<GapReading> gap;
  std::optional<HealthReading> health;
  std::vector<JobReading> jobs;
  std::vector<std::string> cancelled;
  int shouts = 0;

  /// Commands come from another thread.
  void receive(const std::vector<Reference>& command) {
    const std::lock_guard<std::mutex> lock(mutex_);
    commands_.push_back(command);
  }
  std::vector<std::vector<Reference>> take_commands() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::exchange(commands_, {});
  }

 private:
  std::mutex mutex_;
  std::vector<std::vector<Reference>> commands_;
};

/// A panel owns its connection; the test keeps the robot.
class FakeConnection final : public RobotConnection {
 public:
  explicit FakeConnection(std::shared_ptr<FakeRobot> robot) : robot_(std::move(robot)) {}

  void connect(const std::string& robot) override { robot_->connected = robot; }
  News look() override {
    News news;
    if (robot_->talks) news.muscles = robot_->muscles;
    news.diagnostics = std::exchange(robot_->diagnostics, {});
    news.answers = std::exchange(robot_->answers, {});
    news.antagonists = std::exchange(robot_->antagonists, {});
    news.player = robot_->player;
    news.gap = std::exchange(robot_->gap, std::nullopt);
    news.health = std::exchange(robot_->health, std::nullopt);
    news.jobs = std::exchange(robot_->jobs, {});
    return news;
  }
  void send(const std::vector<Reference>& references) override { robot_->receive(references); }
  bool call(const ServiceRequest& request) override {
    robot_->calls.push_back(request);
    return true;
  }
  void shout_stop() override { ++robot_->shouts; }
  void cancel(const std::string& job) override { robot_->cancelled.push_back(job); }
  bool simulated() const override { return robot_->simulated; }
  ReferenceLimits limits() const override { return {}; }

 private:
  std::shared_ptr<FakeRobot> robot_;
};

}  // namespace anthrob
