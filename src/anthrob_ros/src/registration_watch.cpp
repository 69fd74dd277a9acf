#include "anthrob_ros/registration_watch.h"

#include <ros/console.h>
#include <ros/init.h>
#include <ros/master.h>

#include <chrono>
#include <stdexcept>

#include "anthrob_core/monotonic_clock.h"
#include "registration_rules.h"
#include "registrations.h"

namespace anthrob {

namespace {

constexpr double kAnswerPeriods = 5.0;  // periods, for one answer
constexpr double kFirstAnswer = 60.0;   // [s] for the first one: much starts at the same time

std::string master_text() {
  return "the ROS master at " + ros::master::getURI();
}

}  // namespace

/// What is known by the watch's thread only.
class RegistrationWatch::Implementation {
 public:
  /// @throws std::runtime_error if the master does not answer
  explicit Implementation(double seconds)
      : period(seconds),
        patience_(kAnswerPeriods * seconds),
        rules_(monotonic_now(), RegistrationRules::kPatience * seconds) {
    const double end = monotonic_now() + kFirstAnswer;
    Look first = look();
    while (first != Look::kRegistered && monotonic_now() < end && !ros::isShuttingDown()) {
      first = look();
    }
    if (first != Look::kRegistered && !ros::isShuttingDown())
      throw std::runtime_error(why(first) + "; start roscore, then this node again");
  }

  const std::chrono::duration<double> period;

  Look look() {
    const MasterAnswer answer = ask_master(patience_);
    if (answer.reach == Reach::kRefused) return Look::kGone;
    if (!answer.known) return Look::kSilent;
    expected_.add(*answer.known);
    expected_ = still_offered(expected_);
    missing_ = expected_.without(*answer.known);
    publishers_ = answer.publishers;
    return missing_.size() == 0 ? Look::kRegistered : Look::kIncomplete;
  }

  std::string why(Look look) const {
    switch (look) {
      case Look::kGone:
        return master_text() + " is gone";
      case Look::kIncomplete:
        return master_text() + " does not know this node any more (missing: " + missing_.text() +
               ")";
      case Look::kSilent:
      case Look::kRegistered:
        break;
    }
    return master_text() + " does not answer";
  }

  std::optional<Turn> see(Look look) { return rules_.see(look, monotonic_now()); }
  /// Of topics whose publishers are others than at the last look: the master tells us, too, but
  /// only once, and we may have had no descriptor to hear it.
  void refresh_changed() {
    for (const auto& [topic, publishers] : publishers_) {
      const auto before = connected_.find(topic);
      if (before != connected_.end() && before->second == publishers) continue;
      if (refresh_publishers(topic, patience_)) connected_[topic] = publishers;
    }
  }
  bool register_missing() { return register_again(missing_, patience_); }

 private:
  double patience_;  ///< [s] for one answer
  RegistrationRules rules_;
  Registrations expected_, missing_;
  PublishersByTopic publishers_;  ///< by the master's last answer
  PublishersByTopic connected_;   ///< of which we know
};

RegistrationWatch::RegistrationWatch(Lost lost, double period)
    : implementation_(std::make_unique<Implementation>(period)), on_lost_(std::move(lost)) {
  thread_ = std::thread([this] { watch(); });
}

RegistrationWatch::~RegistrationWatch() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    quit_ = true;
  }
  ended_.notify_all();
  thread_.join();
}

std::optional<std::string> RegistrationWatch::lost() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return why_;
}

void RegistrationWatch::watch() {
  for (;;) {
    {
      std::unique_lock<std::mutex> lock(mutex_);
      if (ended_.wait_for(lock, implementation_->period, [this] { return quit_; })) return;
    }
    const Look found = implementation_->look();
    note(found);
    if (found == Look::kRegistered) implementation_->refresh_changed();
    if (found != Look::kIncomplete || !implementation_->register_missing()) continue;
    note(implementation_->look());
  }
}

void RegistrationWatch::note(Look look) {
  // While ROS shuts down the registration ends, as it should.
  if (ros::isShuttingDown()) return;
  const std::optional<Turn> turn = implementation_->see(look);
  if (!turn) return;
  const bool lost = *turn == Turn::kLost;
  const std::string why = implementation_->why(look);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    why_ = lost ? std::optional<std::string>(why) : std::nullopt;
  }
  if (!lost) {
    ROS_WARN_STREAM("registered again with " << master_text());
    return;
  }
  if (on_lost_) on_lost_(why);
  ROS_ERROR_STREAM("registration lost: " << why << "; this node registers again when it can");
}

}  // namespace anthrob
