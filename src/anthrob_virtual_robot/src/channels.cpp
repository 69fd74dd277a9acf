#include "channels.h"

#include <algorithm>
#include <cmath>

namespace anthrob::virtual_robot {
namespace {

/// Sums squares of what differs, in units of the sensor's error.
class Tally final {
 public:
  void add(const std::string& channel, double difference, double sigma) {
    squares_[channel] += std::pow(difference / sigma, 2);
  }
  std::map<std::string, double> roots(std::size_t rows) const {
    std::map<std::string, double> result;
    for (const auto& [channel, sum] : squares_) {
      result[channel] = std::sqrt(sum / static_cast<double>(rows));
    }
    return result;
  }

 private:
  std::map<std::string, double> squares_;
};

/// What the control law makes of its sensors' errors [V], and what comes of it in the motor [A].
double voltage_sigma(const reference::ControllerParameters& controller,
                     const SensorSettings& sensors) {
  return std::hypot(controller.proportional * sensors.position.sigma(),
                    controller.derivative * sensors.velocity.sigma(),
                    controller.force_feedforward * sensors.force.sigma());
}

double current_sigma(const reference::MuscleParameters& muscle, const SensorSettings& sensors) {
  const double resistance = muscle.motor.resistance + muscle.motor.power_stage_resistance;
  return std::hypot(sensors.current.sigma(),
                    voltage_sigma(muscle.controller, sensors) / resistance);
}

}  // namespace

std::map<std::string, double> difference(const Recording& a, const Recording& b,
                                         const reference::ArmParameters& arm,
                                         const SensorSettings& sensors) {
  Tally tally;
  const std::size_t rows = std::min(a.samples.size(), b.samples.size());
  for (std::size_t k = 0; k < rows; ++k) {
    const Readings &x = a.samples[k].readings, &y = b.samples[k].readings;
    for (std::size_t i = 0; i < x.muscles.size(); ++i) {
      const std::string& name = arm.muscles[i].name;
      const MuscleReading &p = x.muscles[i], &q = y.muscles[i];
      tally.add(name + "/position", p.position - q.position, sensors.position.sigma());
      tally.add(name + "/velocity", p.velocity - q.velocity, sensors.velocity.sigma());
      tally.add(name + "/current", p.current - q.current, current_sigma(arm.muscles[i], sensors));
      tally.add(name + "/force", p.force - q.force, sensors.force.sigma());
      tally.add(name + "/voltage", a.samples[k].voltages[i] - b.samples[k].voltages[i],
                voltage_sigma(arm.muscles[i].controller, sensors));
    }
    tally.add("elbow/position", x.elbow - y.elbow, sensors.elbow.sigma());
    tally.add("shoulder/orientation", x.shoulder.angularDistance(y.shoulder),
              std::sqrt(3.0) * sensors.shoulder.sigma());
  }
  return tally.roots(rows);
}

std::pair<std::string, double> worst(const std::map<std::string, double>& channels) {
  return *std::max_element(channels.begin(), channels.end(),
                           [](const auto& x, const auto& y) { return x.second < y.second; });
}

}  // namespace anthrob::virtual_robot
