#include "job_servers.h"

namespace anthrob {

namespace {

jobs::CalibrateOrder order_of(const anthrob_msgs::CalibrateGoal& goal) {
  jobs::CalibrateOrder order;
  order.pipeline = goal.pipeline;
  order.config = goal.config;
  order.data = goal.data;
  order.validation = goal.validation;
  order.model = goal.model;
  order.out = goal.out;
  order.jobs = goal.jobs;
  order.seed = goal.seed;
  order.options = goal.options;
  return order;
}

jobs::DiscoverOrder order_of(const anthrob_msgs::DiscoverGoal& goal) {
  jobs::DiscoverOrder order;
  order.model = goal.model;
  order.calibration = goal.calibration;
  order.out = goal.out;
  order.train = goal.train;
  order.test = goal.test;
  order.repeat = goal.repeat;
  order.jobs = goal.jobs;
  order.seed = goal.seed;
  order.options = goal.options;
  return order;
}

jobs::HealthOrder order_of(const anthrob_msgs::HealthTestGoal& goal, jobs::HealthOrder usual) {
  if (!goal.model.empty()) usual.model = goal.model;
  if (!goal.out.empty()) usual.out = goal.out;
  return usual;
}

}  // namespace

JobServers::JobServers(const ros::NodeHandle& nh, const jobs::HealthOrder& usual)
    : calibrate_(
          nh, "calibrate",
          [](const anthrob_msgs::CalibrateGoal& goal) { return command_of(order_of(goal)); }),
      discover_(nh, "discover",
                [](const anthrob_msgs::DiscoverGoal& goal) { return command_of(order_of(goal)); }),
      health_(nh, "health/test", [usual](const anthrob_msgs::HealthTestGoal& goal) {
        return command_of(order_of(goal, usual));
      }) {}

}  // namespace anthrob
