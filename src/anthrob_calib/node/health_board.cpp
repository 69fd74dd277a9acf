#include "health_board.h"

#include <anthrob_msgs/Health.h>

#include <cmath>
#include <system_error>

#include "anthrob_core/errors.h"
#include "health/health_report.h"

namespace anthrob {

namespace {

constexpr double kLookPeriod = 1.0;  // [s] of wall time

void add_figure(const std::string& muscle, health::Quantity quantity,
                const health::History::Series& series, const health::HealthOptions& options,
                anthrob_msgs::Health& message) {
  const health::Figure& last = series.back().figure;
  message.muscle.push_back(muscle);
  message.quantity.push_back(name_of(quantity));
  message.unit.push_back(unit_of(quantity));
  message.value.push_back(last.value);
  message.low.push_back(last.low);
  message.high.push_back(last.high);
  const auto trend = trend_of(quantity, series, options);
  message.change.push_back(trend ? trend->change() : NAN);
  message.visible.push_back(trend ? trend->visible : NAN);
  message.limit.push_back(trend ? trend->limit : NAN);
  message.per_day.push_back(trend ? trend->per_day : NAN);
  message.days.push_back(trend ? trend->days.value_or(NAN) : NAN);
}

anthrob_msgs::Health message_of(const health::History& history, const std::string& frame) {
  const health::HealthOptions options;
  const auto report = health::report_health("", history, {}, options);
  anthrob_msgs::Health message;
  message.header.stamp = ros::Time::now();
  message.header.frame_id = frame;
  message.time = health::time_of_day(history.last_day());
  message.headline = report.headline;
  message.warning = report.lines;
  for (const std::string& muscle : history.muscles()) {
    for (int k = 0; k < health::kQuantities; ++k) {
      const auto quantity = static_cast<health::Quantity>(k);
      const auto& series = history.series(muscle, quantity);
      if (!series.empty()) add_figure(muscle, quantity, series, options, message);
    }
  }
  return message;
}

}  // namespace

HealthBoard::HealthBoard(ros::NodeHandle nh, const std::string& folder, const std::string& frame)
    : frame_(frame) {
  if (folder.empty()) return;
  file_ = folder + "/health.csv";
  publisher_ = nh.advertise<anthrob_msgs::Health>("health", 1, true);
  timer_ = nh.createWallTimer(ros::WallDuration(kLookPeriod),
                              [this](const ros::WallTimerEvent&) { look(); });
  look();
}

void HealthBoard::look() {
  std::error_code none;
  const auto written = std::filesystem::last_write_time(file_, none);
  if (none || written == written_) return;
  written_ = written;
  try {
    const health::History history = health::History::load(file_);
    if (history.muscles().empty()) return;
    const auto message = message_of(history, frame_);
    for (const std::string& line : message.warning) ROS_WARN_STREAM("health: " << line);
    publisher_.publish(message);
  } catch (const BadInput& error) {
    ROS_ERROR_STREAM("health: " << error.what());
  }
}

}  // namespace anthrob
