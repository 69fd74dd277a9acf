#include "ros/messages.h"

#include <algorithm>

namespace anthrob {
namespace {

MuscleReading reading_at(const anthrob_msgs::MuscleStates& message, std::size_t i) {
  MuscleReading reading;
  reading.name = message.name[i];
  reading.position = message.position[i];
  reading.voltage = message.voltage[i];
  reading.force = message.force[i];
  reading.reference = message.reference[i];
  reading.mode = message.mode[i];
  reading.state = static_cast<EcuState>(message.ecu_state[i]);
  return reading;
}

}  // namespace

std::optional<MuscleReadings> readings_of(const anthrob_msgs::MuscleStates& message) {
  const std::size_t size = message.name.size();
  for (const std::size_t length :
       {message.position.size(), message.voltage.size(), message.force.size(),
        message.reference.size(), message.mode.size(), message.ecu_state.size()}) {
    if (length != size) return std::nullopt;
  }
  MuscleReadings readings;
  for (std::size_t i = 0; i < size; ++i) readings.push_back(reading_at(message, i));
  return readings;
}

PlayerReading reading_of(const anthrob_msgs::PlayerState& message) {
  return {message.bag, message.duration, message.position, message.rate, message.paused != 0};
}

std::optional<GapReading> reading_of(const anthrob_msgs::Gap& message) {
  if (message.gap.size() != message.window.size() * message.channel.size() * message.feed.size() ||
      message.window.size() < 2) {
    return std::nullopt;
  }
  return GapReading{message.channel, message.feed, message.window, message.gap};
}

Diagnosis diagnosis_of(const diagnostic_msgs::DiagnosticStatus& status) {
  Diagnosis diagnosis;
  diagnosis.name = status.name;
  diagnosis.level = static_cast<Level>(std::clamp<int>(status.level, 0, 3));
  diagnosis.message = status.message;
  for (const auto& entry : status.values) diagnosis.values.emplace_back(entry.key, entry.value);
  return diagnosis;
}

anthrob_msgs::MuscleCommand command_of(const std::vector<Reference>& references) {
  anthrob_msgs::MuscleCommand command;
  for (const Reference& reference : references) {
    command.name.push_back(reference.muscle);
    command.mode.push_back(static_cast<std::uint8_t>(reference.mode));
    command.reference.push_back(reference.value);
  }
  return command;
}

}  // namespace anthrob
