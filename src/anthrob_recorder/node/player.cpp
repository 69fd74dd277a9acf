#include "player.h"

#include <anthrob_msgs/PlayerState.h>
#include <rosgraph_msgs/Clock.h>

#include <cmath>

#include "anthrob_core/monotonic_clock.h"

namespace anthrob {
namespace {

constexpr double kTick = 0.005;        // [s]
constexpr double kStatePeriod = 0.05;  // [s]
constexpr double kConnect = 1.0;       // [s] for subscribers, before the first message
/// [s] until everybody has read the clock after a jump: who sees a message first takes it for one
/// that comes late.
constexpr double kClockRead = 0.1;

}  // namespace

Player::Player(ros::NodeHandle nh, ros::NodeHandle own, PlayedBag& bag,
               const Playback::Options& options)
    : bag_(bag), playback_(bag.duration(), options), last_(monotonic_now()) {
  bag_.advertise(nh);
  clock_ = nh.advertise<rosgraph_msgs::Clock>("/clock", 1);
  state_ = own.advertise<anthrob_msgs::PlayerState>("state", 1);
  services_.push_back(own.advertiseService("seek", &Player::on_seek, this));
  services_.push_back(own.advertiseService("set_rate", &Player::on_rate, this));
  services_.push_back(own.advertiseService("pause", &Player::on_pause, this));
}

bool Player::run() {
  const double begin = monotonic_now() + kConnect;
  for (ros::WallRate rate(1.0 / kTick); ros::ok(); rate.sleep()) {
    ros::spinOnce();
    const double now = monotonic_now();
    if (now >= begin && !advance(now)) return true;
    last_ = now;
    tell_time();
    tell_state(now);
  }
  return false;
}

bool Player::advance(double now) {
  const Playback::Step step = playback_.advance(show_ ? 0.0 : now - last_);
  if (step == Playback::Step::kEnded) return false;
  if (step == Playback::Step::kJumped) {
    published_ = time();
    jumped_ = now;
    if (!show_) show_ = now + kClockRead;
  }
  show_place(now);
  if (!show_) bag_.publish(published_, time()), published_ = time();
  return true;
}

/// At most ten times a second, however often somebody drags the time bar.
void Player::show_place(double now) {
  if (!show_ || now < *show_) return;
  bag_.publish_last(time());
  published_ = time();
  show_.reset();
  if (now < jumped_ + kClockRead) show_ = now + kClockRead;
}

void Player::tell_time() {
  rosgraph_msgs::Clock clock;
  clock.clock = time();
  clock_.publish(clock);
}

void Player::tell_state(double now) {
  if (now < next_state_) return;
  next_state_ = now + kStatePeriod;
  anthrob_msgs::PlayerState state;
  state.bag = bag_.file();
  state.duration = playback_.duration(), state.position = playback_.position();
  state.rate = playback_.rate();
  state.paused = playback_.paused(), state.loop = playback_.loops();
  state_.publish(state);
}

bool Player::on_seek(anthrob_msgs::Seek::Request& request, anthrob_msgs::Seek::Response& response) {
  if (!std::isfinite(request.position)) {
    response.message = "position: expected a number [s]";
    return true;
  }
  playback_.seek(request.position);
  response.success = true;
  response.message = "at " + std::to_string(playback_.position()) + " s";
  return true;
}

bool Player::on_rate(anthrob_msgs::SetRate::Request& request,
                     anthrob_msgs::SetRate::Response& response) {
  if (!(request.factor > 0.0) || !std::isfinite(request.factor)) {
    response.message = "factor " + std::to_string(request.factor) + ": expected a number above 0";
    return true;
  }
  playback_.set_rate(request.factor);
  response.success = true;
  return true;
}

bool Player::on_pause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
  playback_.pause(request.data != 0);
  response.success = true;
  response.message = request.data != 0 ? "paused" : "plays";
  return true;
}

}  // namespace anthrob
