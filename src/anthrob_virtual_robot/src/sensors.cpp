#include "sensors.h"

#include <cmath>
#include <sstream>

namespace anthrob::virtual_robot {
namespace {

constexpr std::size_t kPerMuscle = 4;
constexpr std::size_t kJoints = 4;  // three of the shoulder, elbow

SensorErrors load_errors(const ConfigNode& node, const std::string& key, const std::string& unit) {
  SensorErrors errors;
  if (!node.has(key)) return errors;
  const ConfigNode section = node.at(key);
  errors.noise = section.number_or("noise", 0.0, Bounds::nonnegative(), unit);
  errors.quantum = section.number_or("quantum", 0.0, Bounds::nonnegative(), unit);
  errors.memory = section.number_or("memory", 0.0, Bounds::nonnegative(), "s");
  return errors;
}

std::string text(const std::string& name, const SensorErrors& errors) {
  std::ostringstream out;
  out << "  " << name << ": {noise: " << errors.noise << ", quantum: " << errors.quantum << "}\n";
  return out.str();
}

}  // namespace

double SensorErrors::sigma() const {
  return std::sqrt(noise * noise + quantum * quantum / 12.0);
}

SensorSettings SensorSettings::load(const ConfigNode& node) {
  SensorSettings settings;
  settings.position = load_errors(node, "position", "rad");
  settings.velocity = load_errors(node, "velocity", "rad/s");
  settings.current = load_errors(node, "current", "A");
  settings.force = load_errors(node, "force", "N");
  settings.elbow = load_errors(node, "elbow", "rad");
  settings.shoulder = load_errors(node, "shoulder", "rad");
  return settings;
}

std::string SensorSettings::yaml() const {
  return text("position", position) + text("velocity", velocity) + text("current", current) +
         text("force", force) + text("elbow", elbow) + text("shoulder", shoulder);
}

Sensors::Sensors(const SensorSettings& settings, std::size_t muscles, double period,
                 std::uint64_t seed)
    : settings_(settings),
      period_(period),
      random_(seed, 7),
      drifts_(kPerMuscle * muscles + kJoints, 0.0) {}

double Sensors::measured(const SensorErrors& errors, double* drift, double value) {
  if (errors.noise > 0.0) {
    const double keep = errors.memory > 0.0 ? std::exp(-period_ / errors.memory) : 0.0;
    *drift = keep * *drift + std::sqrt(1.0 - keep * keep) * errors.noise * random_.normal();
    value += *drift;
  }
  return errors.quantum > 0.0 ? errors.quantum * std::round(value / errors.quantum) : value;
}

void Sensors::measure(Readings* readings) {
  double* drift = drifts_.data();
  for (MuscleReading& muscle : readings->muscles) {
    muscle.position = measured(settings_.position, drift++, muscle.position);
    muscle.velocity = measured(settings_.velocity, drift++, muscle.velocity);
    muscle.current = measured(settings_.current, drift++, muscle.current);
    muscle.force = measured(settings_.force, drift++, muscle.force);
  }
  readings->elbow = measured(settings_.elbow, drift++, readings->elbow);
  Eigen::Vector3d turn;
  for (int k = 0; k < 3; ++k) turn(k) = measured(settings_.shoulder, drift++, 0.0);
  if (turn.isZero(0.0)) return;
  readings->shoulder =
      readings->shoulder * Eigen::Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
  if (readings->shoulder.w() < 0.0) readings->shoulder.coeffs() *= -1.0;
}

}  // namespace anthrob::virtual_robot
