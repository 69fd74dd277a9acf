#include "comparison/comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "anthrob_recording/orientation_series.h"
#include "anthrob_recording/quantities.h"

namespace anthrob {

namespace {

/// Channels by name, in the order of their first columns: `joint` for the orientation of a ball
/// joint, else the column's own name. Words, such as modes, have no difference.
std::vector<std::string> channels_of(const Dataset& data) {
  std::vector<std::string> channels;
  for (const Table& table : data.tables) {
    for (const Column& column : table.columns) {
      const std::string quantity = column.quantity();
      const bool part = quantity == "x" || quantity == "y" || quantity == "z";
      if (part || holds_words(quantity)) continue;
      const std::string channel = quantity == "w" ? column.owner() : column.name;
      const bool known = std::find(channels.begin(), channels.end(), channel) != channels.end();
      if (!known) channels.push_back(channel);
    }
  }
  return channels;
}

bool is_orientation(const std::string& channel) {
  return channel.find('/') == std::string::npos;
}

/// A recording does not say whether a joint turns or slides.
std::string unit_of(const Dataset& data, const std::string& channel) {
  if (is_orientation(channel)) return "rad";
  const std::size_t slash = channel.find('/');
  const std::string owner = channel.substr(0, slash), quantity = channel.substr(slash + 1);
  const bool ball = quantity == "wx" || quantity == "wy" || quantity == "wz";
  const bool muscle = !data.series(owner + "/voltage").empty() ||
                      !data.series(owner + "/force").empty() ||
                      !data.series(owner + "/reference").empty();
  if (ball) return "rad/s";
  if (quantity == "position") return muscle ? "rad" : "rad or m";
  if (quantity == "velocity") return muscle ? "rad/s" : "rad/s or m/s";
  if (quantity == "current") return "A";
  if (quantity == "voltage") return "V";
  if (quantity == "force") return "N";
  if (quantity == "reference") return "V, rad, A or N";
  return quantity == "effort" || quantity == "load" ? "Nm or N" : "";
}

/// Gathers the differences of one channel.
class Gatherer {
 public:
  explicit Gatherer(ChannelDifference& to) : to_(to) {}
  void add(double time, double difference) {
    if (!std::isfinite(difference)) return;
    ++to_.samples;
    squares_ += difference * difference;
    to_.rms = std::sqrt(squares_ / to_.samples);
    if (std::abs(difference) <= to_.largest) return;
    to_.largest = std::abs(difference);
    to_.at = time;
  }

 private:
  ChannelDifference& to_;
  double squares_ = 0.0;
};

/// Calls `visit` with the number and time of each sample within the time of another series.
void within_both(const std::vector<double>& t, const std::vector<double>& other,
                 const std::function<void(std::size_t, double)>& visit) {
  if (other.empty()) return;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (t[i] >= other.front() && t[i] <= other.back()) visit(i, t[i]);
  }
}

void compare_numbers(const Series& a, const Series& b, bool held, Gatherer& found) {
  within_both(a.t, b.t, [&](std::size_t i, double time) {
    found.add(time, (held ? b.held_at(time) : b.at(time)) - a.values[i]);
  });
}

/// The angle of the rotation from one orientation to the other.
double angle_between(const std::array<double, 4>& a, const std::array<double, 4>& b) {
  double difference = 0.0, sum = 0.0;
  for (int k = 0; k < 4; ++k) {
    difference += (b[k] - a[k]) * (b[k] - a[k]);
    sum += (b[k] + a[k]) * (b[k] + a[k]);
  }
  return 4.0 *
         std::atan2(std::sqrt(std::min(difference, sum)), std::sqrt(std::max(difference, sum)));
}

void compare_orientations(const Dataset& a, const Dataset& b, const std::string& joint,
                          Gatherer& found) {
  const OrientationSeries of_a = OrientationSeries::read(a, joint),
                          of_b = OrientationSeries::read(b, joint);
  within_both(of_a.t(), of_b.t(), [&](std::size_t, double time) {
    std::array<double, 4> turn_a{}, turn_b{};
    of_a.at(time, turn_a.data());
    of_b.at(time, turn_b.data());
    found.add(time, angle_between(turn_a, turn_b));
  });
}

ChannelDifference difference_of(const Dataset& a, const Dataset& b, const std::string& channel) {
  ChannelDifference difference;
  difference.channel = channel;
  difference.unit = unit_of(a, channel);
  Gatherer gatherer(difference);
  if (is_orientation(channel)) {
    compare_orientations(a, b, channel, gatherer);
  } else {
    const bool held = channel.substr(channel.find('/') + 1) == "reference";
    compare_numbers(a.series(channel), b.series(channel), held, gatherer);
  }
  return difference;
}

}  // namespace

Comparison compare(const Dataset& a, const Dataset& b) {
  const std::vector<std::string> of_a = channels_of(a), of_b = channels_of(b);
  const auto has = [](const std::vector<std::string>& list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
  };
  Comparison comparison;
  for (const std::string& channel : of_a) {
    if (has(of_b, channel)) {
      comparison.channels.push_back(difference_of(a, b, channel));
    } else {
      comparison.only_a.push_back(channel);
    }
  }
  for (const std::string& channel : of_b) {
    if (!has(of_a, channel)) comparison.only_b.push_back(channel);
  }
  return comparison;
}

}  // namespace anthrob
