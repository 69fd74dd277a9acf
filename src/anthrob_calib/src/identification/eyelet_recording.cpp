#include <algorithm>
#include <cmath>

#include "anthrob_core/errors.h"
#include "anthrob_core/text.h"
#include "identification/capstan_fit.h"
#include "identification/number_text.h"
#include "identification/rig_recording.h"

namespace anthrob {
namespace identification {

namespace {

constexpr char kRig[] = "eyelet rig";
constexpr double kSmoothing = 0.05;  ///< speeds are taken over twice this [s]
constexpr double kMargin = 0.2;      ///< left out at both ends of a motion [s]
constexpr double kShortest = 1.0;    ///< steady motion that is worth a mean [s]
constexpr double kBlocks = 10.0;     ///< pieces of a mean, for its error
constexpr double kSteady = 0.15;     ///< deviation from the usual speed that counts as steady

/// Speed by the encoder over a window, so that its counts do not show [rad/s].
std::vector<double> smoothed_speed(const RigColumns& columns) {
  const auto& position = columns.values[0];
  const auto reach =
      std::max<std::size_t>(1, static_cast<std::size_t>(kSmoothing / columns.period()));
  std::vector<double> speed(position.size());
  for (std::size_t i = 0; i < position.size(); ++i) {
    const std::size_t a = i > reach ? i - reach : 0, b = std::min(i + reach, position.size() - 1);
    speed[i] = (position[b] - position[a]) / (columns.t[b] - columns.t[a]);
  }
  return speed;
}

/// The speed at which the line mostly moves in one direction, 0 if it does not.
double usual_speed(const std::vector<double>& speed, double direction) {
  double top = 0.0;
  for (const double v : speed) top = std::max(top, direction * v);
  std::vector<double> moving;
  for (const double v : speed) {
    if (direction * v > 0.5 * top) moving.push_back(direction * v);
  }
  if (moving.empty()) return 0.0;
  std::nth_element(moving.begin(), moving.begin() + static_cast<std::ptrdiff_t>(moving.size() / 2),
                   moving.end());
  return moving[moving.size() / 2];
}

struct Stretch {
  std::size_t begin, end;
};

std::vector<Stretch> steady_stretches(const std::vector<double>& speed, double direction,
                                      double period) {
  const double usual = usual_speed(speed, direction);
  const auto margin = static_cast<std::size_t>(kMargin / period);
  std::vector<Stretch> stretches;
  for (std::size_t i = 0; i < speed.size(); ++i) {
    if (usual <= 0.0 || std::abs(direction * speed[i] - usual) > kSteady * usual) continue;
    std::size_t end = i;
    while (end < speed.size() && std::abs(direction * speed[end] - usual) <= kSteady * usual) ++end;
    if (static_cast<double>(end - i) * period >= kShortest + 2.0 * kMargin) {
      stretches.push_back({i + margin, end - margin});
    }
    i = end;
  }
  return stretches;
}

double constant_load(const Dataset& recording) {
  const RigColumns columns = read_columns(recording, kRig, {"weight/load"});
  const auto [least, most] =
      std::minmax_element(columns.values[0].begin(), columns.values[0].end());
  if (!(*least > 0.0) || *most - *least > 0.01 * *most) {
    throw BadInput(recording_name(recording) + ": weight/load: from " + exact_text(*least) +
                   " to " + exact_text(*most) +
                   " N: expected one constant positive load per recording");
  }
  return *least;
}

}  // namespace

EyeletRecording EyeletRecording::read(const Dataset& recording) {
  RigColumns columns = read_columns(recording, kRig, {"tendon/position", "tendon/force"});
  const double load = constant_load(recording);
  const ConfigNode meta = rig_meta(recording);
  EyeletRecording result;
  result.name = recording_name(recording);
  result.specimen = meta.at("specimen").at("number").as_integer(1, 1000000);
  const double turning = meta.at("rig").number("turning", Bounds{0.0, 10.0, true, false}, "rad");
  result.turning_sigma =
      meta.at("rig").number_or("turning_sigma", 0.0, Bounds::nonnegative(), "rad");
  for (const char* part : {"specimen", "rig"}) meta.at(part).refuse_unknown_keys();
  result.speed = smoothed_speed(columns);
  result.t = std::move(columns.t);
  result.force = std::move(columns.values[1]);

  const double period =
      (result.t.back() - result.t.front()) / static_cast<double>(result.t.size() - 1);
  // The creep of a line at rest is no motion.
  const double fastest = std::max(usual_speed(result.speed, 1.0), usual_speed(result.speed, -1.0));
  for (const double direction : {1.0, -1.0}) {
    if (usual_speed(result.speed, direction) < 0.1 * fastest) continue;
    for (const Stretch& stretch : steady_stretches(result.speed, direction, period)) {
      const std::vector<double> piece(
          result.force.begin() + static_cast<std::ptrdiff_t>(stretch.begin),
          result.force.begin() + static_cast<std::ptrdiff_t>(stretch.end));
      const auto block = static_cast<std::size_t>(static_cast<double>(piece.size()) / kBlocks);
      const Estimate force = mean_of_series(piece, std::max<std::size_t>(1, block));
      if (!(force.value > 0.0)) {
        throw BadInput(result.name + ": tendon/force: mean of " + significant(force.value, 3) +
                       " N while the line moves: expected a positive number; reverse the sign of "
                       "the column");
      }
      result.points.push_back({result.name, load, turning, direction > 0.0, force});
    }
  }
  if (result.points.empty()) {
    throw BadInput(result.name +
                   ": tendon/position: never steady for 1.4 s: expected the line pulled or "
                   "relaxed at constant speed; is the recording cut off?");
  }
  return result;
}

}  // namespace identification
}  // namespace anthrob
