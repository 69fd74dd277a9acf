#include "excitation.h"

#include <algorithm>
#include <cmath>

#include "posture_reference.h"

namespace anthrob::virtual_robot {
namespace {

constexpr double kCommandPeriod = 0.01;  // [s]
constexpr double kDegree = M_PI / 180.0;
constexpr double kWaypoint = 8.0 * kDegree;  // references are exact so often on the way

// Directions of the shoulder, humerus axes: to the side, to the front, about the bone.
const Eigen::Vector3d kAbduction(0.644, 0.0, -0.765);
const Eigen::Vector3d kFlexion(-0.765, 0.0, -0.644);

/// References along the way, at equal steps.
using Way = std::vector<std::vector<double>>;

Way way(const Pose& from, const Pose& to, PostureReference* reference) {
  const double turn =
      std::max((to.shoulder - from.shoulder).norm(), std::abs(to.elbow - from.elbow));
  const int count = 1 + static_cast<int>(turn / kWaypoint);
  Way way;
  for (int k = 0; k <= count; ++k) {
    way.push_back(reference->positions(blend(from, to, static_cast<double>(k) / count)));
  }
  return way;
}

std::vector<double> on_the_way(const Way& way, double share) {
  const double place = share * static_cast<double>(way.size() - 1);
  const std::size_t k = std::min(static_cast<std::size_t>(place), way.size() - 2);
  const double part = place - static_cast<double>(k);
  std::vector<double> result(way[k].size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = way[k][i] + part * (way[k + 1][i] - way[k][i]);
  }
  return result;
}

/// Minimum jerk.
double eased(double x) {
  return x * x * x * (10.0 + x * (6.0 * x - 15.0));
}

Pose somewhere(Random* random) {
  Pose pose;
  pose.shoulder = random->uniform(0.0, 38.0) * kDegree * kAbduction +
                  random->uniform(-10.0, 34.0) * kDegree * kFlexion +
                  random->uniform(-14.0, 14.0) * kDegree * Eigen::Vector3d::UnitY();
  // Beyond 90 degrees a straight triceps soon pulls the other way.
  pose.elbow = random->uniform(12.0, 75.0) * kDegree;
  pose.lowest_tension = random->pick<double>({3.0, 6.0, 6.0, 12.0});
  return pose;
}

/// Commands that grow move by move.
class Protocol final {
 public:
  Protocol(const reference::ArmParameters& believed, double seconds, Random* random)
      : reference_(believed), random_(random), seconds_(seconds) {
    // From where every robot is placed, so that nothing snaps into the first posture.
    here_.elbow = 10.0 * kDegree;
    here_.lowest_tension = 3.0;
    commands_.push_back({0.0, reference_.positions(here_)});
  }

  bool done() const { return t_ >= seconds_; }
  const Pose& here() const { return here_; }

  void go(const Pose& to, double duration) {
    const Way path = way(here_, to, &reference_);
    const int count = std::max(1, static_cast<int>(std::lround(duration / kCommandPeriod)));
    for (int k = 1; k <= count && !done(); ++k) {
      t_ += kCommandPeriod;
      commands_.push_back({t_, on_the_way(path, eased(static_cast<double>(k) / count))});
    }
    here_ = to;
  }
  void rest(double duration) { t_ += kCommandPeriod * std::lround(duration / kCommandPeriod); }

  /// To somewhere else, at some pace, and a pause.
  void wander() {
    go(somewhere(random_), random_->pick<double>({0.6, 0.6, 1.2, 2.4}));
    rest(random_->uniform(0.2, 0.8));
  }
  /// Away and back to the same posture.
  void revisit() {
    const Pose home = here_;
    go(somewhere(random_), 0.9);
    go(home, 0.9);
    rest(0.5);
  }
  /// The same posture with more and with less tension.
  void squeeze() {
    Pose pose = here_;
    pose.lowest_tension = here_.lowest_tension < 8.0 ? 15.0 : 2.0;
    const Pose home = here_;
    go(pose, 0.4);
    rest(0.4);
    go(home, 0.4);
    rest(0.3);
  }
  /// A little back and forth.
  void tremble() {
    const Pose home = here_;
    for (int k = 0; k < 3; ++k) {
      Pose pose = home;
      pose.shoulder += random_->uniform(2.0, 5.0) * kDegree * (k % 2 ? kAbduction : kFlexion);
      pose.elbow += random_->uniform(3.0, 8.0) * kDegree;
      go(pose, 0.3);
      go(home, 0.3);
    }
    rest(0.3);
  }

  std::vector<Command> take() {
    while (!commands_.empty() && commands_.back().t >= seconds_) commands_.pop_back();
    return std::move(commands_);
  }

 private:
  PostureReference reference_;
  Random* random_;
  double seconds_;
  double t_ = 0.0;
  Pose here_;
  std::vector<Command> commands_;
};

}  // namespace

std::vector<Command> excitation(const reference::ArmParameters& believed, double seconds,
                                Random random) {
  Protocol protocol(believed, seconds, &random);
  protocol.rest(0.5);
  while (!protocol.done()) {
    protocol.wander();
    protocol.squeeze();
    protocol.wander();
    protocol.tremble();
    protocol.wander();
    protocol.revisit();
  }
  return protocol.take();
}

}  // namespace anthrob::virtual_robot
